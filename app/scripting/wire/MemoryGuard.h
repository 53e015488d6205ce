// MemoryGuard.h - watches the memory of a process while a script runs: of the script's process, and of the program,
// which keeps data for the script. Without this limit the kernel might kill one of them (hazard H10).
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
    /// Returns the number of bytes by which a script, and the program because of it, may grow: 2 GiB, or less if half
    /// of the free memory, a resource limit or a control group allows less.
    [[nodiscard]] static std::size_t usualLimit();

    /// Calls `onExceeded` when the process has grown by more than `most` bytes from now on. Checks every 20 ms, and
    /// calls `eachTime` at every check.
    explicit MemoryGuard(std::function<void()> onExceeded, std::size_t most = usualLimit(),
                         std::function<void()> eachTime = {});
    ~MemoryGuard();
    MemoryGuard(const MemoryGuard&) = delete;
    MemoryGuard& operator=(const MemoryGuard&) = delete;

private:
    void watch(std::size_t most);

    std::function<void()> onExceeded_, eachTime_;
    const int statm_;  // opened at the start, because files cannot be opened later
    std::mutex mutex_;
    std::condition_variable ending_;
    bool ended_ = false;  // guarded by mutex_
    std::thread thread_;
};

}  // namespace tacto
