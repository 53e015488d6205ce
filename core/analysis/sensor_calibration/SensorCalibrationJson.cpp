#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"

#include <cmath>

#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonFields.h"
#include "core/base/RecordFields.h"
#include "core/dsp/UnitWords.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Json distanceJson(const std::optional<SurfaceDistance>& distance) {
    if (!distance) return {};
    Json out = toJson(distance->magnitude());
    out["told_apart"] = distance->toldApart();
    out["pooled_sd"] = numberOrNull(distance->pooledSd);
    return out;
}

tl::unexpected<Error> missing(const char* what, const char* key) {
    return fail(ErrorCode::InvalidArgument, "{}: {} is missing or of another type; what the bench returned is expected",
                what, key);
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

RecordFields<SensorRest> buildRestFields() {
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
}

const RecordFields<SensorRest>& restFields() {
    static const auto fields = buildRestFields();
    return fields;
}

RecordFields<ForceInUse> forceFields() {
    RecordFields<ForceInUse> all;
    all.number("mean", &ForceInUse::mean);
    all.word("unit", &ForceInUse::unit, kForceUnits);
    all.takeNullAsMissing();
    return all;
}

RecordFields<WeightReading> buildWeightFields() {
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
}

const RecordFields<WeightReading>& weightFields() {
    static const auto fields = buildWeightFields();
    return fields;
}

}  // namespace

Json toJson(const SensorCalibration& found) {
    const auto& settings = found.settings;
    const auto h = settings.spectral == SpectralFeature::Relative ? SensorFeature::H : SensorFeature::HAbs;
    const auto v = settings.taxel == TaxelFeature::Static ? SensorFeature::VStatic : SensorFeature::VDynamic;
    Json surfaces = Json::array();
    for (const auto& surface : found.surfaces) {
        Json row = {{"name", surface.name},
                    {"ra_um", numberOrNull(surface.ra_um)},
                    {"rz_um", numberOrNull(surface.rz_um)},
                    {"slides", surface.slides},
                    {"R", numberOrNull(surface.R.mean)},
                    {"R_sd", numberOrNull(surface.R.sd)},
                    {"R_expanded_uncertainty", expandedR(found, surface.R.mean)},
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
        all[std::string(keyOf(feature))] = distanceJson(found.distances[indexOf(feature)]);
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
             {{"h", distanceJson(found.distances[indexOf(h)])},
              {"v", distanceJson(found.distances[indexOf(v)])},
              {"R", distanceJson(found.distanceR)},
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

Json toJson(const SlideReading& slide) {
    Json track = {{"period_s", slide.framePeriod_s}};
    for (const char* key : {"t_s", "contact", "sliding", "h", "v"}) track[key] = Json::array();
    for (const auto& frame : slide.frames) {
        track["t_s"].push_back(frame.t_s);
        track["contact"].push_back(frame.contact);
        track["sliding"].push_back(frame.sliding);
        track["h"].push_back(numberOrNull(frame.h));
        track["v"].push_back(numberOrNull(frame.v));
    }
    Json out = {
        {"force_n", numberOrNull(slide.force_n)}, {"sliding_frames", slide.slidingFrames}, {"track", std::move(track)}};
    for (const auto feature : kSensorFeatures) {
        out[std::string(keyOf(feature))] = numberOrNull(valueOf(slide, feature));
    }
    return out;
}

Json toJson(const ForceInUse& force) { return forceFields().write(force); }

Json toJson(const WeightReading& reading) { return weightFields().write(reading); }

Result<WeightReading> weightReadingFrom(const Json& json) {
    return weightFields().read(json, {.path = "reading"}).map_error(asInvalidArgument);
}

Result<SensorRest> sensorRestFrom(const Json& json) {
    return restFields().read(json, {.path = "rest"}).map_error(asInvalidArgument);
}

Result<SlideReading> slideReadingFrom(const Json& json) {
    SlideReading out;
    if (!json.is_object() || !json.contains("track") || !json["track"].is_object()) return missing("a slide", "track");
    const auto& track = json["track"];
    out.h = numberOr(json, "h");
    out.hAbs = numberOr(json, "h_abs");
    out.vStatic = numberOr(json, "v_static");
    out.vDynamic = numberOr(json, "v_dynamic");
    out.force_n = numberOr(json, "force_n");
    out.framePeriod_s = numberOr(track, "period_s");
    if (!(out.framePeriod_s > 0)) return missing("a slide", "period_s");
    for (const char* key : {"t_s", "contact", "sliding", "h", "v"}) {
        if (!track.contains(key) || !track[key].is_array() || track[key].size() != track["t_s"].size()) {
            return missing("a slide", key);
        }
    }
    for (std::size_t i = 0; i < track["t_s"].size(); ++i) {
        RoughnessFrame frame;
        frame.t_s = numberOr(track["t_s"][i]);
        frame.contact = track["contact"][i] == Json(true);
        frame.sliding = track["sliding"][i] == Json(true);
        frame.h = numberOr(track["h"][i]);
        frame.v = numberOr(track["v"][i]);
        out.slidingFrames += frame.contact && frame.sliding ? 1 : 0;
        out.frames.push_back(frame);
    }
    return out;
}

}  // namespace tacto
