// ExposureMeter.h - the exposure of the last seconds: every approved train, added up over sliding windows.
//
// A train is booked when it is approved. It may be delivered at any moment until its approval expires. So in that time
// the whole train is included in every window that it could touch: the sums are upper bounds, never too small. The ring
// has a fixed size; when it is full, canBook() returns false and the gate refuses.
//
// Thread-safety: none; one caller (the gate).
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/Units.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

struct BookedTrain {
    Instant earliest{0};      ///< the approval: the train cannot start earlier
    Instant latest{0};        ///< end of the approval plus the train's duration: by then it has ended
    double hz = 0;            ///< repetition frequency, to find its frequency band
    TrainExposure overRange;  ///< worst case over the load range
    TrainExposure at500;
};

class ExposureMeter {
public:
    static constexpr Seconds kLongestWindow{5};
    static constexpr std::size_t kCapacity = 4096;
    explicit ExposureMeter(std::size_t capacity = kCapacity);  ///< allocates here and never again

    /// Forgets trains that no window from `now` on can touch. `stretch` (1 or more; also below): the seconds of the
    /// booking clock in one second of a window.
    void forget(Instant now, double stretch = 1) noexcept;
    [[nodiscard]] bool canBook() const noexcept { return size_ < ring_.size(); }
    /// Requires canBook(); does nothing if the meter is full.
    void book(const BookedTrain& train) noexcept;

    struct Sums {
        TrainSums overRange;
        TrainSums at500;
        double lowestHz = 0;  ///< lowest rate of these trains; infinite if there are none
        std::size_t trains = 0;
    };
    /// Returns the sums of all trains that could share a window of `window` with a train that starts at `now` or later.
    [[nodiscard]] Sums couldShare(Seconds window, Instant now, double stretch = 1) const noexcept;
    /// Returns the sums of the trains approved within (now − window, now], for a display.
    [[nodiscard]] Sums booked(Seconds window, Instant now) const noexcept;
    /// Returns the largest value of a quantity of one pulse or train booked in (now − 5 s, now]; 0 if there is none.
    [[nodiscard]] double largest(Quantity quantity, JudgedAt judged, Instant now) const noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }

private:
    [[nodiscard]] const BookedTrain& entry(std::size_t age) const noexcept;  // age 0 is the oldest
    std::vector<BookedTrain> ring_;
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

}  // namespace tacto
