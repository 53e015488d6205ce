#include "core/analysis/variation/IndexedWork.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tacto {

namespace {

constexpr std::chrono::milliseconds kPollInterval{50};

/// A new thread inherits the vector registers of its starting thread. If their upper halves are still in use, which the
/// scripts' engine causes, scalar mathematics waits for them at every step: 7 to 10 times slower when measured.
void clearUpperHalves() noexcept {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx")) asm volatile("vzeroupper");
#endif
}

/// Shared by the caller and its threads for one call.
struct Crew {
    Crew(const IndexedWork& work, std::stop_token token) : wanted(work), stop(std::move(token)) {}
    const IndexedWork& wanted;
    const std::stop_token stop;
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> done{0};
    std::atomic<bool> broken{false};
    std::mutex mutex;
    std::condition_variable_any changed;
    std::size_t working = 0;  // guarded by mutex
    std::string reason;       // guarded by mutex

    void run() {
        clearUpperHalves();
        while (!stop.stop_requested() && !broken) {
            const std::size_t index = next.fetch_add(1);
            if (index >= wanted.count) break;
            try {
                wanted.work(index);
                ++done;
            } catch (const std::exception& surprise) {  // no exception crosses a thread
                breakOff(surprise.what());
            } catch (...) {
                breakOff("an unknown exception");
            }
        }
        const std::lock_guard lock(mutex);
        --working;
        changed.notify_all();
    }

    void breakOff(const char* why) {
        broken = true;
        const std::lock_guard lock(mutex);
        if (reason.empty()) reason = why;
    }
};

}  // namespace

Result<std::size_t> runIndexed(const IndexedWork& wanted, std::stop_token stop) {
    Crew crew(wanted, std::move(stop));
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    const std::size_t most = wanted.threads == 0 ? cores : wanted.threads;
    {
        std::vector<std::jthread> threads;  // joined at the end of this scope, also after an error
        for (std::size_t i = 0; i < std::min(most, wanted.count); ++i) {
            {
                const std::lock_guard lock(crew.mutex);
                ++crew.working;
            }
            try {
                threads.emplace_back([&crew] { crew.run(); });
            } catch (const std::system_error& refused) {
                const std::lock_guard lock(crew.mutex);
                --crew.working;
                if (!threads.empty()) break;  // continue with fewer threads
                return fail(ErrorCode::Unsupported, "no thread could be started: {}", refused.what());
            }
        }
        std::unique_lock lock(crew.mutex);
        while (crew.working > 0) {
            crew.changed.wait_for(lock, kPollInterval, [&crew] { return crew.working == 0; });
            if (!wanted.progress) continue;
            lock.unlock();
            try {
                wanted.progress(crew.done);
            } catch (...) {
                crew.breakOff("the progress display failed");
            }
            lock.lock();
        }
    }
    if (crew.broken) return fail(ErrorCode::Unsupported, "the prediction failed: {}", crew.reason);
    return crew.done.load();
}

}  // namespace tacto
