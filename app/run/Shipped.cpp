#include "app/run/Shipped.h"

#include <algorithm>
#include <filesystem>

#include "app/scripting/ShippedResources.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {

bool overlap(const LimitRow& a, const LimitRow& b) noexcept {
    return (a.upToHz == 0 || b.aboveHz < a.upToHz) && (b.upToHz == 0 || a.aboveHz < b.upToHz);
}

/// A looser row would have no effect, because the built-in rows still apply, but it would promise something untrue.
Result<void> tightens(const LimitSet& added, const std::vector<LimitSet>& shipped, const std::string& file) {
    for (const auto& row : added.rows) {
        if (row.action != LimitAction::Refuse) continue;
        for (const auto& set : shipped) {
            for (const auto& known : set.rows) {
                if (known.action != LimitAction::Refuse || known.quantity != row.quantity ||
                    known.judged != row.judged || !overlap(known, row) || row.max <= known.max) {
                    continue;
                }
                return fail(ErrorCode::ParseError,
                            "{}: {} allows {} of {:g} {} where the built-in set {} allows {:g}; a set beside the "
                            "built-in ones can only tighten them",
                            file, added.id, keyOf(row.quantity), row.max, unitOf(row.quantity), set.id, known.max);
            }
        }
    }
    return {};
}

Result<std::vector<std::filesystem::path>> limitFiles() {
    std::vector<std::filesystem::path> files;
    const auto resources = resourcesFolder();
    if (!resources) return files;  // built-in files need no folder
    std::error_code error;
    if (!std::filesystem::exists(*resources / "limits", error)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(*resources / "limits", error)) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    if (error) return fail(ErrorCode::Io, "{} cannot be read: {}", (*resources / "limits").string(), error.message());
    std::ranges::sort(files);
    return files;
}

}  // namespace

Result<Profile> shippedProfile() { return parseProfile(shippedProfileText(), "the built-in profile"); }

Result<ShippedLimits> shippedLimits() {
    ShippedLimits limits;
    for (const auto& built : shippedLimitTexts()) {
        auto set = parseLimitSet(built.text, built.file);
        if (!set) return failure(set);
        limits.sets.push_back(std::move(*set));
        limits.sha256.push_back(sha256Hex(built.text));
        limits.from.emplace_back();
    }
    const auto shipped = limits.sets;
    const auto digests = limits.sha256;
    const auto files = limitFiles();
    if (!files) return failure(files);
    for (const auto& file : *files) {
        const auto text = readTextFile(file, JsonLimits{}.bytes);
        if (!text) return failure(text);
        const auto digest = sha256Hex(*text);
        if (std::ranges::find(digests, digest) != digests.end()) continue;
        auto set = parseLimitSet(*text, file.string());
        if (!set) return failure(set);
        if (std::ranges::any_of(limits.sets, [&](const LimitSet& one) { return one.id == set->id; })) {
            return fail(ErrorCode::ParseError,
                        "{}: it differs from the limit set {} that is in force already, and cannot replace it; a set "
                        "of another id, which can only tighten, is expected",
                        file.string(), set->id);
        }
        if (auto tighter = tightens(*set, shipped, file.string()); !tighter) return failure(tighter);
        limits.sets.push_back(std::move(*set));
        limits.sha256.push_back(digest);
        limits.from.push_back(file.string());
    }
    return limits;
}

Result<std::vector<InstrumentProfile>> shippedInstruments() {
    std::vector<InstrumentProfile> profiles;
    for (const auto& built : shippedInstrumentTexts()) {
        auto profile = parseInstrumentProfile(built.text, built.file);
        if (!profile) return failure(profile);
        profiles.push_back(std::move(*profile));
    }
    return profiles;
}

std::string addedLimitsText(const ShippedLimits& limits) {
    std::string added;
    for (std::size_t i = 0; i < limits.sets.size(); ++i) {
        if (limits.from[i].empty()) continue;
        added += fmt::format("{}{} ({})", added.empty() ? "" : ", ", limits.sets[i].id, limits.from[i]);
    }
    return added.empty() ? added : fmt::format("Limit sets in force beside the built-in ones: {}.", added);
}

}  // namespace tacto
