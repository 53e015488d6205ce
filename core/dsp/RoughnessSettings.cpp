#include "core/dsp/RoughnessSettings.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

tl::unexpected<Error> outOfRange(std::string_view key, double value, std::string_view expected) {
    return fail(ErrorCode::InvalidArgument, "roughness: {} is {}; {} was expected", key, value, expected);
}

Result<void> validateScale(std::string_view key, const ReferenceScale& scale) {
    for (const double x : {scale.smooth, scale.rough}) {
        if (!(x > 0 && std::isfinite(x))) return outOfRange(key, x, "a positive number for smooth and for rough");
    }
    if (scale.smooth == scale.rough) {
        return fail(ErrorCode::InvalidArgument,
                    "roughness: {} has smooth and rough both {}; two different readings were expected", key,
                    scale.smooth);
    }
    return {};
}

/// Reads one object's keys, refusing those it does not know.
class Section {
public:
    Section(const Json& json, std::string name) : json_(json), name_(std::move(name)) {}

    Result<void> only(std::initializer_list<std::string_view> keys) const { return onlyKeys(json_, keys, name_); }
    Result<void> number(const char* key, double& into) const {
        if (!json_.contains(key)) return {};
        if (!json_[key].is_number()) return wrongType(key, "a number");
        into = json_[key].get<double>();
        return {};
    }
    Result<void> boolean(const char* key, bool& into) const {
        if (!json_.contains(key)) return {};
        if (!json_[key].is_boolean()) return wrongType(key, "true or false");
        into = json_[key].get<bool>();
        return {};
    }
    Result<void> text(const char* key, std::string& into) const {
        if (!json_.contains(key)) return {};
        if (!json_[key].is_string()) return wrongType(key, "a text");
        into = json_[key].get<std::string>();
        return {};
    }
    /// `first` gives false, `second` true.
    Result<void> choice(const char* key, std::string_view first, std::string_view second, bool& into) const {
        if (!json_.contains(key)) return {};
        const auto expected = fmt::format("\"{}\" or \"{}\"", first, second);
        if (!json_[key].is_string()) return wrongType(key, expected);
        const auto value = json_[key].get<std::string>();
        if (value != first && value != second) {
            return fail(ErrorCode::InvalidArgument, "{}: {} is \"{}\"; {} was expected", name_, key, value, expected);
        }
        into = value == second;
        return {};
    }
    [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
    [[nodiscard]] Section at(const char* key) const { return {json_[key], name_ + "." + key}; }

private:
    tl::unexpected<Error> wrongType(const char* key, std::string_view expected) const {
        return fail(ErrorCode::ParseError, "{}: {} is {}; {} was expected", name_, key, shownJson(json_[key]),
                    expected);
    }
    const Json& json_;
    std::string name_;
};

/// The first that failed.
template <class... Steps>
Result<void> firstFailure(Steps&&... steps) {
    Result<void> outcome;
    (void)((outcome = steps(), outcome.has_value()) && ...);
    return outcome;
}

Result<void> readScale(const Section& references, const char* key, ReferenceScale& into) {
    if (!references.has(key)) return {};
    const auto section = references.at(key);
    return firstFailure(
        [&] {
            return section.only({"smooth", "rough"});
        },
        [&] { return section.number("smooth", into.smooth); }, [&] { return section.number("rough", into.rough); });
}

Result<void> readSurface(const Section& surfaces, const char* key, std::optional<ReferenceSurface>& into) {
    if (!surfaces.has(key)) return {};
    const auto section = surfaces.at(key);
    double ra = 0;
    double rz = 0;
    into.emplace();
    const auto done = firstFailure(
        [&] {
            return section.only({"name", "ra_um", "rz_um"});
        },
        [&] { return section.text("name", into->name); }, [&] { return section.number("ra_um", ra); },
        [&] { return section.number("rz_um", rz); });
    into->ra = Micrometres(ra);
    into->rz = Micrometres(rz);
    return done;
}

Result<void> readRest(const Section& root, RoughnessSettings& into) {
    if (!root.has("rest")) return {};
    const auto section = root.at("rest");
    double meanSquare = std::numeric_limits<double>::quiet_NaN();
    bool count = false;
    const auto done = firstFailure(
        [&] {
            return section.only({"mean_square", "unit"});
        },
        [&] { return section.number("mean_square", meanSquare); },
        [&] { return section.choice("unit", "m/s2", "count", count); });
    into.restMeanSquare = meanSquare;
    into.restUnit = count ? StreamUnit::Count : StreamUnit::MetrePerSecondSquared;
    return done;
}

Result<void> readReferences(const Section& root, RoughnessSettings& into) {
    if (root.has("references")) {
        const auto section = root.at("references");
        const auto done = firstFailure(
            [&] {
                return section.only({"h", "h_abs", "v_static", "v_dynamic"});
            },
            [&] { return readScale(section, "h", into.h); }, [&] { return readScale(section, "h_abs", into.hAbs); },
            [&] { return readScale(section, "v_static", into.vStatic); },
            [&] { return readScale(section, "v_dynamic", into.vDynamic); });
        if (!done) return done;
    }
    if (!root.has("surfaces")) return {};
    const auto section = root.at("surfaces");
    return firstFailure(
        [&] {
            return section.only({"smooth", "rough"});
        },
        [&] { return readSurface(section, "smooth", into.smoothSurface); },
        [&] { return readSurface(section, "rough", into.roughSurface); });
}

Result<void> readFingertip(const Json& root, RoughnessSettings& into) {
    if (root.contains("sensor")) {
        auto sensor = sensorScalesFromJson(root["sensor"]);
        if (!sensor) return failure(sensor);
        into.sensor = *std::move(sensor);
    }
    if (!root.contains("uncertainty")) return {};
    auto uncertainty = roughnessUncertaintyFromJson(root["uncertainty"]);
    if (!uncertainty) return failure(uncertainty);
    into.uncertainty = *uncertainty;
    return {};
}

}  // namespace

