#include "core/analysis/calibration/Calibration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "core/base/Statistics.h"
#include "core/base/Words.h"

namespace tacto {

namespace {

/// Indices of the readings of one level and one direction.
struct Group {
    std::size_t level = 0;
    SweepDirection direction = SweepDirection::None;
    std::vector<std::size_t> members;
};

double medianOf(std::vector<double> values) { return statisticsOf(values).median; }

Result<void> check(std::span<const CalibrationReading> readings) {
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const auto& r = readings[i];
        if (!std::isfinite(r.commanded)) {
            return fail(ErrorCode::InvalidArgument, "calibration reading {}: command {}; a finite one was expected",
                        i + 1, r.commanded);
        }
        if (std::isinf(r.measured)) {
            return fail(ErrorCode::InvalidArgument, "calibration reading {}: measured {}; a finite value was expected",
                        i + 1, r.measured);
        }
        if (r.uncertainty < 0 || std::isinf(r.uncertainty)) {
            return fail(ErrorCode::InvalidArgument, "calibration reading {}: uncertainty {}; 0 or more was expected",
                        i + 1, r.uncertainty);
        }
    }
    return {};
}

/// Returns the levels by rising command; `levelOf` gets the level of each reading. A new level begins if a command is
/// more than `apart` above the first command of the level.
std::vector<CalibrationLevel> findLevels(std::span<const CalibrationReading> readings, double apart,
                                         std::vector<std::size_t>& levelOf) {
    std::vector<double> commands;
    for (const auto& r : readings) commands.push_back(r.commanded);
    std::sort(commands.begin(), commands.end());
    std::vector<double> firsts;
    for (const double command : commands) {
        if (firsts.empty() || command - firsts.back() > apart) firsts.push_back(command);
    }
    std::vector<CalibrationLevel> levels(firsts.size());
    std::vector<double> counts(firsts.size(), 0);
    for (const auto& r : readings) {
        const auto above = std::upper_bound(firsts.begin(), firsts.end(), r.commanded);
        const auto k = static_cast<std::size_t>(above - firsts.begin()) - 1;
        levelOf.push_back(k);
        // Relative to the first command, so that equal commands give exactly the same mean.
        levels[k].commanded += r.commanded - firsts[k];
        ++counts[k];
    }
    for (std::size_t k = 0; k < levels.size(); ++k) levels[k].commanded = firsts[k] + levels[k].commanded / counts[k];
    return levels;
}

std::vector<Group> findGroups(const Calibration& found, const std::vector<std::size_t>& levelOf) {
    constexpr std::array kAll{SweepDirection::None, SweepDirection::Up, SweepDirection::Down};
    std::vector<Group> groups(found.levels.size() * kAll.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        groups[g].level = g / kAll.size();
        groups[g].direction = kAll[g % kAll.size()];
    }
    for (std::size_t i = 0; i < found.readings.size(); ++i) {
        if (std::isnan(found.readings[i].measured)) continue;
        groups[levelOf[i] * kAll.size() + static_cast<std::size_t>(found.readings[i].direction)].members.push_back(i);
    }
    std::erase_if(groups, [](const Group& group) { return group.members.empty(); });
    return groups;
}

/// Returns the readings, corrected to the level's own command.
std::vector<double> measuredOf(const Calibration& found, const Group& group) {
    std::vector<double> out;
    for (const std::size_t i : group.members) {
        const auto& r = found.readings[i];
        out.push_back(r.measured - (r.commanded - found.levels[group.level].commanded));
    }
    return out;
}

/// Computes means, spreads, repeatability and hysteresis.
void summarise(Calibration& found, const std::vector<Group>& groups) {
    std::vector<double> squares(found.levels.size(), 0);
    std::vector<double> sums(found.levels.size(), 0);
    double allSquares = 0, allFreedom = 0;
    for (const auto& group : groups) {
        auto& level = found.levels[group.level];
        const auto s = statisticsOf(measuredOf(found, group));
        const auto n = static_cast<double>(s.n);
        level.n += s.n;
        sums[group.level] += s.mean * n;
        if (group.direction == SweepDirection::Up) level.meanUp = s.mean;
        if (group.direction == SweepDirection::Down) level.meanDown = s.mean;
        if (s.n < 2) continue;
        squares[group.level] += s.sd * s.sd * (n - 1);
        level.degreesOfFreedom += n - 1;
        allSquares += s.sd * s.sd * (n - 1);
        allFreedom += n - 1;
    }
    double hysteresis = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < found.levels.size(); ++k) {
        auto& level = found.levels[k];
        level.mean = level.n > 0 ? sums[k] / static_cast<double>(level.n) : std::numeric_limits<double>::quiet_NaN();
        if (level.degreesOfFreedom > 0) level.s = std::sqrt(squares[k] / level.degreesOfFreedom);
        hysteresis = std::fmax(hysteresis, std::abs(level.meanUp - level.meanDown));  // fmax ignores NaN
    }
    found.hysteresis_pct = 100 * hysteresis / found.fullScale;
    if (allFreedom > 0) {
        found.repeatability = std::sqrt(allSquares / allFreedom);
        found.repeatability_pct = 100 * found.repeatability / found.fullScale;
        found.degreesOfFreedom = allFreedom;
    }
}

