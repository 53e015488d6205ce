// ScriptSession.h - what one run of a script works on: bench, session file, operator, and what it has gathered so
// far. The host functions are written against this.
//
// Captures are large, so scripts hold handles and the samples stay here: the last kHeldCaptures of them, and the
// first of each condition for the report.
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

    /// `request` outlives the session; its bench is not null, or no host function is ever called.
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
    /// Asks the operator to do something, and to confirm it. Errors: as ask().
    [[nodiscard]] Result<void> askTo(std::string name, std::string text);
    /// The text that the operator confirmed in this run, until a load is changed.
    [[nodiscard]] bool hasConfirmed(const std::string& text) const { return confirmed_.contains(text); }
    void noteConfirmed(const std::string& text) { confirmed_.insert(text); }
    void forgetConfirmed() { confirmed_.clear(); }
    /// The run ends with `error`: every host call from now on fails with it, and so does the run, also where the script
    /// catches it.
    [[nodiscard]] tl::unexpected<Error> endWith(Error error);
    [[nodiscard]] const std::optional<Error>& endedWith() const noexcept { return end_; }
    void log(const std::string& text);
    void progress(const ScriptProgress& progress);

    /// Keeps captures and returns their handles, objects for the script.
    [[nodiscard]] nlohmann::json hold(std::vector<Capture> captures);
    /// The captures behind a list of handles. Errors: InvalidArgument for what is not a handle or is held no longer.
    [[nodiscard]] Result<std::vector<const Capture*>> held(const nlohmann::json& handles) const;
    /// The command of each capture when it was taken. Errors: as held().
    [[nodiscard]] Result<std::vector<CapturedCommand>> commandsOf(const nlohmann::json& handles) const;

    /// The program's own readings and results in this run.
    [[nodiscard]] RunReadings& own() noexcept { return own_; }
    /// The number that the operator gave the parameter `name` on purpose; nothing where it is the script's default.
    [[nodiscard]] std::optional<double> operatorsNumber(const std::string& name) const;
    /// Whether the operator gave this text: as a parameter, as the answer to a question, or as one word of these
    /// (between blanks or semicolons).
    [[nodiscard]] bool isOperatorsText(const std::string& text) const;
    /// The profile as the operator chose it, before the script changed anything for its run.
    [[nodiscard]] const Profile& chosenProfile() const noexcept { return chosen_; }

    /// Every device is a twin.
    [[nodiscard]] bool isSimulated() const;
    /// A procedure of several steps keeps one T from its first step on. Errors: InvalidArgument naming `procedure`
    /// where it has not begun, and where it begins again.
    template <class T>
    [[nodiscard]] Result<T*> begun(std::string_view procedure);
    template <class T>
    [[nodiscard]] Result<T*> begin(std::string_view procedure, T first);

    /// Writes an item of the report, or a measured value; nothing where the run is not recorded. Errors: of the session
    /// file.
    [[nodiscard]] Result<void> reportItem(const nlohmann::json& item);
    [[nodiscard]] Result<void> reportText(const std::string& text) {
        return reportItem({{"kind", "text"}, {"text", text}});
    }
    /// Keeps it as the event "script: KIND": no event of the program begins like this, and "script not started" is one
    /// (hazard H9).
    [[nodiscard]] Result<void> keepEvent(const std::string& kind, const nlohmann::json& details);
    [[nodiscard]] Result<void> keepMeasurement(std::string_view name, const nlohmann::json& values);

    /// Records a trial with the captures it was measured on. Errors: of the session file, of the capture folder.
    [[nodiscard]] Result<int> addTrial(const std::string& condition, const nlohmann::json& measured);
    [[nodiscard]] const std::vector<nlohmann::json>& trials() const noexcept { return trials_; }

    /// One capture of each condition, in the order first met: what plot.waveforms shows.
    struct Exemplar {
        std::string condition;
        std::optional<std::int64_t> row;  ///< the row in the session file
        Capture capture;
    };
    [[nodiscard]] std::span<const Exemplar> exemplars() const noexcept { return exemplars_; }

    /// The largest exposure of the run so far, row by row, as report figures take it.
    [[nodiscard]] nlohmann::json worstExposure() const;
    /// Writes worstExposure() into the session, once, at the end: what its report says of exposure.
    void recordExposure();

    /// A fault that the script provoked, found as it should be, and reset: it does not void the run.
    void noteExpectedFault() noexcept { ++expectedFaults_; }
    [[nodiscard]] std::uint64_t expectedFaults() const noexcept { return expectedFaults_; }

    /// Code that prints and reads results goes by their kind, not by what they happen to hold: the kind of the analysis
    /// that the script returns, else the kind that it declares.
    [[nodiscard]] std::string kindOf(const nlohmann::json& results) const;

    /// Keeps results for the case that the run ends early, and tables {caption, rows, columns} for the report.
    void keepPartial(nlohmann::json results, nlohmann::json tables);
    /// The kept results, marked, and their tables written into the report; null where nothing was kept.
    [[nodiscard]] nlohmann::json takePartial();

    void judge(ScriptVerdict verdict, std::vector<std::string> reasons, nlohmann::json results);
    /// Writes what `results` rest on into the session, for the report of a run that has no verdict.
    void recordBasis(const nlohmann::json& results);
    /// Moves what the run has come to into `outcome`.
    void finish(ScriptOutcome& outcome);
    [[nodiscard]] std::vector<std::string> takeLog() { return std::move(log_); }

private:
    [[nodiscard]] InstrumentStatement operatorsStatement() const;
    /// Adds what the run's captures state to its results.
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
