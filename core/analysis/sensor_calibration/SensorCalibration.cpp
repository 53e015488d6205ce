#include "core/analysis/sensor_calibration/SensorCalibration.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Words.h"

namespace tacto {

namespace {

ReferenceScale& scaleOf(RoughnessSettings& settings, SensorFeature feature) {
    switch (feature) {
        case SensorFeature::H:
            return settings.h;
        case SensorFeature::HAbs:
            return settings.hAbs;
        case SensorFeature::VStatic:
            return settings.vStatic;
        case SensorFeature::VDynamic:
            break;
    }
    return settings.vDynamic;
}

/// Returns log10 per slide; nothing if any slide lacks the feature, since a mean would then leave out slides.
std::optional<std::vector<double>> logarithms(const SlidSurface& surface, SensorFeature feature) {
    std::vector<double> out;
    for (const auto& slide : surface.slides) {
        const double value = valueOf(slide, feature);
        if (!(value > 0) || !std::isfinite(value)) return std::nullopt;
        out.push_back(std::log10(value));
    }
    return out;
}

Result<void> check(const std::vector<SlidSurface>& surfaces) {
    if (surfaces.size() < 2) {
        return invalid("sensor calibration: {} surfaces; a smooth and a rough reference at least are expected",
                       surfaces.size());
    }
    if (const auto* second = secondIn(surfaces, &SlidSurface::name))
        return invalid("sensor calibration: {}", givenTwice("surface {}", second->name));
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const std::size_t least = i < 2 ? kMinSlides : 1;
        if (surfaces[i].slides.size() < least) {
            return invalid("sensor calibration: {} slides over {}; at least {} are expected", surfaces[i].slides.size(),
                           surfaces[i].name, least);
        }
    }
    const auto& smooth = surfaces[0];
    const auto& rough = surfaces[1];
    if (!(smooth.ra_um > 0) || !(rough.ra_um > smooth.ra_um) || !std::isfinite(rough.ra_um)) {
        return invalid(
            "sensor calibration: Ra of the rough reference {} is {} µm, and of the smooth {} {} µm; a larger "
            "one, and both above 0, is expected",
            rough.name, rough.ra_um, smooth.name, smooth.ra_um);
    }
    return {};
}

std::string apart(std::string_view what, const SurfaceDistance& distance) {
    const auto shown = distance.magnitude();
    return fmt::format(
        "{} of the two references is d′ = {:.3g} apart, 95 % interval {:.3g} to {:.3g}; a lower end of "
        "at least {} is expected to tell them apart",
        what, shown.value, shown.low, shown.high, kToldApart);
}

std::vector<double> roughnesses(const SlidSurface& surface, const RoughnessSettings& settings) {
    std::vector<double> out;
    for (const auto& slide : surface.slides) out.push_back(roughnessOf(slide, settings));
    return out;
}

ReferenceSurface certificate(const SlidSurface& surface) {
    // A profile stores 0 for an Rz that is unknown.
    return {surface.name, Micrometres(surface.ra_um), Micrometres(surface.rz_um > 0 ? surface.rz_um : 0)};
}

/// A rig may lack a feature completely. But a rig that measures it only sometimes would use a scale for it that was not
/// measured on this rig.
void sayAbsent(SensorFeature feature, const std::vector<SlidSurface>& surfaces, SensorCalibration& found) {
    const bool measured = std::ranges::any_of(surfaces, [&](const SlidSurface& surface) {
        return std::ranges::any_of(surface.slides, [&](const auto& slide) { return valueOf(slide, feature) > 0; });
    });
    if (!measured) {
        found.warnings.push_back(fmt::format("{} was absent; R stands on what is left", keyOf(feature)));
        return;
    }
    found.reasons.push_back(fmt::format(
        "{} was measured in some slides and not in every slide over the two references, so it has no scale; "
        "all of them, or none, are expected",
        keyOf(feature)));
}

/// Sets each feature's distance and new scale. A feature in use that cannot tell the references apart becomes a reason.
void setScales(const std::vector<SlidSurface>& surfaces, SensorCalibration& found, RoughnessSettings& scaled) {
    const auto used = featuresInUse(scaled);
    std::size_t present = 0;
    for (std::size_t f = 0; f < kSensorFeatures.size(); ++f) {
        const auto feature = kSensorFeatures[f];
        const bool inUse = std::find(used.begin(), used.end(), feature) != used.end();
        const auto smooth = logarithms(surfaces[0], feature), rough = logarithms(surfaces[1], feature);
        if (!smooth || !rough) {
            if (inUse) sayAbsent(feature, surfaces, found);
            continue;
        }
        const auto distance = surfaceDistance(*smooth, *rough);
        if (!distance) continue;  // check() already checked the number of slides
        found.distances[f] = *distance;
        if (!distance->toldApart()) {
            (inUse ? found.reasons : found.warnings)
                .push_back(apart(keyOf(feature), *distance) + (inUse ? "" : "; its scale stays as it was"));
            continue;
        }
        scaleOf(scaled, feature) = {std::pow(10, statisticsOf(*smooth).mean), std::pow(10, statisticsOf(*rough).mean)};
        present += inUse ? 1 : 0;
    }
    if (present == 0 && found.reasons.empty()) {
        found.reasons.emplace_back("neither reference gave a feature that R stands on; sliding contact is expected");
    }
}

void rank(const std::vector<SlidSurface>& surfaces, SensorCalibration& found) {
    std::vector<double> ra, r;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (!(surfaces[i].ra_um > 0) || !std::isfinite(found.surfaces[i].R.mean)) continue;
        ra.push_back(surfaces[i].ra_um);
        r.push_back(found.surfaces[i].R.mean);
    }
    if (ra.size() < kMinRanked) return;
    if (auto ranking = spearman(ra, r)) {
        found.ranking = *std::move(ranking);
    } else {
        found.warnings.push_back(ranking.error().message);
    }
}

