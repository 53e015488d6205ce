// StopButton.h - the STOP button: calls `stop` as soon as a press goes down within its rectangle, even if covered.
//
// Qt sends a press to the topmost widget (a floating dock or a dialog), and to an open popup always. So the button
// looks at each press in the program before any widget and takes those within its rectangle; nothing else sees them. It
// leaves presses on a participant's window, which has its own STOP. If the display does not report the windows'
// positions (Wayland), the positions that Qt assumes decide.
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
    /// Shows a hint instead of the keys below the word.
    void setHint(const QString& hint);
    /// Large enough for word and keys, so that neither is cut off.
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] static std::optional<QPoint> pressedAt(const QEvent& event);
    bool taken_ = false;  // the release of a taken press must be taken too
    const std::function<void()> stop_;
    QString hint_;
};

/// STOP in a small window with the output's state below the word. It stays above the windows of other programs and
/// never takes the focus.
class SmallStop final : public QWidget {
public:
    /// For `stop` see StopButton. The window first appears at the lower right of the screen with `beside`.
    SmallStop(std::function<void()> stop, const QWidget& beside);
    void showState(InterlockState state);
    /// True if the display lets a program keep a window above others; false on Wayland.
    [[nodiscard]] static bool staysAbove();

private:
    StopButton* stop_;
};

}  // namespace tacto::gui
