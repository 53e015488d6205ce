#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptRun.h"

namespace tacto {

const std::vector<HostFunction>& hostFunctions() {
    static const std::vector<HostFunction> all = [] {
        std::vector<HostFunction> out;
        for (auto* part : {generalFunctions,
                           benchFunctions,
                           surfaceFunctions,
                           benchStateFunctions,
                           operatorFunctions,
                           recordFunctions,
                           referenceFunctions,
                           absoluteReferenceFunctions,
                           measureFunctions,
                           plotFunctions,
                           benchLoadFunctions,
                           tripFunctions,
                           loadSafetyFunctions,
                           calibrationFunctions,
                           calibrationStoreFunctions,
                           sensorCalibrationFunctions,
                           sensorScaleFunctions,
                           sensorProfileFunctions,
                           transitionFunctions,
                           stepFunctions,
                           variationFunctions,
                           latencyFunctions,
                           changeFunctions}) {
            auto functions = part();
            out.insert(out.end(), std::make_move_iterator(functions.begin()), std::make_move_iterator(functions.end()));
        }
        return out;
    }();
    return all;
}

namespace {

std::string heading(const HostFunction& function) {
    std::string out(function.object);
    if (!out.empty()) out += '.';
    out += function.name;
    if (function.kind == HostKind::Property) return out;
    out += '(';
    std::string members;
    bool first = true;
    for (const auto& parameter : function.parameters) {
        constexpr std::string_view kOptions = "options.";
        if (parameter.name.starts_with(kOptions)) {
            members += members.empty() ? "" : ", ";
            members += parameter.name.substr(kOptions.size());
            continue;
        }
        out += first ? "" : ", ";
        out += parameter.name;
        first = false;
    }
    if (!members.empty()) out += (first ? "{ " : ", { ") + members + " }";
    return out + ')';
}

}  // namespace

std::string scriptReference() {
    std::string out =
        "# What a protocol script can call\n\n"
        "A script calls protocol() once at top level and defines run(p), where p holds the parameters. Everything here "
        "may be used inside run(p) only. A function that fails throws an Error with a sentence for the operator; its "
        "`limit` is true where a safety limit forbade what was asked for. Uncaught, it ends the run with the output "
        "off. Arming that the operator did not confirm ends the run in any case.\n";
    // Tables may name an object twice; the reference lists it once.
    std::vector<std::string_view> objects;
    for (const auto& function : hostFunctions()) {
        if (std::find(objects.begin(), objects.end(), function.object) == objects.end()) {
            objects.push_back(function.object);
        }
    }
    for (const auto object : objects) {
        out += fmt::format("\n## {}\n", object.empty() ? "Functions by themselves" : object);
        for (const auto& function : hostFunctions()) {
            if (function.object != object) continue;
            out += fmt::format("\n### `{}`\n\n{}\n", heading(function), function.text);
            for (const auto& parameter : function.parameters) {
                out += fmt::format("- `{}`{}: {}{}{}\n", parameter.name, parameter.optional ? " (optional)" : "",
                                   parameter.type, parameter.unit.empty() ? "" : fmt::format(" in {}", parameter.unit),
                                   parameter.text.empty() ? "" : fmt::format("; {}", parameter.text));
            }
            if (!function.returns.empty()) out += fmt::format("\nReturns: {}\n", function.returns);
            if (!function.errors.empty()) out += fmt::format("\n{}\n", function.errors);
        }
    }
    return out;
}

}  // namespace tacto
