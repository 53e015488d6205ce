#include "app/run/VirtualPerson.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"

namespace tacto {

Result<std::optional<std::uint64_t>> virtualSeed(std::string_view participant) {
    if (!participant.starts_with(kVirtualPrefix)) return std::optional<std::uint64_t>();
    if (const auto seed = parseWhole<std::uint64_t>(participant.substr(kVirtualPrefix.size()))) return seed;
    return fail(ErrorCode::NotFound, "the participant is \"{}\"; virtual: and a whole number from 0 is expected",
                participant);
}

Result<std::vector<ExclusionAnswer>> virtualAnswers(const nlohmann::json& parameters, const StudySettings& study) {
    auto answers = nothingExcludes(study);
    const auto yes = textOr(parameters, "exclusions");
    if (yes.empty()) return answers;
    const auto at = std::ranges::find(answers, yes, &ExclusionAnswer::key);
    if (at == answers.end()) {
        std::vector<std::string> keys;
        for (const auto& answer : answers) keys.push_back(answer.key);
        return fail(ErrorCode::InvalidArgument, "exclusions is \"{}\"; one of {} is expected", yes,
                    fmt::join(keys, ", "));
    }
    at->yes = true;
    return answers;
}

Result<VirtualObserver> virtualObserver(const nlohmann::json& parameters, const StudySettings& study,
                                        std::uint64_t seed, LevelUnit unit) {
    PopulationModel model;
    const auto take = [&parameters](double& into, const char* name) {
        if (const double value = numberOr(parameters, name); std::isfinite(value)) into = value;
    };
    take(model.detection_ma.median, "detection");
    take(model.attention_ma.median, "attention");
    take(model.discomfort_ma, "discomfort");
    take(model.intolerance_ma.median, "intolerance");
    take(model.noise_jnd, "noise");
    if (auto sound = validate(model); !sound) return failure(sound);
    VirtualObserverSettings settings;
    settings.who = drawParticipant(model, seed, 0, Micros(study.train.width_us), study.electrode.area);
    settings.seed = seed;
    take(settings.adaptation, "adaptation");
    settings.unit = unit;
    return VirtualObserver::create(settings);
}

}  // namespace tacto
