// Surfaces under the finger: presenting conditions, and the references that give roughness its scale.
#include "app/scripting/host/bench/Surfaces.h"

#include <algorithm>
#include <cmath>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"
#include "core/base/JsonFields.h"
#include "core/base/Statistics.h"

namespace tacto::host::bench {

Sliding slidingOver(std::string material, const Arguments& arguments, double usualForce_n) {
    return {std::move(material), arguments.number("options.speed_mm_s"),
            arguments.number("options.force_n", usualForce_n)};
}

Result<void> slide(ScriptSession& session, const Sliding& sliding) {
    if (auto& surface = session.bench().devices().surface) {
        return surface->present(sliding.material, MillimetresPerSecond(sliding.speed_mm_s), Newtons(sliding.force_n));
    }
    return session.askTo("surface-" + sliding.material,
                         fmt::format("Slide the fingertip over {} at {} mm/s with {} N", sliding.material,
                                     sliding.speed_mm_s, sliding.force_n));
}

namespace {

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

}  // namespace

Result<Json> present(ScriptSession& session, const Arguments& arguments) {
    const double roughness = arguments.number("condition.roughness"), pressure = arguments.number("condition.pressure");
    const auto tolerance = arguments.number("options.tolerance");
    const auto limit = arguments.number("options.limit_s");
    Bench& bench = session.bench();
    if (arguments.text("options.source") == "direct") {
        if (auto driven = bench.drive(DriveSource::Manual, roughness, pressure); !driven) return failure(driven);
        return settledState(bench, tolerance, limit);
    }

    const auto material = arguments.has("options.material") ? arguments.text("options.material")
                                                            : std::string(roughness < 0.5 ? "glass" : "P60");
    const auto sliding = slidingOver(material, arguments, pressure < 0.5 ? 0.15 : 6);
    if (auto slid = slide(session, sliding); !slid) return failure(slid);
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    return settledState(bench, tolerance, limit);
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
    if (auto waited = bench.wait(Seconds(0.5)); !waited) return failure(waited);  // the finger lands and speeds up
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
    const auto mean = [](const std::vector<double>& x) { return x.empty() ? Json() : Json(statisticsOf(x).mean); };
    Json out{{"material", material}, {"h", mean(h)}, {"v", mean(v)}, {"frames", std::max(h.size(), v.size())}};
    session.own().note(out);
    return out;
}

Result<Json> setReferences(ScriptSession& session, const Arguments& arguments) {
    const Json& smooth = arguments.object("smooth");
    const Json& rough = arguments.object("rough");
    // What gives R its scale, and so trains their amplitude, is felt on this rig and not made up (hazard H7).
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
        if (std::isnan(measured.smooth) && std::isnan(measured.rough)) continue;  // this rig does not have it
        *scale = measured;
        ++set;
    }
    if (set == 0) return arguments.wrong("smooth", smooth, "what bench.measureReference() returned");
    settings.calibrated = true;
    settings.uncertainty.reset();  // each reference was slid over once: what it repeats to is not known
    // The references are of this fingertip from now on; scales of another one are not.
    if (const auto& sensor = session.bench().devices().sensor; sensor && settings.sensor) {
        if (matchOf(*settings.sensor, sensor->identity().serial) == FingertipMatch::Another) settings.sensor.reset();
    }
    settings.smoothSurface = ReferenceSurface{smooth.value("material", ""), {}, {}};
    settings.roughSurface = ReferenceSurface{rough.value("material", ""), {}, {}};
    if (auto valid = validate(settings); !valid) return failure(valid);
    return done(session.bench().setProfile(profile, RBefore::Measuring));
}

}  // namespace tacto::host::bench
