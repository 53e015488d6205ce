// ProtocolDeclaration.h - what a protocol script says about itself before it runs: title, purpose, the devices it
// needs, its parameters with units and ranges, and the questions it may put to an operator.
//
// The declaration is read by running the script's top level in a process of its own (ScriptProcess.h) and without a
// bench: nothing can be delivered, and one that does not end or makes the engine crash ends that process alone.
//
// Thread-safety: values; the functions are pure but for the thread that they run the script on.
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

/// A protocol script as text. `path` is what its errors name.
struct ProtocolSource {
    std::string name;            ///< "separability"
    std::filesystem::path path;  ///< may be empty for a text that lies in no file
    std::string text;
    std::string sha256;    ///< hash of the text's bytes; the library fills it in
    bool shipped = false;  ///< comes with the program: its bytes are those that the program was built with
};

/// The beginning of a script's errors: its path, or "separability.js".
[[nodiscard]] std::string fileOf(const ProtocolSource& source);
/// Where a script comes from, for people: "shipped with the program", or its path.
[[nodiscard]] std::string originOf(const ProtocolSource& source);

/// The picture that a window draws while a run's rows come.
enum class ProtocolView {
    Trials,       ///< trains as captured
    Loads,        ///< a row per load of the bench set
    Calibration,  ///< measured against commanded
    Slides,       ///< a fingertip by itself
    None,
};

struct ProtocolDeclaration {
    std::string name;
    std::string title;
    std::string purpose;
    std::string kind;  ///< what its results are: the `kind` of those that name none. May be empty
    std::set<Role> needs;
    ProtocolView view = ProtocolView::None;
    std::vector<ProtocolParameter> parameters;  ///< as written
    std::vector<std::string> questions;  ///< names the script's text passes to `operator`, "dmm-*" where only the
                                         ///< beginning stands there; "surface-*" and "fit-load" where it uses
                                         ///< functions that may ask those
    bool hasOtherQuestions = false;      ///< whole names are computed, too
};

/// The settings that a run takes out of a list of KEY=VALUE.
struct ProtocolSettings {
    nlohmann::json parameters = nlohmann::json::object();  ///< every declared parameter, typed
    std::map<std::string, std::string> answers;            ///< for `operator`, by question name
    /// The parameters (choices apart) that are the operator's word and not the script's default.
    std::set<std::string> given;
    std::set<std::string> chosen;  ///< choices that were set, also to their defaults
};

/// Runs the script's top level and reads what it declares.
/// Errors: ParseError "file:line: reason" for a script error, a missing protocol(), a missing run(), an unknown key,
/// type or role, a range upside down or a default outside it, a crash of the engine; Timeout when the top level does
/// not end in `limit`; NotFound where the program tactoscope-script is missing; Stopped once `stopped`, where there is
/// one, says so.
[[nodiscard]] Result<ProtocolDeclaration> readDeclaration(const ProtocolSource& source,
                                                          std::chrono::milliseconds limit = std::chrono::seconds(1),
                                                          const std::function<bool()>& stopped = {});

/// Reads what protocol() was given. `order` and `choiceOrder`: the parameters' names as written, and the keys of each
/// one's choices. A title has at most 200 characters, any other text 2000. Errors: InvalidArgument naming the key; as
/// parseParameter().
[[nodiscard]] Result<ProtocolDeclaration> parseDeclaration(const nlohmann::json& given, const nlohmann::json& order,
                                                           const nlohmann::json& choiceOrder);

/// How `now` differs from `before`, as "another purpose"; empty where they declare the same. Names and questions are
/// not compared: a script does not declare those.
[[nodiscard]] std::string differenceOf(const ProtocolDeclaration& before, const ProtocolDeclaration& now);

/// Defaults overridden by `settings`; keys that are not parameters answer the script's questions.
/// Errors: as parseSetting(); InvalidArgument for an unknown key, listing the known ones.
[[nodiscard]] Result<ProtocolSettings> applySettings(const ProtocolDeclaration& declaration,
                                                     const std::map<std::string, std::string>& settings);

/// An element of cli.md's `protocols`: name, title, purpose, kind, needs, view, parameters, questions.
[[nodiscard]] nlohmann::json toJson(const ProtocolDeclaration& declaration);

}  // namespace tacto
