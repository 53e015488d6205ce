// FramePacer.h - says when frames are due if there is no acceleration: every 16 ms, or with each sample of a slower
// stream. After a gap the count starts again.
//
// Thread-safety: none; one owner. Never allocates.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/Stream.h"

namespace tacto {

class FramePacer {
public:
    static constexpr double kFrame_s = 0.016;
    static constexpr std::size_t kRoom = 256;

    explicit FramePacer(double rate_hz) noexcept : grid_(rate_hz), everySample_(1 / rate_hz > kFrame_s) {}

    [[nodiscard]] double period_s() const noexcept { return everySample_ ? grid_.step() : kFrame_s; }

    void sample(double t_s) noexcept {
        const auto kind = grid_.next(t_s);
        if (kind == StampClass::Repeat || kind == StampClass::Backward || kind == StampClass::Invalid) return;
        if (std::isinf(first_)) first_ = t_s;
        newest_ = t_s;
        if (everySample_) return push(t_s);
        if (kind == StampClass::First || kind == StampClass::Gap) {
            anchor_ = t_s;
            frames_ = 0;
        }
        for (;; ++frames_) {
            const double due = anchor_ + static_cast<double>(frames_) * kFrame_s;
            if (due > t_s) return;
            push(due);
        }
    }

    [[nodiscard]] double first_s() const noexcept { return first_; }    ///< infinity before the first sample
    [[nodiscard]] double newest_s() const noexcept { return newest_; }  ///< -infinity before the first sample
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] bool crowded() const noexcept { return count_ > kRoom / 2; }
    [[nodiscard]] double front() const noexcept { return times_[front_]; }
    void pop() noexcept {
        front_ = (front_ + 1) % kRoom;
        --count_;
    }
    void clear() noexcept {
        grid_.reset();
        front_ = count_ = frames_ = 0;
        first_ = std::numeric_limits<double>::infinity();
        newest_ = -first_;
    }

private:
    void push(double t_s) noexcept {
        if (count_ < kRoom) times_[(front_ + count_++) % kRoom] = t_s;
    }

    SampleGrid grid_;
    const bool everySample_;
    std::array<double, kRoom> times_{};
    std::size_t front_ = 0;
    std::size_t count_ = 0;
    std::size_t frames_ = 0;  // frames since the anchor time
    double anchor_ = 0;
    double first_ = std::numeric_limits<double>::infinity();
    double newest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace tacto
