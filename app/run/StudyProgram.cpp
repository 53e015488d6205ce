#include "app/run/StudyProgram.h"

#include <fmt/ranges.h>

#include "app/run/Shipped.h"
#include "app/scripting/ShippedResources.h"
#include "core/base/JsonText.h"
#include "core/pilot/StudyWords.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {
constexpr std::string_view kPilotScripts = "pilot-";
}

void fitProfile(Profile& profile, const StudySettings& study) {
    profile.electrodeArea = study.electrode.area;
    profile.electrode.reset();  // the study's settings and particulars describe its own
    auto& train = profile.encoding.train;
    // Monophasic trains are refused on a person, and so is every other shape that a study may name.
    train.shape = study.train.shape == kBiphasic ? PulseShape::SymmetricBiphasic : PulseShape::Monophasic;
    train.phaseWidth = Micros(study.train.width_us);
    train.interPhaseGap = Micros(study.train.gap_us);
    train.pulses = study.train.pulses;
    if (study.train.rate_hz > 0) train.rate = Hertz(study.train.rate_hz);
}

/// Conditions are stored as hashes, because a study must not contain their names in plain text.
StudyProcedure procedureOf(const Profile& profile, const StudySettings& study, const AskedProcedure& asked) {
    auto fitted = profile;
    fitProfile(fitted, study);
    const auto all = toJson(fitted);
    const auto& encoding = all.at("encoding");
    const nlohmann::json hashed = {{"conditions", encoding.at("conditions")},
                                   {"assignment", encoding.at("assignment")},
                                   {"polarity", encoding.at("polarity")},
                                   {"rate_hz", encoding.at("rate_hz")},
                                   {"safety", all.at("safety")}};
    return {profile.encoding.intervalMin.count(), profile.encoding.intervalMax.count(), asked.method,
            sha256Hex(dumpJson(hashed)), asked.comparison};
}

Result<void> stateProgram(StudySettings& settings, const Profile& profile, const std::filesystem::path& folder) {
    const auto limits = shippedLimits();
    if (!limits) return failure(limits);
    settings.limits.clear();
    for (std::size_t i = 0; i < limits->sets.size(); ++i)
        settings.limits.push_back({limits->sets[i].id, limits->sha256[i]});
    settings.scripts.clear();
    for (const auto& script : shippedProtocols()) {
        if (script.name.starts_with(kPilotScripts))
            settings.scripts.push_back({std::string(script.name), std::string(script.sha256)});
    }
    const auto words = languagesOf(folder);
    if (!words) return failure(words);
    settings.words.clear();
    for (const auto& each : *words) settings.words.push_back({each.code(), each.version(), each.sha256()});
    if (profile.encoding.assignment == Assignment::Swapped && settings.encodings.size() > 1)
        return invalid(
            "encodings are {}, and the profile's assignment is swapped already, so that both would be the "
            "same; one of them is accepted",
            fmt::join(settings.encodings, " and "));
    auto fitted = profile;
    fitProfile(fitted, settings);
    if (auto possible = validate(fitted.encoding); !possible) return possible;  // a session would be refused
    const auto asked = settings.procedure.value_or(StudyProcedure());
    settings.procedure = procedureOf(profile, settings, {asked.method, asked.comparison});
    return {};
}

}  // namespace tacto
