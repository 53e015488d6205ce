// ScriptProcess.h - a script in a process of its own, tactoscope-script: it holds the engine and nothing else, so that
// what makes the engine crash, hang or take all memory ends that process and not the gate's (hazard H10).
//
// What comes from it is bounded and read like a stranger's word: a call names a function of the table and hands over
// plain data; the code and the sentence of a failure are the program's own, whatever the script does with it.
//
// Thread-safety: one thread makes, loads and runs; end() and awaitEnd() from any.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <sys/types.h>
#include <utility>

#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "app/scripting/wire/ScriptMessage.h"
#include "core/base/Result.h"

namespace tacto {

/// Receives what scripts call.
class HostPort {
public:
    virtual ~HostPort() = default;
    /// `line`: where in the script the call stands; 0 when unknown. An error is thrown in the script.
    virtual Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int line) = 0;
};

/// Why a script ended: what was thrown, and where.
struct ScriptError {
    ErrorCode code = ErrorCode::InvalidArgument;  ///< the failed host call's code; ParseError for errors of the script
    std::string reason;
    std::string file;
    int line = 0;
    [[nodiscard]] std::string text() const;  ///< "file:line: reason"
};

class ScriptProcess {
public:
    /// How long a script may compute between two calls, in the processor's time; more ends it.
    static constexpr std::chrono::seconds kMaxThought{60};

    /// Starts `program`; where that is empty tactoscope-script, which is beside this one. `memory`: bytes by which it
    /// may grow. Errors: NotFound where it is missing; Io where the system starts nothing.
    [[nodiscard]] static Result<std::unique_ptr<ScriptProcess>> start(std::size_t memory,
                                                                      std::filesystem::path program = {});
    /// Ends the process.
    ~ScriptProcess();
    ScriptProcess(const ScriptProcess&) = delete;
    ScriptProcess& operator=(const ScriptProcess&) = delete;

    /// Runs the script's top level. The error, or nothing when it went well. After `limit` of the processor's time,
    /// where there is one, the process is ended: Timeout; and once `stopped` says so, which is asked meanwhile:
    /// Stopped. `port` outlives this.
    [[nodiscard]] std::optional<ScriptError> load(HostPort& port, const ProtocolSource& source,
                                                  std::optional<std::chrono::milliseconds> limit = {},
                                                  std::function<bool()> stopped = {});
    /// Calls run(parameters) of the script that was loaded.
    [[nodiscard]] std::optional<ScriptError> run(const nlohmann::json& parameters);

    /// Ends the process now. load() and run() return, once a call that is under way has ended.
    void end() noexcept;
    /// Waits until the process has ended; returns whether it was asked to. For a thread that does nothing else.
    [[nodiscard]] bool awaitEnd() const noexcept;
    /// Whether it has ended, by itself or not: it loads and runs nothing any longer.
    [[nodiscard]] bool ended() const noexcept;
    [[nodiscard]] pid_t id() const noexcept { return pid_; }
    /// Line of `function run` in the loaded script, or 1.
    [[nodiscard]] int runLine() const noexcept { return runLine_; }

private:
    ScriptProcess(pid_t pid, int socket) : pid_(pid), socket_(socket) {}
    [[nodiscard]] Result<void> introduce(std::size_t memory);
    [[nodiscard]] std::optional<ScriptError> serve(const nlohmann::json& message,
                                                   std::optional<std::chrono::milliseconds> limit);
    class Patience;
    [[nodiscard]] std::optional<Result<void>> answer(const nlohmann::json& message, Patience& patience);
    [[nodiscard]] WhileWaiting watching(const Patience& patience) const;
    [[nodiscard]] bool endsWithin(std::chrono::milliseconds time) const noexcept;
    [[nodiscard]] ScriptError error(ErrorCode code, std::string reason, int line = 0) const;
    [[nodiscard]] std::optional<ScriptError> endedBy(const nlohmann::json& ended) const;
    [[nodiscard]] ScriptError lost(const Error& why);
    [[nodiscard]] nlohmann::json remember(Error error);
    void reap() noexcept;

    static constexpr std::size_t kFailures = 256;
    bool ready_ = false;  // it has said that it is ready
    const pid_t pid_;
    const int socket_;
    std::atomic<bool> ending_{false};  // asked to
    std::mutex life_;                  // so that no other process with its number is ended
    std::atomic<bool> reaped_{false};  // changed under it
    int status_ = 0;                   // once reaped
    HostPort* port_ = nullptr;
    std::function<bool()> stopped_;  // asked while the process is waited for
    std::string file_;
    int lines_ = 0;  // lines in the script
    int runLine_ = 1;
    int lastLine_ = 0;                                     // the line of the last call
    std::deque<std::pair<std::int64_t, Error>> failures_;  // the errors of failed calls, by number
    std::int64_t nextFailure_ = 1;
};

}  // namespace tacto
