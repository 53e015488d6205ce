// Latest.h - the newest value of something, written by one thread and read by any.
//
// A sequence lock: the writer never waits; a reader that met a write in progress reads again. Values are
// copied word by word through atomics (release stores, acquire loads), so a torn copy is thrown away
// rather than undefined: a reader that saw any new word also sees the odd sequence number before it.
// The writer stores what differs from the value before: telemetry is written each step, and most of it stays.
//
// Thread-safety: write() has one caller at a time; read() any thread.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tacto {

template <class T>
class Latest {
    static_assert(std::is_trivially_copyable_v<T>, "a copy may be torn and thrown away");

public:
    /// One writer at a time.
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
