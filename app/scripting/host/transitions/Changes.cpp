// A step of the finger and the first train that carries it: read from the oscilloscope against the bench's clock, and
// compared with the scheduler's design.
#include "app/scripting/host/transitions/Changes.h"

#include <algorithm>
#include <cmath>

#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/transitions/TrainRecording.h"
#include "core/base/Statistics.h"
#include "core/encoding/StepResponse.h"
#include "core/encoding/Transitions.h"

namespace tacto::host::transitions {

namespace {

double rateFor(Bench& bench) { return std::min(1e6, bench.devices().oscilloscope->traits().maxRate.value()); }

/// Returns the trains after the step. Amplitudes are corrected by the ratio of reading to command before the step.
std::vector<StepTrain> after(const std::vector<SeenTrain>& seen, double step_s, double gain) {
    std::vector<StepTrain> out;
    for (const auto& train : seen) {
        if (train.onset_s < step_s) continue;
        out.push_back({Seconds(train.onset_s - step_s), Volts(train.amplitude_v / gain)});
    }
    return out;
}

/// Returns train `k` of a change that began at `begin_s`, with its steps from the previous train.
CapturedTrain trainOf(const std::vector<SeenTrain>& seen, std::size_t k, double begin_s) {
    const auto intervalTo = [&](std::size_t i) { return i == 0 ? kNaN : seen[i].onset_s - seen[i - 1].onset_s; };
    const double interval_s = intervalTo(k);
    const double amplitude =
        k == 0 ? kNaN : amplitudeDistance(Volts(seen[k].amplitude_v), Volts(seen[k - 1].amplitude_v));
    const double interval = k < 2 ? kNaN : intervalDistance(Seconds(interval_s), Seconds(intervalTo(k - 1)));
    return {seen[k].onset_s - begin_s,      seen[k].amplitude_v, interval_s, seen[k].onsetUncertainty_s,
            seen[k].amplitudeUncertainty_v, amplitude,           interval};
}

StepCourse courseOf(const StepResponse& response) {
    const auto seconds = [](const std::optional<Seconds>& time) { return time ? time->count() : kNaN; };
    return {seconds(response.latency), response.trains ? *response.trains : kNaN, seconds(response.complete)};
}

/// Returns the observed step and its design; keeps the captures of the train that carries it and of the previous train.
CapturedChange changeOf(ScriptSession& session, std::vector<SeenTrain>& seen, double step_s, const StepEnds& ends,
                        const StepResponse& measured, std::span<const StepTrain> design) {
    const ResponseRange range = rangeOf(ends, design);
    const StepPace pace = fastestPace(ends, kWantedPerTrain);
    CapturedChange change{.at_s = step_s,
                          .sinceOnset_s = ends.sinceOnset.count(),
                          .measured = courseOf(measured),
                          .designed = courseOf(respond(ends, design)),
                          .designedFirst = courseOf(range.first),
                          .designedLast = courseOf(range.last),
                          .fastest = {.trains = static_cast<double>(pace.trains), .complete_s = pace.complete.count()},
                          .from_v = ends.before.amplitude.value(),
                          .to_v = ends.after.amplitude.value(),
                          .from_s = ends.before.interval.count(),
                          .to_s = ends.after.interval.count()};
    std::vector<Capture> kept;  // the train that carries the step, then the previous train
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const bool isBefore = seen[k].onset_s < step_s;
        if (isBefore) {
            change.before_v.push_back(seen[k].amplitude_v);
            kept.clear();
        } else {
            change.trains.push_back(trainOf(seen, k, step_s));
        }
        const bool carries = measured.latency && seen[k].onset_s - step_s == measured.latency->count();
        if (isBefore || carries) kept.insert(kept.begin(), std::move(seen[k].capture));
    }
    for (const auto& handle : session.hold(std::move(kept))) change.captures.push_back(handle["capture"]);
    return change;
}

}  // namespace

