// BurstTimer.h - decides what is written to a massager and when: the burst, its repetitions, and the stop that ends it.
// Computes times only: it knows no bytes, no device and no clock of its own.
//
//   * A stop goes out at once, even just after another write. If that was too soon for the device, the stop is repeated
//     after the shortest write interval.
//   * If a stop cannot be written, it is retried every kRetry, before anything else, until the device takes it.
//   * A burst ends by itself: its stop is due one burst duration after the device took the burst.
//
// Thread-safety: none; the owner locks.
#pragma once

#include <optional>

#include "core/base/Units.h"

namespace tacto::hid {

enum class HidWrite {
    Nothing,
    Burst,   ///< the burst that the caller asked for
    Repeat,  ///< the running burst again, as keep-alive
    Stop,
};

class BurstTimer {
public:
    static constexpr Instant kRetry = std::chrono::milliseconds(50);

    BurstTimer(Seconds keepAlive, Seconds shortestWrite) noexcept
        : keepAlive_(toInstant(keepAlive)), shortest_(toInstant(shortestWrite)) {}

    struct Due {
        HidWrite what = HidWrite::Nothing;
        Instant at{Instant::max()};  ///< a time in the past means at once
    };
    [[nodiscard]] Due next() const noexcept;

    /// Asks for a burst, which replaces a running one. A stop that is due goes first. Not to be called during a write.
    void askBurst(Instant duration) noexcept;
    /// Drops a burst that was asked for but not written yet.
    void dropBurst() noexcept { asked_.reset(); }
    /// Asks for a stop at once; forgets the burst, whether asked for or running.
    void askStop() noexcept;
    /// Tells that the report from next() was written, from `began` to `ended`.
    void wrote(HidWrite what, Instant began, Instant ended, bool taken) noexcept;

    /// True if the device took a burst and no stop since.
    [[nodiscard]] bool vibrating() const noexcept { return end_.has_value(); }
    /// True if a stop is due that the device has not taken yet; a mere repetition of a taken stop does not count.
    [[nodiscard]] bool stopDue() const noexcept { return stopAt_.has_value() && !echo_; }

private:
    [[nodiscard]] Instant spaced() const noexcept { return last_ ? *last_ + shortest_ : Instant(0); }

    const Instant keepAlive_;  // interval of repeats; 0: none
    const Instant shortest_;
    std::optional<Instant> asked_;   // duration of the burst that is wanted
    std::optional<Instant> end_;     // when the running burst ends
    Instant repeatAt_{0};            // when to repeat while a burst runs
    std::optional<Instant> stopAt_;  // when the next stop is due
    bool echo_ = false;              // true if the stop is repeated in case the device missed the first
    std::optional<Instant> last_;    // when the last write ended
};

}  // namespace tacto::hid
