// StimulatorLevels.h - the parts of a stimulator's calibration: its levels, how each is set and read, and whether a
// stored calibration still holds.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::stimulator_calibration {

using Json = nlohmann::json;

/// The range over which a quantity is calibrated, in its setting's unit.
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
/// Members of "settings": load, rate_hz, settling_s, amplitude_min_v, amplitude_max_v, ...
[[nodiscard]] std::vector<HostParameter> levelSettings();
/// Errors: InvalidArgument for a range whose lowest level is not below the largest.
[[nodiscard]] Result<LevelSettings> levelSettingsFrom(const Arguments& arguments);
/// Narrowed to what a stored calibration knows, as storedCalibration() has it. The amplitude of a current source is set
/// in volts and known in mA, and stays as it is. Errors: as levelSettingsFrom().
[[nodiscard]] Result<LevelSettings> narrowed(LevelSettings settings, const Json& stored, const Arguments& arguments);

// Errors of what follows: as bench.arm() and bench.capture().

/// Arms, reads one train of the largest amplitude, and disarms. As measure.pulse() returns it.
[[nodiscard]] Result<Json> readKnownLoad(ScriptSession& session, const LevelSettings& settings);
/// Trains of the lowest amplitude at the shortest interval for so long; disarms. 0: not at all.
[[nodiscard]] Result<void> warmUp(ScriptSession& session, double load_ohm, double seconds);
/// Sets straight curves over the ranges, so that R sets the amplitude and P the interval level by level, and arms for
/// levels of these two. Each level of width and gap arms again, as they are part of the profile.
[[nodiscard]] Result<void> beginLevels(ScriptSession& session, const LevelSettings& settings,
                                       const CalibratedQuantity& quantity);
/// Sets a level, 0 the lowest to 1 the largest, waits until it has settled, and reads a train; for the interval two
/// trains, in one record where the oscilloscope does not state how good the time stamps of its records are. All levels
/// are read in one range of the oscilloscope: its errors are then the same for all.
[[nodiscard]] Result<Json> readLevel(ScriptSession& session, const LevelSettings& settings,
                                     const CalibratedQuantity& quantity, double share);

/// Whether a stored line still holds where its range was read again: { rows, verdict, reasons }, rows { quantity,
/// commanded, expected, measured, direction, off, expanded_uncertainty, allowed, not_measured, unit, verdict }; widths
/// and gaps in us. `found` as analysis.calibration() returns it.
[[nodiscard]] Json checkAgainst(const Json& line, const Json& found, double tolerance_pct);

/// The oscilloscope's time base by the computer's clock, which hands out the trains: one that reads the clock wrong
/// reads every time wrong. Empty when it is right or was not read (null), else why not.
[[nodiscard]] std::string timeBaseProblem(const Json& interval);
/// { verdict, reasons } of what was found of each quantity: the worst quantity's, and indeterminate where `clock` says
/// that the time base is not sure; and the same of checks of what is `stored`.
[[nodiscard]] Json verdictOf(const std::vector<Json>& found, const std::string& clock, bool store);
[[nodiscard]] Json checkVerdictOf(const std::vector<Json>& checks, const std::string& stored);

}  // namespace tacto::host::stimulator_calibration