void fitLine(Calibration& found) {
    std::vector<const CalibrationReading*> used;
    for (const auto& r : found.readings) {
        if (!std::isnan(r.measured)) used.push_back(&r);
    }
    found.weighted = std::all_of(used.begin(), used.end(), [](const auto* r) { return r->uncertainty > 0; });
    double finest = std::numeric_limits<double>::infinity();
    for (const auto* r : used) finest = std::min(finest, r->uncertainty);
    const auto n = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixX2d design(n, 2);
    Eigen::VectorXd measured(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto& r = *used[static_cast<std::size_t>(i)];
        const double weight = found.weighted ? finest / r.uncertainty : 1;
        design.row(i) << weight * r.commanded / found.fullScale, weight;  // scaled: both columns of similar size
        measured(i) = weight * r.measured;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX2d> solver(design);
    const Eigen::Vector2d line = solver.solve(measured);
    found.gain = line(0) / found.fullScale;
    found.offset = line(1);

    double s = found.repeatability;
    if (std::isnan(s) && n > 2) {
        found.degreesOfFreedom = static_cast<double>(n - 2);
        s = std::sqrt((measured - design * line).squaredNorm() / found.degreesOfFreedom);
    }
    // (XᵀX)⁻¹ with the weights in the design. Stated uncertainties also set the scale.
    const Eigen::Matrix2d spread = (design.transpose() * design).inverse();
    if (found.weighted) s = finest;
    found.gainStandardError = s * std::sqrt(spread(0, 0)) / found.fullScale;
    found.offsetStandardError = s * std::sqrt(spread(1, 1));

    for (auto& level : found.levels) {
        level.residual = level.mean - (found.gain * level.commanded + found.offset);
        if (level.n > 0) {
            found.residualMax_pct = std::max(found.residualMax_pct, 100 * std::abs(level.residual) / found.fullScale);
        }
    }
}

void markOutliers(Calibration& found, const std::vector<Group>& groups, double resolution) {
    std::vector<double> apart;  // differences of all pairs of repeats
    std::vector<std::pair<std::size_t, double>> of;
    for (const auto& group : groups) {
        if (group.members.size() < 3) continue;  // two readings cannot show which one is wrong
        const auto measured = measuredOf(found, group);
        const double middle = medianOf(measured);
        for (std::size_t k = 0; k < measured.size(); ++k) {
            of.emplace_back(group.members[k], std::abs(measured[k] - middle));
            for (std::size_t j = 0; j < k; ++j) apart.push_back(std::abs(measured[k] - measured[j]));
        }
    }
    const auto spread = statisticsOf(apart);
    // The difference of two normal values with scatter σ has a median of 0.6745·√2·σ and a mean of 2/√π·σ.
    const double scale = spread.median > 0 ? 1.0483 * spread.median : 0.8862 * spread.mean;
    std::vector<std::string> marked;
    for (const auto& [i, distance] : of) {
        if (!(distance > std::max(kOutlierDistance * scale, resolution))) continue;
        auto& r = found.readings[i];
        r.outlier = true;
        ++found.outliers;
        constexpr std::size_t kNamed = 5;
        if (found.outliers > kNamed) continue;
        marked.push_back(fmt::format("{} ({:.6g} at {:.6g}{}{})", i + 1, r.measured, r.commanded,
                                     r.direction == SweepDirection::None ? "" : " going ", nameOf(r.direction)));
    }
    if (found.outliers == 0) return;
    if (found.outliers > marked.size()) marked.emplace_back("others");
    found.warnings.push_back(fmt::format("{} of {} readings stand out from their repeats and are marked and kept: {}",
                                         found.outliers, found.readings.size(), fmt::join(marked, ", ")));
}

void warnOfGaps(Calibration& found, const std::vector<Group>& groups) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const auto& group : groups) fewest = std::min(fewest, group.members.size());
    const bool bothWays = std::all_of(found.levels.begin(), found.levels.end(), [](const auto& level) {
        return !std::isnan(level.meanUp) && !std::isnan(level.meanDown);
    });
    found.complete =
        found.levels.size() >= kWantedLevels && fewest >= kWantedRepeats && bothWays && found.notMeasured == 0;
    if (found.levels.size() < kWantedLevels) {
        found.warnings.push_back(
            fmt::format("{} levels; a calibration has at least {}", found.levels.size(), kWantedLevels));
    }
    if (fewest < kWantedRepeats) {
        found.warnings.push_back(fmt::format(
            "a level has only {} repeats in a direction; a calibration has at least {}", fewest, kWantedRepeats));
    }
    if (!bothWays) {
        found.warnings.push_back("not every level was met both going up and going down");
    }
    if (found.notMeasured > 0) {
        found.warnings.push_back(
            fmt::format("{} of {} readings were not measured", found.notMeasured, found.readings.size()));
    }
    const auto stated = static_cast<std::size_t>(
        std::count_if(found.readings.begin(), found.readings.end(), [](const auto& r) { return r.uncertainty > 0; }));
    if (stated > 0 && !found.weighted) {
        found.warnings.push_back(fmt::format("{} of {} readings carry an uncertainty, so the fit is unweighted", stated,
                                             found.readings.size()));
    }
}

}  // namespace

