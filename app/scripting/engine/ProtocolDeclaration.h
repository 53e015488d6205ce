// ProtocolDeclaration.h - what a protocol script says about itself before it runs: title, purpose, the devices it
// needs, its parameters with units and ranges, and the questions it may put to an operator.
//
// readDeclaration() runs the script's top level in a separate process (ScriptProcess.h) and without a bench. Nothing
// can be delivered, and a script that hangs or crashes the engine ends only that process.
//
// Thread-safety: values; the functions are pure, but readDeclaration() runs the script on the calling thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/scripting/engine/ProtocolParameter.h"
#include "core/devices/Device.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// A protocol script as text. Errors name `path`.
struct ProtocolSource {
    std::string name;            ///< "separability"
    std::filesystem::path path;  ///< empty if the text is not from a file
    std::string text;
    std::string sha256;    ///< hash of the text's bytes; the library fills it in
    bool shipped = false;  ///< comes with the program, with the same bytes as when the program was built
};

/// Returns the file name that begins a script's errors: its path, or "separability.js".
[[nodiscard]] std::string fileOf(const ProtocolSource& source);
/// Returns where a script comes from, for people to read: "shipped with the program", or its path.
[[nodiscard]] std::string originOf(const ProtocolSource& source);

/// The picture that a window draws while a run produces rows.
enum class ProtocolView {
    Trials,       ///< trains as captured
    Loads,        ///< one row per load of the bench set
    Calibration,  ///< measured values against commanded values
    Slides,       ///< the fingertip sensor without a stimulator
    None,
};

struct ProtocolDeclaration {
    std::string name;
    std::string title;
    std::string purpose;
    std::string kind;  ///< the kind of results that name no `kind` of their own; may be empty
    std::set<Role> needs;
    ProtocolView view = ProtocolView::None;
    std::vector<ProtocolParameter> parameters;  ///< in the order of the script
    std::vector<std::string> questions;  ///< names that the script passes to `operator`; "dmm-*" if only the beginning
                                         ///< is written there; "surface-*" and "fit-load" if its functions may ask them
    bool hasOtherQuestions = false;      ///< some names are computed entirely
};

/// The settings of a run, taken from a list of KEY=VALUE.
struct ProtocolSettings {
    nlohmann::json parameters = nlohmann::json::object();  ///< every declared parameter, with its type
    std::map<std::string, std::string> answers;            ///< answers for `operator`, by question name
    /// Parameters other than choices that the operator set; the others have the script's default.
    std::set<std::string> given;
    std::set<std::string> chosen;  ///< choices that the operator set, even to their defaults
};

/// Runs the script's top level and reads its declaration.
/// Errors: ParseError "file:line: reason" for a script error, a missing protocol(), a missing run(), an unknown key,
/// type or role, a reversed range or a default outside it, a crash of the engine; Timeout if the top level does not end
/// in `limit`; NotFound if the program tactoscope-script is missing; Stopped when `stopped`, if given, returns true.
[[nodiscard]] Result<ProtocolDeclaration> readDeclaration(const ProtocolSource& source,
                                                          std::chrono::milliseconds limit = std::chrono::seconds(1),
                                                          const std::function<bool()>& stopped = {});

/// Reads the argument of protocol(). `order`: the parameters' names in the order of the script; `choiceOrder`: the keys
/// of each parameter's choices. A title has at most 200 characters, other texts 2000. Errors: InvalidArgument naming
/// the key; as parseParameter().
[[nodiscard]] Result<ProtocolDeclaration> parseDeclaration(const nlohmann::json& given, const nlohmann::json& order,
                                                           const nlohmann::json& choiceOrder);

/// Returns how `now` differs from `before` ("another purpose"), or an empty text if they declare the same. Names and
/// questions are not compared, because a script does not declare them.
[[nodiscard]] std::string differenceOf(const ProtocolDeclaration& before, const ProtocolDeclaration& now);

/// Returns the defaults overridden by `settings`. Keys that are not parameters answer the script's questions.
/// Errors: as parseSetting(); InvalidArgument for an unknown key, listing the known ones.
[[nodiscard]] Result<ProtocolSettings> applySettings(const ProtocolDeclaration& declaration,
                                                     const std::map<std::string, std::string>& settings);

/// Returns an element of cli.md's `protocols`: name, title, purpose, kind, needs, view, parameters, questions.
[[nodiscard]] nlohmann::json toJson(const ProtocolDeclaration& declaration);

}  // namespace tacto
