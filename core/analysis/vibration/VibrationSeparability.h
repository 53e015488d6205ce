// VibrationSeparability.h - whether a massager's conditions are told apart by an accelerometer on its motor, as the
// electrical ones are by an oscilloscope.
//
// Separated means the same (Separability.h): every pair differs by at least 5 just-noticeable differences in strength
// (Weber fraction 0.10) or in interval (0.16), each by its one-sided 95 % bound; no condition varies by more than 5 %;
// and 95 % of presentations are recognised, by the lower end of the interval. A presentation in which the motor did not
// move is a failure; one that was not measured leaves the verdict open. Without an accelerometer nothing is measured,
// and nothing is said about the motor.
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
    double intensity = kNaN;  ///< commanded
    double interval_s = kNaN;
    BurstFigures measured;  ///< an accelerometer's readings; all NaN without one
};

struct VibrationCondition {
    std::string name;
    double intensity = kNaN;  ///< commanded
    double interval_s = kNaN;
    std::size_t presentations = 0;
    std::size_t bursts = 0, moved = 0, missed = 0;
    Statistics strength_m_s2, latency_s, rise_s, measuredInterval_s;  ///< over presentations
};

struct VibrationSeparability {
    bool measured = false;  ///< at least one burst was measured
    std::vector<VibrationCondition> conditions;
    std::vector<PairSummary> pairs;  ///< amplitude is strength
    Estimate accuracy;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;
};

/// `conditions` in their order. Errors: InvalidArgument for fewer than two conditions, or a trial whose condition is
/// not listed.
[[nodiscard]] Result<VibrationSeparability> judgeVibration(std::span<const VibrationTrial> trials,
                                                           const std::vector<std::string>& conditions);

/// {"measured", "verdict", "reasons", "conditions": [{name, intensity, interval_s, presentations, bursts, moved,
/// missed, strength_m_s2, latency_s, rise_s, measured_interval_s}], "pairs": [{a, b, strength_jnd, strength_jnd_low,
/// interval_jnd, interval_jnd_low}], "accuracy"}; without a measurement the verdict is null.
[[nodiscard]] nlohmann::json toJson(const VibrationSeparability& found);
/// How it is shown where it is the member `place` of results.
[[nodiscard]] std::vector<ResultTable> vibrationTables(const std::string& place);

/// The figures of one presentation: {bursts, moved, missed, strength_m_s2, strength_u_m_s2, latency_s, rise_s,
/// interval_s, interval_u_s, noise_m_s2}.
[[nodiscard]] nlohmann::json toJson(const BurstFigures& figures);
[[nodiscard]] BurstFigures burstFiguresFrom(const nlohmann::json& json);

}  // namespace tacto
