// StopButton.h - STOP: calls `stop` the moment a press goes down within its rectangle, whatever lies on top.
//
// Qt gives a press to what lies on top, a floating dock or a dialog, and every press to an open popup. So the button
// looks at each press of the program before any widget does, and takes those that lie on it as its own: nothing else
// sees them. Presses on a participant's window are not taken; it has a STOP of its own. Where the display does not say
// how windows lie (Wayland), a press counts where Qt takes the windows to be.
#pragma once

#include <QPushButton>
#include <QWidget>
#include <functional>
#include <optional>

#include "core/safety/Interlock.h"

namespace tacto::gui {

class StopButton final : public QPushButton {
    Q_OBJECT
public:
    StopButton(std::function<void()> stop, QWidget* parent);
    /// Shows a hint in place of the keys below the word.
    void setHint(const QString& hint);
    /// Room for the word and the keys: never cut.
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] static std::optional<QPoint> pressedAt(const QEvent& event);
    bool taken_ = false;  // the press whose release comes next
    const std::function<void()> stop_;
    QString hint_;
};

/// STOP in a small window by itself, with the state of the output below the word, that stays above the windows of other
/// programs and takes no focus.
class SmallStop final : public QWidget {
public:
    /// `stop` as of StopButton. It begins at the lower right of the screen that `beside` is on.
    SmallStop(std::function<void()> stop, const QWidget& beside);
    void showState(InterlockState state);
    /// Whether this display lets a program keep a window above others: Wayland does not.
    [[nodiscard]] static bool staysAbove();

private:
    StopButton* stop_;
};

}  // namespace tacto::gui
