// HostFunction.h - the host objects as data: every function a script can call, with the description its reference is
// made from. A function without a description cannot be written down, so none exists.
//
// Thread-safety: the tables are constant; calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

class ScriptSession;

struct HostParameter {
    std::string_view name;  ///< "seconds"; "options.trains" for a member; "[name]" style is the reference's business
    std::string_view type;  ///< "number", "text", "list", "object", "condition" ...
    std::string_view unit;  ///< "s", "ohm"; empty for a number without one and for what is no number
    std::string_view text;  ///< what it is, its range, and its default where it may be left out
    bool optional = false;
};

enum class HostKind {
    Function,  ///< bench.wait(seconds)
    Property,  ///< bench.conditions, computed when read
};

struct HostFunction {
    std::string_view object;  ///< "bench"; empty for a global function
    std::string_view name;
    HostKind kind = HostKind::Function;
    std::vector<HostParameter> parameters;
    std::string_view text;     ///< what it does, one or two sentences
    std::string_view returns;  ///< empty for nothing
    std::string_view errors;   ///< when it throws; empty when it does so for wrong arguments only
    Result<nlohmann::json> (*call)(ScriptSession& session, const nlohmann::json& arguments) = nullptr;
    /// For functions that must hand the script's own values back: an expression for the function, in which `native`
    /// is the call above. Runs in strict mode before the script does.
    std::string_view javascript = {};
};

/// All of them, grouped by object.
[[nodiscard]] const std::vector<HostFunction>& hostFunctions();

// One table per object.
[[nodiscard]] std::vector<HostFunction> benchFunctions();
[[nodiscard]] std::vector<HostFunction> surfaceFunctions();
[[nodiscard]] std::vector<HostFunction> benchStateFunctions();
[[nodiscard]] std::vector<HostFunction> operatorFunctions();
[[nodiscard]] std::vector<HostFunction> recordFunctions();
[[nodiscard]] std::vector<HostFunction> referenceFunctions();
[[nodiscard]] std::vector<HostFunction> absoluteReferenceFunctions();
[[nodiscard]] std::vector<HostFunction> measureFunctions();
[[nodiscard]] std::vector<HostFunction> plotFunctions();
[[nodiscard]] std::vector<HostFunction> generalFunctions();
[[nodiscard]] std::vector<HostFunction> calibrationFunctions();
[[nodiscard]] std::vector<HostFunction> calibrationStoreFunctions();
[[nodiscard]] std::vector<HostFunction> benchLoadFunctions();
[[nodiscard]] std::vector<HostFunction> sensorCalibrationFunctions();
[[nodiscard]] std::vector<HostFunction> sensorScaleFunctions();
[[nodiscard]] std::vector<HostFunction> sensorProfileFunctions();
[[nodiscard]] std::vector<HostFunction> tripFunctions();
[[nodiscard]] std::vector<HostFunction> loadSafetyFunctions();
[[nodiscard]] std::vector<HostFunction> transitionFunctions();
[[nodiscard]] std::vector<HostFunction> stepFunctions();
[[nodiscard]] std::vector<HostFunction> variationFunctions();
[[nodiscard]] std::vector<HostFunction> latencyFunctions();
[[nodiscard]] std::vector<HostFunction> changeFunctions();

}  // namespace tacto
