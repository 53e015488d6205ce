// SpscRing.h - a queue of limited length between exactly one producer thread and one consumer thread.
//
// Neither thread ever waits or allocates. If the ring is full, the producer drops the oldest element and counts the
// loss: a control loop needs the newest data most, and a loss must be visible.
//
// Memory order. `head_` counts elements ever pushed, `tail_` elements ever taken or dropped; both only grow. The
// release store of `head_` publishes a slot, and the consumer reads the slot after an acquire load of `head_`, so it
// sees the whole element. Because the producer too may advance `tail_` (to drop), the consumer claims slots by
// compare-exchange on `tail_` *after* copying the elements out: if the producer dropped one of them meanwhile, the
// exchange fails and the consumer discards its copies, which may be torn. The producer overwrites a slot only after
// moving `tail_` past it (acq_rel), so no claimed copy can overlap a write. Elements are copied word by word through
// atomics, so that a torn copy is defined behaviour and not a data race. Words are stored with release and loaded with
// acquire, so a consumer that saw any new word also sees the `tail_` moved before it was written, and its exchange must
// fail. (Fences would also work, but the thread sanitizer does not understand them.)
//
// Thread-safety: one producer thread and one consumer thread; see each function.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace tacto {

template <class T>
class SpscRing {
    static_assert(std::is_trivially_copyable_v<T>, "a slot may be copied while the producer drops it");

public:
    using Element = T;

    /// Room for `capacity` elements (at least 1). Allocates here and never again.
    explicit SpscRing(std::size_t capacity)
        : capacity_(capacity == 0 ? 1 : capacity), slots_(std::bit_ceil(capacity_) * kWords) {}

    /// Producer only. Drops the oldest element if the ring is full.
    void push(const T& element) noexcept {
        const std::uint64_t head = head_.load(std::memory_order_relaxed);
        std::uint64_t tail = tail_.load(std::memory_order_acquire);
        if (head - tail >= capacity_ &&
            tail_.compare_exchange_strong(tail, tail + 1, std::memory_order_acq_rel, std::memory_order_acquire)) {
            dropped_.fetch_add(1, std::memory_order_relaxed);
        }
        std::uint64_t words[kWords] = {};
        std::memcpy(words, &element, sizeof(T));
        auto* slot = slotAt(head);
        for (std::size_t i = 0; i < kWords; ++i) slot[i].store(words[i], std::memory_order_release);
        head_.store(head + 1, std::memory_order_release);
    }

    /// Consumer only. Returns the oldest element, or nothing if the ring is empty.
    [[nodiscard]] std::optional<T> pop() noexcept {
        T element;
        return pop(std::span(&element, 1)) == 1 ? std::optional(element) : std::nullopt;
    }

    /// Consumer only. Takes the oldest elements, as many as there are and `into` has room for; returns their number.
    [[nodiscard]] std::size_t pop(std::span<T> into) noexcept {
        std::uint64_t tail = tail_.load(std::memory_order_acquire);
        for (;;) {
            const auto count = std::min<std::uint64_t>(head_.load(std::memory_order_acquire) - tail, into.size());
            if (count == 0) return 0;
            for (std::uint64_t k = 0; k < count; ++k) {
                std::uint64_t words[kWords];
                const auto* slot = slotAt(tail + k);
                for (std::size_t i = 0; i < kWords; ++i) words[i] = slot[i].load(std::memory_order_acquire);
                std::memcpy(static_cast<void*>(&into[k]), words, sizeof(T));
            }
            if (tail_.compare_exchange_weak(tail, tail + count, std::memory_order_acq_rel, std::memory_order_acquire))
                return count;
        }
    }

    /// Number of elements lost to overflow since construction. Any thread.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }

private:
    static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
    using Slot = std::atomic<std::uint64_t>;
    [[nodiscard]] Slot* slotAt(std::uint64_t position) noexcept { return &slots_[(position & mask_) * kWords]; }

    const std::size_t capacity_;  // constant after construction
    const std::size_t mask_ = std::bit_ceil(capacity_) - 1;
    std::vector<Slot> slots_;  // a power of two, so that no position is divided
    alignas(64) std::atomic<std::uint64_t> head_{0};
    alignas(64) std::atomic<std::uint64_t> tail_{0};
    alignas(64) std::atomic<std::uint64_t> dropped_{0};
};

// The newest value of something, written by one thread and read by any thread.
//
// A sequence lock: the writer never waits; a reader reads again if the writer was active meanwhile. Values are copied
// word by word through atomics (release stores, acquire loads), so a torn copy is defined behaviour and is discarded: a
// reader that saw any new word also sees the odd sequence number before it. The writer stores only words that changed,
// since telemetry is written in each step and mostly stays the same.

template <class T>
class Latest {
    static_assert(std::is_trivially_copyable_v<T>, "a copy may be torn and thrown away");

public:
    /// Only one thread may write.
    void write(const T& value) noexcept {
        const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
        auto* const written = reinterpret_cast<std::byte*>(written_.data());
        const auto sequence = sequence_.load(std::memory_order_relaxed);
        sequence_.store(sequence + 1, std::memory_order_release);
        for (std::size_t word = 0; word < kWords; word += kBlock) {
            const auto at = word * sizeof(std::uint64_t);
            const auto size = std::min(kBlock * sizeof(std::uint64_t), sizeof(T) - at);
            if (std::memcmp(written + at, bytes + at, size) == 0) continue;
            std::memcpy(written + at, bytes + at, size);
            for (auto i = word; i < std::min(word + kBlock, kWords); ++i)
                words_[i].store(written_[i], std::memory_order_release);
        }
        sequence_.store(sequence + 2, std::memory_order_release);
    }

    /// Any thread.
    [[nodiscard]] T read() const noexcept {
        std::uint64_t words[kWords];
        std::uint64_t before;
        do {
            before = sequence_.load(std::memory_order_acquire);
            for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
        } while ((before & 1U) != 0 || before != sequence_.load(std::memory_order_acquire));
        T value;
        std::memcpy(static_cast<void*>(&value), words, sizeof(T));
        return value;
    }

private:
    static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
    static constexpr std::size_t kBlock = 32;  ///< words that are compared at a time
    std::atomic<std::uint64_t> sequence_{0};
    std::array<std::atomic<std::uint64_t>, kWords> words_{};
    std::array<std::uint64_t, kWords> written_{};  ///< the last written words; only the writer uses them
};

}  // namespace tacto
