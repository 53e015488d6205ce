// CaptureMask.h - a band around a reference capture, to check other captures. The band widens the reference by a
// half-width in level and one in time; a capture passes if all of its samples lie inside.
//
// Captures are aligned at the trigger. A sample between two samples of the mask is checked against both, so that the
// positions of the samples do not affect the result. A capture without a trigger is not judged. Nor is one in which a
// channel, samples or part of the mask's time are missing, or samples in the band are clipped, unless another sample is
// outside: an unknown result does not pass.
//
// A mask only judges: it never controls the output.
//
// Levels are in each channel's unit, bare doubles because the unit is data; times are seconds from the trigger.
//
// Thread-safety: a mask is constant once made; any thread may use it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto {

/// Half-widths of the band.
struct MaskBand {
    std::map<std::string, double> level;  ///< by unit ("V", "A"), above 0; channels in other units are not judged
    double time_s = 0;                    ///< 0 or more
};

enum class MaskVerdict { Inside, Outside, NotJudged };

/// The sample furthest outside the band, measured in half-widths of the level; the first if several are equal.
struct MaskViolation {
    std::string channel;
    double time_s = 0;  ///< from the trigger
    double value = 0;   ///< in the channel's unit
    double limit = 0;   ///< the limit that the value exceeds
};

struct MaskCheck {
    MaskVerdict verdict = MaskVerdict::NotJudged;
    std::size_t outside = 0;             ///< number of samples outside the band
    std::optional<MaskViolation> worst;  ///< the furthest sample of a capture that is outside
    std::string why;                     ///< a clause that says why the capture is not judged
};

class CaptureMask {
public:
    struct Channel {
        std::string name;
        std::string unit;
        std::vector<float> low;  ///< NaN where samples of the reference are missing
        std::vector<float> high;
        double halfWidth = 0;
    };

    /// Makes a mask. Errors: InvalidArgument if the reference has no trigger or no channel in a unit of the band, or if
    /// a half-width is not finite and above 0 (time: 0 or more).
    [[nodiscard]] static Result<CaptureMask> around(const Capture& reference, const MaskBand& band);

    [[nodiscard]] MaskCheck check(const Capture& capture) const;

    [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
    [[nodiscard]] double rate_hz() const noexcept { return rate_hz_; }
    /// Returns the time of the first sample, from the trigger.
    [[nodiscard]] double start_s() const noexcept { return start_s_; }
    [[nodiscard]] const MaskBand& band() const noexcept { return band_; }

private:
    CaptureMask() = default;
    MaskBand band_;
    double rate_hz_ = 0;
    double start_s_ = 0;
    std::vector<Channel> channels_;
};

/// Counts of the captures judged so far.
struct MaskCounts {
    std::size_t inside = 0;
    std::size_t outside = 0;
    std::size_t notJudged = 0;
    void add(const MaskCheck& check) noexcept {
        ++(check.verdict == MaskVerdict::Inside ? inside : check.verdict == MaskVerdict::Outside ? outside : notJudged);
    }
    [[nodiscard]] std::size_t judged() const noexcept { return inside + outside; }
};

}  // namespace tacto
