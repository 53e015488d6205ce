#include "core/analysis/psychophysics/LevelGrid.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

constexpr double kOnGrid = 1e-9;  // in steps

double stepsDown(double value, double step) noexcept { return std::floor(value / step + kOnGrid); }

}  // namespace

Result<LevelGrid> LevelGrid::create(LevelUnit unit, double step, std::span<const LevelCeiling> ceilings) {
    const bool isIntensity = unit == LevelUnit::Intensity;
    const double mostStep = isIntensity ? 1 : 1000;
    if (!(step > 0 && step <= mostStep)) {
        return invalid("the step of the levels is {}; above 0 to {} is accepted", step, mostStep);
    }
    if (ceilings.empty()) return invalid("the levels have no ceiling; at least one is needed");
    const LevelCeiling* lowest = nullptr;
    for (const auto& ceiling : ceilings) {
        if (!(ceiling.level >= step * (1 - kOnGrid) && std::isfinite(ceiling.level))) {
            return invalid("the highest level ({}) is {}; at least one step of {} is accepted", nameOf(ceiling.by),
                           ceiling.level, step);
        }
        if (isIntensity && ceiling.level > 1) {
            return invalid("the highest intensity ({}) is {}; at most 1 is accepted", nameOf(ceiling.by),
                           ceiling.level);
        }
        if (lowest == nullptr || ceiling.level < lowest->level) lowest = &ceiling;
    }
    const double count = stepsDown(lowest->level, step);
    if (!(count <= static_cast<double>(kMaxLevels))) {
        return invalid("{} levels of {} to {}; at most {} are accepted", count, step, lowest->level, kMaxLevels);
    }
    return LevelGrid(unit, step, static_cast<std::size_t>(count), lowest->by);
}

std::size_t LevelGrid::atOrBelow(double value) const noexcept {
    const double steps = stepsDown(value, step_);
    return steps < static_cast<double>(count_) ? static_cast<std::size_t>(std::max(steps, 0.0)) : count_;
}

std::optional<std::size_t> LevelGrid::atOrAbove(double value) const noexcept {
    const double steps = std::ceil(value / step_ - kOnGrid);
    if (!(steps <= static_cast<double>(count_))) return std::nullopt;
    return static_cast<std::size_t>(std::max(steps, 0.0));
}

std::size_t LevelGrid::nearest(double value) const noexcept {
    const double steps = std::ceil(value / step_ - 0.5 - kOnGrid);  // half-way values go to the weaker level
    if (!(steps >= 1)) return 1;
    return steps < static_cast<double>(count_) ? static_cast<std::size_t>(steps) : count_;
}

std::string LevelGrid::textOf(double level) const {
    return unit_ == LevelUnit::Current ? fmt::format("{:.4g} mA", level) : fmt::format("intensity {:.4g}", level);
}

}  // namespace tacto
