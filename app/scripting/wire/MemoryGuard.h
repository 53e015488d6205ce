// MemoryGuard.h - watches how much memory a process takes while a script runs: the script's own, and the program's,
// which keeps what the script tells it to keep. Otherwise the kernel would kill one of them (hazard H10).
//
// Thread-safety: constructed and destroyed by one thread; `onExceeded` is called once, from the guard's own thread.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>

namespace tacto {

class MemoryGuard {
public:
    /// What a script may grow by, and make the program grow by, in bytes: 2 GiB, or half of the memory that is free now
    /// if that is less, or of what a resource limit or a control group leaves.
    [[nodiscard]] static std::size_t usualLimit();

    /// Calls `onExceeded` when the process has grown by more than `most` bytes since now. Looks every 20 ms, and calls
    /// `eachTime` then.
    explicit MemoryGuard(std::function<void()> onExceeded, std::size_t most = usualLimit(),
                         std::function<void()> eachTime = {});
    ~MemoryGuard();
    MemoryGuard(const MemoryGuard&) = delete;
    MemoryGuard& operator=(const MemoryGuard&) = delete;

private:
    void watch(std::size_t most);

    std::function<void()> onExceeded_, eachTime_;
    const int statm_;  // open from the start on: later nothing may be opened
    std::mutex mutex_;
    std::condition_variable ending_;
    bool ended_ = false;  // guarded
    std::thread thread_;
};

}  // namespace tacto
