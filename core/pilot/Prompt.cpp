#include "core/pilot/Prompt.h"

#include <utility>

#include "core/analysis/identification/IdentificationText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Words.h"

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

PilotPrompt holdPrompt() {
    return prompt(PromptKind::Hold, "hold", "Hold the key while the level rises. Letting go stops at once.", {});
}

PilotPrompt seriesPrompt(std::size_t series, std::size_t of) {
    auto made = holdPrompt();
    made.text = fmt::format("Series {} of {} starts from zero. {}", series, of, made.text);
    return made;
}

PilotPrompt strengthPrompt() {
    return prompt(PromptKind::Strength, "strength", "What did you feel?",
                  {{"nothing", "Nothing"}, {"weak", "Weak"}, {"strong", "Strong"}, {"too-strong", "Too strong"}});
}

PilotPrompt meantPrompt() {
    auto made = yesNoPrompt("meant", "You said “too strong”. The output is off. Was it too strong?");
    made.targets = {{"yes", "Yes, too strong"}, {"no", "No, a slip"}};
    return made;
}

PilotPrompt intervalPrompt() {
    return prompt(PromptKind::Interval, "interval", "Was it in the first or in the second interval? Guess if unsure.",
                  {{"first", "First"}, {"second", "Second"}});
}

PilotPrompt comparisonPrompt() {
    auto made = intervalPrompt();
    made.name = "comparison";
    made.text = "Was it stronger in the first or in the second interval? Guess if unsure.";
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

PilotPrompt conditionPrompt(const std::vector<std::string>& names) {
    std::vector<PromptTarget> targets;
    std::vector<std::string> answers = names;
    answers.insert(answers.end(), {std::string(kNoneResponse), std::string(kNotSureResponse)});
    for (const auto& key : answers) targets.push_back({key, capitalised(answerWords(key))});
    return prompt(PromptKind::Condition, "identification", "What did you feel?", std::move(targets));
}

PilotPrompt yesNoPrompt(std::string name, std::string text, PromptTo to) {
    return prompt(PromptKind::YesNo, std::move(name), std::move(text), {{"yes", "Yes"}, {"no", "No"}}, to);
}

PilotPrompt goOnPrompt(std::string text, PromptTo to) {
    return prompt(PromptKind::GoOn, "go-on", std::move(text), {{"go-on", "Go on"}}, to);
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
