// Surfaces under the finger: presents conditions, and reads the references that set the scale of roughness.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/bench/BenchCalls.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/base/JsonText.h"
#include "core/base/Statistics.h"

namespace tacto::host::bench {

Result<void> slide(ScriptSession& session, const Sliding& sliding) {
    if (auto& surface = session.bench().devices().surface) {
        return surface->present(sliding.material, MillimetresPerSecond(sliding.speed_mm_s), Newtons(sliding.force_n));
    }
    return session.askTo("surface-" + sliding.material,
                         fmt::format("Slide the fingertip over {} at {} mm/s with {} N", sliding.material,
                                     sliding.speed_mm_s, sliding.force_n));
}

Sliding slidingFor(double roughness, double pressure) {
    return {.material = roughness < 0.5 ? "glass" : "P60", .force_n = pressure < 0.5 ? 0.15 : 6};
}

namespace {

/// Returns a slide with the options speed_mm_s and force_n; `usualForce_n` if the function has no default force.
Sliding slidingOver(std::string material, const Arguments& arguments, double usualForce_n = 1) {
    return {std::move(material), arguments.number("options.speed_mm_s"),
            arguments.number("options.force_n", usualForce_n)};
}

/// Waits until roughness R and pressure P are stable within `tolerance` for 0.5 s. Returns false after `limit_s`.
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

/// Of a board that encodes the bench knows the command by its trains alone: waits for one.
Result<void> hearBoard(Bench& bench) {
    constexpr Seconds kStep{0.05};
    const auto before = bench.telemetry();
    const bool sends = before.state == InterlockState::Armed || before.state == InterlockState::Delivering;
    if (!before.boardDrives || !sends) return {};
    const Seconds longest = 2 * bench.profile().encoding.intervalMax;
    for (Seconds passed{0}; passed < longest; passed += kStep) {
        if (bench.telemetry().trainsDelivered != before.trainsDelivered) return {};
        if (auto waited = bench.wait(kStep); !waited) return waited;
    }
    return {};
}

Result<Json> present(ScriptSession& session, const Arguments& arguments) {
    const double roughness = arguments.number("condition.roughness"), pressure = arguments.number("condition.pressure");
    const auto tolerance = arguments.number("options.tolerance");
    const auto limit = arguments.number("options.limit_s");
    Bench& bench = session.bench();
    if (arguments.text("options.source") == "direct") {
        if (auto driven = bench.drive(DriveSource::Manual, roughness, pressure); !driven) return failure(driven);
        return settledState(bench, tolerance, limit);
    }

    const auto usual = slidingFor(roughness, pressure);
    const auto material = arguments.has("options.material") ? arguments.text("options.material") : usual.material;
    const auto sliding = slidingOver(material, arguments, usual.force_n);
    if (auto slid = slide(session, sliding); !slid) return failure(slid);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    auto state = settledState(bench, tolerance, limit);
    if (!state) return state;
    if (auto heard = hearBoard(bench); !heard) return failure(heard);
    return state;
}

Result<Json> lift(ScriptSession& session, const Arguments&) {
    if (auto& surface = session.bench().devices().surface) {
        return done(surface->present("", MillimetresPerSecond(0), Newtons(0)));
    }
    return Json();
}

Result<Json> measureReference(ScriptSession& session, const Arguments& arguments) {
    const auto material = arguments.text("material");
    const auto duration = arguments.number("options.duration_s");
    Bench& bench = session.bench();
    bench.disarm();
    if (auto slid = slide(session, slidingOver(material, arguments)); !slid) return failure(slid);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    if (auto waited = bench.wait(Seconds(0.5)); !waited) return failure(waited);  // the finger lands and starts
    std::vector<double> h, v;
    const double end = toSeconds(session.now()) + duration;
    while (toSeconds(session.now()) < end) {
        if (auto waited = bench.wait(Seconds(0.016)); !waited) return failure(waited);
        const Telemetry now = bench.telemetry();
        if (!now.contact || !now.sliding) continue;
        if (now.h > 0) h.push_back(now.h);
        if (now.v > 0) v.push_back(now.v);
    }
    if (h.empty() && v.empty()) {
        return fail(ErrorCode::Device, "bench.measureReference: {} was not felt in {} s of sliding", material,
                    duration);
    }
    Json out =
        toJson(FeltReference{material, statisticsOf(h).mean, statisticsOf(v).mean, std::max(h.size(), v.size())});
    session.own().note(out);
    return out;
}

Result<Json> setReferences(ScriptSession& session, const Arguments& arguments) {
    const Json& smooth = arguments.object("smooth");
    const Json& rough = arguments.object("rough");
    // The scale of roughness R sets the amplitude of trains, so it must be measured on this rig (hazard H7).
    for (const auto& [name, said] : {std::pair("smooth", &smooth), std::pair("rough", &rough)}) {
        if (!session.own().noted(*said))
            return arguments.wrong(name, *said, "what bench.measureReference() returned in this run, unchanged,");
    }
    Profile profile = session.bench().profile();
    RoughnessSettings& settings = profile.roughness;
    ReferenceScale& spectral = settings.spectral == SpectralFeature::Relative ? settings.h : settings.hAbs;
    ReferenceScale& taxel = settings.taxel == TaxelFeature::Static ? settings.vStatic : settings.vDynamic;
    int set = 0;
    for (const auto& [key, scale] : {std::pair<const char*, ReferenceScale*>{"h", &spectral}, {"v", &taxel}}) {
        const ReferenceScale measured{numberOr(smooth, key), numberOr(rough, key)};
        if (std::isnan(measured.smooth) && std::isnan(measured.rough)) continue;  // this rig lacks that feature
        *scale = measured;
        ++set;
    }
    if (set == 0) return arguments.wrong("smooth", smooth, "what bench.measureReference() returned");
    settings.calibrated = true;
    settings.uncertainty.reset();  // a single slide over each reference shows no repeatability
    // From now on the references belong to this fingertip; the scales of another fingertip are dropped.
    if (const auto& sensor = session.bench().devices().sensor; sensor && settings.sensor) {
        if (matchOf(*settings.sensor, sensor->identity().serial) == FingertipMatch::Another) settings.sensor.reset();
    }
    settings.smoothSurface = ReferenceSurface{smooth.value("material", ""), {}, {}};
    settings.roughSurface = ReferenceSurface{rough.value("material", ""), {}, {}};
    if (auto valid = validate(settings); !valid) return failure(valid);
    return done(session.bench().setProfile(profile, RBefore::Measuring));
}

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> surfaceFunctions() {
    using namespace takes;
    const auto speed = number("options.speed_mm_s", "mm/s", "sliding speed").range(0, 1000).otherwise(50);
    const auto force = number("options.force_n", "N", "normal force").range(0, 50);
    return {
        {.name = "present",
         .parameters =
             {object("condition", "one of bench.conditions"), number("condition.roughness", "", "R").range(0, 1),
              number("condition.pressure", "", "P").range(0, 1),
              text("options.source", "\"finger\": slide over a surface; \"direct\": set R and P")
                  .oneOf({"finger", "direct"})
                  .otherwise("finger"),
              text("options.material", "surface").optional("glass below R 0.5, else P60,"), speed,
              force.optional("0.15 below P 0.5, else 6,"),
              number("options.tolerance", "", "settled: R and P did not change in 0.5 s").range(0, 1).otherwise(0.02),
              number("options.limit_s", "s", "longest wait for that").range(0.5, 600).otherwise(5)},
         .text = "Sets the bench to a condition. On a rig that cannot present surfaces the operator is asked to "
                 "(question surface-MATERIAL).",
         .returns = "{ settled, roughness, pressure }: settled is false when R or P still moved at the limit.",
         .errors = "Throws for an unknown surface, without an answer, or when the run is stopped.",
         .asks = {"surface-*"},
         .call = host::bench::present},
        {.name = "lift",
         .text = "Lifts the finger off the surface, on a rig that can.",
         .errors = "Throws when the run is stopped.",
         .call = host::bench::lift},
        {.name = "measureReference",
         .parameters = {text("material", "surface, as \"P120\""), speed, force.otherwise(1),
                        number("options.duration_s", "s", "of reading").range(1, 600).otherwise(4)},
         .text = "Disarms, slides over a reference surface and averages the two roughness features.",
         .returns = "{ material, h, v, frames }; a feature this rig does not have is null.",
         .errors = "Throws when nothing was felt or the run is stopped.",
         .asks = {"surface-*"},
         .call = host::bench::measureReference},
        {.name = "setReferences",
         .parameters = {object("smooth", "from bench.measureReference()"), object("rough", "the same")},
         .text = "Scales roughness to the two reference surfaces, for the rest of the run.",
         .errors = "Throws for what was not measured in this run, and for equal references.",
         .call = host::bench::setReferences},
    };
}

}  // namespace tacto
