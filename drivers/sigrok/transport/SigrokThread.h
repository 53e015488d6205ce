// SigrokThread.h - the thread that does everything for one instrument: scan, settings, session loop, close.
//
// libsigrok runs a session on its thread's GLib main context, and some of its calls wait for an instrument without
// limit. So each instrument has its own thread and main context, callers wait only as long as they choose, and a thread
// that never returns is left behind with everything it holds instead of blocking the program.
//
// Thread-safety: any thread but this one may call post() and run(); one thread constructs and destroys.
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
    /// Ends the thread after the queued jobs. Waits at most 0.8 s, then leaves the thread running.
    ~SigrokThread();
    SigrokThread(const SigrokThread&) = delete;
    SigrokThread& operator=(const SigrokThread&) = delete;

    /// Runs `job` after the earlier jobs. The job must own what it uses: it may run after this object is gone.
    void post(Job job);
    /// Runs the job and waits. Errors: the job's; Timeout if it has not returned after `timeout` (it keeps running).
    [[nodiscard]] Result<void> run(std::function<Result<void>()> job, Seconds timeout, std::string_view what);
    /// Waits at most `timeout`; true if no job runs or waits.
    [[nodiscard]] bool idle(Seconds timeout) const;

private:
    struct State;
    const std::shared_ptr<State> state_;
};

}  // namespace tacto::sigrok_driver
