// TerminalOperator.h - the person at a terminal as a protocol's operator. Questions answered by --set are not asked; at
// a terminal, a confirmation is a typed word.
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
    /// `interrupts` must outlive this object: a signal ends a question. `beforeAsking` is called before each question
    /// to clear a progress line; it may be empty.
    TerminalOperator(std::map<std::string, std::string> answers, const SignalStop& interrupts,
                     std::function<void()> beforeAsking);
    TerminalOperator(const TerminalOperator&) = delete;
    TerminalOperator& operator=(const TerminalOperator&) = delete;

    [[nodiscard]] Result<nlohmann::json> ask(const OperatorQuestion& question) override;
    void cancel() noexcept override {}  // the signal that stops a run also ends the question
    /// Returns names in `answers` that were never asked for. Do not call while the script runs.
    [[nodiscard]] std::vector<std::string> unasked() const;

private:
    const std::map<std::string, std::string> answers_;
    std::set<std::string> asked_;
    PresetOperator preset_;
    const SignalStop& interrupts_;
    const std::function<void()> beforeAsking_;
};

// A word typed at a terminal before a dangerous action: the second of two steps (H12).

/// True if the operator can be asked: input and messages use a terminal.
[[nodiscard]] bool canAsk();

enum class Answer { Confirmed, Otherwise, TooLate, Signalled };

/// Waits half a second, in which earlier typing arrives and is discarded, then prints `prompt` on stderr and waits for
/// one line. Confirmed only for exactly `word`. Returns within 50 ms of a signal.
[[nodiscard]] Answer askFor(std::string_view word, std::string_view prompt, Seconds within,
                            const SignalStop& interrupts);

}  // namespace tacto::cli
