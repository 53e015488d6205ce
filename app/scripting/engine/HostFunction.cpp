#include "app/scripting/engine/HostFunction.h"

#include "app/scripting/engine/ScriptRun.h"

namespace tacto {

/// The tables of functions. Each table is in the same file as its functions.
using HostTable = std::vector<HostFunction>();
HostTable generalFunctions, randomFunctions, outputFunctions, captureFunctions, surfaceFunctions, stateFunctions,
    settingFunctions, knownLoadFunctions, absoluteReferenceFunctions, fingertipFunctions, loadSafetyFunctions,
    stimulatorCalibrationFunctions, sensorCalibrationFunctions, transitionFunctions, encodingComparisonFunctions,
    variationFunctions, operatorFunctions, pilotFunctions, rowFunctions, referenceFunctions, calibrationRecords,
    reportFunctions, trainFunctions, pulseFunctions, separabilityAnalysis, calibrationAnalysis, transitionAnalysis,
    variationAnalysis, plotFunctions;

std::string HostFunction::fullName() const {
    return object.empty() ? std::string(name) : fmt::format("{}.{}", object, name);
}

const std::vector<HostFunction>& hostFunctions() {
    static const std::vector<HostFunction> all = [] {
        std::vector<HostFunction> out;
        // An object must come after the object that contains it.
        const std::pair<std::string_view, std::vector<HostTable*>> objects[] = {
            {"", {generalFunctions}},
            {"random", {randomFunctions}},
            {"bench",
             {outputFunctions, captureFunctions, surfaceFunctions, stateFunctions, settingFunctions, knownLoadFunctions,
              absoluteReferenceFunctions, fingertipFunctions}},
            {"bench.loadSafety", {loadSafetyFunctions}},
            {"bench.stimulatorCalibration", {stimulatorCalibrationFunctions}},
            {"bench.sensorCalibration", {sensorCalibrationFunctions}},
            {"bench.transitions", {transitionFunctions}},
            {"bench.encodingComparison", {encodingComparisonFunctions}},
            {"bench.variation", {variationFunctions}},
            {"operator", {operatorFunctions}},
            {"pilot", {pilotFunctions}},
            {"record", {rowFunctions, referenceFunctions, calibrationRecords}},
            {"report", {reportFunctions}},
            {"measure", {trainFunctions, pulseFunctions}},
            {"analysis", {separabilityAnalysis, calibrationAnalysis, transitionAnalysis, variationAnalysis}},
            {"plot", {plotFunctions}},
        };
        for (const auto& [object, tables] : objects) {
            for (const auto table : tables) {
                for (auto& function : table()) {
                    function.object = object;
                    out.push_back(std::move(function));
                }
            }
        }
        return out;
    }();
    return all;
}

const HostParameter* hostOption(std::string_view path) {
    const auto dot = path.rfind('.');
    if (dot == std::string_view::npos) return nullptr;
    const auto functionName = path.substr(0, dot), option = path.substr(dot + 1);
    for (const auto& function : hostFunctions()) {
        if (function.fullName() != functionName) continue;
        for (const auto& parameter : function.parameters) {
            const auto& name = parameter.name;
            if (name.starts_with(kOptionPrefix) && name.substr(kOptionPrefix.size()) == option) return &parameter;
        }
    }
    return nullptr;
}

namespace {

/// Returns "bench.capture({ trains, rate_hz })": members are listed for the options only.
std::string heading(const HostFunction& function) {
    if (function.kind == HostKind::Property) return function.fullName();
    std::vector<std::string_view> arguments, members;
    for (const auto& parameter : function.parameters) {
        const bool option = parameter.name.starts_with(kOptionPrefix);
        const auto name = option ? parameter.name.substr(kOptionPrefix.size()) : parameter.name;
        if (name.find('.') == std::string_view::npos) (option ? members : arguments).push_back(name);
    }
    const std::string options = members.empty() ? "" : fmt::format("{{ {} }}", fmt::join(members, ", "));
    return fmt::format("{}({}{}{})", function.fullName(), fmt::join(arguments, ", "),
                       arguments.empty() || members.empty() ? "" : ", ", options);
}

std::string describe(const HostParameter& parameter) {
    std::string out =
        fmt::format("- `{}`{}: {}", parameter.name, parameter.mayBeLeftOut ? " (optional)" : "", parameter.accepted());
    if (!parameter.unit.empty()) out += fmt::format(" in {}", parameter.unit);
    if (!parameter.about.empty()) out += fmt::format("; {}", parameter.about);
    if (const auto usual = parameter.defaultText(); !usual.empty()) out += fmt::format("; {} where left out", usual);
    return out + '\n';
}

}  // namespace

std::string scriptReference() {
    std::string out =
        "# What a protocol script can call\n\n"
        "A script calls protocol() once at top level and defines run(p), where p holds the parameters. Everything here "
        "may be used inside run(p) only. A function that fails throws an Error with a sentence for the operator; its "
        "`limit` is true where a safety limit forbade what was asked for. Uncaught, it ends the run with the output "
        "off. Arming that the operator did not confirm ends the run in any case.\n";
    std::string_view object = "none yet";
    for (const auto& function : hostFunctions()) {
        if (function.object != object) {
            object = function.object;
            out += fmt::format("\n## {}\n", object.empty() ? "Functions by themselves" : object);
        }
        out += fmt::format("\n### `{}`\n\n{}\n", heading(function), function.text);
        for (const auto& parameter : function.parameters) out += describe(parameter);
        if (!function.returns.empty()) {
            const auto members =
                function.members.empty() ? "" : fmt::format("{{ {} }}", fmt::join(function.members, ", "));
            out += fmt::format("\nReturns: {}{}\n", members, function.returns);
        }
        if (!function.errors.empty()) out += fmt::format("\n{}\n", function.errors);
    }
    return out;
}

}  // namespace tacto
