// RoughnessRepeatability.h - how far R of one slide can be off: what the slide and the two references repeat to.
//
// R = Σ w g / Σ w, and g is linear in log10 of its feature, so that R of a slide moves by z = Σ c log10 x with
// c = w / (Σ w · (log10 x_rough − log10 x_smooth)). s is the standard deviation of z within a surface, pooled over all
// surfaces; features of one slide move together, and z holds their covariance. GUM 5.1.2 with the references' means
// over n slides each: u²(R) = s² (1 + (1 − R)²/n_smooth + R²/n_rough), k from Student's t at Σ (n − 1).
// tests/reference/roughness_uncertainty.py computes the same from covariance matrices.
//
// Thread-safety: pure function.
#pragma once

#include "core/analysis/sensor_calibration/SensorCalibration.h"

namespace tacto {

/// Nothing where a feature in use is absent, or no surface was slid over twice. `scaled` holds the new scales.
[[nodiscard]] std::optional<RoughnessUncertainty> roughnessRepeatability(const std::vector<SlidSurface>& surfaces,
                                                                         const RoughnessSettings& scaled);

}  // namespace tacto
