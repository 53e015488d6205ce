// CommitThread.h - a thread for one job at a time: packs chunks and commits them to disk while the caller gathers the
// next ones, or checks samples while the caller reads on.
//
// Thread-safety: one caller. From start() until the job ends, the caller must not touch what the job uses.
#pragma once

#include <atomic>
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

    /// Runs `job` on the other thread. Call wait() for the previous job first.
    void start(Job job);
    /// Whether a job is running. Never waits.
    [[nodiscard]] bool busy() const noexcept { return busy_.load(std::memory_order_acquire); }
    /// Waits, and returns the result of the last job, once; success if there is no result to report.
    [[nodiscard]] Result<void> wait();

private:
    void run();

    std::mutex mutex_;
    std::condition_variable changed_;
    Job job_;  // guarded by mutex_, like the two below; not empty while the job waits or runs
    Result<void> result_;
    bool ending_ = false;
    std::atomic<bool> busy_{false};  // whether job_ is not empty
    std::thread thread_;             // the last member, since the thread uses the others
};

}  // namespace tacto
