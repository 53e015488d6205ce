// ScriptRun.h - one run of a protocol script against a bench, on a thread of its own.
//
// Promise (hazard H10): a script reaches the world through the host objects alone, from a process of its own
// (ScriptProcess.h). stop() reaches the bench's outputs without the script's help; calls that wait come back with an
// error, and the script's process is ended whatever it does. A process that ends by itself, a crash of the engine, is
// an end of the run like an exception. Leaving run() by any door disarms.
//
// Thread-safety: stop(), pause(), resume() and paused() from any thread, as often as wanted; wait functions have one
// caller.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/scripting/engine/Operator.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/base/Result.h"
#include "core/base/Words.h"
#include "core/measure/Capture.h"
#include "core/safety/StopCounter.h"

namespace tacto {

class Bench;
class PilotSession;
class SessionWriter;

/// The progress of a loop over progress(list, label).
struct ScriptProgress {
    std::string label;
    std::size_t done = 0;
    std::size_t total = 0;
};

struct RunRequest {
    ProtocolSource script;
    /// What readDeclaration() gave and the operator saw: what the session says that the script is. A script that
    /// declares something else when it runs is ended before run(p). Nothing where the script was not read before: its
    /// own counts.
    std::optional<ProtocolDeclaration> declaration = {};
    nlohmann::json parameters = nlohmann::json::object();  ///< from applySettings()
    std::set<std::string> operatorGave;                    ///< names of the parameters that the operator set on purpose
    /// Bytes by which the script's process may grow, and the program while it runs; the usual limit of MemoryGuard
    /// where nothing is said.
    std::optional<std::size_t> memoryLimit;
    std::uint64_t seed = 1;
    Bench* bench = nullptr;               ///< used by nobody else until the run is over, except for stop()
    std::filesystem::path program;        ///< runs instead of tactoscope-script, where it is not empty
    StopMark asked = {};                  ///< the bench's stops() when the operator asked for the run
    SessionWriter* session = nullptr;     ///< where null, nothing is recorded
    PilotSession* pilot = nullptr;        ///< what the object `pilot` works on; null: there is none
    Operator* operatorDesk = nullptr;     ///< not owned; where null, every question fails with its name
    std::filesystem::path captureFolder;  ///< each capture as a CSV file there; empty writes none
    std::function<void(const ScriptProgress&)> onProgress;  ///< on the script's thread; may be empty
    std::function<void(const std::string&)> onLog;          ///< on the script's thread; may be empty
    /// A trial as record.trial() was given it, with `condition` and `trial`. On the script's thread; may be empty.
    std::function<void(const nlohmann::json&)> onTrial;
    std::function<void(const Capture&)> onCapture;  ///< every capture; on the script's thread; may be empty
};

enum class ScriptVerdict { None, Pass, Fail, Indeterminate, Stopped };
/// None has no word: it is null in JSON.
inline constexpr Word<ScriptVerdict> kScriptVerdicts[] = {{"pass", ScriptVerdict::Pass},
                                                          {"fail", ScriptVerdict::Fail},
                                                          {"indeterminate", ScriptVerdict::Indeterminate},
                                                          {"stopped", ScriptVerdict::Stopped}};
/// Empty for None.
[[nodiscard]] constexpr std::string_view nameOf(ScriptVerdict verdict) noexcept {
    return wordFor(kScriptVerdicts, verdict, "");
}

struct ScriptOutcome {
    ScriptVerdict verdict = ScriptVerdict::None;
    std::vector<std::string> reasons;  ///< reasons for the verdict, one sentence each
    /// What the verdict was given; null without one. After an early end what record.partial() kept, with partial: true.
    nlohmann::json results;
    std::optional<Error> error;  ///< "file:line: reason" when run() did not return
    std::string file;            ///< the file in which the error stands
    int line = 0;
    std::uint64_t expectedFaults = 0;  ///< faults that the script's trips provoke on purpose, find and reset
    std::vector<std::string> log;      ///< the lines from log()
};

class ScriptRun {
public:
    /// Starts the script. Errors: Stopped when a stop of the bench has come since `request.asked`; InvalidArgument
    /// without a bench; as ScriptProcess::start().
    [[nodiscard]] static Result<std::unique_ptr<ScriptRun>> start(RunRequest request);
    /// Stops, waits as wait() does.
    ~ScriptRun();
    ScriptRun(const ScriptRun&) = delete;
    ScriptRun& operator=(const ScriptRun&) = delete;

    /// Outputs off now; then the script is ended. Safe before, during and after the run. Not for a signal handler
    /// itself: call it from the thread that the handler wakes.
    void stop(const char* by) noexcept;
    /// Bench paused; the script waits at its next host call.
    void pause() noexcept;
    void resume() noexcept;
    /// The number of the script's process, to look at it or to end it.
    [[nodiscard]] int processId() const noexcept;
    /// Whether it waits, or will wait at its next host call.
    [[nodiscard]] bool paused() const noexcept;

    /// Blocks until the script has ended. On return the bench is disarmed.
    [[nodiscard]] ScriptOutcome wait();
    /// Waits as wait() does, but gives up after `time`: nothing then, and the script continues.
    [[nodiscard]] std::optional<ScriptOutcome> waitFor(std::chrono::milliseconds time);

private:
    struct State;
    explicit ScriptRun(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// start() and wait() in one.
[[nodiscard]] Result<ScriptOutcome> runProtocol(RunRequest request);

/// Every host object and function: name, parameters, units, errors, as Markdown. The help's reference.
[[nodiscard]] std::string scriptReference();

}  // namespace tacto
