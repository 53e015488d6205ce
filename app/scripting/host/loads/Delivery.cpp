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

Result<Json> commandOf(ScriptSession& session, const Arguments& arguments) {
    return bench::predictCommand(session, arguments.text("command.load"), arguments.number("command.strength"));
}

double numberOf(const Json& command, const char* key) { return command.at(key).get<double>(); }

/// Drives the command and lets one train pass.
Result<void> begin(Bench& bench, const Json& command) {
    if (auto driven = bench.drive(DriveSource::Manual, numberOf(command, "roughness"), numberOf(command, "pressure"));
        !driven)
        return driven;
    return bench.wait(Seconds(kIntervals * numberOf(command, "interval_s")));
}

bench::CaptureOptions optionsFor(const Json& command, int trains) {
    const Json& suggested = command.at("capture");
    return {.trains = trains,
            .rate_hz = numberOf(suggested, "rate_hz"),
            .samples = static_cast<std::size_t>(numberOf(suggested, "samples")),
            .voltageRange_v = numberOf(suggested, "voltage_range_v"),
            .currentRange_ma = numberOf(suggested, "current_range_ma"),
            .trigger_v = numberOf(suggested, "trigger_v")};
}

Result<Json> held(ScriptSession& session, const bench::CaptureOptions& options) {
    auto captures = bench::captureTrains(session, options);
    if (!captures) return failure(captures);
    return session.hold(std::move(*captures));
}

/// Several trains, so that there is an interval and a spread to measure, after one that brings the output to its level.
Result<Json> readTrains(ScriptSession& session, const Json& command, int trains) {
    Bench& bench = session.bench();
    if (auto begun = begin(bench, command); !begun) return failure(begun);
    while (std::abs(bench.telemetry().amplitude_v - numberOf(command, "command_v")) > 1e-6) {
        if (auto waited = bench.wait(Seconds(kIntervals * numberOf(command, "interval_s"))); !waited)
            return failure(waited);
    }
    measure::LoadCaptures captures;
    auto options = optionsFor(command, trains);
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
    if (!command.at("fine_range_ma").is_null()) {
        options.currentRange_ma = numberOf(command, "fine_range_ma");
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
    if (!command) return command;
    Bench& bench = session.bench();
    Json entry = {{"command_v", command->at("command_v")}, {"interval_s", command->at("interval_s")}};
    if (!command->at("not_applicable").is_null()) {
        entry["reason"] = command->at("not_applicable");
        return Json{{"list", "undriven"}, {"entry", entry}};
    }
    const auto refusal = [&entry](const Json& forbidden, bool refused, const Json& predicted, std::string_view reason) {
        entry.update({{"forbidden", forbidden}, {"refused", refused}, {"predicted", predicted}, {"reason", reason}});
        return Json{{"list", "refusals"}, {"entry", entry}};
    };
    const auto asked = bench::attemptCommand(bench, numberOf(*command, "roughness"), numberOf(*command, "pressure"));
    if (!asked) return failure(asked);
    const bool forbidden = command->at("forbidden").get<bool>();
    if (asked->refused || forbidden) return refusal(forbidden, asked->refused, command->at("predicted"), asked->reason);

    const auto refusedBefore = bench.telemetry().trainsRefused;
    auto reading = readTrains(session, *command, arguments.whole("trains"));
    if (!reading && !isRefusal(bench, refusedBefore, reading.error())) return reading;
    if (auto off = bench.drive(DriveSource::Off); !off) return failure(off);
    if (!reading) return refusal(false, true, "", reading.error().message);
    const double tenths_v = std::round(10 * numberOf(*command, "command_v")) / 10;
    entry["condition"] = fmt::format("{}, {:.1f} V", arguments.text("command.load"), tenths_v);
    entry["rate_hz"] = command->at("capture").at("rate_hz");
    entry["reading"] = std::move(*reading);
    return Json{{"list", "steps"}, {"entry", entry}};
}

Result<Json> burst(ScriptSession& session, const Arguments& arguments) {
    const auto command = commandOf(session, arguments);
    if (!command) return command;
    if (!command->contains("capture"))
        return fail(ErrorCode::InvalidArgument, "loads.burst: {}", command->at("not_applicable").get<std::string>());
    if (auto begun = begin(session.bench(), *command); !begun) return failure(begun);
    constexpr double kFastest_hz = 100e3, kMaxSamples = 500e3, kIntervalsHeld = 2.5;
    const double seconds = kIntervalsHeld * numberOf(*command, "interval_s");
    auto options = optionsFor(*command, 1);
    options.rate_hz = std::min(kFastest_hz, kMaxSamples / seconds);
    options.samples = static_cast<std::size_t>(std::floor(options.rate_hz * seconds));
    const auto captures = held(session, options);
    if (!captures) return captures;
    return Json{{"command_v", command->at("command_v")},
                {"interval_s", command->at("interval_s")},
                {"rate_hz", options.rate_hz},
                {"captures", *captures}};
}

}  // namespace tacto::host::loads
