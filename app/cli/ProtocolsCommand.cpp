#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/TextTable.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/JsonText.h"

namespace tacto::cli {

namespace {

void declareProtocols(QCommandLineParser& parser) {
    parser.addOption({"json", "Prints one JSON value."});
    parser.addOption({"reference", "Prints what scripts may call, as Markdown."});
}

/// Returns a member as text; empty if it is absent or null.
std::string textOf(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || found->is_null()) return {};
    if (found->is_number()) return fmt::format("{:g}", found->get<double>());
    return found->is_string() ? found->get<std::string>() : dumpJson(*found);
}

std::string rangeOf(const nlohmann::json& parameter) {
    std::string text;
    if (const auto choices = parameter.find("choices"); choices != parameter.end() && choices->is_array()) {
        for (const auto& choice : *choices) text += (text.empty() ? "" : " | ") + textOf(choice, "value");
    } else if (!textOf(parameter, "min").empty() || !textOf(parameter, "max").empty()) {
        text = fmt::format("{} to {}", textOf(parameter, "min"), textOf(parameter, "max"));
    }
    if (const auto zero = textOf(parameter, "zero"); !zero.empty())
        text += fmt::format("{}0: {}", text.empty() ? "" : "; ", zero);
    return text;
}

int runProtocols(const QCommandLineParser& parser) {
    if (parser.isSet("reference")) {
        say("{}", lines(scriptReference()));
        return kDone;
    }
    auto all = nlohmann::json::array();
    bool broken = false;
    const ProtocolLibrary library;
    for (const auto& refused : library.refused()) {
        say(stderr, "tactoscope-cli: left out: {}\n", refused.why);
        broken = true;
    }
    for (const auto& source : library.list()) {
        const auto declaration = readDeclaration(source);
        if (!declaration) {
            say(stderr, "tactoscope-cli: {} is left out: {}\n", source.name, lines(declaration.error().message));
            broken = true;
            continue;
        }
        all.push_back(toJson(*declaration));
        all.back()["from"] = originOf(source);
    }
    if (parser.isSet("json")) {
        printJson(all);
        return broken ? kCouldNotRun : kDone;
    }
    for (const auto& protocol : all) {
        say("{}: {} ({})\n", textOf(protocol, "name"), textOf(protocol, "title"), textOf(protocol, "from"));
        TextTable table({"", ""});
        for (const auto& parameter : protocol["parameters"]) {
            const auto range = rangeOf(parameter);
            const auto unit = textOf(parameter, "unit");
            table.add({fmt::format("  --set {}={}{}{}", textOf(parameter, "name"), textOf(parameter, "value"),
                                   unit.empty() ? "" : "   ", unit),
                       textOf(parameter, "label") + (range.empty() ? "" : " (" + range + ")")});
        }
        table.print();
    }
    return broken ? kCouldNotRun : kDone;
}

}  // namespace

const Command kProtocols{"protocols", "[--json] [--reference]", "Shipped and user protocols with their parameters",
                         declareProtocols, runProtocols};

}  // namespace tacto::cli
