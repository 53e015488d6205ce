#include "app/scripting/MemoryGuard.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace tacto {

namespace {

constexpr std::chrono::milliseconds kLook{20};
constexpr std::size_t kMost = std::size_t{2} << 30;

/// Resident memory of this program in bytes; 0 where the system does not tell.
std::size_t resident() noexcept {
    std::FILE* file = std::fopen("/proc/self/statm", "re");
    if (file == nullptr) return 0;
    unsigned long all = 0, inMemory = 0;
    const bool read = std::fscanf(file, "%lu %lu", &all, &inMemory) == 2;
    static_cast<void>(std::fclose(file));
    return read ? inMemory * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// Memory that programs can still be given, in bytes.
std::size_t available() noexcept {
    std::FILE* file = std::fopen("/proc/meminfo", "re");
    if (file == nullptr) return kMost;
    char line[128];
    unsigned long kilobytes = 0;
    while (std::fgets(line, sizeof line, file) != nullptr) {
        if (std::sscanf(line, "MemAvailable: %lu kB", &kilobytes) == 1) break;
    }
    static_cast<void>(std::fclose(file));
    return kilobytes == 0 ? kMost : std::size_t{1024} * kilobytes;
}

}  // namespace

std::size_t MemoryGuard::usualLimit() noexcept { return std::min(kMost, available() / 2); }

MemoryGuard::MemoryGuard(std::function<void()> onExceeded, std::size_t most)
    : onExceeded_(std::move(onExceeded)), thread_([this, most] { watch(most); }) {}

MemoryGuard::~MemoryGuard() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    ending_.notify_all();
    thread_.join();
}

void MemoryGuard::watch(std::size_t most) {
    const std::size_t before = resident();
    std::unique_lock lock(mutex_);
    while (!ending_.wait_for(lock, kLook, [this] { return ended_; })) {
        const std::size_t now = resident();
        if (now <= before || now - before <= most) continue;
        lock.unlock();
        onExceeded_();
        return;
    }
}

}  // namespace tacto
