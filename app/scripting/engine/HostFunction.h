// HostFunction.h - the host objects as data: every function that a script can call, with its description. Arguments are
// checked against the description, the reference is made from it, and no function can be defined without one.
//
// Thread-safety: the tables are constant; calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/scripting/engine/HostParameter.h"
#include "core/base/Result.h"
#include "core/devices/Device.h"

namespace tacto {

class Arguments;
class ScriptSession;

/// Runs a host function with arguments that fit its parameters.
using HostCall = Result<nlohmann::json>(ScriptSession& session, const Arguments& arguments);

enum class HostKind {
    Function,  ///< bench.wait(seconds)
    Property,  ///< bench.conditions, computed when read
};

struct HostFunction {
    /// "bench", "bench.loadSafety"; empty for a global function. Set by hostFunctions().
    std::string_view object = {};
    std::string_view name = {};
    HostKind kind = HostKind::Function;
    std::vector<HostParameter> parameters = {};
    std::string_view text = {};               ///< what the function does, in one or two sentences
    std::vector<std::string> members = {};    ///< keys of the record that it returns, if an analysis describes them
    std::string_view returns = {};            ///< what is to be said of the result; empty if it returns nothing
    std::string_view errors = {};             ///< when it throws; empty if it throws only for wrong arguments
    std::vector<std::string_view> asks = {};  ///< questions to the operator that a search of the script reports
    std::optional<Role> needs = {};           ///< the call fails without a device of this role
    bool failsDisarmed = false;               ///< any failure disarms the output, also one caused by wrong arguments
    HostCall* call = nullptr;
    /// For functions that must return the script's own values: a JavaScript expression for the function. In it,
    /// `native` is `call` above. Evaluated in strict mode before the script runs.
    std::string_view javascript = {};
    std::vector<HostParameter> passes = {};  ///< the parameters of `native`, if they differ from `parameters`

    /// Returns "bench.wait", or "progress" for a global function.
    [[nodiscard]] std::string fullName() const;
};

/// Returns all functions, grouped by object.
[[nodiscard]] const std::vector<HostFunction>& hostFunctions();

/// Returns the option with this path ("analysis.variation.detection_ma"), or null if there is none.
[[nodiscard]] const HostParameter* hostOption(std::string_view path);

}  // namespace tacto
