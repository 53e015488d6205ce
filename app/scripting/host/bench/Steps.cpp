// A step of the finger, and the first train that carries it: read off the oscilloscope against the bench's clock,
// beside what the scheduler's design says.
#include <algorithm>
#include <cmath>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"
#include "app/scripting/host/bench/TrainRecording.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/NaN.h"
#include "core/encoding/StepPace.h"
#include "core/encoding/Transitions.h"

namespace tacto::host::bench {

namespace {

struct Place {
    double roughness = 0;
    double pressure = 0;
};

Place placeFrom(const Arguments& arguments, const std::string& name) {
    return {arguments.number(name + ".roughness"), arguments.number(name + ".pressure")};
}

double rateFor(Bench& bench, const Arguments& arguments) {
    return arguments.number("options.rate_hz", std::min(1e6, bench.devices().oscilloscope->traits().maxRate.value()));
}

/// The trains after the step, amplitudes corrected by what the train before the step read against its command.
std::vector<StepTrain> after(const std::vector<SeenTrain>& seen, double step_s, double gain) {
    std::vector<StepTrain> out;
    for (const auto& train : seen) {
        if (train.onset_s < step_s) continue;
        out.push_back({Seconds(train.onset_s - step_s), Volts(train.amplitude_v / gain)});
    }
    return out;
}

/// Train `k` and how far it steps from the one before, in just-noticeable differences; null where that was not
/// measured.
Json stepOf(const std::vector<SeenTrain>& seen, std::size_t k) {
    const auto intervalTo = [&](std::size_t i) { return i == 0 ? kNaN : seen[i].onset_s - seen[i - 1].onset_s; };
    const double interval_s = intervalTo(k);
    const double amplitude =
        k == 0 ? kNaN : amplitudeDistance(Volts(seen[k].amplitude_v), Volts(seen[k - 1].amplitude_v));
    const double interval = k < 2 ? kNaN : intervalDistance(Seconds(interval_s), Seconds(intervalTo(k - 1)));
    return {{"amplitude_v", numberOrNull(seen[k].amplitude_v)},
            {"interval_s", numberOrNull(interval_s)},
            {"onset_u_s", numberOrNull(seen[k].onsetUncertainty_s)},
            {"amplitude_jnd", numberOrNull(amplitude)},
            {"interval_jnd", numberOrNull(interval)}};
}

Json answer(ScriptSession& session, std::vector<SeenTrain>& seen, double step_s, const StepEnds& ends,
            const StepResponse& measured, std::span<const StepTrain> design) {
    const auto inSeconds = [](const std::optional<Seconds>& time) { return time ? Json(time->count()) : Json(); };
    const auto count = [](const std::optional<int>& trains) { return trains ? Json(*trains) : Json(); };
    const StepResponse designed = respond(ends, design);
    const ResponseRange range = rangeOf(ends, design);
    Json trains = Json::array(), before = Json::array();
    std::vector<Capture> kept;  // the train that carries it, then the one before
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const bool isBefore = seen[k].onset_s < step_s;
        const double after_s = seen[k].onset_s - step_s;
        if (isBefore) {
            before.push_back(numberOrNull(seen[k].amplitude_v));
            kept.clear();
        } else {
            Json row = stepOf(seen, k);
            row["after_step_s"] = after_s;
            trains.push_back(std::move(row));
        }
        const bool carries = measured.latency && after_s == measured.latency->count();
        if (isBefore || carries) kept.insert(kept.begin(), std::move(seen[k].capture));
    }
    const StepPace pace = fastestPace(ends, kWantedPerTrain);
    Json ids = Json::array();
    for (const auto& handle : session.hold(std::move(kept))) ids.push_back(handle["capture"]);
    return {{"type", "step"},
            {"step_s", step_s},
            {"since_onset_s", ends.sinceOnset.count()},
            {"latency_s", inSeconds(measured.latency)},
            {"designed_latency_s", inSeconds(designed.latency)},
            {"designed_latency_low_s", inSeconds(range.first.latency)},
            {"designed_latency_high_s", inSeconds(range.last.latency)},
            {"trains", count(measured.trains)},
            {"designed_trains", count(designed.trains)},
            {"designed_trains_high", count(range.last.trains)},
            {"complete_s", inSeconds(measured.complete)},
            {"designed_complete_s", inSeconds(designed.complete)},
            {"fastest_complete_s", pace.complete.count()},
            {"fewest_trains", pace.trains},
            {"from_v", ends.before.amplitude.value()},
            {"to_v", ends.after.amplitude.value()},
            {"from_s", ends.before.interval.count()},
            {"to_s", ends.after.interval.count()},
            {"before_v", before},
            {"onsets", trains},
            {"captures", ids}};
}

}  // namespace

