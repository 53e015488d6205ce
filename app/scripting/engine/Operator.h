// Operator.h - the person at the bench, as a protocol script sees them: they confirm, choose and enter.
//
// Headless, the answers are given in advance (`--set NAME=...`), and a question without one fails with its name.
//
// Thread-safety: ask() is called on the script's thread and may block; cancel() from any thread wakes it.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto {

struct OperatorQuestion {
    enum class Kind { Confirm, Choose, Enter };
    Kind kind = Kind::Confirm;
    std::string name;                                          ///< the key of --set
    std::string text;                                          ///< the sentence the operator reads
    std::vector<std::pair<std::string, std::string>> choices;  ///< Choose: key and explanation
    std::string unit;                                          ///< Enter: unit of a number; empty for text
    bool number = false;                                       ///< Enter: a number is wanted
    std::optional<double> min;
    std::optional<double> max;
    std::string drawing;  ///< name of a shipped drawing to show; may be empty
    /// Confirm: what exactly is confirmed. An answer that was given in advance must be this text and no "yes"; several,
    /// one to a line, answer a question that is put several times. Empty: "yes" does.
    std::string confirms{};
    /// Confirm, at a terminal: the word that is typed.
    std::string word = "yes";
    /// The question's number at this desk, so that an answer to an earlier question does not answer this one.
    std::uint64_t id = 0;
};

class Operator {
public:
    virtual ~Operator() = default;
    /// How long output may go on while a question waits, unless present() is called again: the operator has the stop,
    /// as long as there is something to press.
    [[nodiscard]] virtual Seconds unwatchedFor() const { return Seconds(35); }  // longer than a terminal's arming waits
    /// Called by ask() while it waits and the operator could press the stop. Set by the run.
    std::function<void()> present;
    /// true for Confirm, the key for Choose, a number or text for Enter.
    /// Errors: NotFound when there is no operator to answer, naming the question; Stopped when refused or cancelled;
    /// InvalidArgument for an answer outside what is accepted; NotArmed for the confirmation of another text.
    [[nodiscard]] virtual Result<nlohmann::json> ask(const OperatorQuestion& question) = 0;
    /// Makes a waiting ask() return Stopped.
    virtual void cancel() noexcept = 0;
};

/// Answers given in advance; never waits.
class PresetOperator final : public Operator {
public:
    explicit PresetOperator(std::map<std::string, std::string> answers) : answers_(std::move(answers)) {}
    PresetOperator(const PresetOperator&) = delete;
    PresetOperator& operator=(const PresetOperator&) = delete;
    [[nodiscard]] Result<nlohmann::json> ask(const OperatorQuestion& question) override;
    void cancel() noexcept override {}

private:
    const std::map<std::string, std::string> answers_;
};

}  // namespace tacto
