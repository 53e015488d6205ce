#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/dsp/SensorScales.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// On the logarithm of the feature.
std::string_view wordsOf(SensorFeature feature) noexcept {
    switch (feature) {
        case SensorFeature::H:
            return "vibration h";
        case SensorFeature::HAbs:
            return "vibration, absolute";
        case SensorFeature::VStatic:
            return "taxels, static";
        case SensorFeature::VDynamic:
            return "taxels, dynamic";
    }
    return "";
}

Json distanceJson(std::string of, const std::optional<SurfaceDistance>& distance) {
    if (!distance) return {};
    Json out = toJson(distance->magnitude());
    out["of"] = std::move(of);
    out["told_apart"] = distance->toldApart();
    out["pooled_sd"] = numberOrNull(distance->pooledSd);
    return out;
}

Json expandedR(const SensorCalibration& found, double R) {
    return found.uncertainty ? numberOrNull(found.uncertainty->expanded(R)) : Json();
}

/// At the ends and in the middle of R, of one slide.
Json uncertaintyJson(const SensorCalibration& found) {
    if (!found.uncertainty) return {};
    Json out = roughnessUncertaintyFields().write(*found.uncertainty);
    out["smooth"] = expandedR(found, 0);
    out["middle"] = expandedR(found, 0.5);
    out["rough"] = expandedR(found, 1);
    return out;
}

std::size_t indexOf(SensorFeature feature) { return static_cast<std::size_t>(feature); }

constexpr std::size_t kMaxTaxels = 100'000;

const RecordFields<SensorRest>& restFields() {
    static const auto fields = [] {
        RecordFields<SensorRest> all;
        all.list("taxel_baseline", in(&SensorRest::levels, &RestLevels::taxelBaseline), numberKind<double>({}), 0,
                 kMaxTaxels)
            .required = true;
        all.number("taxel_floor", in(&SensorRest::levels, &RestLevels::taxelFloor), {.low = 0}).required = true;
        all.number("mean_square", in(&SensorRest::levels, &RestLevels::slidingMeanSquare));
        all.word("taxel_unit", &SensorRest::taxelUnit, kTaxelUnits);
        all.word("unit", &SensorRest::restUnit, kRestUnits);
        all.takeNullAsMissing();
        all.passOverUnknownKeys();
        return all;
    }();
    return fields;
}

RecordFields<ForceInUse> forceFields() {
    RecordFields<ForceInUse> all;
    all.number("mean", &ForceInUse::mean);
    all.word("unit", &ForceInUse::unit, kForceUnits);
    all.number("u", &ForceInUse::uncertainty, {.low = 0});
    all.takeNullAsMissing();
    return all;
}

const RecordFields<WeightReading>& weightFields() {
    static const auto fields = [] {
        using W = WeightReading;
        RecordFields<W> all;
        all.number("mass_g", &W::mass_g, {.unit = "g"});
        all.number("reference_n", &W::reference_n, {.unit = "N"}).required = true;
        all.number("force", &W::force);
        all.word("force_unit", &W::forceUnit, kForceUnits).leftOutIfEmpty = true;
        all.list("taxels", &W::taxels, readingKind(), 0, kMaxTaxels);
        all.word("taxel_unit", &W::taxelUnit, kTaxelUnits).leftOutIfEmpty = true;
        all.record("force_in_use", &W::inUse, forceFields());
        all.takeNullAsMissing();
        all.passOverUnknownKeys();
        return all;
    }();
    return fields;
}

const RecordFields<SlideReading>& slideFields() {
    static const auto fields = [] {
        using S = SlideReading;
        RecordFields<S> all;
        all.number("h", &S::h);
        all.number("h_abs", &S::hAbs);
        all.number("v_static", &S::vStatic);
        all.number("v_dynamic", &S::vDynamic);
        all.number("force_n", &S::force_n);
        all.number("sliding_frames", &S::slidingFrames).required = true;
        all.takeNullAsMissing();
        all.passOverUnknownKeys();
        return all;
    }();
    return fields;
}

}  // namespace

Json toJson(const SensorCalibration& found) {
    const auto& settings = found.settings;
    const auto h = settings.spectral == SpectralFeature::Relative ? SensorFeature::H : SensorFeature::HAbs;
    const auto v = settings.taxel == TaxelFeature::Static ? SensorFeature::VStatic : SensorFeature::VDynamic;
    Json surfaces = Json::array();
    for (const auto& surface : found.surfaces) {
        const double R = std::isnan(surface.R.mean) ? kNaN : std::clamp(surface.R.mean, 0.0, 1.0);
        Json row = {{"name", surface.name},
                    {"ra_um", numberOrNull(surface.ra_um)},
                    {"rz_um", numberOrNull(surface.rz_um)},
                    {"slides", surface.slides},
                    {"R", numberOrNull(R)},
                    {"R_sd", numberOrNull(surface.R.sd)},
                    {"R_expanded_uncertainty", expandedR(found, R)},
                    {"force_n", numberOrNull(surface.force_n.mean)}};
        for (const auto feature : kSensorFeatures) {
            row[std::string(keyOf(feature))] = numberOrNull(surface.features[indexOf(feature)]);
        }
        row["h"] = numberOrNull(surface.features[indexOf(h)]);
        row["v"] = numberOrNull(surface.features[indexOf(v)]);
        surfaces.push_back(std::move(row));
    }
    Json all = Json::object();
    for (const auto feature : kSensorFeatures) {
        all[std::string(keyOf(feature))] =
            distanceJson(std::string(wordsOf(feature)), found.distances[indexOf(feature)]);
    }
    Json ranking;
    if (found.ranking) {
        ranking = toJson(found.ranking->rho);
        ranking["n"] = found.ranking->n;
        ranking["ties"] = found.ranking->ties;
        ranking["note"] = found.ranking->note;
    }
    return {{"surfaces", surfaces},
            {"d_prime",
             {{"h", distanceJson("h", found.distances[indexOf(h)])},
              {"v", distanceJson("v", found.distances[indexOf(v)])},
              {"R", distanceJson("R", found.distanceR)},
              {"all", all}}},
            {"spearman", ranking},
            {"uncertainty_R", uncertaintyJson(found)},
            {"known_limit", kKnownLimitOfR},
            {"accepted", found.accepted},
            {"verdict", found.accepted ? "pass" : "fail"},
            {"reasons", found.reasons},
            {"warnings", found.warnings},
            {"roughness", toJson(settings)}};
}

Json toJson(const SensorScale& found) {
    Json out = toJson(found.fit);
    out["scale"] = numberOrNull(found.scale);
    out["scale_expanded_uncertainty"] = numberOrNull(found.scaleU);
    out["offset_reading"] = out["offset"];
    out["offset"] = numberOrNull(found.offset);
    out["offset_expanded_uncertainty"] = numberOrNull(found.offsetU);
    return out;
}

Json toJson(const SensorRest& rest) { return restFields().write(rest); }

Json toJson(const SlideReading& slide) { return slideFields().write(slide); }

Json toJson(const ForceInUse& force) { return forceFields().write(force); }

Json toJson(const WeightReading& reading) { return weightFields().write(reading); }

Result<WeightReading> weightReadingFrom(const Json& json) {
    return weightFields().read(json, {.path = "reading"}).map_error(asInvalidArgument);
}

Result<SensorRest> sensorRestFrom(const Json& json) {
    return restFields().read(json, {.path = "rest"}).map_error(asInvalidArgument);
}

Result<SlideReading> slideReadingFrom(const Json& json) {
    return slideFields().read(json, {.path = "slide"}).map_error(asInvalidArgument);
}

}  // namespace tacto
