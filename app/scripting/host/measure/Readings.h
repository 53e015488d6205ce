// Readings.h - what is read off captures, and how their trains are measured.
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
    Json ids = Json::array();  ///< for record.trial(), which keeps what was measured
};

/// Behind handles from bench.capture(). Errors: as ScriptSession::held().
[[nodiscard]] Result<GivenCaptures> capturesGiven(ScriptSession& session, const Json& handles);

/// Pulses grouped into the trains that the profile commands.
[[nodiscard]] MeasureOptions optionsFor(const PulseTrain& expected);

/// The mean over the trains, not over their pulses: a train is one event on the skin. NaN where none was measured.
[[nodiscard]] double meanOfTrains(const ChannelMeasurement& channel, double TrainMeasurement::*member);

/// Standard uncertainty of an amplitude but for the gain of its channel, which divides out of the ratio of two.
[[nodiscard]] double withoutGain(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept;

/// The uncertainty of a level by itself: what it does not share with another of the same channel. Gain, linearity (of
/// levels that are near each other) and the baseline's own step divide out of the ratio of two.
[[nodiscard]] double ofLevelAlone(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept;

// How well an oscilloscope's clock is known, as standard uncertainties of what the capture states (science.md section
// 12). Unknown is NaN and never 0.

/// The relative uncertainty of the time base.
[[nodiscard]] inline double timeBaseUncertainty(const Capture& capture) noexcept {
    return capture.timeBaseTolerance / std::sqrt(3.0);
}
/// The uncertainty of a record's time stamp against those of other records, s.
[[nodiscard]] inline double stampUncertainty_s(const Capture& capture) noexcept {
    return capture.stampTolerance_s / std::sqrt(3.0);
}

/// One reading for a calibration as measure.pulse() returns it; `handles` stand for captures, as session.hold() gives
/// them, at least one. Errors: InvalidArgument for captures that are held no longer; as measureTrains().
[[nodiscard]] Result<Json> pulseReading(ScriptSession& session, const Json& handles);

/// Handles of captures of a load; an empty list where there are none.
struct LoadCaptures {
    Json trains = Json::array();  ///< one for each train, all with one command
    Json fine = Json::array();    ///< taken in a current range that fits the end of a phase
    Json rhythm = Json::array();  ///< at most one, and it holds two trains
    bool byVoltage = false;       ///< voltage shows the phases, also of a current source
};
/// The effect of trains on a load: voltage, current, charge, energy, RMS over each window, as toJson(LoadReading), and
/// captures. Errors: InvalidArgument for captures that are held no longer; as readLoad().
[[nodiscard]] Result<Json> loadReading(ScriptSession& session, const LoadCaptures& captures);

}  // namespace tacto::host::measure
