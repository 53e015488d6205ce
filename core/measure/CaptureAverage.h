// CaptureAverage.h - the mean of repeated captures, sample by sample, aligned at the trigger: noise goes, what repeats
// stays.
//
// Up to the chosen number it is the arithmetic mean of all captures so far; from then on each new one counts one n-th
// (an exponential mean, as oscilloscopes do it), so that the picture goes on following the signal. The first capture's
// samples are the grid; those of later ones are taken at the same time from the trigger, between samples by straight
// line.
//
// A sample that is missing in a capture counts in none; one that is clipped in any capture is clipped in the mean, for
// its true value is not known. Captures of other settings (rate, length, place of the trigger, channels, ranges, the
// programmed amplitude) are not repetitions: the mean starts over with them.
//
// Levels are in each channel's unit, a bare double because the unit is data.
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
    /// 1: nothing is averaged. Another number restarts the mean.
    void setCaptures(std::size_t captures);
    [[nodiscard]] std::size_t captures() const noexcept { return wanted_; }
    /// How many captures the present mean covers, at most captures().
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    void clear();

    /// Takes one more capture. Returns the mean with its trigger and its time; the capture itself where nothing is
    /// averaged, and where it has no trigger to align it by (which counts nothing).
    std::shared_ptr<const Capture> add(std::shared_ptr<const Capture> capture);

private:
    struct Channel {
        std::vector<double> mean;
        std::vector<unsigned> seen;  ///< captures with this sample, at most wanted_
        std::vector<float> clipped;  ///< the end of the range that one reached; NaN: none
    };
    [[nodiscard]] bool repeats(const Capture& capture) const;
    void begin(const Capture& capture);
    void take(const Capture& capture);
    [[nodiscard]] std::shared_ptr<const Capture> mean(const Capture& newest) const;

    std::size_t wanted_ = 1;
    std::size_t count_ = 0;
    Capture like_;  ///< the first one, without its samples
    std::size_t samples_ = 0;
    std::vector<Channel> channels_;
};

}  // namespace tacto
