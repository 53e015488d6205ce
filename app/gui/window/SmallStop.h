// SmallStop.h - STOP in a small window by itself, with the state of the output below the word, that stays above the
// windows of other programs and takes no focus.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <functional>

#include "core/safety/Interlock.h"

namespace tacto::gui {

class StopButton;

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
