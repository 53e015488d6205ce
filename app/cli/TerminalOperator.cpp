#include "app/cli/TerminalOperator.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <poll.h>
#include <string>
#include <termios.h>
#include <thread>
#include <unistd.h>

#include "app/cli/Say.h"
#include "core/base/LocaleFreeText.h"
#include "core/safety/Interlock.h"

namespace tacto::cli {

namespace {

/// Long enough for manual work, such as fitting a load.
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

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kAnswerPoll{50};
constexpr milliseconds kUnderWay{500};
constexpr std::size_t kMaxLine = 256;

/// Discards what was typed before the question, because only later text is an answer. On a busy machine the kernel may
/// deliver earlier text for 100 ms, and a flush does not reach it there. Returns false after a signal.
bool forgetWhatWasTyped(const SignalStop& interrupts) {
    for (const auto end = steady_clock::now() + kUnderWay; steady_clock::now() < end;) {
        if (interrupts.signalled()) return false;
        std::this_thread::sleep_for(kAnswerPoll);
    }
    static_cast<void>(tcflush(STDIN_FILENO, TCIFLUSH));
    return true;
}

}  // namespace

bool canAsk() { return isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0; }

Answer askFor(std::string_view word, std::string_view prompt, Seconds within, const SignalStop& interrupts) {
    if (!forgetWhatWasTyped(interrupts)) return Answer::Signalled;
    const auto deadline = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(within);
    say(stderr, "{}", lines(prompt));
    std::fflush(stderr);
    std::string line;
    while (!interrupts.signalled()) {
        if (steady_clock::now() >= deadline) return Answer::TooLate;
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (poll(&input, 1, static_cast<int>(kAnswerPoll.count())) <= 0) continue;
        std::array<char, kMaxLine> chunk{};
        const auto got = read(STDIN_FILENO, chunk.data(), chunk.size());
        if (got <= 0 || line.size() > kMaxLine) return interrupts.signalled() ? Answer::Signalled : Answer::Otherwise;
        line.append(chunk.data(), static_cast<std::size_t>(got));
        if (const auto end = line.find('\n'); end != std::string::npos) {
            if (interrupts.signalled()) break;
            return trimmed(std::string_view(line).substr(0, end)) == word ? Answer::Confirmed : Answer::Otherwise;
        }
    }
    return Answer::Signalled;
}

}  // namespace tacto::cli
