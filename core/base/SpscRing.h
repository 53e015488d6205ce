// SpscRing.h - a bounded queue between exactly one producer thread and one consumer thread.
//
// Neither side ever waits or allocates. When the ring is full the producer drops the oldest element and
// counts it: the newest data matter most to a control loop, and a loss must be seen, not guessed.
//
// Memory order. `head_` counts elements ever pushed, `tail_` elements ever taken or dropped; both only
// grow. A slot is published by the release store of `head_` and read after the acquire load of it, so
// the consumer sees the element whole. Because the producer too may advance `tail_` (to drop), the
// consumer claims a slot by compare-exchange on `tail_` *after* copying the element out: if the
// producer dropped that slot meanwhile the exchange fails, and the copy, which may be torn, is thrown
// away. The producer in turn overwrites a slot only after it moved `tail_` past it (acq_rel), so no
// claimed copy can overlap a write. Elements are copied word by word through atomics, which makes the
// discarded torn copy defined behaviour rather than a data race; the words are stored with release and
// loaded with acquire, so a consumer that saw any new word also sees the `tail_` moved before it was
// written, and its exchange must fail. (Fences would do too; the thread sanitizer cannot see those.)
//
// Thread-safety: one producer thread and one consumer thread; see each function.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

namespace tacto {

template <class T>
class SpscRing {
    static_assert(std::is_trivially_copyable_v<T>, "a slot may be copied while the producer drops it");

public:
    using Element = T;

    /// Room for `capacity` elements (at least 1). Allocates here and never again.
    explicit SpscRing(std::size_t capacity) : capacity_(capacity == 0 ? 1 : capacity), slots_(capacity_ * kWords) {}

    /// Producer only. Drops the oldest element when full.
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

    /// Consumer only. The oldest element, or nothing when empty.
    [[nodiscard]] std::optional<T> pop() noexcept {
        std::uint64_t tail = tail_.load(std::memory_order_acquire);
        for (;;) {
            if (tail == head_.load(std::memory_order_acquire)) return std::nullopt;
            std::uint64_t words[kWords];
            const auto* slot = slotAt(tail);
            for (std::size_t i = 0; i < kWords; ++i) words[i] = slot[i].load(std::memory_order_acquire);
            if (tail_.compare_exchange_weak(tail, tail + 1, std::memory_order_acq_rel, std::memory_order_acquire)) {
                T element;
                std::memcpy(static_cast<void*>(&element), words, sizeof(T));
                return element;
            }
        }
    }

    /// Elements lost to overflow since construction. Any thread.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }

private:
    static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
    using Slot = std::atomic<std::uint64_t>;
    [[nodiscard]] Slot* slotAt(std::uint64_t position) noexcept { return &slots_[(position % capacity_) * kWords]; }

    const std::size_t capacity_;  // Constant after construction
    std::vector<Slot> slots_;
    alignas(64) std::atomic<std::uint64_t> head_{0};
    alignas(64) std::atomic<std::uint64_t> tail_{0};
    alignas(64) std::atomic<std::uint64_t> dropped_{0};
};

// The newest value of something, written by one thread and read by any.
//
// A sequence lock: the writer never waits; a reader that met a write in progress reads again. Values are
// copied word by word through atomics (release stores, acquire loads), so a torn copy is thrown away
// rather than undefined: a reader that saw any new word also sees the odd sequence number before it.
// The writer stores what differs from the value before: telemetry is written each step, and most of it stays.

template <class T>
class Latest {
    static_assert(std::is_trivially_copyable_v<T>, "a copy may be torn and thrown away");

public:
    /// There is one writer at a time.
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
    std::array<std::uint64_t, kWords> written_{};  ///< the words as last written, for the writer alone
};

}  // namespace tacto
