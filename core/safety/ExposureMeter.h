// ExposureMeter.h - the exposure of the last seconds: every approved train, summed over sliding windows.
//
// A train is booked when it is approved. It may be delivered at any moment until its approval expires, so it
// counts from the one moment to the other, whole, in every window that it could touch: sums are upper bounds, never too
// small.
// A fixed ring; when it is full, canBook() is false and the gate refuses.
//
// Thread-safety: none; one caller (the gate's).
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/Units.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

struct BookedTrain {
    Instant earliest{0};      ///< approved: it cannot start before
    Instant latest{0};        ///< the approval's end plus its own duration: by then it has ended
    double hz = 0;            ///< repetition frequency, for frequency bands
    TrainExposure overRange;  ///< worst case over the load range
    TrainExposure at500;
};

class ExposureMeter {
public:
    static constexpr Seconds kLongestWindow{5};
    static constexpr std::size_t kCapacity = 4096;
    explicit ExposureMeter(std::size_t capacity = kCapacity);  ///< allocates here and never again

    /// Forgets what no window from `now` on can touch. `stretch`, 1 or more, here and below: a second of the windows
    /// lasts that many of the clock that trains are booked on.
    void forget(Instant now, double stretch = 1) noexcept;
    [[nodiscard]] bool canBook() const noexcept { return size_ < ring_.size(); }
    /// Requires canBook(); a full meter books nothing.
    void book(const BookedTrain& train) noexcept;

    struct Sums {
        TrainSums overRange;
        TrainSums at500;
        double lowestHz = 0;  ///< lowest rate of the trains counted; infinite for none
        std::size_t trains = 0;
    };
    /// The sums of all trains that could share a window of `window` with one that starts at `now` or later.
    [[nodiscard]] Sums couldShare(Seconds window, Instant now, double stretch = 1) const noexcept;
    /// The trains approved within (now − window, now]: what a display shows.
    [[nodiscard]] Sums booked(Seconds window, Instant now) const noexcept;
    /// The largest of a quantity of one pulse or train among those booked in (now − 5 s, now]; 0 for none.
    [[nodiscard]] double largest(Quantity quantity, JudgedAt judged, Instant now) const noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }

private:
    [[nodiscard]] const BookedTrain& entry(std::size_t age) const noexcept;  // 0 = oldest
    std::vector<BookedTrain> ring_;
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

}  // namespace tacto
