// EmulatedPty.h - the emulated stimulator behind a pseudo-terminal, for programs that open a terminal: this project's
// own, in another process, or another program's.
//
// Thread-safety: every function from any thread. A thread of its own carries the bytes.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/Clock.h"
#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

namespace tacto::sciencemode {

class EmulatedPty {
public:
    /// `clock` outlives it and is steady. Errors: Io when the system gives no pseudo-terminal.
    [[nodiscard]] static Result<std::unique_ptr<EmulatedPty>> open(EmulatedSettings settings, const Clock& clock);
    ~EmulatedPty();
    EmulatedPty(const EmulatedPty&) = delete;
    EmulatedPty& operator=(const EmulatedPty&) = delete;

    /// What to open, "/dev/pts/3".
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// Calls `look(device, now)` while nothing else does.
    template <class Look>
    auto inspect(Look&& look) {
        const std::scoped_lock lock(mutex_);
        return look(device_, clock_.now());
    }

private:
    EmulatedPty(EmulatedSettings settings, const Clock& clock) : clock_(clock), device_(std::move(settings)) {}
    void run();
    void answer();

    const Clock& clock_;
    std::mutex mutex_;
    EmulatedStimulator device_;  // guarded by mutex_
    // Constant once open() has returned:
    int master_ = -1;
    int slave_ = -1;  // held open, so that a client may come and go
    int wake_ = -1;
    std::string path_;
    std::atomic<bool> quitting_{false};
    std::thread thread_;  // Last: starts when all else is ready
};

}  // namespace tacto::sciencemode
