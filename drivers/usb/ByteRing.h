// ByteRing.h - a queue of bytes with a limited size: when full, the oldest bytes are dropped and counted.
//
// Allocates only at construction.
//
// Thread-safety: none; the owner locks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tacto {

class ByteRing {
public:
    explicit ByteRing(std::size_t capacity) : bytes_(std::max<std::size_t>(capacity, 1)) {}

    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return bytes_.size(); }
    /// Returns how many bytes were dropped since construction.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

    void push(std::span<const std::uint8_t> arrived) noexcept {
        if (arrived.size() > capacity()) {
            dropped_ += arrived.size() - capacity();
            arrived = arrived.last(capacity());
        }
        const std::size_t room = capacity() - size_;
        if (arrived.size() > room) {
            const std::size_t excess = arrived.size() - room;
            first_ = (first_ + excess) % capacity();
            size_ -= excess;
            dropped_ += excess;
        }
        const std::size_t end = (first_ + size_) % capacity();
        const std::size_t straight = std::min(arrived.size(), capacity() - end);
        std::ranges::copy(arrived.first(straight), all().subspan(end).begin());
        std::ranges::copy(arrived.subspan(straight), all().begin());
        size_ += arrived.size();
    }

    /// Takes the oldest bytes, as many as there are and fit into `into`; returns how many.
    [[nodiscard]] std::size_t pop(std::span<std::uint8_t> into) noexcept {
        const std::size_t taken = std::min(into.size(), size_);
        const std::size_t straight = std::min(taken, capacity() - first_);
        std::ranges::copy(all().subspan(first_, straight), into.begin());
        std::ranges::copy(all().first(taken - straight), into.subspan(straight).begin());
        first_ = (first_ + taken) % capacity();
        size_ -= taken;
        return taken;
    }

private:
    [[nodiscard]] std::span<std::uint8_t> all() noexcept { return bytes_; }

    std::vector<std::uint8_t> bytes_;
    std::size_t first_ = 0;
    std::size_t size_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace tacto
