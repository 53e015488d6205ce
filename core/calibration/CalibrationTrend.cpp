#include "core/calibration/CalibrationTrend.h"

#include <algorithm>
#include <cmath>

#include "core/base/Statistics.h"

namespace tacto {

const StoredLine* lineOf(const StoredCalibration& stored, std::string_view quantity) {
    if (quantity == kCalibratedAmplitude.id) return &stored.amplitude;
    for (const auto& time : kStoredTimes) {
        if (time.id == quantity && stored.*time.line) return &*(stored.*time.line);
    }
    return nullptr;
}

std::vector<TrendPoint> trendOf(std::span<const StoredCalibration> of, std::string_view unit, bool simulated,
                                std::string_view quantity) {
    std::vector<TrendPoint> points;
    for (const auto& stored : of) {
        const auto* line = lineOf(stored, quantity);
        if (line == nullptr || stored.unit != unit || stored.simulated != simulated) continue;
        const double u = line->uncertainty_pct > 0 ? line->uncertainty_pct : kNaN;
        points.push_back({stored.made, line->gain, line->offset, u, u / 100, u / 100 * line->lowest});
    }
    std::ranges::stable_sort(points, {}, &TrendPoint::made);
    return points;
}

std::vector<TrendJump> jumpsIn(std::span<const TrendPoint> points) {
    std::vector<TrendJump> jumps;
    const auto compare = [&](TrendJump::What what, const TrendPoint& a, const TrendPoint& b, double TrendPoint::*value,
                             double TrendPoint::*u) {
        const double change = b.*value - a.*value;
        const double explained = std::hypot(a.*u, b.*u);
        if (std::abs(change) > explained) jumps.push_back({what, a.made, b.made, change, explained});
    };
    for (std::size_t i = 1; i < points.size(); ++i) {
        const auto& a = points[i - 1];
        const auto& b = points[i];
        compare(TrendJump::What::Gain, a, b, &TrendPoint::gain, &TrendPoint::gainU);
        compare(TrendJump::What::Offset, a, b, &TrendPoint::offset, &TrendPoint::offsetU);
    }
    return jumps;
}

}  // namespace tacto
