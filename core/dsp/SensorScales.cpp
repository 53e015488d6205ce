#include "core/dsp/SensorScales.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

using ScaleJson = nlohmann::json;

tl::unexpected<Error> wrongValue(std::string_view where, const ScaleJson& value, std::string_view expected) {
    return fail(ErrorCode::InvalidArgument, "roughness.{} is {}; {} was expected", where, shownJson(value), expected);
}

Result<double> finiteIn(const ScaleJson& value, std::string_view where) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return wrongValue(where, value, "a number");
    return value.get<double>();
}

Result<SensorLine> lineFrom(const ScaleJson& scale, const ScaleJson& offset, const ScaleJson& uncertainty,
                            const std::string& where) {
    SensorLine line;
    const auto by = finiteIn(scale, where + ".scale");
    if (!by) return failure(by);
    if (*by == 0) return wrongValue(where + ".scale", scale, "a number other than 0");
    const auto from = finiteIn(offset, where + ".offset");
    if (!from) return failure(from);
    line.scale = *by;
    line.offset = *from;
    if (uncertainty.is_null()) return line;
    const auto u = finiteIn(uncertainty, where + ".scale_u");
    if (!u) return failure(u);
    if (!(*u >= 0)) return wrongValue(where + ".scale_u", uncertainty, "0 or more, or null");
    line.scaleU = *u;
    return line;
}

Result<StreamUnit> unitFrom(const ScaleJson& section, StreamUnit calibrated, const std::string& where) {
    const auto unit = section.value("unit", ScaleJson());
    for (const auto known : {calibrated, StreamUnit::Count}) {
        if (unit == symbolOf(known)) return known;
    }
    return wrongValue(where + ".unit", unit, fmt::format("\"{}\" or \"count\"", symbolOf(calibrated)));
}

Result<void> readForce(const ScaleJson& section, SensorScales& into) {
    if (const auto known = onlyKeys(section, {"unit", "scale", "offset_n", "scale_u"}, "roughness.sensor.force");
        !known)
        return known;
    const auto unit = unitFrom(section, StreamUnit::Newton, "sensor.force");
    if (!unit) return failure(unit);
    auto line = lineFrom(section.value("scale", ScaleJson()), section.value("offset_n", ScaleJson()),
                         section.value("scale_u", ScaleJson()), "sensor.force");
    if (!line) return failure(line);
    into.forceUnit = *unit;
    into.force = *line;
    return {};
}

Result<void> readTaxels(const ScaleJson& section, SensorScales& into) {
    if (const auto known = onlyKeys(section, {"unit", "scale", "offset_pa", "scale_u"}, "roughness.sensor.taxels");
        !known)
        return known;
    const auto unit = unitFrom(section, StreamUnit::Pascal, "sensor.taxels");
    if (!unit) return failure(unit);
    into.taxelUnit = *unit;
    const auto scales = section.value("scale", ScaleJson());
    if (!scales.is_array() || scales.empty()) return wrongValue("sensor.taxels.scale", scales, "one number a taxel");
    for (const char* key : {"offset_pa", "scale_u"}) {
        const auto list = section.value(key, ScaleJson());
        if (!list.is_array() || list.size() != scales.size())
            return wrongValue(std::string("sensor.taxels.") + key, list, "as many values as scale has");
    }
    for (std::size_t i = 0; i < scales.size(); ++i) {
        auto line = lineFrom(scales[i], section["offset_pa"][i], section["scale_u"][i], "sensor.taxels");
        if (!line) return failure(line);
        into.taxels.push_back(*line);
    }
    return {};
}

ScaleJson knownOrNull(const std::optional<double>& value) { return value ? ScaleJson(*value) : ScaleJson(); }

}  // namespace

double RoughnessUncertainty::expanded(double R) const noexcept {
    const auto smooth = static_cast<double>(smoothSlides), rough = static_cast<double>(roughSlides);
    return coverage * slideSd * std::sqrt(1 + (1 - R) * (1 - R) / smooth + R * R / rough);
}

FingertipMatch matchOf(const SensorScales& scales, std::string_view serial) noexcept {
    if (scales.fingertip.empty() || serial.empty()) return FingertipMatch::NotNamed;
    return scales.fingertip == serial ? FingertipMatch::Same : FingertipMatch::Another;
}

Result<SensorScales> sensorScalesFromJson(const ScaleJson& section) {
    if (const auto known = onlyKeys(section, {"serial", "force", "taxels"}, "roughness.sensor"); !known)
        return failure(known);
    SensorScales out;
    const auto serial = section.value("serial", ScaleJson(""));
    if (!serial.is_string()) return wrongValue("sensor.serial", serial, "a text");
    out.fingertip = serial.get<std::string>();
    if (section.contains("force")) {
        if (const auto read = readForce(section["force"], out); !read) return failure(read);
    }
    if (section.contains("taxels")) {
        if (const auto read = readTaxels(section["taxels"], out); !read) return failure(read);
    }
    return out;
}

ScaleJson toJson(const SensorScales& scales) {
    ScaleJson out{{"serial", scales.fingertip}};
    if (scales.force) {
        out["force"] = {{"unit", symbolOf(scales.forceUnit)},
                        {"scale", scales.force->scale},
                        {"offset_n", scales.force->offset},
                        {"scale_u", knownOrNull(scales.force->scaleU)}};
    }
    if (scales.taxels.empty()) return out;
    auto& taxels = out["taxels"];
    taxels["unit"] = symbolOf(scales.taxelUnit);
    for (const auto& line : scales.taxels) {
        taxels["scale"].push_back(line.scale);
        taxels["offset_pa"].push_back(line.offset);
        taxels["scale_u"].push_back(knownOrNull(line.scaleU));
    }
    return out;
}

Result<RoughnessUncertainty> roughnessUncertaintyFromJson(const ScaleJson& section) {
    constexpr const char* kWhere = "roughness.uncertainty";
    if (const auto known = onlyKeys(section, {"slide_sd", "smooth_slides", "rough_slides", "coverage_factor"}, kWhere);
        !known)
        return failure(known);
    RoughnessUncertainty out;
    for (const auto& [key, target] :
         {std::pair("slide_sd", &out.slideSd), std::pair("coverage_factor", &out.coverage)}) {
        const auto value = section.value(key, ScaleJson());
        const auto number = finiteIn(value, std::string("uncertainty.") + key);
        if (!number) return failure(number);
        if (!(*number >= 0)) return wrongValue(std::string("uncertainty.") + key, value, "0 or more");
        *target = *number;
    }
    for (const auto& [key, target] :
         {std::pair("smooth_slides", &out.smoothSlides), std::pair("rough_slides", &out.roughSlides)}) {
        const auto value = section.value(key, ScaleJson());
        // A script hands on every number as a double.
        const double number = value.is_number() ? value.get<double>() : 0;
        if (!(number >= 1 && number <= 100'000) || number != std::floor(number))
            return wrongValue(std::string("uncertainty.") + key, value, "a whole number from 1 to 100000");
        *target = static_cast<std::size_t>(number);
    }
    return out;
}

ScaleJson toJson(const RoughnessUncertainty& uncertainty) {
    return {{"slide_sd", uncertainty.slideSd},
            {"smooth_slides", uncertainty.smoothSlides},
            {"rough_slides", uncertainty.roughSlides},
            {"coverage_factor", uncertainty.coverage}};
}

}  // namespace tacto
