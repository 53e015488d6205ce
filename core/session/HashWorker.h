// HashWorker.h - hashes a chunk on a second core while the first one gives it to SQLite.
//
// Hashing in line would cost a third of the recording rate (tests/perf/SessionPerf.cpp). Chunks too small to be worth
// the hand-over are hashed by the caller.
//
// Thread-safety: one caller, which starts a job and waits for it before the next.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <thread>

#include "core/session/Digest.h"

namespace tacto {

struct ChunkChecks {
    Digest digest{};
    std::uint32_t crc = 0;
};

[[nodiscard]] ChunkChecks checksOf(std::span<const std::span<const std::byte>> parts);

class HashWorker {
public:
    HashWorker();
    ~HashWorker();
    HashWorker(const HashWorker&) = delete;
    HashWorker& operator=(const HashWorker&) = delete;

    /// The bytes must stay until wait() returned.
    void start(std::span<const std::byte> first, std::span<const std::byte> second);
    [[nodiscard]] ChunkChecks wait();

private:
    enum class Step { Idle, Wanted, Done };
    void run();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::array<std::span<const std::byte>, 2> parts_;  // Guarded by mutex_, as all below
    ChunkChecks checks_;
    Step step_ = Step::Idle;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace tacto
