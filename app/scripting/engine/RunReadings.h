// RunReadings.h - the readings and calibrations that the program itself made during one run. A script refers to them by
// number; whatever else a script says about them is ignored (hazard H1: a script asks, it never vouches).
//
// Thread-safety: none, like ScriptSession, which owns this.
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

/// The command at the time of a capture, in seconds and in the source's unit (V or mA). NaN: not known.
struct CapturedCommand {
    double amplitude = 0;
    double interval_s = 0;
    double width_s = 0;
    double gap_s = 0;
    bool calibrationApplied = false;  ///< the programmed value differed from the command
    bool simulated = false;           ///< captured by a simulated instrument
};

/// One reading of measure.pulse().
struct OwnReading {
    std::vector<std::int64_t> captures;
    std::vector<CapturedCommand> commands;  ///< one for each capture
    nlohmann::json read;                    ///< amplitude, interval_s, width_s, gap_s as measured; null: not measured
    std::string unit;                       ///< the amplitude's unit: V or mA
    // The oscilloscope's own statement, in the amplitude's unit; NaN: not stated.
    double gainTolerance = kNaN;
    double probeTolerance = kNaN;
    double linearityTolerance = 0;
    double resolution = kNaN;
    double fullScale = kNaN;
    double timeBaseTolerance = kNaN;
    double stampTolerance_s = kNaN;  ///< 0 if a single record holds the whole reading
    std::string statedBy{};
    double samplingStep_s = 0;
};

/// A result of analysis.calibration() that uses only readings of this run.
struct OwnCalibration {
    std::string quantity;
    nlohmann::json found;                ///< as analysis.calibration() returned it
    std::vector<std::int64_t> readings;  ///< the numbers of the readings
    bool simulated = false;
    std::optional<double> gainTolerance;  ///< the instrument's relative half-width; nothing: not stated
    std::string statedBy;                 ///< "the instrument" or "the operator"
    bool calibrationApplied = false;      ///< at least one reading was taken with a calibration applied
};

/// Returns `value` as scripts get it and hand it back: NaN and infinities become null, whole numbers have no fraction.
[[nodiscard]] nlohmann::json asScriptsSeeIt(nlohmann::json value);

class RunReadings {
public:
    [[nodiscard]] std::int64_t add(OwnReading reading);
    [[nodiscard]] std::int64_t add(OwnCalibration calibration);

    /// Returns the readings with these numbers, for one calibration. Errors: InvalidArgument for an unknown number, or
    /// for a reading or capture that occurs twice.
    [[nodiscard]] Result<std::vector<const OwnReading*>> readings(const std::vector<std::int64_t>& numbers) const;
    /// Remembers what a host function returned, for results that scripts pass on unchanged.
    void note(nlohmann::json made);
    /// True if note() got exactly this value.
    [[nodiscard]] bool noted(const nlohmann::json& said) const;

    /// Returns null if no calibration has this number.
    [[nodiscard]] const OwnCalibration* calibration(const nlohmann::json& number) const noexcept;

private:
    std::vector<OwnReading> readings_;
    std::vector<OwnCalibration> calibrations_;
    std::vector<nlohmann::json> made_;
};

/// A calibrated quantity, and the member of CapturedCommand with its commanded value.
struct OwnQuantity : CalibratedQuantity {
    double CapturedCommand::*commanded;
};
/// Returns null for an unknown id.
[[nodiscard]] const OwnQuantity* ownQuantity(std::string_view id) noexcept;

}  // namespace tacto
