// TerminalOperator.h - the person at a terminal as a protocol's operator: a question that --set answers is not asked; a
// confirmation is a typed word, where there is a terminal.
//
// Thread-safety: ask() on the script's thread; cancel() any thread.
#pragma once

#include <functional>
#include <set>
#include <string_view>

#include "app/run/SignalStop.h"
#include "app/scripting/engine/Operator.h"
#include "core/base/Units.h"

namespace tacto::cli {

class TerminalOperator final : public Operator {
public:
    /// `interrupts` outlives it: a signal ends a question. `beforeAsking` is called before something is asked, to clear
    /// a progress line; it may be empty.
    TerminalOperator(std::map<std::string, std::string> answers, const SignalStop& interrupts,
                     std::function<void()> beforeAsking);
    TerminalOperator(const TerminalOperator&) = delete;
    TerminalOperator& operator=(const TerminalOperator&) = delete;

    [[nodiscard]] Result<nlohmann::json> ask(const OperatorQuestion& question) override;
    void cancel() noexcept override {}  // the signal that stops a run ends the question too
    /// Names of `answers` that nothing has asked for. Not while the script runs.
    [[nodiscard]] std::vector<std::string> unasked() const;

private:
    const std::map<std::string, std::string> answers_;
    std::set<std::string> asked_;
    PresetOperator preset_;
    const SignalStop& interrupts_;
    const std::function<void()> beforeAsking_;
};

// A word typed on a terminal before something dangerous: the second of two steps (H12).

/// Whether the operator can be asked: input and messages are a terminal.
[[nodiscard]] bool canAsk();

enum class Answer { Confirmed, Otherwise, TooLate, Signalled };

/// After half a second, in which what was typed before arrives and is forgotten, prints `prompt` on stderr and waits
/// for one line. Confirmed only for `word` itself. Returns within 50 ms of a signal.
[[nodiscard]] Answer askFor(std::string_view word, std::string_view prompt, Seconds within,
                            const SignalStop& interrupts);

}  // namespace tacto::cli
