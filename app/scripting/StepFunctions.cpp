// A step of the finger, and the first train that carries it: read off the oscilloscope against the bench's clock,
// beside what the scheduler's design says.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/bench/ScopeSession.h"
#include "core/encoding/StepResponse.h"
#include "core/encoding/Transitions.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

namespace {

using Json = nlohmann::json;
constexpr Seconds kStepLook{0.02};

/// A train as the oscilloscope saw it. NaN where the record could not be measured.
struct SeenTrain {
    double onset_s = 0;
    double amplitude_v = 0;
    Capture capture;
};

struct Place {
    double roughness = 0;
    double pressure = 0;
};

Result<Place> placeFrom(const Arguments& arguments, std::size_t index, const char* name) {
    auto given = arguments.object(index, name);
    if (!given) return failure(given);
    Place place;
    for (const auto& [key, target] :
         {std::pair("roughness", &place.roughness), std::pair("pressure", &place.pressure)}) {
        auto value = arguments.number(**given, key, std::nan(""), {0, 1});
        if (!value) return failure(value);
        if (std::isnan(*value)) return arguments.wrong(name, **given, "{ roughness, pressure }, each from 0 to 1");
        *target = *value;
    }
    return place;
}

/// One record per train, short, in one range for both ends of the step: its errors are then the same for both.
ScopeSettings settingsFor(Bench& bench, double rate_hz, const Command& a, const Command& b) {
    const PulseTrain& train = bench.profile().encoding.train;
    const Telemetry now = bench.telemetry();
    const double load_ohm = std::isfinite(now.impedance_ohm) && now.impedance_ohm > 0 ? now.impedance_ohm : 1000;
    const double most_v = std::max(a.amplitude, b.amplitude).value();
    const double train_s = (train.pulses - 1) / train.rate.value() + train.pulseDuration().count();
    ScopeSettings settings;
    settings.sampleRate = Hertz(rate_hz);
    settings.samples = static_cast<std::size_t>(std::ceil((1.4 * train_s + 3e-4) * rate_hz));
    settings.preTrigger = 0.15;
    settings.triggerLevel = std::max(0.05, 0.4 * std::min(a.amplitude, b.amplitude).value());
    settings.voltageRange = Volts(std::max(1.0, 1.3 * most_v));
    settings.currentRange = Milliamps(std::max(1.0, 2e3 * most_v / load_ohm));
    return settings;
}

/// One record of every train from begin() to the end of its life, measured as they come.
struct Recording {
    Bench& bench;
    ScopeSettings settings;
    std::size_t left = 0;  // of those that were asked for
    std::vector<SeenTrain> seen;

