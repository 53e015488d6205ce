// ConfirmButton.h - the button of a second step. It needs a press of its own: a press that began before the button
// appeared has no effect (hazard H12).
//
// The button ignores presses until it has been visible for half a second, so the second half of a double click does
// nothing. The time of the press decides: while the window is stuck, an earlier press may arrive long after the button
// appeared. The button has no mnemonic, because a held Alt+letter repeats; Return presses it through StopKeys, which
// counts a held key as one press. If the meaning of a visible button changes (Pause, Resume), call setMeaning(): it
// then ignores presses again for half a second.
#pragma once

#include <QInputEvent>
#include <QPushButton>
#include <chrono>
#include <optional>

namespace tacto::gui {

// The time when a key, a button or a finger went down, on the computer's steady clock.
//
// Qt passes on the window system's event time in milliseconds. X and Wayland on this computer use the same clock as
// steady_clock, so the delay from the device to the window does not enter a response time. A time outside the last ten
// seconds comes from another clock (remote display, test); the time of arrival is used instead.

using SteadyTime = std::chrono::steady_clock::time_point;

[[nodiscard]] SteadyTime timeOf(const QInputEvent& event);
/// `stamp_ms`: the event's time; only its lowest 32 bits are used, because X has no more.
[[nodiscard]] SteadyTime timeOf(quint64 stamp_ms, SteadyTime arrival);

class ConfirmButton final : public QPushButton {
    Q_OBJECT
public:
    static constexpr int kDebounce_ms = 500;
    explicit ConfirmButton(const QString& text, QWidget* parent = nullptr);
    /// Sets the meaning of a press from now on; `text` may have a mnemonic. `confirms` true: the button is a second
    /// step, ignores presses for kDebounce_ms, and a press that has already begun does nothing. False: every press
    /// works at once, as needed for stop, pause and disarm. The same meaning again changes nothing.
    void setMeaning(const QString& text, bool confirms);
    /// True if a press made at `pressed` is meant for the button's present meaning. Code on clicked() must ask this too
    /// if the meaning changes, because keys and screen readers press without the mouse.
    [[nodiscard]] bool listens(SteadyTime pressed = std::chrono::steady_clock::now()) const;

protected:
    bool event(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

private:
    std::optional<SteadyTime> seen_;  // when the button was first painted with this meaning
    QString meaning_;                 // the text given to setMeaning()
    bool confirms_ = true;
};

}  // namespace tacto::gui
