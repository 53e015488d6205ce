// The steps of a protocol: arm, drive, capture, wait.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/Arming.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/electrode/Load.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// A declared load: a number of ohms, or text as parseLoad() reads it.
Result<std::string> loadText(const Arguments& arguments, const Json& value) {
    if (value.is_number()) {
        const double ohms = value.get<double>();
        if (!(ohms > 0) || !std::isfinite(ohms)) return arguments.wrong("load", value, "ohms above 0");
        return fmt::format("{} ohm", ohms);
    }
    if (!value.is_string())
        return arguments.wrong("load", value, "ohms, or a text such as \"200 ohm + 10 kohm || 50 nF\"");
    const auto text = value.get<std::string>();
    if (auto load = parseLoad(text); !load) return failure(load);
    return text;
}

Result<Json> arm(ScriptSession& session, const Json& list) {
    auto armed = [&]() -> Result<void> {
        const Arguments arguments("bench.arm", list);
        auto options = arguments.options(0, {"load"});
        if (!options) return failure(options);
        std::string load = ArmRequest{}.load;
        if (options->contains("load")) {
            auto given = loadText(arguments, (*options)["load"]);
            if (!given) return failure(given);
            load = *given;
        }
        auto request = confirmedArming(session, load);
        if (!request) return failure(request);
        return session.bench().arm(*request);
    }();
    if (armed) return Json();
    session.bench().disarm();  // also what an earlier arm() of the script had armed
    return failure(armed);
}

Result<Json> disarm(ScriptSession& session, const Json&) {
    session.bench().disarm();
    return Json();
}

