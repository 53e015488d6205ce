// Latest.h - the newest value of something, written by one thread and read by any.
//
// A sequence lock: the writer never waits; a reader that met a write in progress reads again. Values are
// copied word by word through atomics (release stores, acquire loads), so a torn copy is thrown away
// rather than undefined: a reader that saw any new word also sees the odd sequence number before it.
//
// Thread-safety: write() has one caller at a time; read() any thread.
#pragma once

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
        std::uint64_t words[kWords] = {};
        std::memcpy(words, &value, sizeof(T));
        const auto sequence = sequence_.load(std::memory_order_relaxed);
        sequence_.store(sequence + 1, std::memory_order_release);
        for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
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
    std::atomic<std::uint64_t> sequence_{0};
    std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace tacto