constexpr Word<SensorFeature> kFeatureKeys[] = {{"h", SensorFeature::H},
                                                {"h_abs", SensorFeature::HAbs},
                                                {"v_static", SensorFeature::VStatic},
                                                {"v_dynamic", SensorFeature::VDynamic}};

}  // namespace

std::string_view keyOf(SensorFeature feature) noexcept { return wordFor(kFeatureKeys, feature); }

double valueOf(const SlideReading& slide, SensorFeature feature) noexcept {
    switch (feature) {
        case SensorFeature::H:
            return slide.h;
        case SensorFeature::HAbs:
            return slide.hAbs;
        case SensorFeature::VStatic:
            return slide.vStatic;
        case SensorFeature::VDynamic:
            break;
    }
    return slide.vDynamic;
}

std::vector<SensorFeature> featuresInUse(const RoughnessSettings& settings) {
    std::vector<SensorFeature> out;
    const bool relative = settings.spectral == SpectralFeature::Relative;
    const bool fixed = settings.taxel == TaxelFeature::Static;
    if (settings.spectralWeight > 0) out.push_back(relative ? SensorFeature::H : SensorFeature::HAbs);
    if (settings.taxelWeight > 0) out.push_back(fixed ? SensorFeature::VStatic : SensorFeature::VDynamic);
    return out;
}

