// Sandbox.h - a JavaScript engine with only ECMAScript and the host objects.
//
// Scripts find no file, module, network, console or Qt object here. The host objects are frozen, and their globals
// cannot be written, deleted or redefined. Scripts run in strict mode, so that such an attempt throws an error. The
// only QObject behind the host objects is held in a closure that no script can look into. Promises (there is no event
// loop) and everything outside ECMAScript (URL) are removed; Math.random follows the seed.
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
    std::optional<std::int64_t> failure = {};  ///< set if the call threw: the program's number of this failure
    int code = 0;                              ///< the failure's code
    std::string text;                          ///< the failure's sentence for the operator
};

/// Receives the calls that scripts make.
class HostCalls {
public:
    virtual ~HostCalls() = default;
    /// `function`: index in the table. `line`: the script's line with the call; 0 if unknown.
    virtual HostAnswer call(int function, const nlohmann::json& arguments, int line) = 0;
    /// Answers a call with arguments that cannot be handed over.
    virtual HostAnswer refuse(int function, const std::string& why) = 0;
};

/// An exception from a script.
struct Thrown {
    std::string reason;
    int line = 0;                              ///< 0 if unknown
    std::optional<std::int64_t> failure = {};  ///< the failed host call, if its own error was thrown
    bool outOfMemory = false;
};

class Sandbox {
public:
    /// `calls` must outlive the sandbox. `file`: the script's name in errors.
    Sandbox(HostCalls& calls, const std::vector<SeenFunction>& functions, std::string file, std::string text);
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    /// Runs the script's top level. Returns the exception, or nothing on success.
    [[nodiscard]] std::optional<Thrown> load();
    /// Calls run(parameters).
    [[nodiscard]] std::optional<Thrown> run(const nlohmann::json& parameters);

private:
    struct Engine;  // Qt stays out of this header
    std::unique_ptr<Engine> engine_;
};

}  // namespace tacto
