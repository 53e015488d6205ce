// SensorCalibration.h - reference surfaces become the scale of R: science.md section 2.6.
//
// Each surface was slid over several times; a slide gives one value per feature. The first two surfaces are the smooth
// and the rough reference: x_smooth and x_rough are the geometric means over their slides, because g() works on log10.
// How far apart the two read is a distance in d′ (SurfaceDistance.h) of log10 x per slide, and of R per slide under the
// new scale. A pair that cannot be told apart, in a feature that R stands on or in R itself, is refused: the settings
// then stay as they were. With five or more surfaces of known Ra, Spearman's correlation of mean R against Ra says
// whether R ranks as the profilometer does (RankCorrelation.h); it is reported, and not judged.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/sensor_calibration/RankCorrelation.h"
#include "core/analysis/sensor_calibration/SensorReading.h"
#include "core/analysis/sensor_calibration/SurfaceDistance.h"
#include "core/dsp/RoughnessSettings.h"

namespace tacto {

enum class SensorFeature { H, HAbs, VStatic, VDynamic };
inline constexpr std::array kSensorFeatures{SensorFeature::H, SensorFeature::HAbs, SensorFeature::VStatic,
                                            SensorFeature::VDynamic};
[[nodiscard]] std::string_view keyOf(SensorFeature feature) noexcept;  // "h", "h_abs", "v_static", "v_dynamic"
[[nodiscard]] double valueOf(const SlideReading& slide, SensorFeature feature) noexcept;
/// The two that `settings` choose, without those of weight 0.
[[nodiscard]] std::vector<SensorFeature> featuresInUse(const RoughnessSettings& settings);

struct SlidSurface {
    std::string name;
    double ra_um = std::numeric_limits<double>::quiet_NaN();  ///< by profilometer; NaN: not known
    double rz_um = std::numeric_limits<double>::quiet_NaN();
    std::vector<SlideReading> slides;
};

struct SurfaceResult {
    std::string name;
    double ra_um = std::numeric_limits<double>::quiet_NaN();
    double rz_um = std::numeric_limits<double>::quiet_NaN();
    std::size_t slides = 0;
    std::array<double, kSensorFeatures.size()> features{};  ///< geometric means; NaN: absent
    Statistics R;        ///< R of the slides under the new scale, each beyond 0..1 where it is beyond the references
    Statistics force_n;  ///< from the slides' means
};

struct SensorCalibration {
    bool accepted = false;
    std::vector<std::string> reasons;   ///< reasons why it is not usable, one sentence each
    std::vector<std::string> warnings;  ///< limitations of an accepted calibration
    RoughnessSettings settings;         ///< settings with the new scales, surfaces and rest; unchanged where refused
    std::optional<RoughnessUncertainty> uncertainty;  ///< uncertainty of R under the new scales; nothing: not evaluated
    std::vector<SurfaceResult> surfaces;
    std::array<std::optional<SurfaceDistance>, kSensorFeatures.size()> distances;  ///< nothing where the rig lacks it
    std::optional<SurfaceDistance> distanceR;
    std::optional<RankCorrelation> ranking;  ///< nothing: fewer than five surfaces of known Ra, or R does not vary
};

/// `surfaces` begins with the smooth and the rough reference.
/// Errors: InvalidArgument for fewer than two surfaces, fewer than kMinSlides slides of a reference, a name that
/// appears twice, and a rough reference whose Ra is not known or not above the smooth one's.
[[nodiscard]] Result<SensorCalibration> calibrateSensor(const std::vector<SlidSurface>& surfaces,
                                                        const RoughnessSettings& settings, const SensorRest& rest);

// How far R of one slide can be off, from the repeatability of the slide and the two references.
//
// R = Σ w g / Σ w, and g is linear in log10 of its feature, so that R of a slide moves by z = Σ c log10 x with
// c = w / (Σ w · (log10 x_rough − log10 x_smooth)). s is the standard deviation of z within a surface, pooled over all
// surfaces; features of one slide move together, and z holds their covariance. GUM 5.1.2 with the references' means
// over n slides each: u²(R) = s² (1 + (1 − R)²/n_smooth + R²/n_rough), k from Student's t at Σ (n − 1).
// tests/reference/roughness_uncertainty.py computes the same from covariance matrices.

/// Nothing where a feature in use is absent, or no surface was slid over twice. `scaled` holds the new scales.
[[nodiscard]] std::optional<RoughnessUncertainty> roughnessRepeatability(const std::vector<SlidSurface>& surfaces,
                                                                         const RoughnessSettings& scaled);

}  // namespace tacto
