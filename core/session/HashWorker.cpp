#include "core/session/HashWorker.h"

namespace tacto {

namespace {

/// About 40 us of hashing: less than twice the price of waking a thread.
constexpr std::size_t kWorthHandingOver = 32 * 1024;

}  // namespace

ChunkChecks checksOf(std::span<const std::span<const std::byte>> parts) { return {bulkDigest(parts), crc32(parts)}; }

HashWorker::HashWorker() : thread_([this] { run(); }) {}

HashWorker::~HashWorker() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void HashWorker::start(std::span<const std::byte> first, std::span<const std::byte> second) {
    const bool handOver = first.size() + second.size() >= kWorthHandingOver;
    {
        const std::lock_guard lock(mutex_);
        parts_ = {first, second};
        if (!handOver) checks_ = checksOf(parts_);
        step_ = handOver ? Step::Wanted : Step::Done;
    }
    if (handOver) changed_.notify_all();
}

ChunkChecks HashWorker::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return step_ != Step::Wanted; });
    step_ = Step::Idle;
    return checks_;
}

void HashWorker::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ending_ || step_ == Step::Wanted; });
        if (ending_) return;
        const auto parts = parts_;
        lock.unlock();
        const auto checks = checksOf(parts);
        lock.lock();
        checks_ = checks;
        step_ = Step::Done;
        changed_.notify_all();
    }
}

}  // namespace tacto