Result<Json> wait(ScriptSession& session, const Json& list) {
    auto seconds = Arguments("bench.wait", list).number(0, "seconds", {0, 86'400});
    if (!seconds) return failure(seconds);
    auto waited = session.bench().wait(Seconds(*seconds));
    if (!waited) return failure(waited);
    return Json();
}

Result<Json> drive(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.drive", list);
    auto source = arguments.text(0, "source");
    if (!source) return failure(source);
    auto options = arguments.options(1, {"roughness", "pressure"});
    if (!options) return failure(options);
    auto roughness = arguments.number(*options, "roughness", 0, {0, 1});
    if (!roughness) return failure(roughness);
    auto pressure = arguments.number(*options, "pressure", 0, {0, 1});
    if (!pressure) return failure(pressure);
    const std::pair<const char*, DriveSource> known[] = {
        {"off", DriveSource::Off}, {"manual", DriveSource::Manual}, {"sensor", DriveSource::Sensor}};
    for (const auto& [name, value] : known) {
        if (*source != name) continue;
        if (auto driven = session.bench().drive(value, *roughness, *pressure); !driven) return failure(driven);
        return Json();
    }
    return arguments.wrong("source", *source, "\"sensor\", \"manual\" or \"off\"");
}

Result<ScopeSettings> scopeSettings(ScriptSession& session, const Arguments& arguments, const Json& options) {
    Bench& bench = session.bench();
    const EncodingProfile& encoding = bench.profile().encoding;
    const PulseTrain& train = encoding.train;
    const Telemetry now = bench.telemetry();
    const double expected_v = std::isfinite(now.amplitude_v) ? now.amplitude_v : encoding.amplitudeMax.value();
    const double load_ohm = std::isfinite(now.impedance_ohm) && now.impedance_ohm > 0 ? now.impedance_ohm : 1000;
    const Oscilloscope* scope = bench.devices().oscilloscope.get();
    if (scope == nullptr) return fail(ErrorCode::Unsupported, "bench.capture: no oscilloscope is connected");

    auto rate = arguments.number(options, "rate_hz", std::min(1e6, scope->traits().maxRate.value()), {1, 1e9});
    if (!rate) return failure(rate);
    // The whole train, with a tenth before it and a tail to see the charge run off.
    const double train_s = (train.pulses - 1) / train.rate.value() + train.pulseDuration().count();
    const double wanted = std::max(1.0, std::ceil((1.4 * train_s + 3e-4) * *rate));
    auto samples = arguments.number(options, "samples", wanted, {1, 1e8, true});
    if (!samples) return failure(samples);
    auto range_v = arguments.number(options, "voltage_range_v", std::max(1.0, 1.3 * expected_v), {1e-3, 1e4});
    if (!range_v) return failure(range_v);
    auto range_ma =
        arguments.number(options, "current_range_ma", std::max(1.0, 2e3 * expected_v / load_ohm), {1e-3, 1e5});
    if (!range_ma) return failure(range_ma);
    auto level = arguments.number(options, "trigger_v", std::max(0.05, 0.2 * expected_v), {1e-6, 1e4});
    if (!level) return failure(level);

    ScopeSettings settings;
    settings.sampleRate = Hertz(*rate);
    settings.samples = static_cast<std::size_t>(*samples);
    settings.preTrigger = 0.15;
    settings.triggerLevel = *level;
    settings.voltageRange = Volts(*range_v);
    settings.currentRange = Milliamps(*range_ma);
    return settings;
}

constexpr int kTrainsInOne = 8;  // of a record that holds several

/// One record that holds `trains` trains at the interval of now: from one record to another their distance is known
/// only as well as the records' time stamps are (science.md section 12).
Result<std::vector<Capture>> captureInOne(Bench& bench, int trains, ScopeSettings settings) {
    constexpr double kBefore = 0.05, kSpare = 0.1;  // of the record; of an interval
    constexpr double kMaxSamples = 5e5, kLeastRate_hz = 1e5;
    const double interval_s = bench.telemetry().interval_s;
    if (!(interval_s > 0) || !std::isfinite(interval_s))
        return fail(ErrorCode::InvalidArgument, "bench.capture: intervals are wanted and nothing is driven");
    const double seconds = (trains - 1 + kSpare) * interval_s / (1 - kBefore);
    const double rate_hz = std::min(settings.sampleRate.value(), std::max(kLeastRate_hz, kMaxSamples / seconds));
    settings.sampleRate = Hertz(rate_hz);
    settings.samples = static_cast<std::size_t>(std::ceil(rate_hz * seconds));
    settings.preTrigger = kBefore;
    return bench.capture(1, settings);
}

Result<Json> capture(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.capture", list);
    auto options = arguments.options(
        0, {"trains", "rate_hz", "samples", "voltage_range_v", "current_range_ma", "trigger_v", "intervals"});
    if (!options) return failure(options);
    auto intervals = arguments.flag(*options, "intervals", false);
    if (!intervals) return failure(intervals);
    const auto allowed = *intervals ? NumberRange{2, kTrainsInOne, true}
                                    : NumberRange{1, static_cast<double>(ScriptSession::kHeldCaptures), true};
    auto trains = arguments.number(*options, "trains", allowed.min, allowed);
    if (!trains) return failure(trains);
    auto settings = scopeSettings(session, arguments, *options);
    if (!settings) return failure(settings);
    const auto count = static_cast<int>(*trains);
    if (!*intervals || session.scopeSeen().stampsStated()) {
        auto captures = session.bench().capture(count, *settings);
        if (!captures) return failure(captures);
        if (!*intervals || std::isfinite(captures->front().stampTolerance_s)) return session.hold(std::move(*captures));
    }
    auto captures = captureInOne(session.bench(), count, *settings);
    if (!captures) return failure(captures);
    return session.hold(std::move(*captures));
}

Result<Json> fitLoad(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.fitLoad", list);
    auto load = loadText(arguments, arguments.at(0));
    if (!load) return failure(load);
    session.bench().disarm();
    session.forgetConfirmed();
    if (auto& fitter = session.bench().devices().load) {
        if (auto fitted = fitter->fitLoad(*load); !fitted) return failure(fitted);
        return Json();
    }
    OperatorQuestion question;
    question.name = "fit-load";
    question.text = fmt::format("Fit the load {}", *load);
    if (auto answer = session.ask(question); !answer) return failure(answer);
    return Json();
}

}  // namespace

std::vector<HostFunction> benchFunctions() {
    return {
        {"bench",
         "arm",
         HostKind::Function,
         {{"options.load", "number or text", "ohm", "declared load, ± 20 % for the limits; 1000 where left out", true}},
         "Checks the load with one small pulse and arms the output. From then on trains are delivered as the drive "
         "says. Where the output is real, the operator confirms device, load and largest amplitude first (question "
         "confirm-arming).",
         "",
         "Throws with what is missing; without the confirmation; when the impedance is out of range; when the run is "
         "stopped. Then the output is disarmed.",
         arm},
        {"bench", "disarm", HostKind::Function, {}, "Ends the output. Leaving run(p) does it too.", "", "", disarm},
        {"bench",
         "wait",
         HostKind::Function,
         {{"seconds", "number", "s", "0 to 86400, on the bench's clock"}},
         "Lets time pass while the bench goes on.",
         "",
         "Throws when the run is stopped or a device fails.",
         wait},
        {"bench",
         "drive",
         HostKind::Function,
         {{"source", "text", "", "\"sensor\", \"manual\" or \"off\""},
          {"options.roughness", "number", "", "R from 0 to 1, for manual; 0 where left out", true},
          {"options.pressure", "number", "", "P from 0 to 1, for manual; 0 where left out", true}},
         "Says where R and P come from, from the next train on.",
         "",
         "Throws for sensor without a sensor.",
         drive},
        {"bench",
         "capture",
         HostKind::Function,
         {{"options.trains", "number", "", "how many trains, 1 to 64; 1 where left out", true},
          {"options.rate_hz", "number", "Hz", "sampling rate; 1e6 or the instrument's largest where left out", true},
          {"options.samples", "number", "", "per capture; the whole train where left out", true},
          {"options.voltage_range_v", "number", "V", "full scale is ± this; 1.3 times the command where left out",
           true},
          {"options.current_range_ma", "number", "mA", "full scale is ± this; from command and |Z| where left out",
           true},
          {"options.trigger_v", "number", "V", "trigger level; a fifth of the command where left out", true},
          {"options.intervals", "flag", "",
           "the intervals between the trains, 2 to 8, are wanted: where the oscilloscope does not state how good the "
           "time stamps of its records are, one record holds them all, at a lower rate where it would be longer than "
           "half a million samples",
           true}},
         "Waits for the next trains and takes one oscilloscope record of each.",
         "List of captures { capture, start_s, trigger_s, rate_hz, samples, stamp_tolerance_s, not_stated }, for "
         "measure.train(): stamp_tolerance_s is how good trigger_s is against other records, null where the "
         "oscilloscope "
         "does not state it; not_stated says what else it does not, \"\" where it states all.",
         "Throws without an oscilloscope; when fewer trains came; when the run is stopped.",
         capture},
        {"bench",
         "fitLoad",
         HostKind::Function,
         {{"load", "number or text", "ohm", "\"500 ohm\", \"open\", \"200 ohm + 10 kohm || 50 nF\""}},
         "Disarms and changes the load: by itself where the bench can, else the operator is asked to (question "
         "fit-load).",
         "",
         "Throws for a load that cannot be read, or without an answer.",
         fitLoad},
    };
}

}  // namespace tacto