Result<SensorCalibration> calibrateSensor(const std::vector<SlidSurface>& surfaces, const RoughnessSettings& settings,
                                          const SensorRest& rest) {
    if (auto fine = check(surfaces); !fine) return failure(fine);
    SensorCalibration found;
    found.settings = settings;
    RoughnessSettings scaled = settings;
    setScales(surfaces, found, scaled);
    scaled.calibrated = true;
    scaled.uncertainty = roughnessRepeatability(surfaces, scaled);
    found.uncertainty = scaled.uncertainty;
    if (!scaled.uncertainty)
        found.warnings.emplace_back("the uncertainty of R was not evaluated: a feature was absent");
    scaled.smoothSurface = certificate(surfaces[0]);
    scaled.roughSurface = certificate(surfaces[1]);
    if (rest.levels.slidingMeanSquare > 0) {
        scaled.restMeanSquare = rest.levels.slidingMeanSquare;
        scaled.restUnit = rest.restUnit;
    }
    if (auto valid = validate(scaled); !valid) return failure(valid);

    for (const auto& surface : surfaces) {
        SurfaceResult row{surface.name, surface.ra_um, surface.rz_um, surface.slides.size(), {}, {},
                          {},           surface.source};
        for (std::size_t f = 0; f < kSensorFeatures.size(); ++f) {
            const auto values = logarithms(surface, kSensorFeatures[f]);
            row.features[f] = values ? std::pow(10, statisticsOf(*values).mean) : std::nan("");
        }
        row.R = statisticsOf(roughnesses(surface, scaled));
        std::vector<double> forces;
        for (const auto& slide : surface.slides) forces.push_back(slide.force_n);
        row.force_n = statisticsOf(forces);
        found.surfaces.push_back(std::move(row));
    }
    if (found.reasons.empty()) {
        // R has scales from this run only if every used feature has one.
        if (auto distance = surfaceDistance(roughnesses(surfaces[0], scaled), roughnesses(surfaces[1], scaled))) {
            found.distanceR = *distance;
            if (!(distance->difference > 0) || !distance->toldApart()) found.reasons.push_back(apart("R", *distance));
        } else {
            found.reasons.push_back(distance.error().message);
        }
        rank(surfaces, found);
    }
    found.accepted = found.reasons.empty();
    if (found.accepted) found.settings = scaled;
    return found;
}

namespace {

struct Weight {
    SensorFeature feature;
    double perDecade = 0;  // dR / d log10 x
};

std::vector<Weight> weightsOf(const RoughnessSettings& scaled, const std::vector<SlidSurface>& surfaces) {
    std::vector<Weight> out;
    double total = 0;
    for (const auto feature : featuresInUse(scaled)) {
        const bool spectral = feature == SensorFeature::H || feature == SensorFeature::HAbs;
        // A feature that the rig does not measure is not part of R.
        if (!(valueOf(surfaces.front().slides.front(), feature) > 0)) continue;
        const auto& scale = spectral ? scaled.spectralScale() : scaled.taxelScale();
        const double weight = spectral ? scaled.spectralWeight : scaled.taxelWeight;
        out.push_back({feature, weight / (std::log10(scale.rough) - std::log10(scale.smooth))});
        total += weight;
    }
    for (auto& one : out) one.perDecade /= total;
    return out;
}

/// The roughness of a slide apart from a constant; NaN if a feature is absent.
double positionOf(const SlideReading& slide, const std::vector<Weight>& weights) {
    double z = 0;
    for (const auto& weight : weights) z += weight.perDecade * std::log10(valueOf(slide, weight.feature));
    return std::isfinite(z) ? z : std::nan("");
}

}  // namespace

std::optional<RoughnessUncertainty> roughnessRepeatability(const std::vector<SlidSurface>& surfaces,
                                                           const RoughnessSettings& scaled) {
    if (surfaces.size() < 2 || surfaces[0].slides.empty() || surfaces[1].slides.empty()) return std::nullopt;
    const auto weights = weightsOf(scaled, surfaces);
    if (weights.empty()) return std::nullopt;
    double squares = 0;
    std::size_t freedom = 0;
    for (const auto& surface : surfaces) {
        std::vector<double> z;
        for (const auto& slide : surface.slides) {
            z.push_back(positionOf(slide, weights));
            if (std::isnan(z.back())) return std::nullopt;
        }
        const auto seen = statisticsOf(z);
        if (seen.n < 2) continue;
        squares += static_cast<double>(seen.n - 1) * seen.sd * seen.sd;
        freedom += seen.n - 1;
    }
    if (freedom == 0) return std::nullopt;
    const auto degrees = static_cast<double>(freedom);
    return RoughnessUncertainty{std::sqrt(squares / degrees), surfaces[0].slides.size(), surfaces[1].slides.size(),
                                studentQuantile(0.975, degrees)};
}

}  // namespace tacto
