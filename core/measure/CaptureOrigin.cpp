#include "core/measure/CaptureOrigin.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

constexpr const char* kFile = "origin.json";
constexpr std::size_t kMostBytes = 4096;

std::optional<bool> readOrigin(const std::filesystem::path& folder) {
    std::ifstream stream(folder / kFile, std::ios::binary);
    std::string text(kMostBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    const auto json = parseJson(text, kFile, {.bytes = kMostBytes, .depth = 1});
    if (!json || !json->is_object()) return std::nullopt;
    const auto said = json->find("simulated");
    return said != json->end() && said->is_boolean() ? std::optional(said->get<bool>()) : std::nullopt;
}

}  // namespace

Result<void> stateCaptureOrigin(const std::filesystem::path& folder, bool simulated) {
    const auto said = readOrigin(folder);
    if (said && (*said || *said == simulated)) return {};
    std::ofstream stream(folder / kFile, std::ios::binary);
    stream << nlohmann::json{{"simulated", simulated}}.dump() << "\n";
    stream.flush();
    if (!stream) return fail(ErrorCode::Io, "{} could not be written", (folder / kFile).string());
    return {};
}

std::optional<bool> statedSimulated(const std::filesystem::path& file) { return readOrigin(file.parent_path()); }

}  // namespace tacto
