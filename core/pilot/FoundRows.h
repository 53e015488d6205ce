// FoundRows.h - rows of a pilot session that say what was planned and found, each described once: as they are written,
// read again after a crash, and shared. Absent numbers are NaN here and null in the row.
//
// Levels are in mA or, of a massager, intensities; their keys say which ("min_ma", "min_intensity").
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/statistics/Estimate.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"

namespace tacto {

/// Row "plan", beside the trials in their order.
struct PlanRow {
    std::uint64_t seed = 0;
    std::string encoding;
    std::uint64_t blocks = 0;
    std::string runSha256;
    std::string answers;  ///< conditions by their place and key, with commas between; empty: kAnswerPlaces
};
[[nodiscard]] nlohmann::json toJson(const PlanRow& row);
/// What cannot be read stays as it is in a new one; so for the others.
[[nodiscard]] PlanRow planRowFrom(const nlohmann::json& body);

/// Row "range".
struct RangeRow {
    LevelUnit unit = LevelUnit::Current;
    bool usable = false;
    std::string reason = {};  ///< in a sentence, where it is not usable
    double min = kNaN, max = kNaN;
    double jnd = kNaN;  ///< from one to the other
    LevelLimit limitedBy = LevelLimit::TooStrong;
    // Where they are currents:
    Volts minVoltage{kNaN}, maxVoltage{kNaN};  ///< at `impedance`
    Ohms impedance{kNaN};
};
[[nodiscard]] nlohmann::json toJson(const RangeRow& row);
[[nodiscard]] RangeRow rangeRowFrom(const nlohmann::json& body);

/// Row "drift": the check before a block.
struct DriftRow {
    LevelUnit unit = LevelUnit::Current;
    std::uint64_t block = 0;
    Estimate detection = {};
    double probability = kNaN;  ///< that the weakest condition is felt too little
    std::uint64_t rests = 0;
    bool adapted = false;
};
[[nodiscard]] nlohmann::json toJson(const DriftRow& row);
[[nodiscard]] DriftRow driftRowFrom(const nlohmann::json& body);

/// As StatisticsJson.h has it; null without a value.
[[nodiscard]] nlohmann::json estimateOrNull(const Estimate& estimate);
[[nodiscard]] Estimate estimateFrom(const nlohmann::json& value);

}  // namespace tacto
