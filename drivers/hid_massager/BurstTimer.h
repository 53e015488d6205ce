// BurstTimer.h - what is to be written to a massager, and when: the burst, its repetitions, and the stop that ends it.
// Times only: no bytes, no device, no clock of its own.
//
//   * A stop goes out at once, even just after another write; when that was too soon for the device, once more after
//     the shortest write interval.
//   * A stop that could not be written is tried again every kRetry, before anything else, until the device takes it.
//   * A burst ends by itself: the stop is due its duration after the device took it.
//
// Thread-safety: none; its owner locks.
#pragma once

#include <optional>

#include "core/base/Units.h"

namespace tacto::hid {

enum class HidWrite {
    Nothing,
    Burst,   ///< the burst that was asked for
    Repeat,  ///< the running burst, again: keep-alive
    Stop,
};

class BurstTimer {
public:
    static constexpr Instant kRetry = std::chrono::milliseconds(50);

    BurstTimer(Seconds keepAlive, Seconds shortestWrite) noexcept
        : keepAlive_(toInstant(keepAlive)), shortest_(toInstant(shortestWrite)) {}

    struct Due {
        HidWrite what = HidWrite::Nothing;
        Instant at{Instant::max()};  ///< may lie in the past: at once
    };
    [[nodiscard]] Due next() const noexcept;

    /// A burst is wanted, in place of one that runs. A stop that is due goes first. Not while a write is under way.
    void askBurst(Instant duration) noexcept;
    /// A burst that was asked for and not written is no longer wanted.
    void dropBurst() noexcept { asked_.reset(); }
    /// Off at once; forgets the burst, asked for or running.
    void askStop() noexcept;
    /// Tells that the report from next() was written, from `began` to `ended`.
    void wrote(HidWrite what, Instant began, Instant ended, bool taken) noexcept;

    /// A burst was taken, and no stop since.
    [[nodiscard]] bool vibrating() const noexcept { return end_.has_value(); }
    /// A stop is due that the device has not taken; one that merely repeats another does not count.
    [[nodiscard]] bool stopDue() const noexcept { return stopAt_.has_value() && !echo_; }

private:
    [[nodiscard]] Instant spaced() const noexcept { return last_ ? *last_ + shortest_ : Instant(0); }

    const Instant keepAlive_;  // 0: none
    const Instant shortest_;
    std::optional<Instant> asked_;   // duration of the burst that is wanted
    std::optional<Instant> end_;     // the end of the running burst
    Instant repeatAt_{0};            // when to repeat while a burst runs
    std::optional<Instant> stopAt_;  // a stop is due then
    bool echo_ = false;              // the device may have missed a command: it is repeated
    std::optional<Instant> last_;    // the last write ended then
};

}  // namespace tacto::hid
