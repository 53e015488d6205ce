// Arms on a load, gives a command on it, and reads the oscilloscope's captures.
#include <algorithm>
#include <cmath>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/load_safety/LoadCommands.h"
#include "app/scripting/host/measure/Readings.h"

namespace tacto::host::load_safety {

namespace {

constexpr double kIntervals = 1.2;  // intervals to wait: the next train has come by then, even if late

struct Attempt {
    bool refused = false;
    std::string reason;  ///< why the train was refused
};

/// Asks for one train of this command while armed; the drive is off again afterwards.
Result<Attempt> attempt(Bench& bench, const LoadCommand& command) {
    const auto before = bench.telemetry().trainsDelivered;
    if (auto driven = bench.drive(DriveSource::Manual, command.roughness, command.pressure); !driven)
        return failure(driven);
    // Two intervals: the first train may take one interval to come, and its status a little longer.
    const Seconds longest = 2 * Seconds(bench.profile().encoding.intervalMax);
    Result<void> waited;
    double passed_s = 0;
    constexpr double kPoll_s = 0.05;
    while (waited && passed_s < longest.count() && bench.telemetry().trainsDelivered == before) {
        waited = bench.wait(Seconds(kPoll_s));
        passed_s += kPoll_s;
    }
    if (auto off = bench.drive(DriveSource::Off); !off) return failure(off);
    if (!waited && waited.error().code != ErrorCode::LimitExceeded) return failure(waited);
    const bool delivered = bench.telemetry().trainsDelivered != before;
    return Attempt{!waited && !delivered, waited ? "" : waited.error().message};
}

/// Drives the command and lets one train pass.
Result<void> begin(Bench& bench, const LoadCommand& command) {
    if (auto driven = bench.drive(DriveSource::Manual, command.roughness, command.pressure); !driven) return driven;
    return bench.wait(Seconds(kIntervals * command.interval_s));
}

Result<Json> held(ScriptSession& session, const bench::CaptureOptions& options) {
    auto captures = bench::captureTrains(session, options);
    if (!captures) return failure(captures);
    return session.hold(std::move(*captures));
}

/// Lets one train pass so that the output reaches its level, then reads several trains for interval and spread.
Result<Json> readTrains(ScriptSession& session, const LoadCommand& command, int trains) {
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
    // For an oscilloscope that states no tolerance of its time stamps: two trains in one record.
    if (captures.trains.at(0).at("stamp_tolerance_s").is_null()) {
        auto together = options;
        together.trains = 2;
        together.samples = 0;
        together.intervals = true;
        auto rhythm = held(session, together);
        if (!rhythm) return rhythm;
        captures.rhythm = std::move(*rhythm);
    }
    // A current that settles far below a charging spike is captured again in its own range.
    if (std::isfinite(command.fineRange_ma)) {
        options.currentRange_ma = command.fineRange_ma;
        auto fine = held(session, options);
        if (!fine) return fine;
        captures.fine = std::move(*fine);
    }
    return measure::loadReading(session, captures);
}

/// True for a train that was refused although no limit forbids it: the bench counts it and is in no fault.
bool isRefusal(Bench& bench, std::uint64_t refusedBefore, const Error& error) {
    return error.code != ErrorCode::Stopped && bench.telemetry().trainsRefused != refusedBefore &&
           bench.telemetry().state != InterlockState::Faulted;
}

}  // namespace

Result<std::optional<Error>> tryToArm(ScriptSession& session, const std::string& load) {
    const auto request = confirmedArming(session, load);
    if (!request) return failure(request);
    const auto armed = session.bench().arm(*request);
    if (armed) return std::optional<Error>();
    session.bench().disarm();
    const bool isOver = session.bench().telemetry().state != InterlockState::Disarmed;
    if (isOver || armed.error().code == ErrorCode::Stopped) return failure(armed);
    return std::optional(armed.error());
}

Result<Given> give(ScriptSession& session, const LoadCommand& command, int trains) {
    Bench& bench = session.bench();
    Json entry = {{"command_v", command.command_v}, {"interval_s", command.interval_s}};
    if (!command.notApplicable.empty()) {
        entry["reason"] = command.notApplicable;
        return Given{"undriven", entry};
    }
    const auto refusal = [&entry](bool forbidden, bool refused, std::string_view predicted, std::string_view reason) {
        entry.update({{"forbidden", forbidden}, {"refused", refused}, {"predicted", predicted}, {"reason", reason}});
        return Given{"refusals", entry};
    };
    const auto asked = attempt(bench, command);
    if (!asked) return failure(asked);
    const bool forbidden = !command.forbidden.empty();
    if (asked->refused || forbidden) return refusal(forbidden, asked->refused, command.forbidden, asked->reason);

    const auto refusedBefore = bench.telemetry().trainsRefused;
    auto reading = readTrains(session, command, trains);
    if (!reading && !isRefusal(bench, refusedBefore, reading.error())) return failure(reading);
    if (auto off = bench.drive(DriveSource::Off); !off) return failure(off);
    if (!reading) return refusal(false, true, "", reading.error().message);
    const double tenths_v = std::round(10 * command.command_v) / 10;
    entry["condition"] = fmt::format("{}, {:.1f} V", command.load, tenths_v);
    entry["rate_hz"] = command.capture.rate_hz;
    entry["reading"] = std::move(*reading);
    return Given{"steps", entry};
}

Result<Json> captureBurst(ScriptSession& session, const LoadCommand& command) {
    if (auto begun = begin(session.bench(), command); !begun) return failure(begun);
    constexpr double kFastest_hz = 100e3, kMaxSamples = 500e3, kIntervalsHeld = 2.5;
    const double seconds = kIntervalsHeld * command.interval_s;
    auto options = command.capture;
    options.rate_hz = std::min(kFastest_hz, kMaxSamples / seconds);
    options.samples = static_cast<std::size_t>(std::floor(options.rate_hz * seconds));
    auto captures = held(session, options);
    if (!captures) return captures;
    return Json{{"command_v", command.command_v},
                {"interval_s", command.interval_s},
                {"rate_hz", options.rate_hz},
                {"captures", std::move(*captures)}};
}

}  // namespace tacto::host::load_safety