Result<Json> step(ScriptSession& session, const Arguments& arguments) {
    const Place from = placeFrom(arguments, "from"), to = placeFrom(arguments, "to");
    const auto phase = arguments.number("options.phase");
    Bench& bench = session.bench();
    const double rate = rateFor(bench, arguments);

    const EncodingProfile& profile = bench.profile().encoding;
    const Encoder encoder(profile);
    const auto before = encoder.encode(from.roughness, from.pressure);
    if (!before) return failure(before);
    const auto wanted = encoder.encode(to.roughness, to.pressure);
    if (!wanted) return failure(wanted);
    if (std::max(amplitudeDistance(before->amplitude, wanted->amplitude),
                 intervalDistance(before->interval, wanted->interval)) < 1) {
        return arguments.wrong("to", arguments.object("to"),
                               "a step of at least one just-noticeable difference from where it begins");
    }

    if (auto driven = bench.drive(DriveSource::Manual, from.roughness, from.pressure); !driven) return failure(driven);
    if (auto settled = settleAt(bench, *before, "bench.step"); !settled) return failure(settled);
    TrainRecording recording(bench, trainSettings(bench, rate, *before, *wanted));
    if (auto asked = recording.begin(); !asked) return failure(asked);
    auto& seen = recording.seen();
    const Seconds timeout = 4 * profile.intervalMax + Seconds(1);
    // Two: the interval between them is the one that the first train after the step is compared with.
    auto shown = recording.watch(timeout, [&] { return seen.size() >= 2; });
    if (!shown) return failure(shown);
    if (!*shown) {
        return fail(ErrorCode::Timeout, "bench.step: the oscilloscope saw {} train(s) in {:.1f} s; two were expected",
                    seen.size(), timeout.count());
    }
    const double at_s = seen.back().onset_s + phase * before->interval.count();
    const double wait_s = at_s - toSeconds(session.now());
    if (wait_s > 0) {
        if (auto waited = bench.wait(Seconds(wait_s)); !waited) return failure(waited);
    }
    const double step_s = toSeconds(session.now());
    if (auto driven = bench.drive(DriveSource::Manual, to.roughness, to.pressure); !driven) return failure(driven);
    const double reference_s = seen.back().onset_s, reference_v = seen.back().amplitude_v;

    StepEnds ends{Seconds(std::clamp(step_s - reference_s, 0.0, before->interval.count())), *before, *wanted};
    const auto design = designedTrains(profile, ends);
    if (!design) return failure(design);
    const double gain = reference_v / before->amplitude.value();
    const auto ready = [&] { return respond(ends, after(seen, step_s, gain)).trains.has_value(); };
    // A train that comes later than all of these has not carried the step.
    const Seconds longest = design->back().onset + 4 * profile.intervalMax + Seconds(1);
    const auto finished = recording.watch(longest, ready);
    if (!finished) return failure(finished);
    const auto trains = after(seen, step_s, gain);
    return answer(session, seen, step_s, ends, respond(ends, trains), *design);
}

/// The finger moves to `to` and back at an even pace while the oscilloscope looks at every train.
Result<Json> traverse(ScriptSession& session, const Arguments& arguments) {
    const Place from = placeFrom(arguments, "from"), to = placeFrom(arguments, "to");
    const auto seconds = arguments.number("options.seconds");
    Bench& bench = session.bench();
    const double rate = rateFor(bench, arguments);
    const Encoder encoder(bench.profile().encoding);
    const auto start = encoder.encode(from.roughness, from.pressure);
    if (!start) return failure(start);
    const auto turn = encoder.encode(to.roughness, to.pressure);
    if (!turn) return failure(turn);

    if (auto driven = bench.drive(DriveSource::Manual, from.roughness, from.pressure); !driven) return failure(driven);
    if (auto settled = settleAt(bench, *start, "bench.traverse"); !settled) return failure(settled);
    TrainRecording recording(bench, trainSettings(bench, rate, *start, *turn));
    if (auto asked = recording.begin(); !asked) return failure(asked);
    auto& seen = recording.seen();
    const double begin_s = toSeconds(session.now());
    for (double phase = 0; phase < 2;) {
        const auto waited = recording.watch(TrainRecording::kPollInterval, [] { return false; });
        if (!waited) return failure(waited);
        phase = std::min(2.0, (toSeconds(session.now()) - begin_s) / seconds);
        const double share = phase <= 1 ? phase : 2 - phase;
        const auto along = [share](double a, double b) { return std::clamp(a + share * (b - a), 0.0, 1.0); };
        if (auto driven = bench.drive(DriveSource::Manual, along(from.roughness, to.roughness),
                                      along(from.pressure, to.pressure));
            !driven) {
            return failure(driven);
        }
    }
    const auto finished = recording.watch(2 * bench.profile().encoding.intervalMax, [] { return false; });
    if (!finished) return failure(finished);
    Json trains = Json::array();
    for (std::size_t k = 0; k < seen.size(); ++k) {
        Json row = stepOf(seen, k);
        row["after_step_s"] = seen[k].onset_s - begin_s;
        trains.push_back(std::move(row));
    }
    return Json{{"type", "movement"}, {"seconds", seconds}, {"onsets", trains}};
}

}  // namespace tacto::host::bench
