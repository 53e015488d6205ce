#include "core/bench/Profile.h"

#include "core/base/Csv.h"
#include "core/base/RecordFields.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr AcceptedNumbers aboveZero(std::string_view unit = {}) { return {.low = 0, .openLow = true, .unit = unit}; }

/// Reads ceilings such as {"peak_current": 20}; any quantity may be a key.
ValueKind<Ceilings> ceilingsKind() {
    ValueKind<Ceilings> kind;
    kind.reads([](const json& value, Ceilings& into, const RecordPlace& place, std::string_view key) -> Result<void> {
        const auto inside = place.in(key);
        std::vector<std::string_view> known;
        for (std::size_t i = 0; i < kQuantityCount; ++i) known.push_back(keyOf(static_cast<Quantity>(i)));
        if (auto sound = onlyKeys(value, known, inside.text()); !sound) return sound;
        into.clear();
        for (const auto& [quantity, max] : value.items()) {
            const auto number = readNumber(max, aboveZero(), inside, quantity);
            if (!number) return failure(number);
            into.push_back({*quantityOf(quantity), *number});
        }
        return {};
    });
    kind.writes([](const Ceilings& ceilings) {
        json out = json::object();
        for (const auto& ceiling : ceilings) out[std::string(keyOf(ceiling.quantity))] = ceiling.max;
        return out;
    });
    return kind;
}

RecordFields<Profile> safetyFields() {
    RecordFields<Profile> all;
    all.number("load_low_ohm", &Profile::loadLow, aboveZero("Ω"));
    all.number("load_high_ohm", &Profile::loadHigh, aboveZero("Ω"));
    all.number("electrode_area_cm2", &Profile::electrodeArea, aboveZero("cm²"));
    all.add("ceilings", &Profile::ceilings, ceilingsKind());
    all.rule([](const Profile& profile) -> Result<void> {
        if (profile.loadLow < profile.loadHigh) return {};
        return invalid("load_low_ohm {} must be below load_high_ohm {}", profile.loadLow.value(),
                       profile.loadHigh.value());
    });
    return all;
}

RecordFields<ElectrodeDescription> electrodeFields() {
    using E = ElectrodeDescription;
    RecordFields<E> all;
    all.texts({{"name", &E::name}, {"material", &E::material}, {"medium", &E::medium}}, {.mayBeEmpty = true});
    return all;
}

RecordFields<Profile> buildProfileFields() {
    RecordFields<Profile> all;
    all.text("name", &Profile::name, {.mayBeEmpty = true});
    all.record("roughness", &Profile::roughness, roughnessFields());
    all.record("encoding", &Profile::encoding, encodingFields());
    all.record("safety", std::identity{}, safetyFields());
    all.record("electrode", &Profile::electrode, electrodeFields()).leftOutIfEmpty = true;
    return all;
}

}  // namespace

const RecordFields<Profile>& profileFields() { return builtOnce<buildProfileFields>(); }

Result<Profile> parseProfile(std::string_view text, std::string_view source) {
    const auto document = parseJson(text, source);
    if (!document) return failure(document);
    return profileFields().read(*document, {.file = std::string(source)});
}

Result<Profile> loadProfile(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseProfile(*text, path.string());
}

json toJson(const Profile& profile) { return profileFields().write(profile); }

}  // namespace tacto