double ReferenceScale::g(double x) const noexcept {
    if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
    const double from = std::log10(smooth);
    return std::clamp((std::log10(x) - from) / (std::log10(rough) - from), 0.0, 1.0);
}

double pressureIndex(double pressure_pa, const RoughnessSettings& settings) noexcept {
    const double low = settings.pressureMin.value();
    return std::clamp((pressure_pa - low) / (settings.pressureMax.value() - low), 0.0, 1.0);
}

Result<void> validate(const RoughnessSettings& s) {
    if (!(s.bandLow.value() >= 5 && s.bandLow.value() < 1000)) {
        return outOfRange("band_low_hz", s.bandLow.value(), "5 to below 1000 Hz");
    }
    if (!(s.spectralWeight >= 0 && s.spectralWeight <= 1e6)) {
        return outOfRange("spectral_weight", s.spectralWeight, "0 or more");
    }
    if (!(s.taxelWeight >= 0 && s.taxelWeight <= 1e6)) return outOfRange("taxel_weight", s.taxelWeight, "0 or more");
    if (s.spectralWeight + s.taxelWeight == 0) {
        return outOfRange("spectral_weight", 0, "above 0 for it or for taxel_weight");
    }
    const double tau = s.smoothing.count();
    if (!(tau > 0 && tau <= 60)) return outOfRange("smoothing_s", tau, "above 0 to 60 s");
    const double area = s.contactArea.value();
    if (!(area > 0 && area <= 1e4)) return outOfRange("contact_area_cm2", area, "above 0 to 10000 cm2");
    const double low = s.pressureMin.value();
    const double high = s.pressureMax.value();
    if (!(low >= 0 && low <= 1e9)) return outOfRange("pressure_min_pa", low, "0 Pa or more");
    if (!(high > low && high <= 1e9)) return outOfRange("pressure_max_pa", high, "more than pressure_min_pa");
    if (s.restMeanSquare && !(*s.restMeanSquare > 0 && std::isfinite(*s.restMeanSquare))) {
        return outOfRange("rest.mean_square", *s.restMeanSquare, "a positive number");
    }
    return firstFailure([&] { return validateScale("references.h", s.h); },
                        [&] { return validateScale("references.h_abs", s.hAbs); },
                        [&] { return validateScale("references.v_static", s.vStatic); },
                        [&] { return validateScale("references.v_dynamic", s.vDynamic); });
}

