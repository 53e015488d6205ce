// Operator.h - the person at the bench, as a protocol script sees them: they confirm, choose and enter.
//
// Without a window or terminal, answers are given in advance (`--set NAME=...`); a question without one fails by name.
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
    bool number = false;                                       ///< Enter: the answer must be a number
    std::optional<double> min;
    std::optional<double> max;
    std::string drawing;  ///< name of a shipped drawing to show; may be empty
    /// Confirm: the exact text that the operator confirms. An answer given in advance must be this text, not "yes". A
    /// question that is asked several times takes several texts, one per line. If empty, "yes" is enough.
    std::string confirms{};
    /// Confirm, at a terminal: the word that the operator types.
    std::string word = "yes";
    /// The question's number at this desk: an answer to an earlier question cannot answer this one.
    std::uint64_t id = 0;
};

class Operator {
public:
    virtual ~Operator() = default;
    /// How long the output may continue while a question waits and present() is not called. A call of present() says
    /// that the operator can press the stop.
    [[nodiscard]] virtual Seconds unwatchedFor() const { return Seconds(35); }  // longer than a terminal's arming waits
    /// Called by ask() while it waits and the operator can press the stop. Set by the run.
    std::function<void()> present;
    /// Returns true for Confirm, the key for Choose, a number or text for Enter. Errors: NotFound, naming the question,
    /// if there is no operator; Stopped if refused or cancelled; InvalidArgument if the answer is not accepted;
    /// NotArmed if another text was confirmed.
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
