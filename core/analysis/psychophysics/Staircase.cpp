#include "core/analysis/psychophysics/Staircase.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/analysis/statistics/GivenFigure.h"

namespace tacto {

namespace {

constexpr double kStartTimes = 1.5;       // start level as a multiple of F
constexpr double kStepShare = 0.05;       // step size as a share of F
constexpr std::size_t kUpSteps = 2;       // steps in a move up, for one step in a move down
constexpr std::size_t kDoubledUntil = 2;  // number of reversals
constexpr std::size_t kRightForDown = 2;

}  // namespace

Result<Staircase> Staircase::create(const LevelGrid& grid, const StaircaseSettings& settings, std::uint64_t seed) {
    const auto reversals = static_cast<double>(settings.reversals);
    auto valid = checkFigures({givenAboveZero("the first felt level", settings.felt),
                               givenCount("the number of reversals", settings.reversals, 2, 1e9),
                               givenCount("the number of reversals averaged", settings.averaged, 1, reversals),
                               givenCount("the staircase's number of trials", settings.most, 1, 1e9)});
    if (!valid) return failure(valid);
    return Staircase(grid, settings, seed);
}

Staircase::Staircase(const LevelGrid& grid, const StaircaseSettings& settings, std::uint64_t seed)
    : grid_(grid),
      settings_(settings),
      order_(seed, settings.stream),
      step_(std::max<std::size_t>(1, grid.atOrBelow(kStepShare * settings.felt))),
      index_(grid.nearest(kStartTimes * settings.felt)) {}

std::optional<TwoIntervalTrial> Staircase::next() const {
    if (done()) return std::nullopt;
    const std::size_t number = trials_.size() + 1;
    return TwoIntervalTrial{number, grid_.level(index_), order_.of(number)};
}

Result<void> Staircase::answer(TrialInterval said) {
    if (auto valid = validate(said); !valid) return valid;
    const auto asked = next();
    if (!asked) return invalid("the staircase is complete; no answer is accepted");
    const bool correct = said == asked->interval;
    shares_.add(asked->interval, correct);
    trials_.push_back({asked->level, asked->interval, correct});
    rightInARow_ = correct ? rightInARow_ + 1 : 0;
    if (!correct) {
        move(true);
    } else if (rightInARow_ == kRightForDown) {
        rightInARow_ = 0;
        move(false);
    }
    return {};
}

void Staircase::move(bool up) {
    if (wentUp_ && *wentUp_ != up) reversals_.push_back(grid_.level(index_));
    wentUp_ = up;
    std::size_t steps = up ? kUpSteps * step_ : step_;
    if (reversals_.size() < kDoubledUntil) steps *= 2;
    if (up) {
        index_ = std::min(index_ + steps, grid_.count());
    } else {
        index_ = index_ > steps ? index_ - steps : 1;
    }
}

bool Staircase::done() const noexcept {
    return reversals_.size() >= settings_.reversals || trials_.size() >= settings_.most;
}

StaircaseResult Staircase::result() const {
    StaircaseResult out;
    if (reversals_.size() >= settings_.averaged) {
        const auto from = reversals_.end() - static_cast<std::ptrdiff_t>(settings_.averaged);
        out.estimate = std::accumulate(from, reversals_.end(), 0.0) / static_cast<double>(settings_.averaged);
    }
    out.reversals = reversals_;
    out.intervals = shares_;
    out.trials = trials_;
    return out;
}

}  // namespace tacto
