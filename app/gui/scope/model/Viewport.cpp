#include "app/gui/scope/model/Viewport.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tacto::gui {

namespace {

constexpr double kShortest_s = 1e-9;  // seconds per division
constexpr double kLongest_s = 1e4;
constexpr double kFinest = 1e-12;  // per division, in V, A, W or C
constexpr double kCoarsest = 1e6;
constexpr qint64 kOneTurn_ms = 700;
constexpr std::size_t kRemembered = 100;

double stepWithin(double value, double low, double high) {
    return std::isfinite(value) ? std::clamp(value, low, high) : low;
}

}  // namespace

double onGrid(double value, double perDivision) {
    const double grain = perDivision / 50;
    return std::round(value / grain) * grain;
}

double leastPerDivision(double rate_hz) {
    constexpr double kSamplesAcross = 4;
    return stepNotBelow(std::max(kShortest_s, kSamplesAcross / rate_hz / kDivisionsAcross));
}

Viewport withTimeBase(Viewport view, double perDivision_s, double anchor_s) {
    view.left_s = onGrid(anchor_s - (anchor_s - view.left_s) * perDivision_s / view.perDivision_s, perDivision_s);
    view.perDivision_s = perDivision_s;
    return view;
}

Viewport zoomedInTime(const Viewport& view, int steps, double anchor_s, double least_s) {
    // If the view is already narrower, because the last record had more samples, zooming in does not widen it.
    const double shortest_s = std::max(kShortest_s, std::min(least_s, view.perDivision_s));
    return withTimeBase(view, stepWithin(stepAlong(view.perDivision_s, steps), shortest_s, kLongest_s), anchor_s);
}

Viewport spanningTime(Viewport view, double from_s, double to_s, double least_s) {
    view.perDivision_s = stepWithin((to_s - from_s) / kDivisionsAcross, std::max(kShortest_s, least_s), kLongest_s);
    view.left_s = (from_s + to_s) / 2 - view.width_s() / 2;
    return view;
}

Viewport framingPulse(Viewport view, double from_s, double to_s) {
    constexpr double kShare = 1.0 / 3;
    const double wanted = stepWithin((to_s - from_s) / kShare / kDivisionsAcross, kShortest_s, kLongest_s);
    const double digit = std::pow(10, std::floor(std::log10(wanted)) - 1);
    view.perDivision_s = std::round(wanted / digit) * digit;
    view.left_s = onGrid((from_s + to_s) / 2 - view.width_s() / 2, view.perDivision_s);
    return view;
}

Viewport showingTime(Viewport view, double from_s, double to_s) {
    view.perDivision_s =
        stepWithin(stepNotBelow(std::max(to_s - from_s, kShortest_s) / kDivisionsAcross), kShortest_s, kLongest_s);
    view.left_s = onGrid((from_s + to_s) / 2 - view.width_s() / 2, view.perDivision_s);
    return view;
}

LaneScale zoomedInLevel(const LaneScale& lane, int steps, double anchor) {
    LaneScale zoomed;
    zoomed.perDivision = stepWithin(stepAlong(lane.perDivision, steps), kFinest, kCoarsest);
    zoomed.position = onGrid(anchor - (anchor - lane.position) * lane.perDivision / zoomed.perDivision, 1);
    return zoomed;
}

LaneScale showingHeights(const LaneScale& lane, double bottom, double top) {
    const double low = lane.levelAt(bottom), high = lane.levelAt(top);
    LaneScale shown;
    shown.perDivision = stepWithin((high - low) / kDivisionsUp, kFinest, kCoarsest);
    shown.position = -(low + high) / 2 / shown.perDivision;
    return shown;
}

LaneScale fittingLevels(double low, double high, double middle, double height) {
    LaneScale lane;
    lane.perDivision = stepWithin(stepNotBelow(std::max((high - low) / height, kFinest)), kFinest, kCoarsest);
    lane.position = onGrid(middle - (low + high) / 2 / lane.perDivision, 1);
    return lane;
}

LaneScale aroundZero(double low, double high, double position) {
    constexpr double kEitherWay = 2.45;  // divisions; 2.5 less some room for noise
    const double most = std::max({std::abs(low), std::abs(high), kFinest});
    return {stepWithin(stepNotBelow(most / kEitherWay), kFinest, kCoarsest), position};
}

LaneScale restingLevels(double low, double high, double middle, double height) {
    constexpr double kInside = kDivisionsUp / 2.0 - 0.1;
    constexpr double kHalfDivision = 0.5;
    LaneScale lane = fittingLevels(low, high, middle, height);
    for (int tries = 0; tries < 3; ++tries) {
        lane.position = std::round(lane.position / kHalfDivision) * kHalfDivision;
        const double top = high / lane.perDivision, bottom = low / lane.perDivision;
        const double most = std::floor((kInside - top) / kHalfDivision) * kHalfDivision;
        const double least = std::ceil((-kInside - bottom) / kHalfDivision) * kHalfDivision;
        if (least <= most) {
            lane.position = std::clamp(lane.position, least, most);
            break;
        }
        lane = fittingLevels(low, high, middle, (high - low) / stepAlong(lane.perDivision, 1));
    }
    return lane;
}

void ViewHistory::remember(const Viewport& view, const QString& kind) {
    const bool sameTurn = !kind.isEmpty() && kind == lastKind_ && since_.isValid() && since_.elapsed() < kOneTurn_ms;
    lastKind_ = kind;
    since_.start();
    if (sameTurn && !views_.empty()) return;
    views_.push_back(view);
    if (views_.size() > kRemembered) views_.erase(views_.begin());
}

std::optional<Viewport> ViewHistory::undo() {
    lastKind_.clear();
    if (views_.empty()) return std::nullopt;
    auto view = std::move(views_.back());
    views_.pop_back();
    return view;
}

namespace {

constexpr std::array<int, 3> kMantissas{1, 2, 5};

/// Returns step number n: 0 is 1, 1 is 2, 2 is 5, 3 is 10, -1 is 0.5. Powers of ten are exact, so a step is always the
/// same number, whichever way it was reached.
double stepNumber(int n) {
    const int decade = n >= 0 ? n / 3 : -((2 - n) / 3);
    const auto mantissa = static_cast<double>(kMantissas[static_cast<std::size_t>(n - 3 * decade)]);
    return decade >= 0 ? mantissa * std::pow(10.0, decade) : mantissa / std::pow(10.0, -decade);
}

int numberNotBelow(double value) {
    int n = 3 * static_cast<int>(std::floor(std::log10(value))) - 1;
    while (stepNumber(n) < value * (1 - 1e-9)) ++n;
    return n;
}

}  // namespace

double stepNotBelow(double value) { return stepNumber(numberNotBelow(value)); }

double stepAlong(double value, int steps) {
    const int upper = numberNotBelow(value);
    const bool between = stepNumber(upper) > value * (1 + 1e-9);
    return stepNumber(upper + steps - (between && steps > 0 ? 1 : 0));
}

std::vector<double> stepsBetween(double low, double high) {
    std::vector<double> steps;
    for (int n = numberNotBelow(low); stepNumber(n) <= high * (1 + 1e-9); ++n) steps.push_back(stepNumber(n));
    return steps;
}

}  // namespace tacto::gui
