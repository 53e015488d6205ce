// Sandbox.h - a JavaScript engine that holds ECMAScript and the host objects, and nothing else.
//
// No file, module, network, console or Qt object exists in it. The host objects are frozen and their globals can
// neither be written, deleted nor redefined; scripts run in strict mode, so that an attempt is an error and not
// silence. The one QObject behind them is held in a closure that no script can look into. What would not work here
// (promises, as there is no event loop) or is not ECMAScript's (URL) is taken away; Math.random follows the seed.
//
// Thread-safety: constructed, used and destroyed by one thread; interrupt() from any.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/base/Result.h"

namespace tacto {

/// Receives what scripts call.
class HostPort {
public:
    virtual ~HostPort() = default;
    /// `line`: where in the script the call stands; 0 when unknown. An error is thrown in the script.
    virtual Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int line) = 0;
};

/// Why a script ended: what was thrown, and from where.
struct ScriptError {
    ErrorCode code = ErrorCode::InvalidArgument;  ///< of the host call that failed, ParseError for the script's own
    std::string reason;
    std::string file;
    int line = 0;
    [[nodiscard]] std::string text() const;  ///< "file:line: reason"
};

class Sandbox {
public:
    /// `port` outlives the sandbox.
    Sandbox(HostPort& port, const ProtocolSource& source);
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    /// Runs the script's top level. The error, or nothing when it went well.
    [[nodiscard]] std::optional<ScriptError> load();
    /// Calls run(parameters).
    [[nodiscard]] std::optional<ScriptError> run(const nlohmann::json& parameters);

    /// Ends the script at its next statement. Any thread. Cannot end a native call, such as a sort.
    void interrupt() noexcept;
    /// Line of `function run`, or 1.
    [[nodiscard]] int runLine() const noexcept { return runLine_; }

private:
    struct Engine;  // Qt stays out of this header
    std::unique_ptr<Engine> engine_;
    const int runLine_;
};

}  // namespace tacto
