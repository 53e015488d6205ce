// ScriptSession.h - the data that the host functions of one run work on: bench, session file, operator and results so
// far.
//
// Captures are large, so scripts hold handles and this object holds the samples: those of the last kHeldCaptures
// captures, and of the first capture of each condition for the report.
//
// Thread-safety: none; ScriptRun lets one thread in at a time.
#pragma once

#include <any>
#include <deque>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <typeindex>
#include <vector>

#include "app/scripting/engine/Operator.h"
#include "app/scripting/engine/RunReadings.h"
#include "app/scripting/engine/ScopeSeen.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/Random.h"
#include "core/bench/Bench.h"
#include "core/measure/InstrumentStatement.h"
#include "core/pilot/PilotSession.h"

namespace tacto {

class ScriptSession {
public:
    static constexpr std::size_t kHeldCaptures = 64;

    /// `request` must outlive the session. Its bench may be null only if no host function is called.
    explicit ScriptSession(const RunRequest& request);

    [[nodiscard]] Bench& bench() noexcept { return *request_.bench; }
    [[nodiscard]] ScopeSeen& scopeSeen() noexcept { return scopeSeen_; }
    /// Errors: Unsupported outside a session of a study.
    [[nodiscard]] Result<PilotSession*> pilot();
    [[nodiscard]] SessionWriter* writer() noexcept { return request_.session; }
    [[nodiscard]] Random& random() noexcept { return random_; }
    [[nodiscard]] Instant now() const { return request_.bench->clock().now(); }
    [[nodiscard]] const RunRequest& request() const noexcept { return request_; }

    /// Errors: as Operator::ask(); NotFound naming the question without an operator.
    [[nodiscard]] Result<nlohmann::json> ask(const OperatorQuestion& question);
    /// Asks the operator to do something and to confirm that it is done. Errors: as ask().
    [[nodiscard]] Result<void> askTo(std::string name, std::string text);
    /// True if the operator confirmed this text in this run and no load has changed since.
    [[nodiscard]] bool hasConfirmed(const std::string& text) const { return confirmed_.contains(text); }
    void noteConfirmed(const std::string& text) { confirmed_.insert(text); }
    void forgetConfirmed() { confirmed_.clear(); }
    /// Ends the run with `error`: every later host call fails with it, and so does the run, even if the script catches
    /// the error.
    [[nodiscard]] tl::unexpected<Error> endWith(Error error);
    [[nodiscard]] const std::optional<Error>& endedWith() const noexcept { return end_; }
    void log(const std::string& text);
    void progress(const ScriptProgress& progress);

    /// Keeps captures and returns their handles as objects for the script.
    [[nodiscard]] nlohmann::json hold(std::vector<Capture> captures);
    /// Returns the captures for a list of handles. Errors: InvalidArgument for an invalid or expired handle.
    [[nodiscard]] Result<std::vector<const Capture*>> held(const nlohmann::json& handles) const;
    /// Returns the command at the time of each capture. Errors: as held().
    [[nodiscard]] Result<std::vector<CapturedCommand>> commandsOf(const nlohmann::json& handles) const;

    /// Readings and results that the program itself made in this run.
    [[nodiscard]] RunReadings& own() noexcept { return own_; }
    /// Returns the number that the operator set for parameter `name`, or nothing if it has the script's default.
    [[nodiscard]] std::optional<double> operatorsNumber(const std::string& name) const;
    /// True if the operator gave this text as a parameter, as an answer, or as one word of a longer parameter or answer
    /// (words are separated by blanks or semicolons).
    [[nodiscard]] bool isOperatorsText(const std::string& text) const;
    /// Returns the profile as the operator chose it, without changes made by the script.
    [[nodiscard]] const Profile& chosenProfile() const noexcept { return chosen_; }

    /// True if every device is simulated.
    [[nodiscard]] bool isSimulated() const;
    /// Returns the state (of type T) that a procedure of several steps keeps from its first step on. Errors:
    /// InvalidArgument naming `procedure` if it has not begun, or has begun again.
    template <class T>
    [[nodiscard]] Result<T*> begun(std::string_view procedure);
    template <class T>
    [[nodiscard]] Result<T*> begin(std::string_view procedure, T first);

