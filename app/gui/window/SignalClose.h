// SignalClose.h - Ctrl+C in the terminal of the window, termination and a terminal that closes: the output goes off at
// once, even while the window is busy, and then the window closes without a question, so that the session is closed
// (hazard H2).
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "app/gui/window/MainWindow.h"
#include "app/run/SignalStop.h"

namespace tacto::gui {

class SignalClose {
public:
    /// A signal that comes this long after the first one ends the program: the window does not close.
    static constexpr std::chrono::seconds kExitTimeout{5};

    /// `stops` was made before any other thread and outlives this; `window` does too.
    SignalClose(SignalStop& stops, MainWindow& window);
    /// Signals no longer reach the window; what kExitTimeout says still holds.
    ~SignalClose();
    SignalClose(const SignalClose&) = delete;
    SignalClose& operator=(const SignalClose&) = delete;

private:
    /// The moment of the first signal.
    using First = std::shared_ptr<std::optional<std::chrono::steady_clock::time_point>>;  // the waiting thread's
    static void note(const First& first);

    SignalStop& stops_;
    const First first_ = std::make_shared<First::element_type>();
};

}  // namespace tacto::gui
