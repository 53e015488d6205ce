// CommitThread.h - lets a commit write to disk while the next chunk is hashed on another core.
//
// Hashing and the disk one after the other would cost a third of the recording rate (tests/perf/SessionPerf.cpp).
//
// Thread-safety: one caller. Between start() and the end of the job the caller does not touch what the job touches.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "core/base/Result.h"

namespace tacto {

class CommitThread {
public:
    using Job = std::function<Result<void>()>;

    CommitThread();
    ~CommitThread();  ///< waits for a running job
    CommitThread(const CommitThread&) = delete;
    CommitThread& operator=(const CommitThread&) = delete;

    /// Runs `job` on the other thread. The one before must have been waited for.
    void start(Job job);
    /// True while a job runs. Never waits for it.
    [[nodiscard]] bool busy() const;
    /// The result of the last job, once; success when there is none to report.
    [[nodiscard]] Result<void> wait();

private:
    void run();

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Job job_;  // Guarded by mutex_, as all below; not empty while it waits or runs
    Result<void> result_;
    bool ending_ = false;
    std::thread thread_;  // Last: starts when all else is there
};

}  // namespace tacto
