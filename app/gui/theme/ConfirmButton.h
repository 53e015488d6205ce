// ConfirmButton.h - the button of a second step: it takes a press of its own and nothing that was under way when it
// came (hazard H12).
//
// It is deaf until it has been in sight for half a second, so the second half of a double click does not press it. What
// counts is when the press was made: while the window stands still, one that was made before may arrive long after the
// button is in sight. It has no mnemonic, since a held Alt+letter repeats. Return presses it through StopKeys, which
// takes a held key for one press.
// A button whose meaning changes while it is shown (Pause, Resume) says so by setMeaning(), and is deaf after that.
#pragma once

#include <QInputEvent>
#include <QPushButton>
#include <chrono>
#include <optional>

namespace tacto::gui {

// When a key, a button or a finger went down, by the computer's steady clock.
//
// Qt hands on the window system's time of an event in milliseconds. X and Wayland on this computer take it from the
// same clock as steady_clock, so the way from the device to the window does not count into a response time. A time that
// is not within the last ten seconds is of another clock (a remote display, a test): then the moment of arrival counts.

using SteadyTime = std::chrono::steady_clock::time_point;

[[nodiscard]] SteadyTime timeOf(const QInputEvent& event);
/// `stamp_ms`: the event's; only its lowest 32 bits are looked at, as X has no more.
[[nodiscard]] SteadyTime timeOf(quint64 stamp_ms, SteadyTime arrival);

class ConfirmButton final : public QPushButton {
    Q_OBJECT
public:
    static constexpr int kDebounce_ms = 500;
    explicit ConfirmButton(const QString& text, QWidget* parent = nullptr);
    /// What a press does from now on; `text` may have a mnemonic. `confirms`: it is a second step; it is deaf for
    /// kDebounce_ms, and a press that is under way does nothing. Otherwise it takes every press at once, as what stops,
    /// pauses or disarms must. The same meaning again changes nothing.
    void setMeaning(const QString& text, bool confirms);
    /// Whether a press made at `pressed` is meant for what the button does now. Code that acts on clicked() where the
    /// meaning changes asks this too: keys and screen readers press without the mouse.
    [[nodiscard]] bool listens(SteadyTime pressed = std::chrono::steady_clock::now()) const;

protected:
    bool event(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

private:
    std::optional<SteadyTime> seen_;  // first painted with this meaning
    QString meaning_;                 // the text that setMeaning() got
    bool confirms_ = true;
};

}  // namespace tacto::gui
