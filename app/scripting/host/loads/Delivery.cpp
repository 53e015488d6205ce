// Giving a command on the load that is armed, and reading what the oscilloscope saw of it.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/bench/Prediction.h"
#include "app/scripting/host/bench/TrainCaptures.h"
#include "app/scripting/host/loads/LoadsObject.h"
#include "app/scripting/host/measure/LoadReadings.h"

namespace tacto::host::loads {

namespace {

constexpr double kIntervals = 1.2;  // of a wait: the next train has come, also a little late

using bench::PredictedCommand;

Result<PredictedCommand> commandOf(ScriptSession& session, const Arguments& arguments) {
    return bench::predictCommand(session, arguments.text("command.load"), arguments.number("command.strength"));
}

/// Drives the command and lets one train pass.
Result<void> begin(Bench& bench, const PredictedCommand& command) {
    if (auto driven = bench.drive(DriveSource::Manual, command.roughness, command.pressure); !driven) return driven;
    return bench.wait(Seconds(kIntervals * command.interval_s));
}

Result<Json> held(ScriptSession& session, const bench::CaptureOptions& options) {
    auto captures = bench::captureTrains(session, options);
    if (!captures) return failure(captures);
    return session.hold(std::move(*captures));
}

/// Several trains, so that there is an interval and a spread to measure, after one that brings the output to its level.
Result<Json> readTrains(ScriptSession& session, const PredictedCommand& command, int trains) {
    Bench& bench = session.bench();
    if (auto begun = begin(bench, command); !begun) return failure(begun);
    while (std::abs(bench.telemetry().amplitude_v - command.command_v) > 1e-6) {
        if (auto waited = bench.wait(Seconds(kIntervals * command.interval_s)); !waited) return failure(waited);
    }
    measure::LoadCaptures captures;
    auto options = command.capture;
    options.trains = trains;
    auto taken = held(session, options);
    if (!taken) return taken;
    captures.trains = std::move(*taken);
    // Two trains in one record, for an oscilloscope that does not state how good its time stamps are.
    if (captures.trains.at(0).at("stamp_tolerance_s").is_null()) {
        auto together = options;
        together.trains = 2;
        together.samples = 0;
        together.intervals = true;
        auto rhythm = held(session, together);
        if (!rhythm) return rhythm;
        captures.rhythm = std::move(*rhythm);
    }
    // Where current settles far below a charging spike, it is read in a range of its own.
    if (std::isfinite(command.fineRange_ma)) {
        options.currentRange_ma = command.fineRange_ma;
        auto fine = held(session, options);
        if (!fine) return fine;
        captures.fine = std::move(*fine);
    }
    return measure::loadReading(session, captures);
}

/// A train that was refused although no limit forbids it: the bench counts it and is in no fault.
bool isRefusal(Bench& bench, std::uint64_t refusedBefore, const Error& error) {
    return error.code != ErrorCode::Stopped && bench.telemetry().trainsRefused != refusedBefore &&
           bench.telemetry().state != InterlockState::Faulted;
}

}  // namespace

Result<Json> give(ScriptSession& session, const Arguments& arguments) {
    const auto command = commandOf(session, arguments);
    if (!command) return failure(command);
    Bench& bench = session.bench();
    Json entry = {{"command_v", command->command_v}, {"interval_s", command->interval_s}};
    if (!command->notApplicable.empty()) {
        entry["reason"] = command->notApplicable;
        return Json{{"list", "undriven"}, {"entry", entry}};
    }
    const auto refusal = [&entry](bool forbidden, bool refused, std::string_view predicted, std::string_view reason) {
        entry.update({{"forbidden", forbidden}, {"refused", refused}, {"predicted", predicted}, {"reason", reason}});
        return Json{{"list", "refusals"}, {"entry", entry}};
    };
    const auto asked = bench::attemptCommand(bench, command->roughness, command->pressure);
    if (!asked) return failure(asked);
    const bool forbidden = !command->forbidden.empty();
    if (asked->refused || forbidden) return refusal(forbidden, asked->refused, command->forbidden, asked->reason);

    const auto refusedBefore = bench.telemetry().trainsRefused;
    auto reading = readTrains(session, *command, arguments.whole("trains"));
    if (!reading && !isRefusal(bench, refusedBefore, reading.error())) return reading;
    if (auto off = bench.drive(DriveSource::Off); !off) return failure(off);
    if (!reading) return refusal(false, true, "", reading.error().message);
    const double tenths_v = std::round(10 * command->command_v) / 10;
    entry["condition"] = fmt::format("{}, {:.1f} V", command->load, tenths_v);
    entry["rate_hz"] = command->capture.rate_hz;
    entry["reading"] = std::move(*reading);
    return Json{{"list", "steps"}, {"entry", entry}};
}

Result<Json> burst(ScriptSession& session, const Arguments& arguments) {
    const auto command = commandOf(session, arguments);
    if (!command) return failure(command);
    if (!command->notApplicable.empty())
        return fail(ErrorCode::InvalidArgument, "loads.burst: {}", command->notApplicable);
    if (auto begun = begin(session.bench(), *command); !begun) return failure(begun);
    constexpr double kFastest_hz = 100e3, kMaxSamples = 500e3, kIntervalsHeld = 2.5;
    const double seconds = kIntervalsHeld * command->interval_s;
    auto options = command->capture;
    options.rate_hz = std::min(kFastest_hz, kMaxSamples / seconds);
    options.samples = static_cast<std::size_t>(std::floor(options.rate_hz * seconds));
    const auto captures = held(session, options);
    if (!captures) return captures;
    return Json{{"command_v", command->command_v},
                {"interval_s", command->interval_s},
                {"rate_hz", options.rate_hz},
                {"captures", *captures}};
}

}  // namespace tacto::host::loads
