// Sandbox.h - a JavaScript engine that holds ECMAScript and the host objects, and nothing else.
//
// No file, module, network, console or Qt object exists in it. The host objects are frozen and their globals can
// neither be written, deleted nor redefined; scripts run in strict mode, so that an attempt is an error and not
// silence. The one QObject behind them is held in a closure that no script can look into. What would not work here
// (promises, as there is no event loop) or is not ECMAScript's (URL) is taken away; Math.random follows the seed.
//
// Thread-safety: constructed, used and destroyed by one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tacto {

/// A host function as scripts see it.
struct SeenFunction {
    std::string object;  ///< empty for a global function
    std::string name;
    bool property = false;   ///< computed when read
    std::string javascript;  ///< HostFunction::javascript
};

/// The outcome of a call.
struct HostAnswer {
    nlohmann::json value;
    std::optional<std::int64_t> failure = {};  ///< the program's number for it: it threw
    int code = 0;                              ///< the failure's code
    std::string text;                          ///< what the operator reads
};

/// Receives what scripts call.
class HostCalls {
public:
    virtual ~HostCalls() = default;
    /// `function`: its place in the table. `line`: where in the script the call stands; 0 when unknown.
    virtual HostAnswer call(int function, const nlohmann::json& arguments, int line) = 0;
    /// Answers a call whose arguments cannot be handed over.
    virtual HostAnswer refuse(int function, const std::string& why) = 0;
};

/// What a script threw.
struct Thrown {
    std::string reason;
    int line = 0;                              ///< 0 when unknown
    std::optional<std::int64_t> failure = {};  ///< the failure of the call itself
    bool outOfMemory = false;
};

class Sandbox {
public:
    /// `calls` outlives the sandbox. `file`: as errors name it.
    Sandbox(HostCalls& calls, const std::vector<SeenFunction>& functions, std::string file, std::string text);
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    /// Runs the script's top level. What it threw, or nothing when it went well.
    [[nodiscard]] std::optional<Thrown> load();
    /// Calls run(parameters).
    [[nodiscard]] std::optional<Thrown> run(const nlohmann::json& parameters);

private:
    struct Engine;  // Qt stays out of this header
    std::unique_ptr<Engine> engine_;
};

}  // namespace tacto
