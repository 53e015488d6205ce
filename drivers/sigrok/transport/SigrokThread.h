// SigrokThread.h - the thread on which everything of one instrument happens: scan, settings, session loop, close.
//
// libsigrok runs a session on the GLib main context of its thread, and some of its calls wait for an instrument for as
// long as that likes. So each instrument has a thread with a main context of its own, callers wait for it no longer
// than they say, and one that never comes back is left behind with all it holds instead of stopping the program.
//
// Thread-safety: post(), run() any thread but its own; construction and destruction one thread.
#pragma once

#include <functional>
#include <memory>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto::sigrok_driver {

class SigrokThread {
public:
    using Job = std::function<void()>;  ///< must not throw

    SigrokThread();
    /// Ends after the jobs that are waiting. Waits for that at most 0.8 s, then leaves the thread to itself.
    ~SigrokThread();
    SigrokThread(const SigrokThread&) = delete;
    SigrokThread& operator=(const SigrokThread&) = delete;

    /// Runs `job` after those before it. What it uses it must own: it may run after this object is gone.
    void post(Job job);
    /// Runs the job and waits. Errors: the job's; Timeout when it has not come back after `timeout` (it still runs).
    [[nodiscard]] Result<void> run(std::function<Result<void>()> job, Seconds timeout, std::string_view what);
    /// Whether nothing runs or waits, at the latest after `timeout`.
    [[nodiscard]] bool idle(Seconds timeout) const;

private:
    struct State;
    const std::shared_ptr<State> state_;
};

}  // namespace tacto::sigrok_driver
