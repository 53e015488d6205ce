// SensorCalibration.h - sets the scale of the roughness R with reference surfaces (science.md section 2.6).
//
// The finger slides over each surface several times; a slide gives one value per feature. The first two surfaces are
// the smooth and the rough reference. x_smooth and x_rough are geometric means over their slides, because g() uses
// log10. Their distance is a d′ (SurfaceDistance.h) of log10 x per slide, and of R per slide with the new scale. If R
// or a feature used by R cannot tell the two apart, the calibration is refused and the settings stay unchanged. With
// five or more surfaces of known Ra, Spearman's correlation of mean R with Ra tells whether R ranks like the
// profilometer (RankCorrelation.h). It is reported but not judged.
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
/// Returns the two features that `settings` choose, without any of weight 0.
[[nodiscard]] std::vector<SensorFeature> featuresInUse(const RoughnessSettings& settings);

struct SlidSurface {
    std::string name;
    double ra_um = std::numeric_limits<double>::quiet_NaN();  ///< measured by a profilometer; NaN: unknown
    double rz_um = std::numeric_limits<double>::quiet_NaN();
    std::vector<SlideReading> slides;
    std::string source = {};  ///< of Ra and Rz: "typed in", or the file
};

struct SurfaceResult {
    std::string name;
    double ra_um = std::numeric_limits<double>::quiet_NaN();
    double rz_um = std::numeric_limits<double>::quiet_NaN();
    std::size_t slides = 0;
    std::array<double, kSensorFeatures.size()> features{};  ///< geometric means; NaN: absent
    Statistics R;        ///< R of the slides with the new scale; outside 0..1 if outside the references
    Statistics force_n;  ///< from the mean force of each slide
    std::string source = {};
};

struct SensorCalibration {
    bool accepted = false;
    std::vector<std::string> reasons;                 ///< why the calibration is refused, one sentence each
    std::vector<std::string> warnings;                ///< limitations of an accepted calibration
    RoughnessSettings settings;                       ///< with new scales, surfaces and rest; unchanged if refused
    std::optional<RoughnessUncertainty> uncertainty;  ///< of R with the new scales; empty: not evaluated
    std::vector<SurfaceResult> surfaces;
    std::array<std::optional<SurfaceDistance>, kSensorFeatures.size()> distances;  ///< empty if not measured
    std::optional<SurfaceDistance> distanceR;
    std::optional<RankCorrelation> ranking;  ///< empty: fewer than five surfaces of known Ra, or constant R
};

/// The first two `surfaces` are the smooth and the rough reference. Errors: InvalidArgument for fewer than two
/// surfaces, fewer than kMinSlides slides of a reference, a repeated name, or a rough reference whose Ra is unknown or
/// not above that of the smooth one.
[[nodiscard]] Result<SensorCalibration> calibrateSensor(const std::vector<SlidSurface>& surfaces,
                                                        const RoughnessSettings& settings, const SensorRest& rest);

// The uncertainty of R of one slide, from the repeatability of the slide and of the two references.
//
// R = Σ w g / Σ w, and g is linear in log10 of its feature. R of a slide therefore changes with z = Σ c log10 x, where
// c = w / (Σ w · (log10 x_rough − log10 x_smooth)). s is the standard deviation of z within a surface, pooled over all
// surfaces; z includes the covariance of a slide's features. With reference means over n slides each, GUM 5.1.2 gives
// u²(R) = s² (1 + (1 − R)²/n_smooth + R²/n_rough), with k from Student's t at Σ (n − 1).
// tests/reference/roughness_uncertainty.py computes the same from covariance matrices.

/// Returns nothing if a used feature is absent or no surface has two slides. `scaled` holds the new scales.
[[nodiscard]] std::optional<RoughnessUncertainty> roughnessRepeatability(const std::vector<SlidSurface>& surfaces,
                                                                         const RoughnessSettings& scaled);

}  // namespace tacto
