// Makes one reading for a calibration from captures.
#include <cmath>

#include "app/scripting/host/measure/Readings.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/measure/InstrumentStatement.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::host::measure {

namespace {

/// Returns the data sheet's statements about the channel, in the reading's unit (`scale`: mA per A).
Json instrumentOf(const Capture& capture, const CaptureChannel& channel, double scale) {
    const auto positive = [](double value) { return value > 0 ? Json(value) : Json(); };
    return {{"gain_tolerance", numberOrNull(channel.gainTolerance)},
            {"probe_tolerance", numberOrNull(channel.probeTolerance)},
            {"linearity_tolerance", numberOrNull(channel.linearityTolerance * scale)},
            {"offset_tolerance", numberOrNull(channel.offsetTolerance * scale)},
            {"resolution", positive(channel.lsb * scale)},
            {"timebase_tolerance", numberOrNull(capture.timeBaseTolerance)},
            {"stamp_tolerance_s", numberOrNull(capture.stampTolerance_s)},
            {"stated_by", channel.statedBy},
            {"not_stated", notStatedText(capture)},
            {"sampling_step_s", 1 / capture.rate_hz},
            {"full_scale", positive(channel.high * scale)}};
}

/// Returns the command to the stimulator at the time of the capture.
Json commandJson(const CapturedCommand& command) {
    return {{"amplitude", numberOrNull(command.amplitude)},
            {"interval_s", numberOrNull(command.interval_s)},
            {"width_s", numberOrNull(command.width_s)},
            {"gap_s", numberOrNull(command.gap_s)}};
}

/// Adds the load V/I with its expanded uncertainty from what both channels state; null if they do not state it.
void addLoad(Json& out, const Capture& capture, const ChannelMeasurement& voltage, const ChannelMeasurement& current) {
    const double volts = meanOfTrains(voltage, &TrainMeasurement::amplitude);
    const double amps = meanOfTrains(current, &TrainMeasurement::amplitude);
    const auto *v = channelOf(capture, "voltage"), *i = channelOf(capture, "current");
    if (v == nullptr || i == nullptr || !(volts > 0) || !(amps > 0)) return;
    const bool shared = capture.gainShared;  // a shared gain cancels in V/I
    const double relative = std::hypot((shared ? withoutGain(voltage, *v) : voltage.uncertainty.amplitude) / volts,
                                       (shared ? withoutGain(current, *i) : current.uncertainty.amplitude) / amps);
    out["load_ohm"] = volts / amps;
    out["load_expanded_ohm"] = numberOrNull(kCoverage * relative * volts / amps);
    if (i->lsb > 0) out["current_lsb"] = amps / i->lsb;
}

}  // namespace

Result<Json> pulseReading(ScriptSession& session, const Json& handles) {
    auto given = capturesGiven(session, handles);
    if (!given) return failure(given);
    const auto& captures = given->captures;
    const auto commands = session.commandsOf(given->ids);
    if (!commands) return failure(commands);
    const auto& stimulator = session.bench().devices().stimulator;
    const auto options = optionsFor(session.bench().profile().encoding.train);

    auto voltage = measureTrains(captures, "voltage", options);
    if (!voltage) return failure(voltage);
    const auto current = measureTrains(captures, "current", options);
    const bool drivesCurrent = stimulator->traits().drive == Drive::Current;
    if (drivesCurrent && !current) return failure(current);
    const ChannelMeasurement& read = drivesCurrent ? *current : *voltage;
    const double scale = drivesCurrent ? 1e3 : 1;
    const auto* channel = channelOf(captures.front(), read.name);

    Json out = {{"unit", amplitudeUnit(stimulator->traits().drive)},
                {"amplitude", numberOrNull(scale * meanOfTrains(read, &TrainMeasurement::amplitude))},
                {"interval_s", numberOrNull(meanOfTrains(read, &TrainMeasurement::interval_s))},
                {"width_s", numberOrNull(meanOfTrains(read, &TrainMeasurement::width_s))},
                {"gap_s", numberOrNull(read.gap_s.mean)},
                {"trains", read.trains.size()},
                {"warnings", read.warnings},
                {"commanded", commandJson(commands->back())},
                {"instrument", instrumentOf(captures.front(), *channel, scale)},
                {"captures", given->ids}};
    if (current) {
        addLoad(out, captures.front(), *voltage, *current);
    }
    OwnReading own;
    for (const auto& id : given->ids) own.captures.push_back(id.get<std::int64_t>());
    own.commands = *commands;
    for (const char* key : {"amplitude", "interval_s", "width_s", "gap_s"}) own.read[key] = out[key];
    own.unit = amplitudeUnit(stimulator->traits().drive);
    own.gainTolerance = channel->gainTolerance;
    own.probeTolerance = channel->probeTolerance;
    own.linearityTolerance = channel->linearityTolerance * scale;
    if (channel->lsb > 0) own.resolution = channel->lsb * scale;
    if (channel->high > 0) own.fullScale = channel->high * scale;
    own.timeBaseTolerance = captures.front().timeBaseTolerance;
    own.stampTolerance_s = captures.size() > 1 ? captures.front().stampTolerance_s : 0;
    own.statedBy = channel->statedBy;
    own.samplingStep_s = 1 / captures.front().rate_hz;
    out["reading"] = session.own().add(std::move(own));
    return out;
}

namespace {

Result<Json> pulse(ScriptSession& session, const Arguments& arguments) {
    const Json& handles = arguments.list("captures");
    if (handles.empty()) return arguments.wrong("captures", handles, "at least one capture");
    return pulseReading(session, handles);
}

}  // namespace

}  // namespace tacto::host::measure

namespace tacto {

std::vector<HostFunction> pulseFunctions() {
    using namespace takes;
    return {
        {.name = "pulse",
         .parameters = {list("captures", "from bench.capture(), in time order")},
         .text = "One reading for a calibration: what came out beside what was commanded, and what the oscilloscope "
                 "states of itself.",
         .returns =
             "{ unit, amplitude, interval_s, width_s, gap_s, trains, warnings, commanded: { amplitude, interval_s, "
             "width_s, gap_s }, instrument: { gain_tolerance, offset_tolerance, resolution, sampling_step_s, "
             "full_scale }, load_ohm, load_expanded_ohm, captures, reading }: reading is its number in this run, for "
             "analysis.calibration(); amplitude in unit, V or mA by the stimulator's source; what could not be "
             "measured or is not stated is null; load_ohm is V / I, load_expanded_ohm its U from what both channels "
             "state.",
         .errors = "Throws for captures that are held no longer, or without the channel that is read.",
         .needs = Role::Stimulator,
         .call = host::measure::pulse},
    };
}

}  // namespace tacto
