// Readings.h - readings from captures, and how their trains are measured.
//
// Thread-safety: as ScriptSession.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::host::measure {

using Json = nlohmann::json;

/// Captures that a script handed to a host function.
struct GivenCaptures {
    std::vector<Capture> captures;
    Json ids = Json::array();  ///< for record.trial(), which records the measured captures
};

/// Returns the captures for handles from bench.capture(). Errors: as ScriptSession::held().
[[nodiscard]] Result<GivenCaptures> capturesGiven(ScriptSession& session, const Json& handles);

/// Groups pulses into the trains that the profile commands.
[[nodiscard]] MeasureOptions optionsFor(const PulseTrain& expected);

/// Returns the mean over trains, not over pulses: a train is one event on the skin. NaN if none was measured.
[[nodiscard]] double meanOfTrains(const ChannelMeasurement& channel, double TrainMeasurement::*member);

/// Returns an amplitude's standard uncertainty without its channel's gain, which cancels in a ratio of two amplitudes.
[[nodiscard]] double withoutGain(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept;

/// Returns the part of a level's uncertainty that it does not share with another level of its channel. Gain, linearity
/// (for levels near each other) and the baseline's step cancel in a ratio of two levels.
[[nodiscard]] double ofLevelAlone(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept;

// Uncertainty of an oscilloscope's clock: standard uncertainties from what the capture states (science.md section 12).
// Unknown is NaN, never 0.

/// Returns the relative uncertainty of the time base.
[[nodiscard]] inline double timeBaseUncertainty(const Capture& capture) noexcept {
    return capture.timeBaseTolerance / std::sqrt(3.0);
}
/// Returns the uncertainty in seconds of a record's time stamp against those of other records.
[[nodiscard]] inline double stampUncertainty_s(const Capture& capture) noexcept {
    return capture.stampTolerance_s / std::sqrt(3.0);
}

/// Returns one reading for a calibration, as measure.pulse() does. `handles`: at least one, from session.hold().
/// Errors: InvalidArgument for expired captures; as measureTrains().
[[nodiscard]] Result<Json> pulseReading(ScriptSession& session, const Json& handles);

/// Handles of captures of a load; a list is empty if there are none.
struct LoadCaptures {
    Json trains = Json::array();  ///< one per train, all with the same command
    Json fine = Json::array();    ///< taken in a current range that fits the end of a phase
    Json rhythm = Json::array();  ///< at most one capture, which holds two trains
    bool byVoltage = false;       ///< phases are found in the voltage, even for a current source
};
/// Returns the effect of trains on a load: voltage, current, charge, energy and RMS over each window, as
/// toJson(LoadReading), and captures. Errors: InvalidArgument for expired captures; as readLoad().
[[nodiscard]] Result<Json> loadReading(ScriptSession& session, const LoadCaptures& captures);

}  // namespace tacto::host::measure
