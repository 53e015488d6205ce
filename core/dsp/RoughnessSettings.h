// RoughnessSettings.h - the parameters of science.md sections 2 and 3 that a profile sets.
//
// Thread-safety: plain values.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/base/Units.h"
#include "core/dsp/SensorScales.h"

namespace tacto {

enum class SpectralFeature { Relative, Absolute };  ///< in profiles: "h", "h_abs"
enum class TaxelFeature { Static, Dynamic };        ///< in profiles: "static", "dynamic"

/// Values of one feature on the smooth and the rough reference surface of this rig, in the feature's unit.
struct ReferenceScale {
    double smooth = 0;
    double rough = 0;
    /// Returns the position of x on a logarithmic scale from smooth (0) to rough (1), not limited. NaN if x is absent
    /// (NaN) or not positive.
    [[nodiscard]] double position(double x) const noexcept;
    /// Returns g(x): the position, limited to 0..1.
    [[nodiscard]] double g(double x) const noexcept;
    bool operator==(const ReferenceScale&) const = default;
};

/// A reference surface, as in its profilometer certificate.
struct ReferenceSurface {
    std::string name;
    Micrometres ra{0};
    Micrometres rz{0};
    bool operator==(const ReferenceSurface&) const = default;
};

/// Values of the simulated finger on plastic (smooth) and P120 (rough), 4 s at 50 mm/s and 1 N, as the separability
/// protocol measures them. A result based on these is "uncalibrated R".
inline constexpr ReferenceScale kSimulatedH{0.024, 0.334};
inline constexpr ReferenceScale kSimulatedHAbs{0.042, 0.772};  // (m/s2/N)2
inline constexpr ReferenceScale kSimulatedVStatic{2.0e-4, 0.052};
inline constexpr ReferenceScale kSimulatedVDynamic{1.8e-4, 0.045};

struct RoughnessSettings {
    SpectralFeature spectral = SpectralFeature::Relative;
    TaxelFeature taxel = TaxelFeature::Static;
    Hertz bandLow{200};           ///< lower end of the band for roughness, 5 Hz to 1 kHz
    double spectralWeight = 0.5;  ///< ≥ 0; the two weights must not both be 0
    double taxelWeight = 0.5;
    ReferenceScale h = kSimulatedH;
    ReferenceScale hAbs = kSimulatedHAbs;
    ReferenceScale vStatic = kSimulatedVStatic;
    ReferenceScale vDynamic = kSimulatedVDynamic;
    bool calibrated = false;                          ///< true if the scales were measured on this rig
    std::optional<RoughnessUncertainty> uncertainty;  ///< uncertainty of R with these scales; nothing: not known
    std::optional<SensorScales> sensor;               ///< scales of the fingertip used for the measurement
    std::optional<ReferenceSurface> smoothSurface;
    std::optional<ReferenceSurface> roughSurface;
    Seconds smoothing{0.05};           ///< time constant τ of the first-order smoother of R, > 0
    SquareCentimetres contactArea{1};  ///< must be above 0
    Pascals pressureMin{2'000};
    Pascals pressureMax{50'000};
    /// Mean square at rest of the band-passed acceleration (5 Hz..1 kHz, all axes, force normalisation undone), in
    /// restUnit squared. Used if a recording has no rest of its own and its acceleration has this unit.
    std::optional<double> restMeanSquare;
    StreamUnit restUnit = StreamUnit::MetrePerSecondSquared;

    [[nodiscard]] const ReferenceScale& spectralScale() const noexcept {
        return spectral == SpectralFeature::Relative ? h : hAbs;
    }
    [[nodiscard]] const ReferenceScale& taxelScale() const noexcept {
        return taxel == TaxelFeature::Static ? vStatic : vDynamic;
    }
    bool operator==(const RoughnessSettings&) const = default;
};

/// Returns P in 0..1 for a contact pressure (science.md section 3); NaN for NaN.
[[nodiscard]] double pressureIndex(double pressure_pa, const RoughnessSettings& settings) noexcept;

/// Returns the fields of a profile's `roughness` section: every key with its accepted values.
[[nodiscard]] const RecordFields<RoughnessSettings>& roughnessFields();
/// Errors: InvalidArgument naming the key, its value and the accepted values (NaN and equal references are refused).
[[nodiscard]] Result<void> validate(const RoughnessSettings& settings);
/// Reads the section; missing keys keep their defaults. Errors: as RecordFields::read().
[[nodiscard]] Result<RoughnessSettings> roughnessSettingsFromJson(const nlohmann::json& section);
[[nodiscard]] nlohmann::json toJson(const RoughnessSettings& settings);

}  // namespace tacto