Result<Calibration> fitCalibration(std::span<const CalibrationReading> readings, const CalibrationOptions& options) {
    if (!(options.sameLevel >= 0) || !(options.sameLevel < 1)) {
        return fail(ErrorCode::InvalidArgument,
                    "calibration: levels {} of the largest command apart are one; 0 or more and below 1 was expected",
                    options.sameLevel);
    }
    if (!(options.resolution >= 0) || !std::isfinite(options.resolution)) {
        return fail(ErrorCode::InvalidArgument, "calibration: resolution {}; 0 or more was expected",
                    options.resolution);
    }
    if (readings.size() > kMaxReadings) {
        return fail(ErrorCode::InvalidArgument, "calibration: {} readings; at most {} are expected", readings.size(),
                    kMaxReadings);
    }
    if (auto sane = check(readings); !sane) return failure(sane);
    Calibration found;
    found.readings.assign(readings.begin(), readings.end());
    for (auto& r : found.readings) {
        r.outlier = false;
        found.fullScale = std::max(found.fullScale, std::abs(r.commanded));
    }
    if (!(found.fullScale > 0)) {
        return fail(ErrorCode::InvalidArgument,
                    "calibration: {} readings and no command other than 0; at least two levels were expected",
                    readings.size());
    }
    std::vector<std::size_t> levelOf;
    found.levels = findLevels(readings, options.sameLevel * found.fullScale, levelOf);
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (!std::isnan(readings[i].measured)) continue;
        ++found.notMeasured;
        ++found.levels[levelOf[i]].notMeasured;
    }
    const auto groups = findGroups(found, levelOf);
    summarise(found, groups);
    const auto measuredLevels =
        std::count_if(found.levels.begin(), found.levels.end(), [](const auto& level) { return level.n > 0; });
    if (measuredLevels < 2) {
        return fail(ErrorCode::InvalidArgument,
                    "calibration: {} levels with a measured reading; a straight line needs at least two",
                    measuredLevels);
    }
    fitLine(found);
    markOutliers(found, groups, options.resolution);
    warnOfGaps(found, groups);
    return found;
}

}  // namespace tacto
