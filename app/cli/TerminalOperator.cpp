#include "app/cli/TerminalOperator.h"

#include "app/cli/Confirmation.h"
#include "core/safety/Interlock.h"

namespace tacto::cli {

namespace {

/// For what is done by hand, as fitting a load.
constexpr Seconds kQuestionTimeout{3600};

}  // namespace

TerminalOperator::TerminalOperator(std::map<std::string, std::string> answers, const SignalStop& interrupts,
                                   std::function<void()> beforeAsking)
    : answers_(std::move(answers)),
      preset_(answers_),
      interrupts_(interrupts),
      beforeAsking_(std::move(beforeAsking)) {}

Result<nlohmann::json> TerminalOperator::ask(const OperatorQuestion& question) {
    asked_.insert(question.name);
    const bool isConfirmation = question.kind == OperatorQuestion::Kind::Confirm;
    if (!isConfirmation || answers_.contains(question.name) || !canAsk()) return preset_.ask(question);
    if (beforeAsking_) beforeAsking_();
    const bool arms = !question.confirms.empty();
    const Seconds within = arms ? Interlock::kConfirmWithin : kQuestionTimeout;
    const auto prompt = fmt::format("{}\nType \"{}\" within {:g} s; anything else {}: ", question.text, question.word,
                                    within.count(), arms ? "delivers nothing" : "ends the run");
    switch (askFor(question.word, prompt, within, interrupts_)) {
        case Answer::Confirmed:
            return nlohmann::json(true);
        case Answer::Otherwise:
            return fail(ErrorCode::Stopped, "\"{}\" was not confirmed", question.text);
        case Answer::TooLate:
            return fail(ErrorCode::Stopped, "\"{}\" was not confirmed in time", question.text);
        case Answer::Signalled:
            break;
    }
    return fail(ErrorCode::Stopped, "stopped by the operator (signal)");
}

std::vector<std::string> TerminalOperator::unasked() const {
    std::vector<std::string> names;
    for (const auto& [name, answer] : answers_)
        if (!asked_.contains(name)) names.push_back(name);
    return names;
}

}  // namespace tacto::cli
