// CaptureMask.h - a band around a reference capture that others are held against: it widens the reference by so much in
// level and so much in time, and a capture passes if every sample of it lies inside.
//
// Captures are aligned at the trigger. A sample between two of the mask's is held against both, so that where samples
// lie decides nothing. A capture that has no trigger, misses a channel, misses samples, is clipped where the mask ends
// or reaches beyond the mask's time is not judged there, and if that leaves nothing outside, the capture is not judged
// at all: what is not known does not pass.
//
// A mask judges and does nothing else: it never controls the output.
//
// Levels are in each channel's unit, a bare double because the unit is data; times are seconds from the trigger.
//
// Thread-safety: a mask is constant once it is made; any thread may judge by it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto {

/// Half-widths.
struct MaskBand {
    std::map<std::string, double> level;  ///< by unit ("V", "A"), above 0; a channel with another unit is not judged
    double time_s = 0;                    ///< 0 and up
};

enum class MaskVerdict { Inside, Outside, NotJudged };

/// The sample furthest from the band, in half-widths of its level; of several the first.
struct MaskViolation {
    std::string channel;
    double time_s = 0;  ///< from the trigger
    double value = 0;   ///< in the channel's unit
    double limit = 0;   ///< the limit that it is beyond
};

struct MaskCheck {
    MaskVerdict verdict = MaskVerdict::NotJudged;
    std::size_t outside = 0;             ///< samples
    std::optional<MaskViolation> worst;  ///< the worst of a capture that is outside
    std::string why;                     ///< a clause that says why it is not judged
};

class CaptureMask {
public:
    struct Channel {
        std::string name;
        std::string unit;
        std::vector<float> low;  ///< NaN where the reference misses its samples
        std::vector<float> high;
        double halfWidth = 0;
    };

    /// Errors: InvalidArgument when the reference has no trigger or no channel in a unit of the band, or a half-width
    /// is not finite and above 0 (time: 0 and up).
    [[nodiscard]] static Result<CaptureMask> around(const Capture& reference, const MaskBand& band);

    [[nodiscard]] MaskCheck check(const Capture& capture) const;

    [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
    [[nodiscard]] double rate_hz() const noexcept { return rate_hz_; }
    /// Time of the first sample, from the trigger.
    [[nodiscard]] double start_s() const noexcept { return start_s_; }
    [[nodiscard]] const MaskBand& band() const noexcept { return band_; }

private:
    CaptureMask() = default;
    MaskBand band_;
    double rate_hz_ = 0;
    double start_s_ = 0;
    std::vector<Channel> channels_;
};

/// What a mask has judged so far.
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
