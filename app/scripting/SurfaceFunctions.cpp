// Surfaces under the finger: presenting conditions, and the references that give roughness its scale.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "app/scripting/SurfaceSliding.h"
#include "core/base/Statistics.h"

namespace tacto {

Result<Sliding> slidingFrom(const Arguments& arguments, const nlohmann::json& options, const Sliding& usual) {
    auto material = arguments.text(options, "material", usual.material);
    if (!material) return failure(material);
    auto speed = arguments.number(options, "speed_mm_s", usual.speed_mm_s, {0, 1000});
    if (!speed) return failure(speed);
    auto force = arguments.number(options, "force_n", usual.force_n, {0, 50});
    if (!force) return failure(force);
    return Sliding{*material, *speed, *force};
}

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

namespace {

using Json = nlohmann::json;

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

Result<Json> settledState(Bench& bench, double tolerance, double limit_s) {
    auto settled = settle(bench, tolerance, limit_s);
    if (!settled) return failure(settled);
    const Telemetry now = bench.telemetry();
    return Json{{"settled", *settled}, {"roughness", now.roughness}, {"pressure", now.pressure}};
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
    auto tolerance = arguments.number(*options, "tolerance", 0.02, {0, 1});
    if (!tolerance) return failure(tolerance);
    auto limit = arguments.number(*options, "limit_s", 5, {0.5, 600});
    if (!limit) return failure(limit);
    Bench& bench = session.bench();
    if (*source == "direct") {
        if (auto driven = bench.drive(DriveSource::Manual, *roughness, *pressure); !driven) return failure(driven);
        return settledState(bench, *tolerance, *limit);
    }
    if (*source != "finger") return arguments.wrong("source", *source, "\"finger\" or \"direct\"");

    const Sliding usual{*roughness < 0.5 ? "glass" : "P60", 50, *pressure < 0.5 ? 0.15 : 6};
    auto sliding = slidingFrom(arguments, *options, usual);
    if (!sliding) return failure(sliding);
    if (auto slid = slide(session, *sliding); !slid) return failure(slid);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    return settledState(bench, *tolerance, *limit);
}

Result<Json> lift(ScriptSession& session, const Json&) {
    if (auto& surface = session.bench().devices().surface) {
        if (auto lifted = surface->present("", MillimetresPerSecond(0), Newtons(0)); !lifted) return failure(lifted);
    }
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
    settings.uncertainty.reset();  // each reference was slid over once: what it repeats to is not known
    // The references are of this fingertip from now on; scales of another one are not.
    if (const auto& sensor = session.bench().devices().sensor; sensor && settings.sensor) {
        if (matchOf(*settings.sensor, sensor->identity().serial) == FingertipMatch::Another) settings.sensor.reset();
    }
    settings.smoothSurface = ReferenceSurface{(*smooth)->value("material", ""), {}, {}};
    settings.roughSurface = ReferenceSurface{(*rough)->value("material", ""), {}, {}};
    if (auto valid = validate(settings); !valid) return failure(valid);
    if (auto replaced = session.bench().setProfile(profile, RBefore::Measuring); !replaced) return failure(replaced);
    return Json();
}

}  // namespace

std::vector<HostFunction> surfaceFunctions() {
    constexpr std::string_view kStops = "Throws when the run is stopped";
    return {
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
