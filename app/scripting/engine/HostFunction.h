// HostFunction.h - the host objects as data: every function a script can call, with the description that its arguments
// are checked against and its reference is made from. A function without a description cannot be written down.
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

/// A host function: it runs with arguments that fit its parameters.
using HostCall = Result<nlohmann::json>(ScriptSession& session, const Arguments& arguments);

enum class HostKind {
    Function,  ///< bench.wait(seconds)
    Property,  ///< bench.conditions, computed when read
};

struct HostFunction {
    /// "bench", "bench.loadSafety"; empty for a global function; set by hostFunctions().
    std::string_view object = {};
    std::string_view name = {};
    HostKind kind = HostKind::Function;
    std::vector<HostParameter> parameters = {};
    std::string_view text = {};               ///< what it does, one or two sentences
    std::string_view returns = {};            ///< empty for nothing
    std::string_view errors = {};             ///< when it throws; empty when only wrong arguments make it throw
    std::vector<std::string_view> asks = {};  ///< questions to the operator that scripts are searched for
    std::optional<Role> needs = {};           ///< without a device of this role the call fails
    bool failsDisarmed = false;               ///< a failure, of its arguments too, leaves the output disarmed
    HostCall* call = nullptr;
    /// Serves functions that must hand the script's own values back: an expression for the function, in which `native`
    /// is the call above. Runs in strict mode before the script does.
    std::string_view javascript = {};
    std::vector<HostParameter> passes = {};  ///< the parameters passed to `native`, where those are not `parameters`

    /// "bench.wait", "progress".
    [[nodiscard]] std::string fullName() const;
};

/// All functions, grouped by object.
[[nodiscard]] const std::vector<HostFunction>& hostFunctions();

/// The option with that path, "analysis.variation.detection_ma". Null if there is none.
[[nodiscard]] const HostParameter* hostOption(std::string_view path);

}  // namespace tacto
