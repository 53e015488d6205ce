// IdentificationTrial.h - one presentation of an identification test and what was answered to it: what a pilot session
// records of each trial, and what every figure of its analysis is computed from.
//
// Thread-safety: values; pure functions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/base/Words.h"

namespace tacto {

enum class TrialPhase { Familiarisation, Training, Test };
inline constexpr Word<TrialPhase> kTrialPhases[] = {
    {"familiarisation", TrialPhase::Familiarisation}, {"training", TrialPhase::Training}, {"test", TrialPhase::Test}};
[[nodiscard]] constexpr std::string_view nameOf(TrialPhase phase) noexcept { return wordFor(kTrialPhases, phase); }
/// Errors: InvalidArgument naming the phases.
[[nodiscard]] Result<TrialPhase> trialPhaseFrom(std::string_view name);

inline constexpr std::string_view kCatchCondition = "catch";      ///< nothing is presented
inline constexpr std::string_view kNoneResponse = "none";         ///< "I felt nothing": right after a catch only
inline constexpr std::string_view kNotSureResponse = "not-sure";  ///< never right

struct IdentificationTrial {
    std::size_t number = 0;  ///< in the plan; skipped training leaves holes
    TrialPhase phase = TrialPhase::Test;
    std::size_t block = 0;
    std::string condition;  ///< a label, or kCatchCondition
    std::string response;  ///< a label, kNoneResponse or kNotSureResponse; empty: no answer came, also when asked again
    std::size_t attempt = 1;   ///< 2 where the first was interrupted or not answered
    double rt_s = kNaN;        ///< from the appearance of the targets; NaN without an answer
    Milliamps current{kNaN};   ///< delivered; NaN where the device has none (a massager)
    double interval_s = kNaN;  ///< between onsets of trains; NaN for a catch
    std::size_t trains = 0;    ///< delivered
};

/// The two features that a label names: "rough-high" has texture "rough" and pressure "high".
struct LabelFeatures {
    std::string_view texture;
    std::string_view pressure;
};
/// Views into `label`; the second part is what follows the first hyphen, empty where there is none.
[[nodiscard]] LabelFeatures featuresOf(std::string_view label) noexcept;

}  // namespace tacto
