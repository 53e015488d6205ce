#include <algorithm>

#include "app/scripting/engine/Operator.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/TypedNumber.h"
#include "core/base/ValueKind.h"

namespace tacto {

namespace {

/// Returns the answer that can be given in advance, as the operator types it.
std::string presetFor(const OperatorQuestion& question) {
    return question.confirms.empty() ? fmt::format("--set {}=...", question.name)
                                     : fmt::format("--set {}=\"{}\"", question.name, question.confirms);
}

Result<nlohmann::json> confirmText(const OperatorQuestion& question, const std::string& answer) {
    for (const auto given : split(answer, '\n')) {
        if (trimmed(given) == question.confirms) return nlohmann::json(true);
    }
    return fail(ErrorCode::NotArmed,
                "{}=\"{}\" does not confirm \"{}\". Nothing was delivered. Where that is what is wanted, give {}",
                question.name, fmt::join(split(answer, '\n'), "\", \""), question.confirms, presetFor(question));
}

Result<nlohmann::json> confirm(const OperatorQuestion& question, const std::string& answer) {
    if (!question.confirms.empty()) return confirmText(question, answer);
    if (answer == "yes" || answer == "true" || answer == "1") return nlohmann::json(true);
    if (answer == "no" || answer == "false" || answer == "0") {
        return fail(ErrorCode::Stopped, "\"{}\" was answered with {}", question.text, answer);
    }
    return fail(ErrorCode::InvalidArgument, "{}={} does not answer \"{}\"; yes or no is expected", question.name,
                answer, question.text);
}

Result<nlohmann::json> choose(const OperatorQuestion& question, const std::string& answer) {
    std::vector<std::string> keys;
    for (const auto& [key, text] : question.choices) keys.push_back(key);
    if (std::find(keys.begin(), keys.end(), answer) != keys.end()) return nlohmann::json(answer);
    return fail(ErrorCode::InvalidArgument, "{}={} does not answer \"{}\"; one of {} is expected", question.name,
                answer, question.text, fmt::join(keys, ", "));
}

Result<nlohmann::json> enter(const OperatorQuestion& question, const std::string& answer) {
    if (!question.number) return nlohmann::json(answer);
    const auto value = typedNumber(answer);
    const AcceptedNumbers numbers{.low = question.min.value_or(AcceptedNumbers{}.low),
                                  .high = question.max.value_or(AcceptedNumbers{}.high),
                                  .unit = question.unit};
    if (value && numbers.contain(*value)) return nlohmann::json(*value);
    return fail(ErrorCode::InvalidArgument, "{}={} does not answer \"{}\"; {} is expected{}", question.name, answer,
                question.text, numbers.text(), typedTrouble(answer));
}

}  // namespace

Result<nlohmann::json> PresetOperator::ask(const OperatorQuestion& question) {
    const auto answer = answers_.find(question.name);
    if (answer == answers_.end()) {
        return fail(ErrorCode::NotFound, "\"{}\" needs an answer, and this run has no operator to ask: give {}",
                    question.text, presetFor(question));
    }
    switch (question.kind) {
        case OperatorQuestion::Kind::Confirm:
            return confirm(question, answer->second);
        case OperatorQuestion::Kind::Choose:
            return choose(question, answer->second);
        case OperatorQuestion::Kind::Enter:
            return enter(question, answer->second);
    }
    return fail(ErrorCode::InvalidArgument, "\"{}\" is not a kind of question", question.name);
}

}  // namespace tacto
