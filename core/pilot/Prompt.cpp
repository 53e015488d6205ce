#include "core/pilot/Prompt.h"

#include <utility>

#include "core/analysis/identification/IdentificationText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Words.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

constexpr Word<PromptTo> kPromptTo[] = {
    {"participant", PromptTo::Participant}, {"operator", PromptTo::Operator}, {"both", PromptTo::Both}};

constexpr Word<PromptKind> kPromptKinds[] = {{"hold", PromptKind::Hold},         {"strength", PromptKind::Strength},
                                             {"interval", PromptKind::Interval}, {"condition", PromptKind::Condition},
                                             {"yes-no", PromptKind::YesNo},      {"go-on", PromptKind::GoOn},
                                             {"choice", PromptKind::Choice},     {"several", PromptKind::Several},
                                             {"scale", PromptKind::Scale},       {"text", PromptKind::Text}};

PilotPrompt prompt(PromptKind kind, std::string name, std::string text, std::vector<PromptTarget> targets,
                   PromptTo to = PromptTo::Participant) {
    PilotPrompt made;
    made.to = to;
    made.kind = kind;
    made.name = std::move(name);
    made.text = std::move(text);
    made.targets = std::move(targets);
    return made;
}

/// Returns the words with a capital first letter, as buttons show them.
std::string capitalised(std::string words) {
    if (!words.empty()) words.front() = capital(words.front());
    return words;
}

}  // namespace

std::string_view nameOf(PromptTo to) noexcept { return wordFor<PromptTo>(kPromptTo, to); }
std::string_view nameOf(PromptKind kind) noexcept { return wordFor<PromptKind>(kPromptKinds, kind); }

std::string conditionWords(std::string_view key, const ParticipantWords& words) {
    return words.text("condition", key, answerWords(key));
}

PilotPrompt holdPrompt(const ParticipantWords& words) {
    return prompt(PromptKind::Hold, "hold", words.text("hold.text"), {});
}

PilotPrompt seriesPrompt(std::size_t series, std::size_t of, const ParticipantWords& words) {
    auto made = holdPrompt();
    made.text = words.text("hold.series", {{"series", fmt::format("{}", series)}, {"of", fmt::format("{}", of)}});
    return made;
}

PilotPrompt strengthPrompt(const ParticipantWords& words) {
    auto made = prompt(PromptKind::Strength, "strength", words.text("strength.question"), {});
    for (const char* key : {"nothing", "weak", "strong", row::kTooStrong})
        made.targets.push_back({key, words.text("strength", key, key)});
    return made;
}

PilotPrompt meantPrompt(const ParticipantWords& words) {
    auto made = yesNoPrompt("meant", words.text("meant.question"));
    made.targets = {{"yes", words.text("meant.yes")}, {"no", words.text("meant.no")}};
    return made;
}

PilotPrompt intervalPrompt(const ParticipantWords& words) {
    return prompt(PromptKind::Interval, "interval", words.text("interval.question"),
                  {{"first", words.text("interval.first")}, {"second", words.text("interval.second")}});
}

PilotPrompt comparisonPrompt(const ParticipantWords& words) {
    auto made = intervalPrompt(words);
    made.name = "comparison";
    made.text = words.text("comparison.question");
    return made;
}

std::vector<std::string> answersIn(std::size_t way) {
    std::vector<std::string> answers;
    for (std::size_t place = 0; place < kAnswerPlaces.size(); ++place) {
        std::size_t row = place / 2, column = place % 2;
        if ((way & 4) != 0) std::swap(row, column);
        if ((way & 2) != 0) row = 1 - row;
        if ((way & 1) != 0) column = 1 - column;
        answers.emplace_back(kAnswerPlaces[2 * row + column]);
    }
    return answers;
}

PilotPrompt conditionPrompt(const std::vector<std::string>& names, const ParticipantWords& words) {
    std::vector<PromptTarget> targets;
    std::vector<std::string> answers = names;
    answers.insert(answers.end(), {std::string(kNoneResponse), std::string(kNotSureResponse)});
    for (const auto& key : answers) targets.push_back({key, capitalised(conditionWords(key, words))});
    return prompt(PromptKind::Condition, "identification", words.text("condition.question"), std::move(targets));
}

PilotPrompt yesNoPrompt(std::string name, std::string text, PromptTo to, const ParticipantWords& words) {
    return prompt(PromptKind::YesNo, std::move(name), std::move(text),
                  {{"yes", words.text("answer.yes")}, {"no", words.text("answer.no")}}, to);
}

PilotPrompt goOnPrompt(std::string text, PromptTo to, const ParticipantWords& words) {
    return prompt(PromptKind::GoOn, "go-on", std::move(text), {{"go-on", words.text("answer.go-on")}}, to);
}

PilotPrompt scalePrompt(std::string name, std::string text, int least, int most, PromptTo to) {
    auto made = prompt(PromptKind::Scale, std::move(name), std::move(text), {}, to);
    made.least = least;
    made.most = most;
    return made;
}

PilotPrompt choicePrompt(std::string name, std::string text, std::vector<PromptTarget> targets, PromptTo to) {
    return prompt(PromptKind::Choice, std::move(name), std::move(text), std::move(targets), to);
}

}  // namespace tacto
