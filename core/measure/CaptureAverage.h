// CaptureAverage.h - the mean of repeated captures, sample by sample, aligned at the trigger: noise averages out, and
// the repeated signal stays.
//
// Up to the chosen number, the result is the arithmetic mean of all captures so far. After that, each new capture has
// the weight 1/n (an exponential mean, as in oscilloscopes), so that the picture keeps following the signal. The
// samples of the first capture define the grid. Later captures are interpolated linearly at the same times from the
// trigger.
//
// A sample that is missing in a capture does not enter the mean. A sample that is clipped in any capture is clipped in
// the mean, because its true value is unknown. A capture with other settings (rate, length, place of the trigger,
// channels, ranges, programmed amplitude) is not a repetition: the mean starts again from it.
//
// Levels are in each channel's unit. They are bare doubles because the unit is data.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/measure/Capture.h"

namespace tacto {

class CaptureAverage {
public:
    /// 1 switches averaging off. A different number restarts the mean.
    void setCaptures(std::size_t captures);
    [[nodiscard]] std::size_t captures() const noexcept { return wanted_; }
    /// Returns the number of captures in the present mean, at most captures().
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    void clear();

    /// Adds a capture and returns the mean, with the trigger and time of this capture. Returns the capture itself if
    /// averaging is off, or if it has no trigger for the alignment (it is then not counted).
    std::shared_ptr<const Capture> add(std::shared_ptr<const Capture> capture);

private:
    struct Channel {
        std::vector<double> mean;
        std::vector<unsigned> seen;  ///< number of captures with this sample, at most wanted_
        std::vector<float> clipped;  ///< end of the range that a capture reached; NaN: none
    };
    [[nodiscard]] bool repeats(const Capture& capture) const;
    void begin(const Capture& capture);
    void take(const Capture& capture);
    [[nodiscard]] std::shared_ptr<const Capture> mean(const Capture& newest) const;

    std::size_t wanted_ = 1;
    std::size_t count_ = 0;
    Capture like_;  ///< the first capture, without its samples
    std::size_t samples_ = 0;
    std::vector<Channel> channels_;
};

}  // namespace tacto
