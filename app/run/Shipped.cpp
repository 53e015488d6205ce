#include "app/run/Shipped.h"

#include <algorithm>
#include <filesystem>

#include "app/scripting/ProtocolLibrary.h"
#include "core/base/Csv.h"
#include "core/session/Digest.h"

namespace tacto {

Result<Profile> shippedProfile() {
    const auto resources = resourcesFolder();
    if (!resources) return failure(resources);
    return loadProfile(*resources / "encodings" / "default.json");
}

Result<ShippedLimits> shippedLimits() {
    const auto resources = resourcesFolder();
    if (!resources) return failure(resources);
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(*resources / "limits", error)) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    if (error || files.empty()) {
        return fail(ErrorCode::NotFound, "no limit sets in {}: nothing is delivered without limits",
                    (*resources / "limits").string());
    }
    std::ranges::sort(files);
    ShippedLimits limits;
    for (const auto& file : files) {
        const auto text = readTextFile(file);
        if (!text) return failure(text);
        auto set = parseLimitSet(*text, file.string());
        if (!set) return failure(set);
        limits.sets.push_back(std::move(*set));
        limits.sha256.push_back(sha256Hex(*text));
    }
    return limits;
}

}  // namespace tacto
