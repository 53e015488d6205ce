// RoughnessSettings.h - the choices that science.md sections 2 and 3 leave to the profile.
//
// Thread-safety: values.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/base/Units.h"
#include "core/dsp/SensorScales.h"

namespace tacto {

enum class SpectralFeature { Relative, Absolute };  ///< "h", "h_abs"
enum class TaxelFeature { Static, Dynamic };        ///< "static", "dynamic"

/// What one feature reads on the smooth and on the rough reference surface of this rig. In the feature's own unit.
struct ReferenceScale {
    double smooth = 0;
    double rough = 0;
    /// The place of x between smooth (0) and rough (1) on a logarithmic scale, and beyond them; NaN for x that is
    /// absent (NaN) or not positive.
    [[nodiscard]] double position(double x) const noexcept;
    /// g(x): the position, held within 0..1.
    [[nodiscard]] double g(double x) const noexcept;
    bool operator==(const ReferenceScale&) const = default;
};

/// A reference surface as its profilometer certificate describes it.
struct ReferenceSurface {
    std::string name;
    Micrometres ra{0};
    Micrometres rz{0};
    bool operator==(const ReferenceSurface&) const = default;
};

/// What the shipped simulated finger reads on plastic (smooth) and P120 (rough), 4 s at 50 mm/s and 1 N, as the
/// separability protocol measures them. A result that stands on these is "uncalibrated R".
inline constexpr ReferenceScale kSimulatedH{0.024, 0.334};
inline constexpr ReferenceScale kSimulatedHAbs{0.042, 0.772};  // (m/s2/N)2
inline constexpr ReferenceScale kSimulatedVStatic{2.0e-4, 0.052};
inline constexpr ReferenceScale kSimulatedVDynamic{1.8e-4, 0.045};

struct RoughnessSettings {
    SpectralFeature spectral = SpectralFeature::Relative;
    TaxelFeature taxel = TaxelFeature::Static;
    Hertz bandLow{200};           ///< lower end of the rough band, 5 Hz..1 kHz
    double spectralWeight = 0.5;  ///< ≥ 0; not both 0
    double taxelWeight = 0.5;
    ReferenceScale h = kSimulatedH;
    ReferenceScale hAbs = kSimulatedHAbs;
    ReferenceScale vStatic = kSimulatedVStatic;
    ReferenceScale vDynamic = kSimulatedVDynamic;
    bool calibrated = false;                          ///< the scales in use were measured on this rig
    std::optional<RoughnessUncertainty> uncertainty;  ///< uncertainty of R under these scales; nothing: not known
    std::optional<SensorScales> sensor;               ///< scales of the fingertip that they were measured with
    std::optional<ReferenceSurface> smoothSurface;
    std::optional<ReferenceSurface> roughSurface;
    Seconds smoothing{0.05};           ///< τ of R's first-order smoother, > 0
    SquareCentimetres contactArea{1};  ///< > 0
    Pascals pressureMin{2'000};
    Pascals pressureMax{50'000};
    /// Mean square at rest of the band-passed acceleration (5 Hz..1 kHz, all axes, force normalisation undone), in
    /// restUnit squared; used when a recording offers no rest of its own and its acceleration has this unit.
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

/// P in 0..1 of a contact pressure (science.md section 3); NaN when it is NaN.
[[nodiscard]] double pressureIndex(double pressure_pa, const RoughnessSettings& settings) noexcept;

/// The `roughness` section of a profile: every key with what it accepts.
[[nodiscard]] const RecordFields<RoughnessSettings>& roughnessFields();
/// Errors: InvalidArgument naming the key, its value and what it takes (NaN and equal references are refused).
[[nodiscard]] Result<void> validate(const RoughnessSettings& settings);
/// Reads the section; absent keys keep their defaults. Errors: as RecordFields::read().
[[nodiscard]] Result<RoughnessSettings> roughnessSettingsFromJson(const nlohmann::json& section);
[[nodiscard]] nlohmann::json toJson(const RoughnessSettings& settings);

}  // namespace tacto
