#include "app/scripting/wire/MemoryGuard.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

constexpr std::chrono::milliseconds kPollInterval{20};
constexpr std::size_t kMaxGuardedBytes = std::size_t{2} << 30;

/// Returns this process's resident memory in bytes from /proc/self/statm, or 0 if the system does not tell.
std::size_t resident(int statm) noexcept {
    char line[128];
    const ssize_t read = ::pread(statm, line, sizeof line, 0);
    std::string_view pages(line, read > 0 ? static_cast<std::size_t>(read) : 0);
    pages.remove_prefix(std::min(pages.find(' ') + 1, pages.size()));  // the first number counts addresses
    const auto inMemory = parseWhole<std::size_t>(pages.substr(0, pages.find(' ')));
    return inMemory.value_or(0) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Returns the memory in bytes that the system can still give to programs.
std::size_t available() noexcept {
    std::FILE* file = std::fopen("/proc/meminfo", "re");
    if (file == nullptr) return kMaxGuardedBytes;
    char line[128];
    std::size_t kilobytes = 0;
    while (kilobytes == 0 && std::fgets(line, sizeof line, file) != nullptr) {
        std::string_view text = line;
        if (!text.starts_with("MemAvailable:")) continue;
        text.remove_prefix(std::min(text.find_first_of("0123456789"), text.size()));
        kilobytes = parseWhole<std::size_t>(text.substr(0, text.find(' '))).value_or(0);
    }
    static_cast<void>(std::fclose(file));
    return kilobytes == 0 ? kMaxGuardedBytes : std::size_t{1024} * kilobytes;
}

/// Returns the first number in a file of the kernel, or nothing if it has none ("max").
std::optional<std::size_t> numberIn(const std::string& path) {
    std::ifstream file(path);
    std::size_t value = 0;
    if (!(file >> value)) return std::nullopt;
    return value;
}

/// Returns the bytes that the control groups of this program leave: its own group and all enclosing groups.
std::size_t leftByGroup() {
    std::size_t left = std::numeric_limits<std::size_t>::max();
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        if (!line.starts_with("0::/")) continue;
        for (auto group = line.substr(3);; group = group.substr(0, group.rfind('/'))) {
            const auto folder = "/sys/fs/cgroup" + group;
            const auto most = numberIn(folder + "/memory.max");
            const auto used = numberIn(folder + "/memory.current");
            if (most && used) left = std::min(left, *most > *used ? *most - *used : 0);
            if (group.empty() || group == "/") break;
        }
    }
    return left;
}

/// Returns what a resource limit leaves after what this program uses: field `field` of /proc/self/statm.
std::size_t leftByLimit(int resource, int field) {
    rlimit limit{};
    if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::numeric_limits<std::size_t>::max();
    std::ifstream statm("/proc/self/statm");
    std::size_t pages = 0;
    for (int i = 0; i <= field; ++i) statm >> pages;
    const std::size_t used = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}

}  // namespace

std::size_t MemoryGuard::usualLimit() {
    constexpr int kAddressSpace = 0, kData = 5;
    return std::min({kMaxGuardedBytes, available() / 2, leftByGroup() / 2, leftByLimit(RLIMIT_AS, kAddressSpace) / 2,
                     leftByLimit(RLIMIT_DATA, kData) / 2});
}

MemoryGuard::MemoryGuard(std::function<void()> onExceeded, std::size_t most, std::function<void()> eachTime)
    : onExceeded_(std::move(onExceeded)),
      eachTime_(std::move(eachTime)),
      statm_(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC)),
      thread_([this, most] { watch(most); }) {}

MemoryGuard::~MemoryGuard() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    ending_.notify_all();
    thread_.join();
    if (statm_ >= 0) ::close(statm_);
}

void MemoryGuard::watch(std::size_t most) {
    const std::size_t before = resident(statm_);
    std::unique_lock lock(mutex_);
    while (!ending_.wait_for(lock, kPollInterval, [this] { return ended_; })) {
        if (eachTime_) eachTime_();
        const std::size_t now = resident(statm_);
        if (now <= before || now - before <= most) continue;
        lock.unlock();
        onExceeded_();
        return;
    }
}

}  // namespace tacto
