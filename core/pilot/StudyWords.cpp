#include "core/pilot/StudyWords.h"

#include <algorithm>
#include <fmt/ranges.h>

#include "core/base/ResourcesFolder.h"
#include "core/study/Gates.h"

namespace tacto {

Result<std::vector<ParticipantWords>> languagesOf(const std::filesystem::path& study) {
    std::vector<ParticipantWords> all;
    const auto add = [&all](const std::vector<ParticipantWords>& more) {
        for (const auto& each : more) {
            if (std::ranges::find(all, each.code(), &ParticipantWords::code) == all.end()) all.push_back(each);
        }
    };
    std::vector<std::filesystem::path> folders;
    if (!study.empty()) folders.push_back(study / "words");
    if (const auto resources = resourcesFolder()) folders.push_back(*resources / "words");
    for (const auto& folder : folders) {
        const auto found = ParticipantWords::in(folder);
        if (!found) return failure(found);
        add(*found);
    }
    add(ParticipantWords::builtIn());
    std::ranges::stable_sort(all, {}, [](const ParticipantWords& each) { return each.code() != "en"; });
    return all;
}

Result<ParticipantWords> languageOf(const std::filesystem::path& study, std::string_view code) {
    const auto all = languagesOf(study);
    if (!all) return failure(all);
    const auto found = std::ranges::find(*all, code, &ParticipantWords::code);
    if (found != all->end()) return *found;
    std::vector<std::string> codes;
    for (const auto& each : *all) codes.push_back(each.code());
    return fail(ErrorCode::NotFound, "the language is \"{}\"; {} is expected, or a file words/{}.json", code,
                fmt::join(codes, ", "), code);
}

Result<void> wordsGate(const StudySettings& settings, const ParticipantWords& words) {
    if (settings.words.empty() ||
        std::ranges::find(settings.words, words.sha256(), &WordsHash::sha256) != settings.words.end())
        return {};
    std::vector<std::string> approved;
    for (const auto& each : settings.words) approved.push_back(nameOf(each));
    return fail(kGateRefused, "the participant would read {}, which the approval does not state; it states {}",
                words.name(), fmt::join(approved, ", "));
}

}  // namespace tacto
