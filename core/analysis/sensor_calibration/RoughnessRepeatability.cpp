#include "core/analysis/sensor_calibration/RoughnessRepeatability.h"

#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"

namespace tacto {

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
        // A feature that the rig does not have takes no part in R.
        if (!(valueOf(surfaces.front().slides.front(), feature) > 0)) continue;
        const auto& scale = spectral ? scaled.spectralScale() : scaled.taxelScale();
        const double weight = spectral ? scaled.spectralWeight : scaled.taxelWeight;
        out.push_back({feature, weight / (std::log10(scale.rough) - std::log10(scale.smooth))});
        total += weight;
    }
    for (auto& one : out) one.perDecade /= total;
    return out;
}

/// The roughness of a slide, but for a constant; NaN where a feature is absent.
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
