// SignalClose.h - handles Ctrl+C in the window's terminal, termination, and a closed terminal: the output goes off at
// once, even while the window is busy. Then the window closes without a question, so that the session is closed (hazard
// H2).
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "app/gui/window/MainWindow.h"
#include "app/run/SignalStop.h"

namespace tacto::gui {

class SignalClose {
public:
    /// If the window has not closed by this time after the first signal, another signal ends the program.
    static constexpr std::chrono::seconds kExitTimeout{5};

    /// `stops` was made before any other thread and outlives this; `window` outlives this too.
    SignalClose(SignalStop& stops, MainWindow& window);
    /// Signals no longer reach the window, but kExitTimeout still applies.
    ~SignalClose();
    SignalClose(const SignalClose&) = delete;
    SignalClose& operator=(const SignalClose&) = delete;

private:
    /// The time of the first signal.
    using First = std::shared_ptr<std::optional<std::chrono::steady_clock::time_point>>;  // used by the waiting thread
    static void note(const First& first);

    SignalStop& stops_;
    const First first_ = std::make_shared<First::element_type>();
};

}  // namespace tacto::gui
