// PersonalRange.h - finds the range of levels for a participant's conditions today (pilot.md section 4).
//
// I_min is 1.25 times the detection threshold, rounded up to the grid. I_max is the lowest of the gate's highest level
// at the shortest interval, the cap, and 0.8 times the "too strong" level, rounded down. The participant feels I_max
// for 4 s at the shortest interval and is asked "half an hour of this?". Each no lowers I_max by a step. Fewer than two
// steps are no usable range. This is a normal result: omitting such people would flatter the study.
//
// The same settings and answers give the same presentations.
#pragma once

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/base/JustNoticeable.h"

namespace tacto {

struct PersonalRangeSettings {
    double detection = 0;       ///< estimated detection threshold, in the grid's unit; > 0
    double tooStrong = 0;       ///< the level that is too strong; > 0
    bool saidTooStrong = true;  ///< true if the participant called it too strong; else it is the highest level
    double aboveDetection = 1.25;
    double belowTooStrong = 0.8;
    std::size_t leastSteps = 2;              ///< smallest number of steps between I_min and I_max
    double weber = kAmplitudeWeberFraction;  ///< Weber fraction of the level, for the distance in JND; > 0
};

struct PersonalRangeResult {
    bool usable = false;
    std::string reason;                                     ///< sentence: why it is not usable; else empty
    double min = std::numeric_limits<double>::quiet_NaN();  ///< I_min on the grid; NaN if above the highest level
    double max = std::numeric_limits<double>::quiet_NaN();  ///< I_max on the grid; NaN if below one step
    LevelLimit limitedBy = LevelLimit::TooStrong;           ///< what limits I_max
    std::size_t steps = 0;                                  ///< steps from min to max; 0 if max is not above min
    double jnd = std::numeric_limits<double>::quiet_NaN();  ///< ln(max/min) / ln(1 + weber); NaN if not usable
    std::size_t lowered = 0;                                ///< how often the participant said no
};

class PersonalRange {
public:
    /// The grid's highest level already includes the limits of the gate, the cap and the device. Errors:
    /// InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<PersonalRange> create(const LevelGrid& grid, const PersonalRangeSettings& settings);

    /// The level to present and ask about; nothing if done().
    [[nodiscard]] std::optional<double> next() const;
    /// Takes the answer to "half an hour of this?". Errors: InvalidArgument if done().
    [[nodiscard]] Result<void> answer(bool acceptable);
    /// True if I_max is accepted or no usable range is left.
    [[nodiscard]] bool done() const noexcept { return confirmed_ || !wideEnough(); }
    [[nodiscard]] PersonalRangeResult result() const;

private:
    PersonalRange(const LevelGrid& grid, const PersonalRangeSettings& settings);
    [[nodiscard]] bool wideEnough() const noexcept;

    LevelGrid grid_;
    PersonalRangeSettings settings_;
    std::optional<std::size_t> min_;  // index; empty: above the highest level
    std::size_t max_ = 0;             // index; 0: below one step
    LevelLimit limitedBy_ = LevelLimit::TooStrong;
    std::size_t lowered_ = 0;
    bool confirmed_ = false;
};

}  // namespace tacto
