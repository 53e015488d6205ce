// ProtocolRun.h - everything that a protocol's run needs in addition to its script: devices, clock, bench, session
// file, report. Command line and window run protocols through this, and therefore in the same way.
//
// Thread-safety: one caller; but any thread may call bench().stop() and script().stop().
#pragma once

#include <memory>
#include <vector>

#include "app/run/LoadSafetyRecord.h"
#include "app/run/MarkerServer.h"
#include "app/run/OpenedBench.h"
#include "app/scripting/engine/ScriptRun.h"

namespace tacto {

/// The fault in which a run left its stimulator, or found it.
struct LeftFault {
    /// Driver and serial number of the stimulator, of the massager where there is none, or else of the sensor.
    std::string unit;
    std::string reason;        ///< as kept with the fault
    std::uint32_t causes = 0;  ///< as in UnitFault
    [[nodiscard]] std::optional<FaultCause> grave() const noexcept { return graveCause(causes); }
    /// True if it is the same fault of the same unit.
    [[nodiscard]] bool is(const LeftFault& other) const { return unit == other.unit && reason == other.reason; }
};

/// The operator's order, after checks.
struct RunOrder : BenchOrder {
    ProtocolSource script;
    ProtocolDeclaration declaration;  ///< as the operator saw it; without a title: the script was not read before
    ProtocolSettings settings;
    std::string ownLoad = {};      ///< replaces the load in the parameters: a virtual participant's skin
    std::set<Role> ownNeeds = {};  ///< replaces the roles that the script needs, in massager studies; empty: no change
    /// File with this order's details for the certificate of a stimulator calibration (CertificateDetails.h); empty:
    /// only the laboratory's own details. Not used by other kinds of results.
    std::filesystem::path certificateDetails = {};
    /// Resets a fault left in the stimulator by an earlier run; else the fault ends this run. After a fault with a
    /// grave cause only a load-safety run does so.
    bool resetFault = false;
    std::optional<LeftFault> faultSeen = {};  ///< resets only this fault; empty: any
};

/// Returns the load in a protocol's parameters, with which the simulated bench starts.
[[nodiscard]] std::string declaredLoad(const nlohmann::json& parameters);

/// Returns the description of a script for its session.
[[nodiscard]] SessionAbout aboutScript(const RunOrder& order);

/// The outcome of a run, even if the run failed.
struct RunResult {
    ScriptOutcome outcome;
    bool stoppedBySafety = false;     ///< by a fault, a refused train or an operator's stop
    std::optional<LeftFault> leftIn;  ///< no run begins on the stimulator until this fault is reset
    bool simulated = false;           ///< a device was simulated, or the results are a prediction; `marks` say which
    std::vector<std::string> marks;   ///< from sessionMarks(): origin, calibration, flags of roughness R
    std::vector<SessionDevice> devices;
    std::filesystem::path session;
    std::vector<Error> troubles;         ///< errors in addition to the outcome's own: closing the session
    std::optional<MarkerTally> markers;  ///< for a pilot session with markers
    std::optional<LslTally> lsl;         ///< for a session with streams
    /// Returns pass, fail, indeterminate or stopped; empty for a protocol without a judgement or a run with an error.
    [[nodiscard]] std::string verdict() const;
    /// If nothing else failed, makes the first trouble the error and removes the verdict. Drops troubles that the error
    /// already mentions.
    void weighTroubles();
};

class ProtocolRun {
public:
    /// Opens the devices that the protocol needs, with the load in its parameters. A stop ends the opening of devices;
    /// start() detects a later stop. Errors: as openBench() and certificateDetails(); NotArmed for a fault in which the
    /// stimulator was left, which goes into `found` then.
    [[nodiscard]] static Result<std::unique_ptr<ProtocolRun>> prepare(RunOrder order, Registry& registry,
                                                                      std::shared_ptr<BenchTap> tap = nullptr,
                                                                      std::optional<LeftFault>* found = nullptr);
    /// Ends a running script and switches the output off. An unfinished run leaves its session without an end mark.
    ~ProtocolRun();
    ProtocolRun(const ProtocolRun&) = delete;
    ProtocolRun& operator=(const ProtocolRun&) = delete;

    /// Fills in script, declaration, parameters, seed, bench, session and capture folder of `hooks` and starts the
    /// script; the caller sets the callbacks and the operator. `onLog` first reports expected failures, such as a
    /// profile beyond the stimulator's reach. Errors: as ScriptRun::start(); finish() reports them too.
    [[nodiscard]] Result<void> start(RunRequest hooks);
    /// Blocks until the script has ended, then closes bench and session.
    [[nodiscard]] RunResult finish();

    [[nodiscard]] Bench& bench() noexcept { return *opened_->bench; }
    [[nodiscard]] ScriptRun* script() noexcept { return script_.get(); }
    [[nodiscard]] const OpenedBench& opened() const noexcept { return *opened_; }
    [[nodiscard]] const RunFiles& files() const noexcept { return opened_->files; }

private:
    [[nodiscard]] Result<void> leaveFault(const LeftFault& fault);
    [[nodiscard]] std::optional<LeftFault> presentFault() const;
    [[nodiscard]] Result<void> beginCheck();
    void endCheck(RunResult& result);
    explicit ProtocolRun(RunOrder order) : order_(std::move(order)) {}
    RunOrder order_;
    std::shared_ptr<OpenedBench> opened_;  // the open bench, which the script uses too
    std::optional<Error> notStarted_;
    std::optional<LoadSafetyCheck> check_;  // the record of a load-safety run
    std::optional<LeftFault> checked_;      // the grave fault that a pass of this run clears
    std::unique_ptr<ScriptRun> script_;     // declared last, so that it ends first
};

}  // namespace tacto