    Recording(Bench& onBench, ScopeSettings with) : bench(onBench), settings(with) {}
    ~Recording() { bench.cancelCaptures(); }
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    /// As many as may be asked for at once.
    Result<void> begin() {
        left = ScopeSession::kMaxCaptures;
        return bench.requestCaptures(static_cast<int>(left), settings);
    }
    Result<void> take();
};

/// Errors: of the oscilloscope.
Result<void> Recording::take() {
    auto captures = bench.takeCaptures();
    if (!captures) return failure(captures);
    left -= std::min(left, captures->size());
    MeasureOptions options;
    const PulseTrain& expected = bench.profile().encoding.train;
    if (expected.pulses > 1) options.intraTrainRate = expected.rate;
    for (auto& capture : *captures) {
        SeenTrain train{capture.trigger_s, std::nan(""), {}};
        auto voltage = measureTrains(std::span(&capture, 1), "voltage", options);
        if (!voltage) return failure(voltage);
        if (!voltage->trains.empty()) {
            const auto& first = voltage->trains.front();
            if (std::isfinite(first.onset_s)) train.onset_s = first.onset_s;
            train.amplitude_v = first.amplitude;
        }
        train.capture = std::move(capture);
        seen.push_back(std::move(train));
    }
    if (left > 0) return {};
    return begin();  // slew limits may stretch a step over more trains than may be asked for at once
}

/// Lets trains run until the encoder's command is `wanted`, slew limits and all, and a train with it has gone out.
Result<void> settle(Bench& bench, const Command& wanted) {
    constexpr double kLongest_s = 3600;
    const auto arrived = [&] {
        const Telemetry now = bench.telemetry();
        return std::abs(now.amplitude_v - wanted.amplitude.value()) <= 1e-9 &&
               std::abs(now.interval_s - wanted.interval.count()) <= 1e-9;
    };
    std::uint64_t deliveredBefore = bench.telemetry().trainsDelivered;
    for (double passed = 0; passed < kLongest_s; passed += kStepLook.count()) {
        if (auto waited = bench.wait(kStepLook); !waited) return waited;
        if (!arrived()) deliveredBefore = bench.telemetry().trainsDelivered;
        if (bench.telemetry().trainsDelivered > deliveredBefore) return {};
    }
    return fail(ErrorCode::Timeout, "bench.step: {:.3g} V every {:.3g} s was not reached within {} s",
                wanted.amplitude.value(), wanted.interval.count(), kLongest_s);
}

/// Waits until `enough()` or `limit` has passed. False then.
template <class Enough>
Result<bool> watch(Recording& recording, Seconds limit, const Enough& enough) {
    Bench& bench = recording.bench;
    const Instant until = bench.clock().now() + toInstant(limit);
    for (;;) {
        if (auto taken = recording.take(); !taken) return failure(taken);
        if (enough()) return true;
        const Instant now = bench.clock().now();
        if (now >= until) return false;
        if (auto waited = bench.wait(Seconds(std::min(toInstant(kStepLook), until - now))); !waited)
            return failure(waited);
    }
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

Json answer(ScriptSession& session, std::vector<SeenTrain>& seen, double step_s, const StepEnds& ends,
            const StepResponse& measured, std::span<const StepTrain> design) {
    const auto inSeconds = [](const std::optional<Seconds>& time) { return time ? Json(time->count()) : Json(); };
    const auto count = [](const std::optional<int>& trains) { return trains ? Json(*trains) : Json(); };
    const StepResponse designed = respond(ends, design);
    const ResponseRange range = rangeOf(ends, design);
    Json trains = Json::array();
    std::vector<Capture> kept;  // the train that carries it, then the one before
    double last_s = std::nan("");
    for (auto& train : seen) {
        const bool before = train.onset_s < step_s;
        const double after_s = train.onset_s - step_s;
        if (!before) {
            trains.push_back({{"after_step_s", after_s},
                              {"amplitude_v", numberOrNull(train.amplitude_v)},
                              {"interval_s", numberOrNull(train.onset_s - last_s)}});
        }
        last_s = train.onset_s;
        if (before) kept.clear();
        const bool carries = measured.latency && after_s == measured.latency->count();
        if (before || carries) kept.insert(kept.begin(), std::move(train.capture));
    }
    Json ids = Json::array();
    for (const auto& handle : session.hold(std::move(kept))) ids.push_back(handle["capture"]);
    return {{"step_s", step_s},
            {"since_onset_s", ends.sinceOnset.count()},
            {"latency_s", inSeconds(measured.latency)},
            {"designed_latency_s", inSeconds(designed.latency)},
            {"designed_latency_low_s", inSeconds(range.first.latency)},
            {"designed_latency_high_s", inSeconds(range.last.latency)},
            {"trains", count(measured.trains)},
            {"designed_trains", count(designed.trains)},
            {"designed_trains_high", count(range.last.trains)},
            {"onsets", trains},
            {"captures", ids}};
}

Result<Json> step(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.step", list);
    auto from = placeFrom(arguments, 0, "from");
    if (!from) return failure(from);
    auto to = placeFrom(arguments, 1, "to");
    if (!to) return failure(to);
    auto options = arguments.options(2, {"phase", "rate_hz"});
    if (!options) return failure(options);
    auto phase = arguments.number(*options, "phase", 0.5, {0.05, 0.9});
    if (!phase) return failure(phase);
    Bench& bench = session.bench();
    const Oscilloscope* scope = bench.devices().oscilloscope.get();
    if (scope == nullptr) return fail(ErrorCode::Unsupported, "bench.step: no oscilloscope is connected");
    auto rate = arguments.number(*options, "rate_hz", std::min(1e6, scope->traits().maxRate.value()), {1, 1e9});
    if (!rate) return failure(rate);

    const EncodingProfile& profile = bench.profile().encoding;
    const Encoder encoder(profile);
    const auto before = encoder.encode(from->roughness, from->pressure);
    if (!before) return failure(before);
    const auto wanted = encoder.encode(to->roughness, to->pressure);
    if (!wanted) return failure(wanted);
    if (std::max(amplitudeDistance(before->amplitude, wanted->amplitude),
                 intervalDistance(before->interval, wanted->interval)) < 1) {
        return arguments.wrong("to", **arguments.object(1, "to"),
                               "a step of at least one just-noticeable difference from where it begins");
    }

    if (auto driven = bench.drive(DriveSource::Manual, from->roughness, from->pressure); !driven)
        return failure(driven);
    if (auto settled = settle(bench, *before); !settled) return failure(settled);
    Recording recording(bench, settingsFor(bench, *rate, *before, *wanted));
    if (auto asked = recording.begin(); !asked) return failure(asked);
    auto& seen = recording.seen;
    const Seconds patience = 3 * profile.intervalMax + Seconds(1);
    auto shown = watch(recording, patience, [&] { return !seen.empty(); });
    if (!shown) return failure(shown);
    if (!*shown) {
        return fail(ErrorCode::Timeout, "bench.step: the oscilloscope saw no train in {:.1f} s", patience.count());
    }
    const double at_s = seen.back().onset_s + *phase * before->interval.count();
    const double wait_s = at_s - toSeconds(session.now());
    if (wait_s > 0) {
        if (auto waited = bench.wait(Seconds(wait_s)); !waited) return failure(waited);
    }
    const double step_s = toSeconds(session.now());
    if (auto driven = bench.drive(DriveSource::Manual, to->roughness, to->pressure); !driven) return failure(driven);
    const SeenTrain reference{seen.back().onset_s, seen.back().amplitude_v, {}};

    StepEnds ends{Seconds(std::clamp(step_s - reference.onset_s, 0.0, before->interval.count())), *before, *wanted};
    const auto design = designedTrains(profile, ends);
    if (!design) return failure(design);
    const double gain = reference.amplitude_v / before->amplitude.value();
    const auto ready = [&] { return respond(ends, after(seen, step_s, gain)).trains.has_value(); };
    // A train that comes later than all of these has not carried the step.
    const Seconds longest = design->back().onset + 4 * profile.intervalMax + Seconds(1);
    const auto finished = watch(recording, longest, ready);
    if (!finished) return failure(finished);
    const auto trains = after(seen, step_s, gain);
    return answer(session, seen, step_s, ends, respond(ends, trains), *design);
}

}  // namespace

std::vector<HostFunction> stepFunctions() {
    return {
        {"bench",
         "step",
         HostKind::Function,
         {{"from", "object", "", "{ roughness, pressure } before the step, each from 0 to 1"},
          {"to", "object", "", "the same after it; at least one just-noticeable difference away"},
          {"options.phase", "number", "",
           "when, as a share of the interval between trains: 0.05 to 0.9; 0.5 where left out", true},
          {"options.rate_hz", "number", "Hz", "sampling rate; 1e6 or the instrument's largest where left out", true}},
         "Lets trains run at one place of the plane, steps to another and watches the trains that follow, each in a "
         "record of its own.",
         "{ step_s, since_onset_s, latency_s, designed_latency_s, trains, designed_trains, onsets, captures }: "
         "latency_s is from the step to the onset of the first train whose amplitude, or interval since the train "
         "before, has left what was there by a quarter of a just-noticeable difference; trains how many it takes until "
         "the new ones are reached; designed_ the same of the trains that the scheduler's design has, with _low_s and "
         "_high "
         "as a reading that is off by 0.05 of a difference finds them; onsets { "
         "after_step_s, amplitude_v, interval_s } as measured; captures those of the train that carries it and "
         "of the train before the step, for record.trial(). What was not measured is null.",
         "Throws without an oscilloscope, when it sees no train before the step, or when the run is stopped.",
         step},
    };
}

}  // namespace tacto
