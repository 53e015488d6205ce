// StopCounter.h - how often the operator has stopped the output (H2). A stop is never forgotten: there is no way to
// take one back.
//
// Everything that starts output is asked for at a moment, by a click or a command, and is carried out later, on another
// thread, perhaps after devices took seconds to open. The mark is taken at that moment; what is asked for is carried
// out only if no stop has come since. A new order takes a new mark, and so runs after an old stop.
//
// Thread-safety: any thread may call anything; lock-free.
#pragma once

#include <atomic>
#include <cstdint>

namespace tacto {

/// The moment at which an operator asked for something. A mark from no counter, or from another one, counts as stopped:
/// an order with a forgotten mark starts nothing.
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

    /// A stop. The caller raises the counter first and switches off afterwards, so that what is started in between
    /// finds it raised.
    void raise() noexcept { count_.fetch_add(1, std::memory_order_acq_rel); }
    /// Now. Taken when the operator asks, not when the order is carried out.
    [[nodiscard]] StopMark mark() const noexcept { return StopMark(count_.load(std::memory_order_acquire)); }
    /// Whether a stop has come since `mark` was taken.
    [[nodiscard]] bool movedSince(StopMark mark) const noexcept {
        return count_.load(std::memory_order_acquire) != mark.count_;
    }

private:
    /// Apart in every counter, so that none honours another's mark, and never 0.
    static std::uint64_t firstCount() noexcept {
        static std::atomic<std::uint64_t> counters{0};
        return (counters.fetch_add(1) + 1) << 40U;
    }
    std::atomic<std::uint64_t> count_;
};

}  // namespace tacto
