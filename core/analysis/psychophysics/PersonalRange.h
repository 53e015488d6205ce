// PersonalRange.h - the levels between which a participant's conditions lie today (pilot.md section 4).
//
// I_min = 1.25 times the detection threshold, up to the grid. I_max = the lowest of 0.8 U, what the gate approves at
// the shortest interval, and the cap, down to the grid. Then the participant feels I_max for 4 s at the shortest
// interval and is asked "half an hour of this?"; each no lowers it by one step. Fewer than two steps between the two is
// no usable range, which is a result like any other: leaving such participants out would flatter the answer.
//
// The same settings and answers give the same presentations.
#pragma once

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/base/JustNoticeable.h"

namespace tacto {

struct PersonalRangeSettings {
    double detection = 0;       ///< α̂, in the grid's unit; > 0
    double tooStrong = 0;       ///< U; > 0
    bool saidTooStrong = true;  ///< U was called too strong; else it is the highest level that was presented
    double aboveDetection = 1.25;
    double belowTooStrong = 0.8;
    std::size_t leastSteps = 2;              ///< between I_min and I_max
    double weber = kAmplitudeWeberFraction;  ///< Weber fraction of the level, for the distance in JND; > 0
};

struct PersonalRangeResult {
    bool usable = false;
    std::string reason;                                     ///< one sentence that says why it is not usable; else empty
    double min = std::numeric_limits<double>::quiet_NaN();  ///< I_min on the grid; NaN: above the highest level
    double max = std::numeric_limits<double>::quiet_NaN();  ///< I_max on the grid; NaN: below one step
    LevelLimit limitedBy = LevelLimit::TooStrong;           ///< the reason why I_max is no higher
    std::size_t steps = 0;                                  ///< from min to max; 0 where max is not above min
    double jnd = std::numeric_limits<double>::quiet_NaN();  ///< ln(max/min) / ln(1 + weber); NaN where not usable
    std::size_t lowered = 0;                                ///< times that the participant said no
};

class PersonalRange {
public:
    /// The grid's highest level stands for the gate, the cap and the device. Errors: InvalidArgument naming the
    /// setting, its value and what is accepted.
    [[nodiscard]] static Result<PersonalRange> create(const LevelGrid& grid, const PersonalRangeSettings& settings);

    /// The level to be felt and asked about; nothing when done().
    [[nodiscard]] std::optional<double> next() const;
    /// "Half an hour of this?" Errors: InvalidArgument when done().
    [[nodiscard]] Result<void> answer(bool acceptable);
    /// Accepted, or nothing usable is left.
    [[nodiscard]] bool done() const noexcept { return confirmed_ || !wideEnough(); }
    [[nodiscard]] PersonalRangeResult result() const;

private:
    PersonalRange(const LevelGrid& grid, const PersonalRangeSettings& settings);
    [[nodiscard]] bool wideEnough() const noexcept;

    LevelGrid grid_;
    PersonalRangeSettings settings_;
    std::optional<std::size_t> min_;  // Index; nothing: above the highest level
    std::size_t max_ = 0;             // Index; 0: below one step
    LevelLimit limitedBy_ = LevelLimit::TooStrong;
    std::size_t lowered_ = 0;
    bool confirmed_ = false;
};

}  // namespace tacto
