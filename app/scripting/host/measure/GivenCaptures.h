// GivenCaptures.h - the captures that a script handed to a host function, and how their trains are measured.
//
// Thread-safety: as ScriptSession.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::host::measure {

struct GivenCaptures {
    std::vector<Capture> captures;
    nlohmann::json ids = nlohmann::json::array();  ///< for record.trial(), which keeps what was measured
};

/// Behind handles from bench.capture(). Errors: as ScriptSession::held().
[[nodiscard]] Result<GivenCaptures> capturesGiven(ScriptSession& session, const nlohmann::json& handles);

/// Pulses grouped into the trains that the profile commands.
[[nodiscard]] MeasureOptions optionsFor(const PulseTrain& expected);

/// Over the trains, not over their pulses: a train is one event on the skin. NaN where none was measured.
[[nodiscard]] double meanOfTrains(const ChannelMeasurement& channel, double TrainMeasurement::*member);

/// Standard uncertainty of an amplitude but for the gain of its channel, which divides out of the ratio of two.
[[nodiscard]] double withoutGain(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept;

/// The uncertainty of a level by itself: what it does not share with another of the same channel. Gain, linearity (of
/// levels that are near each other) and the baseline's own step divide out of the ratio of two.
[[nodiscard]] double ofLevelAlone(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept;

}  // namespace tacto::host::measure
