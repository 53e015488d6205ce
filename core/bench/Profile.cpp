#include "core/bench/Profile.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace {

using nlohmann::json;

Result<double> positive(const json& value, std::string_view key) {
    if (!value.is_number() || !(value.get<double>() > 0) || !std::isfinite(value.get<double>())) {
        return fail(ErrorCode::InvalidArgument, "safety.{} is {}; a number above 0 is expected", key, shownJson(value));
    }
    return value.get<double>();
}

Result<Ceilings> readCeilings(const json& section) {
    if (!section.is_object()) {
        return fail(ErrorCode::ParseError, "safety.ceilings is {}; {{\"quantity\": maximum}} is expected",
                    shownJson(section));
    }
    Ceilings ceilings;
    for (const auto& [key, value] : section.items()) {
        const auto quantity = quantityOf(key);
        if (!quantity) {
            return fail(ErrorCode::ParseError,
                        "safety.ceilings has \"{}\", which is no quantity; for example peak_current, rms_current_5s",
                        key);
        }
        const auto max = positive(value, "ceilings." + key);
        if (!max) return failure(max);
        ceilings.push_back({*quantity, *max});
    }
    return ceilings;
}

Result<void> readSafety(const json& section, Profile& profile) {
    if (auto known = onlyKeys(section, {"load_low_ohm", "load_high_ohm", "electrode_area_cm2", "ceilings"}, "safety");
        !known) {
        return known;
    }
    for (const auto& [key, value] : section.items()) {
        if (key == "ceilings") {
            auto ceilings = readCeilings(value);
            if (!ceilings) return failure(ceilings);
            profile.ceilings = std::move(*ceilings);
            continue;
        }
        if (key == "electrode_area_cm2" && value.is_null()) continue;
        const auto number = positive(value, key);
        if (!number) return failure(number);
        if (key == "load_low_ohm") profile.loadLow = Ohms(*number);
        if (key == "load_high_ohm") profile.loadHigh = Ohms(*number);
        if (key == "electrode_area_cm2") profile.electrodeArea = SquareCentimetres(*number);
    }
    if (!(profile.loadLow < profile.loadHigh)) {
        return fail(ErrorCode::InvalidArgument, "safety.load_low_ohm {} must be below load_high_ohm {}",
                    profile.loadLow.value(), profile.loadHigh.value());
    }
    return {};
}

}  // namespace

Result<Profile> parseProfile(std::string_view text, std::string_view source) {
    const auto read = parseJson(text, source);
    if (!read) return failure(read);
    const json& document = *read;
    if (auto known = onlyKeys(document, {"name", "roughness", "encoding", "safety"}, source); !known) {
        return failure(known);
    }
    const auto within = [&](const auto& failed) {
        return fail(failed.error().code, "{}: {}", source, failed.error().message);
    };
    Profile profile;
    for (const auto& [key, value] : document.items()) {
        if (key == "name") {
            if (!value.is_string()) {
                return fail(ErrorCode::ParseError, "{}: name is {}; a text is expected", source, shownJson(value));
            }
            profile.name = value.get<std::string>();
        } else if (key == "roughness") {
            auto roughness = roughnessSettingsFromJson(value);
            if (!roughness) return within(roughness);
            profile.roughness = std::move(*roughness);
        } else if (key == "encoding") {
            auto encoding = encodingProfileFrom(value);
            if (!encoding) return within(encoding);
            profile.encoding = std::move(*encoding);
        } else if (key == "safety") {
            if (const auto safety = readSafety(value, profile); !safety) return within(safety);
        }
    }
    return profile;
}

Result<Profile> loadProfile(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseProfile(*text, path.string());
}

json toJson(const Profile& profile) {
    json ceilings = json::object();
    for (const auto& ceiling : profile.ceilings) ceilings[std::string(keyOf(ceiling.quantity))] = ceiling.max;
    return {{"name", profile.name},
            {"roughness", toJson(profile.roughness)},
            {"encoding", toJson(profile.encoding)},
            {"safety",
             {{"load_low_ohm", profile.loadLow.value()},
              {"load_high_ohm", profile.loadHigh.value()},
              {"electrode_area_cm2", profile.electrodeArea ? json(profile.electrodeArea->value()) : json(nullptr)},
              {"ceilings", ceilings}}}};
}

}  // namespace tacto
