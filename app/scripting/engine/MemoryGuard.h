// MemoryGuard.h - watches how much memory the program takes while a script runs: otherwise the kernel would kill the
// program when a script takes all of it (hazard H10).
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
    /// What a script may make the program grow by, in bytes: 2 GiB, or half of the memory that is free now if that is
    /// less, or of what a resource limit or a control group leaves. The captures that are held for it count.
    [[nodiscard]] static std::size_t usualLimit();

    /// Calls `onExceeded` when the program has grown by more than `most` bytes since now. Looks every 20 ms.
    explicit MemoryGuard(std::function<void()> onExceeded, std::size_t most = usualLimit());
    ~MemoryGuard();
    MemoryGuard(const MemoryGuard&) = delete;
    MemoryGuard& operator=(const MemoryGuard&) = delete;

private:
    void watch(std::size_t most);

    std::function<void()> onExceeded_;
    std::mutex mutex_;
    std::condition_variable ending_;
    bool ended_ = false;  // guarded
    std::thread thread_;
};

}  // namespace tacto
