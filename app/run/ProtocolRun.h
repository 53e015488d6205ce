// ProtocolRun.h - everything a run of a protocol needs around its script: devices, clock, bench, session file, report.
// The command line and the window run protocols through this, and so the same way.
//
// Thread-safety: one caller, but for bench().stop() and script().stop(), which any thread may call.
#pragma once

#include <memory>
#include <vector>

#include "app/run/RunFiles.h"
#include "app/run/RunNotes.h"
#include "app/run/Shipped.h"
#include "app/scripting/ScriptRun.h"
#include "core/bench/Bench.h"
#include "core/devices/DeviceUri.h"
#include "core/session/SessionWriter.h"

namespace tacto {

/// What the operator asks for, checked.
struct RunOrder {
    ProtocolSource script;
    ProtocolDeclaration declaration;  ///< as the operator saw it; without a title: the script was not read before
    ProtocolSettings settings;
    std::uint64_t seed = 1;
    std::vector<DeviceUri> uris;
    bool realtime = false;    ///< the steady clock even where a virtual one could serve
    bool resetFault = false;  ///< a fault in which an earlier run left the stimulator is reset; else it ends this one
    Profile profile;
    ShippedLimits limits;
    std::string out;  ///< folder, as prepareRunFiles() takes it
    RunNotes notes;
    /// Whose stops end the run, from the opening of its devices on; null: the bench's own. `asked` is when the operator
    /// asked for the run.
    std::shared_ptr<StopCounter> stops = nullptr;
    StopMark asked = {};
    std::function<bool()> watched = {};  ///< BenchConfig::watched
};

/// The load that a protocol's parameters declare: what the simulated bench starts with.
[[nodiscard]] std::string declaredLoad(const nlohmann::json& parameters);

/// What a session says before its first row. `protocol` may be null: a session without a script.
[[nodiscard]] SessionAbout aboutSession(const DeviceSet& devices, const Profile& profile, const ShippedLimits& limits,
                                        const RunOrder* protocol);

/// What came of a run, also when it failed.
struct RunResult {
    ScriptOutcome outcome;
    bool stoppedBySafety = false;    ///< a fault, a refused train, an operator's stop
    bool simulated = false;          ///< any device, or a prediction; `marks` say which
    std::vector<std::string> marks;  ///< of sessionMarks(): origin, calibration, the flags of R
    std::vector<SessionDevice> devices;
    std::filesystem::path session;
    std::vector<Error> troubles;  ///< beside the outcome: closing the session
    /// pass, fail, indeterminate, stopped; empty for a protocol that judges nothing or ended by an error.
    [[nodiscard]] std::string verdict() const;
};

class ProtocolRun {
public:
    /// Opens devices, makes the session file and the bench. A stop ends the opening of devices; one that comes later is
    /// found by start(). Errors: as openDevices(), prepareRunFiles(),
    /// SessionWriter::create() and Bench::create().
    /// `tap` may be null; else it outlives the run.
    [[nodiscard]] static Result<std::unique_ptr<ProtocolRun>> prepare(RunOrder order, Registry& registry,
                                                                      BenchTap* tap = nullptr);
    /// Ends a script that still runs; output off. A run that was not finished leaves its session without an end mark.
    ~ProtocolRun();
    ProtocolRun(const ProtocolRun&) = delete;
    ProtocolRun& operator=(const ProtocolRun&) = delete;

    /// Fills in script, declaration, parameters, seed, bench, session and capture folder of `hooks`, whose callbacks
    /// and operator are the caller's, and starts the script. What is known to fail, as a profile that the stimulator
    /// cannot reach, is said through `onLog` before. Errors: as ScriptRun::start(); finish() tells them too.
    [[nodiscard]] Result<void> start(RunRequest hooks);
    /// Blocks until the script has ended, then closes bench and session. An abandoned script keeps its bench: it is
    /// leaked on purpose, with outputs off.
    [[nodiscard]] RunResult finish();

    [[nodiscard]] Bench& bench() noexcept { return *bench_; }
    [[nodiscard]] ScriptRun* script() noexcept { return script_.get(); }
    [[nodiscard]] const SessionAbout& about() const noexcept { return about_; }
    [[nodiscard]] const RunFiles& files() const noexcept { return files_; }

private:
    [[nodiscard]] Result<void> leaveFault();
    explicit ProtocolRun(RunOrder order) : order_(std::move(order)) {}
    RunOrder order_;
    RunFiles files_;
    SessionAbout about_;
    std::string warning_;  // of what is known before the script runs; empty: none
    std::shared_ptr<Clock> clock_;
    std::unique_ptr<SessionWriter> session_;
    std::unique_ptr<Bench> bench_;
    std::optional<Error> notStarted_;
    std::unique_ptr<ScriptRun> script_;  // Last: ends first
};

}  // namespace tacto
