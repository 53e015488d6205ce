// ScriptRun.h - one run of a protocol script against a bench, on a thread of its own.
//
// Promise (hazard H10): a script acts only through the host objects, from its own process (ScriptProcess.h). stop()
// switches the bench's outputs off without help from the script. Waiting calls return an error, and the script's
// process is ended whatever it does. If that process crashes, the run ends as after an exception. However run() ends,
// the bench is disarmed.
//
// Thread-safety: stop(), pause(), resume() and paused() from any thread, any number of times; only one thread may call
// the wait functions.
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
    /// The declaration from readDeclaration(), as the operator saw it and the session records it. If the running script
    /// declares something else, it is ended before run(p). If empty, the script was not read before and the declaration
    /// of the run is used.
    std::optional<ProtocolDeclaration> declaration = {};
    nlohmann::json parameters = nlohmann::json::object();  ///< as applySettings() returns them
    std::set<std::string> operatorGave;                    ///< names of the parameters that the operator set
    /// Bytes by which the script's process, and the program during the run, may grow. Default: the usual limit of
    /// MemoryGuard.
    std::optional<std::size_t> memoryLimit;
    std::uint64_t seed = 1;
    Bench* bench = nullptr;               ///< for the run alone until it is over, except for stop()
    std::filesystem::path program;        ///< runs instead of tactoscope-script, unless empty
    StopMark asked = {};                  ///< the bench's stops() when the operator requested the run
    SessionWriter* session = nullptr;     ///< null: nothing is recorded
    PilotSession* pilot = nullptr;        ///< the session behind the object `pilot`; null: none
    Operator* operatorDesk = nullptr;     ///< not owned; null: every question fails by name
    std::filesystem::path captureFolder;  ///< each capture is written there as a CSV file; empty: none
    std::function<void(const ScriptProgress&)> onProgress;  ///< on the script's thread; may be empty
    std::function<void(const std::string&)> onLog;          ///< on the script's thread; may be empty
    /// A trial as given to record.trial(), with `condition` and `trial`. Called on the script's thread; may be empty.
    std::function<void(const nlohmann::json&)> onTrial;
    std::function<void(const Capture&)> onCapture;  ///< every capture; on the script's thread; may be empty
};

enum class ScriptVerdict { None, Pass, Fail, Indeterminate, Stopped };
/// None has no word: JSON shows null.
inline constexpr Word<ScriptVerdict> kScriptVerdicts[] = {{"pass", ScriptVerdict::Pass},
                                                          {"fail", ScriptVerdict::Fail},
                                                          {"indeterminate", ScriptVerdict::Indeterminate},
                                                          {"stopped", ScriptVerdict::Stopped}};
/// Returns an empty text for None.
[[nodiscard]] constexpr std::string_view nameOf(ScriptVerdict verdict) noexcept {
    return wordFor(kScriptVerdicts, verdict, "");
}

struct ScriptOutcome {
    ScriptVerdict verdict = ScriptVerdict::None;
    std::vector<std::string> reasons;  ///< reasons for the verdict, one sentence each
    /// The results given with the verdict, or null. After an early end: those of record.partial(), with partial: true.
    nlohmann::json results;
    std::optional<Error> error;  ///< "file:line: reason" if run() did not return
    std::string file;            ///< the file with the error
    int line = 0;
    std::uint64_t expectedFaults = 0;  ///< faults that the script provoked on purpose, found and reset
    std::vector<std::string> log;      ///< the lines from log()
};

class ScriptRun {
public:
    /// Starts the script. Errors: Stopped if the bench was stopped after `request.asked`; InvalidArgument without a
    /// bench; as ScriptProcess::start().
    [[nodiscard]] static Result<std::unique_ptr<ScriptRun>> start(RunRequest request);
    /// Stops the script, then waits like wait().
    ~ScriptRun();
    ScriptRun(const ScriptRun&) = delete;
    ScriptRun& operator=(const ScriptRun&) = delete;

    /// Switches the outputs off, then ends the script. Allowed before, during and after the run. A signal handler must
    /// not call this; the thread that it wakes may.
    void stop(const char* by) noexcept;
    /// Pauses the bench; the script waits at its next host call.
    void pause() noexcept;
    void resume() noexcept;
    /// Returns the process id of the script, for inspecting or ending it.
    [[nodiscard]] int processId() const noexcept;
    /// True if the script waits or will wait at its next host call.
    [[nodiscard]] bool paused() const noexcept;

    /// Blocks until the script has ended; then the bench is disarmed.
    [[nodiscard]] ScriptOutcome wait();
    /// Waits like wait(), but returns nothing after `time`; the script continues.
    [[nodiscard]] std::optional<ScriptOutcome> waitFor(std::chrono::milliseconds time);

private:
    struct State;
    explicit ScriptRun(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Calls start() and wait().
[[nodiscard]] Result<ScriptOutcome> runProtocol(RunRequest request);

/// Returns the reference for the help: every host object and function with parameters, units and errors, as Markdown.
[[nodiscard]] std::string scriptReference();

}  // namespace tacto
