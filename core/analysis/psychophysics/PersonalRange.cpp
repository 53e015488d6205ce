#include "core/analysis/psychophysics/PersonalRange.h"

#include <cmath>

#include "core/analysis/statistics/GivenFigure.h"

namespace tacto {

Result<PersonalRange> PersonalRange::create(const LevelGrid& grid, const PersonalRangeSettings& settings) {
    auto valid = checkFigures({givenAboveZero("the detection threshold", settings.detection, 1e6),
                               givenAboveZero("the level that is too strong", settings.tooStrong, 1e6),
                               givenAboveZero("the Weber fraction of the level", settings.weber, 10),
                               givenAboveZero("the factor below what is too strong", settings.belowTooStrong, 1),
                               {"the factor above detection", settings.aboveDetection, {.low = 1, .high = 10}},
                               givenCount("the fewest steps of a range", settings.leastSteps, 1, 1e9)});
    if (!valid) return failure(valid);
    return PersonalRange(grid, settings);
}

PersonalRange::PersonalRange(const LevelGrid& grid, const PersonalRangeSettings& settings)
    : grid_(grid),
      settings_(settings),
      min_(grid.atOrAbove(settings.aboveDetection * settings.detection)),
      limitedBy_(grid.limitedBy()) {
    const double comfortable = settings_.belowTooStrong * settings_.tooStrong;
    max_ = grid_.atOrBelow(comfortable);
    if (comfortable <= grid_.highest() && settings_.saidTooStrong) limitedBy_ = LevelLimit::TooStrong;
}

bool PersonalRange::wideEnough() const noexcept { return min_ && max_ >= *min_ + settings_.leastSteps; }

std::optional<double> PersonalRange::next() const {
    if (done()) return std::nullopt;
    return grid_.level(max_);
}

Result<void> PersonalRange::answer(bool acceptable) {
    if (done()) return invalid("the range is settled; no answer is accepted");
    if (acceptable) {
        confirmed_ = true;
        return {};
    }
    --max_;
    ++lowered_;
    limitedBy_ = LevelLimit::Confirmation;
    return {};
}

PersonalRangeResult PersonalRange::result() const {
    PersonalRangeResult out;
    out.usable = confirmed_;
    out.limitedBy = limitedBy_;
    out.lowered = lowered_;
    if (min_) out.min = grid_.level(*min_);
    if (max_ > 0) out.max = grid_.level(max_);
    if (min_ && max_ > *min_) out.steps = max_ - *min_;
    if (out.usable) out.jnd = justNoticeableDifferences(out.max, out.min, settings_.weber);
    if (wideEnough()) return out;
    if (!min_) {
        out.reason = fmt::format("the lowest level would be {}, above the highest of {}, limited by {}",
                                 grid_.textOf(settings_.aboveDetection * settings_.detection),
                                 grid_.textOf(grid_.highest()), inWords(grid_.limitedBy()));
    } else {
        out.reason = fmt::format(
            "from the lowest level of {} to the highest of {}, limited by {}, the device has {} step{}; {} or "
            "more are needed",
            grid_.textOf(out.min), grid_.textOf(grid_.level(max_)), inWords(limitedBy_), out.steps,
            out.steps == 1 ? "" : "s", settings_.leastSteps);
    }
    return out;
}

}  // namespace tacto
