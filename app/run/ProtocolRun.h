// ProtocolRun.h - everything a run of a protocol needs around its script: devices, clock, bench, session file, report.
// The command line and the window run protocols through this, and so the same way.
//
// Thread-safety: one caller, but for bench().stop() and script().stop(), which any thread may call.
#pragma once

#include <memory>
#include <vector>

#include "app/run/LoadSafetyRecord.h"
#include "app/run/MarkerServer.h"
#include "app/run/OpenedBench.h"
#include "app/scripting/engine/ScriptRun.h"

namespace tacto {

/// The operator's order, checked.
struct RunOrder : BenchOrder {
    ProtocolSource script;
    ProtocolDeclaration declaration;  ///< as the operator saw it; without a title: the script was not read before
    ProtocolSettings settings;
    std::string ownLoad = {};      ///< replaces the load that the parameters declare: a virtual participant's skin
    std::set<Role> ownNeeds = {};  ///< replaces what the script declares to need, in massager studies; empty: nothing
    /// File of the order's details for the certificate of a stimulator calibration: CertificateDetails.h; empty: the
    /// laboratory's own alone. Other kinds of results do not use it.
    std::filesystem::path certificateDetails = {};
    bool resetFault = false;  ///< a fault in which an earlier run left the stimulator is reset; else it ends this one
};

/// The load that a protocol's parameters declare: what the simulated bench starts with.
[[nodiscard]] std::string declaredLoad(const nlohmann::json& parameters);

/// The description of a script in its session.
[[nodiscard]] SessionAbout aboutScript(const RunOrder& order);

/// The outcome of a run, also of a failed one.
struct RunResult {
    ScriptOutcome outcome;
    bool stoppedBySafety = false;    ///< a fault, a refused train, an operator's stop
    bool simulated = false;          ///< by a device, or as a prediction; `marks` say which
    std::vector<std::string> marks;  ///< the marks from sessionMarks(): origin, calibration, the flags of R
    std::vector<SessionDevice> devices;
    std::filesystem::path session;
    std::vector<Error> troubles;         ///< beside the outcome's error, which does not say them: closing the session
    std::optional<MarkerTally> markers;  ///< for a pilot session with markers
    /// pass, fail, indeterminate, stopped; empty for a protocol that judges nothing or ended by an error.
    [[nodiscard]] std::string verdict() const;
    /// If nothing else failed, the first trouble becomes the error, and there is no verdict; troubles that the error
    /// mentions are left out.
    void weighTroubles();
};

class ProtocolRun {
public:
    /// Opens the bench: what the protocol needs, on the load that its parameters declare. A stop ends the opening of
    /// devices; one that comes later is found by start(). Errors: as openBench() and certificateDetails(); NotArmed for
    /// a fault in which the stimulator was left.
    [[nodiscard]] static Result<std::unique_ptr<ProtocolRun>> prepare(RunOrder order, Registry& registry,
                                                                      std::shared_ptr<BenchTap> tap = nullptr);
    /// Ends a script that still runs; output off. A run that was not finished leaves its session without an end mark.
    ~ProtocolRun();
    ProtocolRun(const ProtocolRun&) = delete;
    ProtocolRun& operator=(const ProtocolRun&) = delete;

    /// Fills in script, declaration, parameters, seed, bench, session and capture folder of `hooks`, whose callbacks
    /// and operator are the caller's, and starts the script. Expected failures, as a profile beyond the stimulator's
    /// reach, are told through `onLog` first. Errors: as ScriptRun::start(); finish() reports them too.
    [[nodiscard]] Result<void> start(RunRequest hooks);
    /// Blocks until the script has ended, then closes bench and session.
    [[nodiscard]] RunResult finish();

    [[nodiscard]] Bench& bench() noexcept { return *opened_->bench; }
    [[nodiscard]] ScriptRun* script() noexcept { return script_.get(); }
    [[nodiscard]] const OpenedBench& opened() const noexcept { return *opened_; }
    [[nodiscard]] const RunFiles& files() const noexcept { return opened_->files; }

private:
    [[nodiscard]] Result<void> leaveFault();
    [[nodiscard]] Result<void> beginCheck();
    void endCheck(RunResult& result);
    explicit ProtocolRun(RunOrder order) : order_(std::move(order)) {}
    RunOrder order_;
    std::shared_ptr<OpenedBench> opened_;  // the bench that is open, and the script's
    std::optional<Error> notStarted_;
    std::optional<LoadSafetyCheck> check_;  // the record of a load-safety run
    std::unique_ptr<ScriptRun> script_;     // Last: ends first
};

}  // namespace tacto
