// VibrationSeparability.h - tests whether a massager's conditions can be told apart by an accelerometer on its motor,
// as an oscilloscope does for electrical conditions.
//
// The criteria are those of Separability.h. Every pair must differ by at least 5 just-noticeable differences in
// strength (Weber fraction 0.10) or in interval (0.16), each by its one-sided 95 % bound. No condition may vary by more
// than 5 %. 95 % of presentations must be recognised, by the lower end of the interval. A presentation in which the
// motor did not move is a failure; one that was not measured leaves the verdict open. Without an accelerometer there is
// no result.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/analysis/vibration/BurstFigures.h"
#include "core/results/ResultTable.h"

namespace tacto {

/// One presentation of a condition.
struct VibrationTrial {
    std::string condition;
    double intensity = kNaN;  ///< commanded intensity
    double interval_s = kNaN;
    BurstFigures measured;  ///< accelerometer figures; all NaN without an accelerometer
};

struct VibrationCondition {
    std::string name;
    double intensity = kNaN;  ///< commanded intensity
    double interval_s = kNaN;
    std::size_t presentations = 0;
    std::size_t bursts = 0, moved = 0, missed = 0;
    Statistics strength_m_s2, latency_s, rise_s, measuredInterval_s;  ///< over all presentations
};

struct VibrationSeparability {
    bool measured = false;  ///< true if at least one burst was measured
    std::vector<VibrationCondition> conditions;
    std::vector<PairSummary> pairs;  ///< the amplitude of a pair is the strength
    Estimate accuracy;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;
};

/// `conditions` in the order of the results. Errors: InvalidArgument for fewer than two conditions, or a trial with a
/// condition that is not listed.
[[nodiscard]] Result<VibrationSeparability> judgeVibration(std::span<const VibrationTrial> trials,
                                                           const std::vector<std::string>& conditions);

/// {"measured", "verdict", "reasons", "conditions": [{name, intensity, interval_s, presentations, bursts, moved,
/// missed, strength_m_s2, latency_s, rise_s, measured_interval_s}], "pairs": [{a, b, strength_jnd, strength_jnd_low,
/// interval_jnd, interval_jnd_low}], "accuracy"}; without a measurement the verdict is null.
[[nodiscard]] nlohmann::json toJson(const VibrationSeparability& found);
/// Returns the tables for results that hold this one as their member `place`.
[[nodiscard]] std::vector<ResultTable> vibrationTables(const std::string& place);

/// Writes the figures of one presentation: {bursts, moved, missed, strength_m_s2, strength_u_m_s2, latency_s, rise_s,
/// interval_s, interval_u_s, noise_m_s2}.
[[nodiscard]] nlohmann::json toJson(const BurstFigures& figures);
[[nodiscard]] BurstFigures burstFiguresFrom(const nlohmann::json& json);

}  // namespace tacto
