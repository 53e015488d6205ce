// StopCounter.h - counts how often the operator has stopped the output (H2). A stop is never forgotten: it cannot be
// taken back.
//
// Output is requested at one moment, by a click or a command, and starts later, on another thread, perhaps after
// devices took seconds to open. The mark is taken at the request, and the request is carried out only if no stop has
// come since. A new order takes a new mark, and so runs after an old stop.
//
// Thread-safety: any thread may call anything; lock-free.
#pragma once

#include <atomic>
#include <cstdint>

namespace tacto {

/// The moment at which an operator requested something. An empty mark, or the mark of another counter, is treated as
/// stopped: an order with a forgotten mark starts nothing.
class StopMark {
public:
    StopMark() noexcept = default;

private:
    friend class StopCounter;
    explicit StopMark(std::uint64_t count) noexcept : count_(count) {}
    std::uint64_t count_ = 0;
};

class StopCounter {
public:
    StopCounter() noexcept : count_(firstCount()) {}
    StopCounter(const StopCounter&) = delete;
    StopCounter& operator=(const StopCounter&) = delete;

    /// Counts a stop. The caller first raises the counter and then switches off, so that anything started in between
    /// finds the counter raised.
    void raise() noexcept { count_.fetch_add(1, std::memory_order_acq_rel); }
    /// Returns a mark for now. Take the mark when the operator asks, not when the order is carried out.
    [[nodiscard]] StopMark mark() const noexcept { return StopMark(count_.load(std::memory_order_acquire)); }
    /// True if a stop has come since `mark` was taken.
    [[nodiscard]] bool movedSince(StopMark mark) const noexcept {
        return count_.load(std::memory_order_acquire) != mark.count_;
    }

private:
    /// Differs in every counter, so that no counter accepts another's mark; never 0.
    static std::uint64_t firstCount() noexcept {
        static std::atomic<std::uint64_t> counters{0};
        return (counters.fetch_add(1) + 1) << 40U;
    }
    std::atomic<std::uint64_t> count_;
};

}  // namespace tacto
