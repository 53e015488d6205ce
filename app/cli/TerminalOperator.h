// TerminalOperator.h - the person at a terminal as a protocol's operator: a question that --set answers is not asked; a
// confirmation is a typed word, where there is a terminal.
//
// Thread-safety: ask() on the script's thread; cancel() any thread.
#pragma once

#include <functional>
#include <set>

#include "app/run/SignalStop.h"
#include "app/scripting/engine/Operator.h"

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

}  // namespace tacto::cli
