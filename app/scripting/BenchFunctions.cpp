// The steps of a protocol: arm, present, capture, wait.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/base/Statistics.h"
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
    const Arguments arguments("bench.arm", list);
    auto options = arguments.options(0, {"load"});
    if (!options) return failure(options);
    ArmRequest request;
    if (options->contains("load")) {
        auto load = loadText(arguments, (*options)["load"]);
        if (!load) return failure(load);
        request.load = *load;
    }
    if (auto armed = session.bench().arm(request); !armed) return failure(armed);
    return Json();
}

Result<Json> disarm(ScriptSession& session, const Json&) {
    session.bench().disarm();
    return Json();
}

Result<Json> wait(ScriptSession& session, const Json& list) {
    auto seconds = Arguments("bench.wait", list).number(0, "seconds", {0, 86'400});
    if (!seconds) return failure(seconds);
    auto waited = session.bench().wait(Seconds(*seconds));
    session.watchExposure();
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

struct Sliding {
    std::string material;
    double speed_mm_s = 50;
    double force_n = 1;
};

Result<Sliding> slidingFrom(const Arguments& arguments, const Json& options, const Sliding& usual) {
    auto material = arguments.text(options, "material", usual.material);
    if (!material) return failure(material);
    auto speed = arguments.number(options, "speed_mm_s", usual.speed_mm_s, {0, 1000});
    if (!speed) return failure(speed);
    auto force = arguments.number(options, "force_n", usual.force_n, {0, 50});
    if (!force) return failure(force);
    return Sliding{*material, *speed, *force};
}

/// Puts a surface under the finger, or asks for it.
Result<void> slide(ScriptSession& session, const Sliding& sliding) {
    if (auto& surface = session.bench().devices().surface) {
        return surface->present(sliding.material, MillimetresPerSecond(sliding.speed_mm_s), Newtons(sliding.force_n));
    }
    OperatorQuestion question;
    question.name = "surface-" + sliding.material;
    question.text = fmt::format("Slide the fingertip over {} at {} mm/s with {} N", sliding.material,
                                sliding.speed_mm_s, sliding.force_n);
    if (auto answer = session.ask(question); !answer) return failure(answer);
    return {};
}

/// Waits until R and P stayed within `tolerance` for half a second. False when they did not by `limit_s`.
Result<bool> settle(Bench& bench, double tolerance, double limit_s) {
    constexpr double kStep_s = 0.1;
    constexpr std::size_t kSteady = 5;
    std::vector<double> r, p;
    for (double passed = 0; passed < limit_s; passed += kStep_s) {
        if (auto waited = bench.wait(Seconds(kStep_s)); !waited) return failure(waited);
        const Telemetry now = bench.telemetry();
        r.push_back(now.roughness);
        p.push_back(now.pressure);
        if (r.size() < kSteady) continue;
        const auto steady = [&](const std::vector<double>& x) {
            const auto [low, high] = std::minmax_element(x.end() - kSteady, x.end());
            const bool known =
                std::all_of(x.end() - kSteady, x.end(), [](double value) { return std::isfinite(value); });
            return known && *high - *low <= tolerance;
        };
        if (steady(r) && steady(p)) return true;
    }
    return false;
}

Result<Json> present(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.present", list);
    auto condition = arguments.object(0, "condition");
    if (!condition) return failure(condition);
    auto options = arguments.options(1, {"source", "material", "speed_mm_s", "force_n", "tolerance", "limit_s"});
    if (!options) return failure(options);
    auto roughness = arguments.number(**condition, "roughness", std::nan(""), {0, 1});
    if (!roughness || std::isnan(*roughness))
        return arguments.wrong("condition", **condition, "one of bench.conditions");
    auto pressure = arguments.number(**condition, "pressure", std::nan(""), {0, 1});
    if (!pressure || std::isnan(*pressure)) return arguments.wrong("condition", **condition, "one of bench.conditions");
    auto source = arguments.text(*options, "source", "finger");
    if (!source) return failure(source);
    Bench& bench = session.bench();
    if (*source == "direct") {
        if (auto driven = bench.drive(DriveSource::Manual, *roughness, *pressure); !driven) return failure(driven);
        return Json{{"settled", true}, {"roughness", *roughness}, {"pressure", *pressure}};
    }
    if (*source != "finger") return arguments.wrong("source", *source, "\"finger\" or \"direct\"");

    const Sliding usual{*roughness < 0.5 ? "glass" : "P60", 50, *pressure < 0.5 ? 0.15 : 6};
    auto sliding = slidingFrom(arguments, *options, usual);
    if (!sliding) return failure(sliding);
    auto tolerance = arguments.number(*options, "tolerance", 0.02, {0, 1});
    if (!tolerance) return failure(tolerance);
    auto limit = arguments.number(*options, "limit_s", 5, {0.5, 600});
    if (!limit) return failure(limit);
    if (auto slid = slide(session, *sliding); !slid) return failure(slid);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    auto settled = settle(bench, *tolerance, *limit);
    if (!settled) return failure(settled);
    const Telemetry now = bench.telemetry();
    return Json{{"settled", *settled}, {"roughness", now.roughness}, {"pressure", now.pressure}};
}

Result<Json> lift(ScriptSession& session, const Json&) {
    if (auto& surface = session.bench().devices().surface) {
        if (auto lifted = surface->present("", MillimetresPerSecond(0), Newtons(0)); !lifted) return failure(lifted);
    }
    return Json();
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

Result<Json> capture(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.capture", list);
    auto options =
        arguments.options(0, {"trains", "rate_hz", "samples", "voltage_range_v", "current_range_ma", "trigger_v"});
    if (!options) return failure(options);
    auto trains = arguments.number(*options, "trains", 1, {1, static_cast<double>(ScriptSession::kHeldCaptures), true});
    if (!trains) return failure(trains);
    auto settings = scopeSettings(session, arguments, *options);
    if (!settings) return failure(settings);
    auto captures = session.bench().capture(static_cast<int>(*trains), *settings);
    session.watchExposure();
    if (!captures) return failure(captures);
    return session.hold(std::move(*captures));
}

Result<Json> fitLoad(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.fitLoad", list);
    auto load = loadText(arguments, arguments.at(0));
    if (!load) return failure(load);
    session.bench().disarm();
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

Result<Json> measureReference(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.measureReference", list);
    auto material = arguments.text(0, "material");
    if (!material) return failure(material);
    auto options = arguments.options(1, {"speed_mm_s", "force_n", "duration_s"});
    if (!options) return failure(options);
    auto sliding = slidingFrom(arguments, *options, {*material, 50, 1});
    if (!sliding) return failure(sliding);
    auto duration = arguments.number(*options, "duration_s", 4, {1, 600});
    if (!duration) return failure(duration);
    Bench& bench = session.bench();
    bench.disarm();
    if (auto slid = slide(session, *sliding); !slid) return failure(slid);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    if (auto waited = bench.wait(Seconds(0.5)); !waited) return failure(waited);  // the finger lands and speeds up
    std::vector<double> h, v;
    const double end = toSeconds(session.now()) + *duration;
    while (toSeconds(session.now()) < end) {
        if (auto waited = bench.wait(Seconds(0.016)); !waited) return failure(waited);
        const Telemetry now = bench.telemetry();
        if (!now.contact || !now.sliding) continue;
        if (now.h > 0) h.push_back(now.h);
        if (now.v > 0) v.push_back(now.v);
    }
    if (h.empty() && v.empty()) {
        return fail(ErrorCode::Device, "bench.measureReference: {} was not felt in {} s of sliding", *material,
                    *duration);
    }
    const auto mean = [](const std::vector<double>& x) { return x.empty() ? Json() : Json(statisticsOf(x).mean); };
    return Json{{"material", *material}, {"h", mean(h)}, {"v", mean(v)}, {"frames", std::max(h.size(), v.size())}};
}

Result<Json> setReferences(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.setReferences", list);
    auto smooth = arguments.object(0, "smooth");
    if (!smooth) return failure(smooth);
    auto rough = arguments.object(1, "rough");
    if (!rough) return failure(rough);
    Profile profile = session.bench().profile();
    RoughnessSettings& settings = profile.roughness;
    const auto value = [](const Json& of, const char* key) {
        const auto at = of.find(key);
        return at != of.end() && at->is_number() ? at->get<double>() : std::nan("");
    };
    ReferenceScale& spectral = settings.spectral == SpectralFeature::Relative ? settings.h : settings.hAbs;
    ReferenceScale& taxel = settings.taxel == TaxelFeature::Static ? settings.vStatic : settings.vDynamic;
    int set = 0;
    for (const auto& [key, scale] : {std::pair<const char*, ReferenceScale*>{"h", &spectral}, {"v", &taxel}}) {
        const ReferenceScale measured{value(**smooth, key), value(**rough, key)};
        if (std::isnan(measured.smooth) && std::isnan(measured.rough)) continue;  // this rig does not have it
        *scale = measured;
        ++set;
    }
    if (set == 0) return arguments.wrong("smooth", **smooth, "what bench.measureReference() returned");
    settings.calibrated = true;
    settings.smoothSurface = ReferenceSurface{(*smooth)->value("material", ""), {}, {}};
    settings.roughSurface = ReferenceSurface{(*rough)->value("material", ""), {}, {}};
    if (auto valid = validate(settings); !valid) return failure(valid);
    if (auto replaced = session.bench().setProfile(profile); !replaced) return failure(replaced);
    return Json();
}

}  // namespace

std::vector<HostFunction> benchFunctions() {
    constexpr std::string_view kStops = "Throws when the run is stopped";
    return {
        {"bench",
         "arm",
         HostKind::Function,
         {{"options.load", "number or text", "ohm", "declared load, ± 20 % for the limits; 1000 where left out", true}},
         "Checks the load with one small pulse and arms the output. From then on trains are delivered as the drive "
         "says.",
         "",
         "Throws with what is missing; when the impedance is out of range; when the run is stopped.",
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
         "present",
         HostKind::Function,
         {{"condition", "condition", "", "one of bench.conditions"},
          {"options.source", "text", "",
           "\"finger\": slide over a surface; \"direct\": set R and P; finger where left out", true},
          {"options.material", "text", "", "surface; glass below R 0.5, else P60, where left out", true},
          {"options.speed_mm_s", "number", "mm/s", "sliding speed; 50 where left out", true},
          {"options.force_n", "number", "N", "normal force; 0.15 below P 0.5, else 6, where left out", true},
          {"options.tolerance", "number", "", "settled: R and P moved no more in 0.5 s; 0.02 where left out", true},
          {"options.limit_s", "number", "s", "longest wait for that; 5 where left out", true}},
         "Brings the bench into a condition. On a rig that cannot present surfaces the operator is asked to (question "
         "surface-MATERIAL).",
         "{ settled, roughness, pressure }: settled is false when R or P still moved at the limit.",
         "Throws for an unknown surface, without an answer, or when the run is stopped.",
         present},
        {"bench",
         "lift",
         HostKind::Function,
         {},
         "Lifts the finger off the surface, on a rig that can.",
         "",
         kStops,
         lift},
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
          {"options.trigger_v", "number", "V", "trigger level; a fifth of the command where left out", true}},
         "Waits for the next trains and takes one oscilloscope record of each.",
         "List of captures { capture, start_s, trigger_s, rate_hz, samples }, for measure.train().",
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
        {"bench",
         "measureReference",
         HostKind::Function,
         {{"material", "text", "", "surface, as \"P120\""},
          {"options.speed_mm_s", "number", "mm/s", "sliding speed; 50 where left out", true},
          {"options.force_n", "number", "N", "normal force; 1 where left out", true},
          {"options.duration_s", "number", "s", "1 to 600; 4 where left out", true}},
         "Disarms, slides over a reference surface and averages the two roughness features.",
         "{ material, h, v, frames }; a feature this rig does not have is null.",
         "Throws when nothing was felt or the run is stopped.",
         measureReference},
        {"bench",
         "setReferences",
         HostKind::Function,
         {{"smooth", "reference", "", "from bench.measureReference()"}, {"rough", "reference", "", "the same"}},
         "Scales roughness to the two reference surfaces, for the rest of the run.",
         "",
         "Throws for equal references.",
         setReferences},
    };
}

}  // namespace tacto
