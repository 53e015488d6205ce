// ScriptProcess.h - a script in its own process, tactoscope-script, which holds only the engine. If the engine crashes,
// hangs or takes all memory, that process ends and the gate's process continues (hazard H10).
//
// The program limits and distrusts everything that this process sends. A call names a function of the table and hands
// over plain data. Code and text of a failure come from the program, whatever the script does with them.
//
// Thread-safety: one thread makes, loads and runs; end() and awaitEnd() may be called from any thread.
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

/// Receives the calls that scripts make.
class HostPort {
public:
    virtual ~HostPort() = default;
    /// `line`: the script's line with the call; 0 if unknown. A returned error is thrown in the script.
    virtual Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int line) = 0;
};

/// Why and where a script ended.
struct ScriptError {
    ErrorCode code = ErrorCode::InvalidArgument;  ///< of the failed host call; ParseError for script errors
    std::string reason;
    std::string file;
    int line = 0;
    [[nodiscard]] std::string text() const;  ///< "file:line: reason"
};

class ScriptProcess {
public:
    /// Longest processor time that a script may use between two calls; then its process is ended.
    static constexpr std::chrono::seconds kMaxThought{60};

    /// Starts `program`, or tactoscope-script next to this program if it is empty. `memory`: bytes by which the process
    /// may grow. Errors: NotFound if the program is missing; Io if the system cannot start it.
    [[nodiscard]] static Result<std::unique_ptr<ScriptProcess>> start(std::size_t memory,
                                                                      std::filesystem::path program = {});
    /// Ends the process.
    ~ScriptProcess();
    ScriptProcess(const ScriptProcess&) = delete;
    ScriptProcess& operator=(const ScriptProcess&) = delete;

    /// Runs the script's top level. Returns the error, or nothing on success. Ends the process with Timeout after
    /// `limit` (processor time), if given, and with Stopped once `stopped`, which is polled meanwhile, returns true.
    /// `port` must outlive this object.
    [[nodiscard]] std::optional<ScriptError> load(HostPort& port, const ProtocolSource& source,
                                                  std::optional<std::chrono::milliseconds> limit = {},
                                                  std::function<bool()> stopped = {});
    /// Calls run(parameters) of the loaded script.
    [[nodiscard]] std::optional<ScriptError> run(const nlohmann::json& parameters);

    /// Ends the process now. load() and run() return as soon as a running host call has ended.
    void end() noexcept;
    /// Waits until the process has ended. Returns true if end() was called before. Blocks, so give it its own thread.
    [[nodiscard]] bool awaitEnd() const noexcept;
    /// True if the process has ended for any reason. It cannot load or run anything then.
    [[nodiscard]] bool ended() const noexcept;
    [[nodiscard]] pid_t id() const noexcept { return pid_; }
    /// Returns the line of `function run` in the loaded script, or 1.
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
    bool ready_ = false;  // the process has said that it is ready
    const pid_t pid_;
    const int socket_;
    std::atomic<bool> ending_{false};  // end() was called
    std::mutex life_;                  // prevents ending another process that got the same number
    std::atomic<bool> reaped_{false};  // changed with `life_` held
    int status_ = 0;                   // valid once reaped
    HostPort* port_ = nullptr;
    std::function<bool()> stopped_;  // polled while waiting for the process
    std::string file_;
    int lines_ = 0;  // lines in the script
    int runLine_ = 1;
    int lastLine_ = 0;                                     // the line of the last call
    std::deque<std::pair<std::int64_t, Error>> failures_;  // the errors of failed calls, by number
    std::int64_t nextFailure_ = 1;
};

}  // namespace tacto