Result<RoughnessSettings> roughnessSettingsFromJson(const nlohmann::json& json) {
    const Section root(json, "roughness");
    RoughnessSettings s;
    bool absolute = false;
    bool dynamic = false;
    double bandLow = s.bandLow.value();
    double smoothing = s.smoothing.count();
    double area = s.contactArea.value();
    double low = s.pressureMin.value();
    double high = s.pressureMax.value();
    const auto done = firstFailure(
        [&] {
            return root.only({"spectral_feature", "taxel_feature", "band_low_hz", "spectral_weight", "taxel_weight",
                              "calibrated", "references", "surfaces", "smoothing_s", "contact_area_cm2",
                              "pressure_min_pa", "pressure_max_pa", "rest", "sensor", "uncertainty"});
        },
        [&] { return root.choice("spectral_feature", "h", "h_abs", absolute); },
        [&] { return root.choice("taxel_feature", "static", "dynamic", dynamic); },
        [&] { return root.number("band_low_hz", bandLow); },
        [&] { return root.number("spectral_weight", s.spectralWeight); },
        [&] { return root.number("taxel_weight", s.taxelWeight); },
        [&] { return root.boolean("calibrated", s.calibrated); }, [&] { return root.number("smoothing_s", smoothing); },
        [&] { return root.number("contact_area_cm2", area); }, [&] { return root.number("pressure_min_pa", low); },
        [&] { return root.number("pressure_max_pa", high); }, [&] { return readRest(root, s); },
        [&] { return readReferences(root, s); }, [&] { return readFingertip(json, s); });
    if (!done) return failure(done);
    s.spectral = absolute ? SpectralFeature::Absolute : SpectralFeature::Relative;
    s.taxel = dynamic ? TaxelFeature::Dynamic : TaxelFeature::Static;
    s.bandLow = Hertz(bandLow);
    s.smoothing = Seconds(smoothing);
    s.contactArea = SquareCentimetres(area);
    s.pressureMin = Pascals(low);
    s.pressureMax = Pascals(high);
    if (const auto valid = validate(s); !valid) return failure(valid);
    return s;
}

nlohmann::json toJson(const RoughnessSettings& s) {
    const auto scale = [](const ReferenceScale& x) { return Json{{"smooth", x.smooth}, {"rough", x.rough}}; };
    const auto surface = [](const ReferenceSurface& x) {
        return Json{{"name", x.name}, {"ra_um", x.ra.value()}, {"rz_um", x.rz.value()}};
    };
    Json out{{"spectral_feature", s.spectral == SpectralFeature::Relative ? "h" : "h_abs"},
             {"taxel_feature", s.taxel == TaxelFeature::Static ? "static" : "dynamic"},
             {"band_low_hz", s.bandLow.value()},
             {"spectral_weight", s.spectralWeight},
             {"taxel_weight", s.taxelWeight},
             {"calibrated", s.calibrated},
             {"references",
              {{"h", scale(s.h)},
               {"h_abs", scale(s.hAbs)},
               {"v_static", scale(s.vStatic)},
               {"v_dynamic", scale(s.vDynamic)}}},
             {"smoothing_s", s.smoothing.count()},
             {"contact_area_cm2", s.contactArea.value()},
             {"pressure_min_pa", s.pressureMin.value()},
             {"pressure_max_pa", s.pressureMax.value()}};
    if (s.smoothSurface) out["surfaces"]["smooth"] = surface(*s.smoothSurface);
    if (s.roughSurface) out["surfaces"]["rough"] = surface(*s.roughSurface);
    if (s.sensor) out["sensor"] = toJson(*s.sensor);
    if (s.uncertainty) out["uncertainty"] = toJson(*s.uncertainty);
    if (s.restMeanSquare)
        out["rest"] = {{"mean_square", *s.restMeanSquare}, {"unit", std::string(symbolOf(s.restUnit))}};
    return out;
}

}  // namespace tacto
