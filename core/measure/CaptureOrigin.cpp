#include "core/measure/CaptureOrigin.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "core/base/WholeFile.h"
#include "core/measure/CaptureDescription.h"

namespace tacto {

namespace {

constexpr const char* kFile = "origin.json";
constexpr std::size_t kMaxBytes = 4096;
constexpr std::size_t kMaxHeader = 16'384;

std::optional<bool> readOrigin(const std::filesystem::path& folder) {
    std::ifstream stream(folder / kFile, std::ios::binary);
    std::string text(kMaxBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    const auto origin = parseJson(text, kFile, {.bytes = kMaxBytes, .depth = 1});
    if (!origin || !origin->is_object()) return std::nullopt;
    const auto said = origin->find("simulated");
    return said != origin->end() && said->is_boolean() ? std::optional(said->get<bool>()) : std::nullopt;
}

}  // namespace

Result<void> stateCaptureOrigin(const std::filesystem::path& folder, bool simulated) {
    const auto said = readOrigin(folder);
    if (said && (*said || *said == simulated)) return {};
    const auto file = folder / kFile;
    return namedAs(file, writeWholeFile(file, dumpJson(nlohmann::json{{"simulated", simulated}}) + "\n"));
}

std::optional<bool> statedSimulated(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(kMaxHeader, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    const auto header = headerIn(text);
    const auto folder = readOrigin(file.parent_path());
    // Either may say that it is simulated. That it is not, neither says against the other; an origin.json that cannot
    // be read is a doubt.
    if ((header && header->simulated) || folder == true) return true;
    std::error_code ignored;
    const bool unreadable = !folder && std::filesystem::exists(file.parent_path() / kFile, ignored);
    if (unreadable) return std::nullopt;
    return header ? std::optional(false) : folder;
}

}  // namespace tacto
