// Any text as a profile or other JSON file is read with the same result as the library's, or refused with a sentence
// (H10): never nested too deep, never with a repeated key.
#include <cstdint>
#include <string_view>

#include "core/base/JsonText.h"
#include "core/bench/Profile.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::JsonTextFuzz {

namespace {

using nlohmann::json;

int depthOf(const json& value) {
    int deepest = 0;
    if (!value.is_structured()) return 0;
    for (const auto& member : value) deepest = std::max(deepest, depthOf(member));
    return deepest + 1;
}

}  // namespace

TACTO_FUZZ(JsonTextFuzz, const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const tacto::JsonLimits limits{.bytes = 30'000, .depth = 8};
    const auto parsed = tacto::parseJson(text, "fuzz.json", limits);
    if (parsed) {
        require(size <= limits.bytes && depthOf(*parsed) <= limits.depth);
        require(*parsed == json::parse(text, nullptr, false));
        const auto again = tacto::parseJson(parsed->dump(), "fuzz.json", limits);
        require(parsed->dump().size() > limits.bytes || (again && *again == *parsed));
    } else {
        require(parsed.error().code == tacto::ErrorCode::ParseError);
        require(parsed.error().message.starts_with("fuzz.json: "));
    }
    const auto profile = tacto::parseProfile(text, "fuzz.json");
    if (!profile) {
        require(!profile.error().message.empty());
        return 0;
    }
    const auto again =
        tacto::parseProfile(tacto::toJson(*profile).dump(-1, ' ', true, json::error_handler_t::replace), "again.json");
    require(again && tacto::toJson(*again) == tacto::toJson(*profile));
    return 0;
}

}  // namespace tacto::fuzz::JsonTextFuzz
