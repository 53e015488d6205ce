// StimulatorLevels.h - the parts of a stimulator's calibration: its levels, how each is set and read, and the check of
// a stored calibration.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/calibration/CalibrationVerdict.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::stimulator_calibration {

using Json = nlohmann::json;

/// The range over which a quantity is calibrated, in the unit of its setting.
struct LevelRange {
    [[nodiscard]] double at(double share) const { return low + share * (high - low); }

    double low = 0, high = 0;
};

/// The settings for the levels of a run.
struct LevelSettings {
    double load_ohm = 0, rate_hz = 0, settling_s = 0;
    LevelRange amplitude_v = {}, interval_s = {}, width_us = {}, gap_us = {};
    [[nodiscard]] LevelRange& of(const CalibratedQuantity& quantity);
};
/// Returns the members of "settings": load, rate_hz, settling_s, amplitude_min_v, amplitude_max_v, ...
[[nodiscard]] std::vector<HostParameter> levelSettings();
/// Errors: InvalidArgument for a range with a lowest level that is not below the largest.
[[nodiscard]] Result<LevelSettings> levelSettingsFrom(const Arguments& arguments);
/// Narrows the ranges to the ranges of a stored calibration (storedCalibration()). The amplitude of a current source is
/// set in volts but known in mA, so it is not narrowed. Errors: as levelSettingsFrom().
[[nodiscard]] Result<LevelSettings> narrowed(LevelSettings settings, const Json& stored, const Arguments& arguments);

// Errors of the functions below: as bench.arm() and bench.capture().

/// Arms, reads one train of the largest amplitude, and disarms. Returns a reading like measure.pulse().
[[nodiscard]] Result<Json> readKnownLoad(ScriptSession& session, const LevelSettings& settings);
/// Delivers trains of the lowest amplitude at the shortest interval for `seconds` (0: none), then disarms.
[[nodiscard]] Result<void> warmUp(ScriptSession& session, double load_ohm, double seconds);
/// Sets straight curves, so that roughness R sets the amplitude and pressure P the interval, and arms for levels of
/// these two. Each level of width and gap arms again, because they are part of the profile.
[[nodiscard]] Result<void> beginLevels(ScriptSession& session, const LevelSettings& settings,
                                       const CalibratedQuantity& quantity);
/// Sets a level (0 lowest to 1 largest), waits until it has settled, and reads a train; for the interval, two trains,
/// in one record if the oscilloscope states no tolerance of its time stamps. All levels are read in one range of the
/// oscilloscope, so that its errors are the same for all.
[[nodiscard]] Result<Json> readLevel(ScriptSession& session, const LevelSettings& settings,
                                     const CalibratedQuantity& quantity, double share);

/// Checks whether a stored line still holds where its range was read again. `found`: from analysis.calibration().
[[nodiscard]] CalibrationCheck checkAgainst(const Json& line, const Json& found, double tolerance_pct);

/// Checks the oscilloscope's time base by the computer's clock, which times the trains: a wrong time base makes all
/// times wrong. Returns an empty text if it is right or was not read (null), else the reason.
[[nodiscard]] std::string timeBaseProblem(const Json& interval);
/// Returns { verdict, reasons } of all quantities found: the worst verdict, or indeterminate if `clock` says that the
/// time base is uncertain. checkVerdictOf() does the same for checks of what is `stored`.
[[nodiscard]] Json verdictOf(const std::vector<Json>& found, const std::string& clock, bool store);
[[nodiscard]] Json checkVerdictOf(const std::vector<Json>& checks, const std::string& stored);

}  // namespace tacto::host::stimulator_calibration
