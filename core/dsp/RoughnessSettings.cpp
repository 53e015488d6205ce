#include "core/dsp/RoughnessSettings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/RecordFields.h"
#include "core/dsp/SensorScales.h"

namespace tacto {

namespace {

constexpr Word<SpectralFeature> kSpectralFeatures[] = {{"h", SpectralFeature::Relative},
                                                       {"h_abs", SpectralFeature::Absolute}};
constexpr Word<TaxelFeature> kTaxelFeatures[] = {{"static", TaxelFeature::Static}, {"dynamic", TaxelFeature::Dynamic}};

tl::unexpected<Error> refused(std::string_view key, double value, std::string_view expected) {
    return invalid("\"{}\" is {}; {} was expected", key, value, expected);
}

RecordFields<RoughnessSettings> referenceFields() {
    using S = RoughnessSettings;
    RecordFields<ReferenceScale> scale;
    scale.number("smooth", &ReferenceScale::smooth, {.low = 0, .openLow = true});
    scale.number("rough", &ReferenceScale::rough, {.low = 0, .openLow = true});
    scale.rule([](const ReferenceScale& s) -> Result<void> {
        if (s.smooth != s.rough) return {};
        return invalid("smooth and rough are both {}; two different readings were expected", s.smooth);
    });
    RecordFields<S> all;
    all.record("h", &S::h, scale);
    all.record("h_abs", &S::hAbs, scale);
    all.record("v_static", &S::vStatic, scale);
    all.record("v_dynamic", &S::vDynamic, scale);
    return all;
}

RecordFields<RoughnessSettings> surfaceFields() {
    RecordFields<ReferenceSurface> surface;
    surface.text("name", &ReferenceSurface::name, {.mayBeEmpty = true});
    surface.number("ra_um", &ReferenceSurface::ra, {.unit = "µm"});
    surface.number("rz_um", &ReferenceSurface::rz, {.unit = "µm"});
    RecordFields<RoughnessSettings> all;
    all.record("smooth", &RoughnessSettings::smoothSurface, surface).leftOutIfEmpty = true;
    all.record("rough", &RoughnessSettings::roughSurface, surface).leftOutIfEmpty = true;
    return all;
}

RecordFields<RoughnessSettings> restFields() {
    RecordFields<RoughnessSettings> all;
    auto& meanSquare = all.number("mean_square", &RoughnessSettings::restMeanSquare, {.low = 0, .openLow = true});
    meanSquare.required = true;
    meanSquare.mayBeNull = false;
    all.word("unit", &RoughnessSettings::restUnit, kRestUnits);
    all.absentWhere([](const RoughnessSettings& s) { return !s.restMeanSquare; });
    return all;
}

Result<void> oneFeatureHasWeight(const RoughnessSettings& s) {
    if (s.spectralWeight + s.taxelWeight > 0) return {};
    return refused("spectral_weight", 0, "above 0 for it or for taxel_weight");
}

Result<void> pressuresIncrease(const RoughnessSettings& s) {
    if (s.pressureMax > s.pressureMin) return {};
    return refused("pressure_max_pa", s.pressureMax.value(), "more than pressure_min_pa");
}

RecordFields<RoughnessSettings> buildRoughnessFields() {
    using S = RoughnessSettings;
    RecordFields<S> all;
    all.word("spectral_feature", &S::spectral, kSpectralFeatures);
    all.word("taxel_feature", &S::taxel, kTaxelFeatures);
    all.number("band_low_hz", &S::bandLow, {.low = 5, .high = 1000, .openHigh = true, .unit = "Hz"});
    all.number("spectral_weight", &S::spectralWeight, {.low = 0, .high = 1e6});
    all.number("taxel_weight", &S::taxelWeight, {.low = 0, .high = 1e6});
    all.flag("calibrated", &S::calibrated);
    all.record("references", std::identity{}, referenceFields());
    all.record("surfaces", std::identity{}, surfaceFields()).leftOutIfEmpty = true;
    all.number("smoothing_s", &S::smoothing, {.low = 0, .high = 60, .openLow = true, .unit = "s"});
    all.number("contact_area_cm2", &S::contactArea, {.low = 0, .high = 1e4, .openLow = true, .unit = "cm²"});
    all.number("pressure_min_pa", &S::pressureMin, {.low = 0, .high = 1e9, .unit = "Pa"});
    all.number("pressure_max_pa", &S::pressureMax, {.low = 0, .high = 1e9, .openLow = true, .unit = "Pa"});
    all.record("rest", std::identity{}, restFields()).leftOutIfEmpty = true;
    all.add("sensor", &S::sensor, sensorScalesKind()).leftOutIfEmpty = true;
    all.record("uncertainty", &S::uncertainty, roughnessUncertaintyFields()).leftOutIfEmpty = true;
    all.rule(oneFeatureHasWeight);
    all.rule(pressuresIncrease);
    return all;
}

}  // namespace

double ReferenceScale::position(double x) const noexcept {
    if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
    const double from = std::log10(smooth);
    return (std::log10(x) - from) / (std::log10(rough) - from);
}

double ReferenceScale::g(double x) const noexcept { return std::clamp(position(x), 0.0, 1.0); }

double pressureIndex(double pressure_pa, const RoughnessSettings& settings) noexcept {
    const double low = settings.pressureMin.value();
    return std::clamp((pressure_pa - low) / (settings.pressureMax.value() - low), 0.0, 1.0);
}

const RecordFields<RoughnessSettings>& roughnessFields() { return builtOnce<buildRoughnessFields>(); }

Result<void> validate(const RoughnessSettings& settings) {
    return roughnessFields().check(settings, {.path = "roughness"});
}

Result<RoughnessSettings> roughnessSettingsFromJson(const nlohmann::json& section) {
    return roughnessFields().read(section, {.path = "roughness"});
}

nlohmann::json toJson(const RoughnessSettings& settings) { return roughnessFields().write(settings); }

}  // namespace tacto
