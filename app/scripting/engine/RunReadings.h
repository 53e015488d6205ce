// RunReadings.h - the readings and calibrations that the program itself made during one run. A script refers to them by
// number; nothing else that it says about them counts (hazard H1: a script asks, it never vouches).
//
// Thread-safety: none; as ScriptSession, which holds it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

/// The command when a capture was taken: s, and V or mA by the source. NaN where it is not known.
struct CapturedCommand {
    double amplitude = 0;
    double interval_s = 0;
    double width_s = 0;
    double gap_s = 0;
    bool calibrationApplied = false;  ///< something else than the command was programmed
    bool simulated = false;           ///< the capture is of a simulated instrument
};

/// One reading of measure.pulse().
struct OwnReading {
    std::vector<std::int64_t> captures;
    std::vector<CapturedCommand> commands;  ///< one for each capture
    nlohmann::json read;                    ///< amplitude, interval_s, width_s, gap_s as measured; null: not measured
    std::string unit;                       ///< the amplitude's unit: V or mA
    // The oscilloscope's statement, in the amplitude's unit; NaN: not stated.
    double gainTolerance = kNaN;
    double probeTolerance = kNaN;
    double linearityTolerance = 0;
    double resolution = kNaN;
    double fullScale = kNaN;
    double timeBaseTolerance = kNaN;
    double stampTolerance_s = kNaN;  ///< 0 where one record holds all of it
    std::string statedBy{};
    double samplingStep_s = 0;
};

/// One result of analysis.calibration() that rests on own readings alone.
struct OwnCalibration {
    std::string quantity;
    nlohmann::json found;                ///< as the function returned it
    std::vector<std::int64_t> readings;  ///< their numbers
    bool simulated = false;
    std::optional<double> gainTolerance;  ///< the instrument's, as a relative half-width; nothing: not stated
    std::string statedBy;                 ///< "the instrument" or "the operator"
    bool calibrationApplied = false;      ///< one of the readings had its calibration applied
};

/// The form of `value` that scripts get and hand back: NaN and the infinities are null, whole numbers have no fraction.
[[nodiscard]] nlohmann::json asScriptsSeeIt(nlohmann::json value);

class RunReadings {
public:
    [[nodiscard]] std::int64_t add(OwnReading reading);
    [[nodiscard]] std::int64_t add(OwnCalibration calibration);

    /// The readings with these numbers, for one calibration. Errors: InvalidArgument for a number without a reading, or
    /// a reading or capture that comes twice.
    [[nodiscard]] Result<std::vector<const OwnReading*>> readings(const std::vector<std::int64_t>& numbers) const;
    /// Remembers what a host function returned, where scripts hand on whole objects.
    void note(nlohmann::json made);
    /// True for what was noted, unchanged.
    [[nodiscard]] bool noted(const nlohmann::json& said) const;

    /// Nothing for a number that belongs to no calibration.
    [[nodiscard]] const OwnCalibration* calibration(const nlohmann::json& number) const noexcept;

private:
    std::vector<OwnReading> readings_;
    std::vector<OwnCalibration> calibrations_;
    std::vector<nlohmann::json> made_;
};

/// A calibrated quantity, and what was commanded of it.
struct OwnQuantity : CalibratedQuantity {
    double CapturedCommand::*commanded;
};
/// Null for another id.
[[nodiscard]] const OwnQuantity* ownQuantity(std::string_view id) noexcept;

}  // namespace tacto