Result<CapturedChange> captureStep(ScriptSession& session, const Place& from, const Place& to, double phase) {
    Bench& bench = session.bench();
    const EncodingProfile& profile = bench.profile().encoding;
    const Encoder encoder(profile);
    const auto before = encoder.encode(from.roughness, from.pressure);
    if (!before) return failure(before);
    const auto wanted = encoder.encode(to.roughness, to.pressure);
    if (!wanted) return failure(wanted);
    if (std::max(amplitudeDistance(before->amplitude, wanted->amplitude),
                 intervalDistance(before->interval, wanted->interval)) < 1) {
        return fail(
            ErrorCode::InvalidArgument,
            "bench.transitions.step: to is R {} P {}, a step of at least one just-noticeable difference from where "
            "it begins is expected",
            to.roughness, to.pressure);
    }

    if (auto driven = bench.drive(DriveSource::Manual, from.roughness, from.pressure); !driven) return failure(driven);
    if (auto settled = settleAt(bench, *before, "bench.transitions.step"); !settled) return failure(settled);
    TrainRecording recording(bench, trainSettings(bench, rateFor(bench), *before, *wanted));
    if (auto asked = recording.begin(); !asked) return failure(asked);
    auto& seen = recording.seen();
    const Seconds timeout = 4 * profile.intervalMax + Seconds(1);
    // Two trains: their interval is compared with the first train after the step.
    auto shown = recording.watch(timeout, [&] { return seen.size() >= 2; });
    if (!shown) return failure(shown);
    if (!*shown) {
        return fail(ErrorCode::Timeout,
                    "bench.transitions.step: the oscilloscope saw {} train(s) in {:.1f} s; two were expected",
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
    // A train that comes even later than this did not carry the step.
    const Seconds longest = design->back().onset + 4 * profile.intervalMax + Seconds(1);
    const auto finished = recording.watch(longest, ready);
    if (!finished) return failure(finished);
    const auto trains = after(seen, step_s, gain);
    return changeOf(session, seen, step_s, ends, respond(ends, trains), *design);
}

Result<CapturedChange> captureMovement(ScriptSession& session, const Place& from, const Place& to, double seconds) {
    Bench& bench = session.bench();
    const Encoder encoder(bench.profile().encoding);
    const auto start = encoder.encode(from.roughness, from.pressure);
    if (!start) return failure(start);
    const auto turn = encoder.encode(to.roughness, to.pressure);
    if (!turn) return failure(turn);

    if (auto driven = bench.drive(DriveSource::Manual, from.roughness, from.pressure); !driven) return failure(driven);
    if (auto settled = settleAt(bench, *start, "bench.transitions.traverse"); !settled) return failure(settled);
    TrainRecording recording(bench, trainSettings(bench, rateFor(bench), *start, *turn));
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
    CapturedChange change{.kind = ChangeKind::Movement, .seconds = seconds};
    for (std::size_t k = 0; k < seen.size(); ++k) change.trains.push_back(trainOf(seen, k, begin_s));
    return change;
}

namespace {

/// Watches until the newest of the trains from `begin` on differ from each other by less than is felt.
Result<void> watchUntilSteady(TrainRecording& recording, std::size_t begin) {
    constexpr std::size_t kAlike = 4;
    constexpr Seconds kLongest{60};
    const auto steady = [&, &seen = recording.seen()] {
        if (seen.size() < begin + kAlike) return false;
        const auto isLikeBefore = [&](std::size_t k) {
            const auto train = trainOf(seen, k, 0);
            return train.amplitude_jnd < 1 && train.interval_jnd < 1;
        };
        return isLikeBefore(seen.size() - 1) && isLikeBefore(seen.size() - 2);
    };
    const auto seen = recording.watch(kLongest, steady);
    if (!seen) return failure(seen);
    if (*seen) return {};
    return fail(ErrorCode::Timeout, "bench.transitions.press: the trains did not become steady within {} s",
                kLongest.count());
}

}  // namespace

Result<CapturedChange> capturePress(ScriptSession& session, const Place& from, const Place& to) {
    Bench& bench = session.bench();
    const Encoder encoder(bench.profile().encoding);
    const auto least = encoder.encode(0, 0), most = encoder.encode(1, 1);
    if (!least) return failure(least);
    if (!most) return failure(most);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    if (auto slid = bench::slide(session, bench::slidingFor(from.roughness, from.pressure)); !slid)
        return failure(slid);
    TrainRecording recording(bench, trainSettings(bench, rateFor(bench), *least, *most));
    if (auto asked = recording.begin(); !asked) return failure(asked);
    auto& seen = recording.seen();
    if (auto steady = watchUntilSteady(recording, 0); !steady) return failure(steady);
    seen.erase(seen.begin(), seen.end() - 2);
    const double begin_s = toSeconds(session.now());
    if (auto slid = bench::slide(session, bench::slidingFor(to.roughness, to.pressure)); !slid) return failure(slid);
    if (auto steady = watchUntilSteady(recording, seen.size()); !steady) return failure(steady);
    CapturedChange change{.kind = ChangeKind::Movement};
    for (std::size_t k = 0; k < seen.size(); ++k) change.trains.push_back(trainOf(seen, k, begin_s));
    return change;
}

}  // namespace tacto::host::transitions