    /// Writes a report item or a measured value. Does nothing if the run is not recorded. Errors: of the session file.
    [[nodiscard]] Result<void> reportItem(const nlohmann::json& item);
    [[nodiscard]] Result<void> reportText(const std::string& text) {
        return reportItem({{"kind", "text"}, {"text", text}});
    }
    /// Writes the event "script: KIND". The program's own events never begin like this; "script not started" is one of
    /// them (hazard H9).
    [[nodiscard]] Result<void> keepEvent(const std::string& kind, const nlohmann::json& details);
    [[nodiscard]] Result<void> keepMeasurement(std::string_view name, const nlohmann::json& values);

    /// Records a trial with its captures. Errors: of the session file, of the capture folder.
    [[nodiscard]] Result<int> addTrial(const std::string& condition, const nlohmann::json& measured);
    [[nodiscard]] const std::vector<nlohmann::json>& trials() const noexcept { return trials_; }

    /// One capture of each condition, in the order of their first occurrence, for plot.waveforms.
    struct Exemplar {
        std::string condition;
        std::optional<std::int64_t> row;  ///< the row in the session file
        Capture capture;
    };
    [[nodiscard]] std::span<const Exemplar> exemplars() const noexcept { return exemplars_; }

    /// Returns the largest exposures of the run so far, row by row, in the form of report figures.
    [[nodiscard]] nlohmann::json worstExposure() const;
    /// Writes worstExposure() into the session once, at the end, for the report.
    void recordExposure();

    /// Counts a fault that the script provoked, found as expected, and reset: such a fault does not void the run.
    void noteExpectedFault() noexcept { ++expectedFaults_; }
    [[nodiscard]] std::uint64_t expectedFaults() const noexcept { return expectedFaults_; }

    /// Returns the kind by which results are printed and read: the kind of the analysis that the script returns, else
    /// the kind that the script declares. The contents of the results do not matter.
    [[nodiscard]] std::string kindOf(const nlohmann::json& results) const;

    /// Keeps results in case the run ends early, and tables {caption, rows, columns} for the report.
    void keepPartial(nlohmann::json results, nlohmann::json tables);
    /// Returns the kept results, marked as partial, and writes their tables into the report; null if none were kept.
    [[nodiscard]] nlohmann::json takePartial();

    void judge(ScriptVerdict verdict, std::vector<std::string> reasons, nlohmann::json results);
    /// Writes what `results` are based on into the session, for the report of a run that has no verdict.
    void recordBasis(const nlohmann::json& results);
    /// Moves the results of the run into `outcome`.
    void finish(ScriptOutcome& outcome);
    [[nodiscard]] std::vector<std::string> takeLog() { return std::move(log_); }

private:
    [[nodiscard]] InstrumentStatement operatorsStatement() const;
    /// Adds the accuracy that the captures state to the run's results.
    void addBasis(nlohmann::json& results) const;
    ScopeSeen scopeSeen_;
    struct Held {
        std::int64_t id;
        Capture capture;
        CapturedCommand command;
        std::optional<std::int64_t> row;
    };
    [[nodiscard]] Result<const Held*> find(const nlohmann::json& handle) const;
    [[nodiscard]] CapturedCommand commandOf(const Capture& capture) const;
    [[nodiscard]] Result<void> store(Held& held, int trial);

    const RunRequest& request_;
    Random random_;
    std::set<std::string> confirmed_;
    std::optional<Error> end_;
    Profile chosen_;
    std::set<std::string> answered_;  // texts that the operator gave as answers
    std::deque<Held> captures_;
    std::int64_t nextCapture_ = 1;
    std::vector<nlohmann::json> trials_;
    std::vector<Exemplar> exemplars_;
    RunReadings own_;
    std::map<std::type_index, std::any> procedures_;
    std::uint64_t expectedFaults_ = 0;
    nlohmann::json partial_, partialTables_;
    std::vector<std::string> log_;
    ScriptVerdict verdict_ = ScriptVerdict::None;
    std::vector<std::string> reasons_;
    nlohmann::json results_;
};

template <class T>
Result<T*> ScriptSession::begun(std::string_view procedure) {
    const auto found = procedures_.find(typeid(T));
    if (found != procedures_.end()) return std::any_cast<T>(&found->second);
    return fail(ErrorCode::InvalidArgument, "{0} has not begun; {0}.begin() is expected first", procedure);
}

template <class T>
Result<T*> ScriptSession::begin(std::string_view procedure, T first) {
    const auto [at, isNew] = procedures_.try_emplace(typeid(T), std::move(first));
    if (isNew) return std::any_cast<T>(&at->second);
    return fail(ErrorCode::InvalidArgument, "{}.begin() was called before; once in a run is expected", procedure);
}

}  // namespace tacto
