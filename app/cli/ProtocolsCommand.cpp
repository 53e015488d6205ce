#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/scripting/ProtocolLibrary.h"
#include "app/scripting/ScriptRun.h"

namespace tacto::cli {

namespace {

void declare(QCommandLineParser& parser) {
    parser.addOption({"json", "Prints one JSON value."});
    parser.addOption({"reference", "Prints what scripts may call, as Markdown."});
}

std::string rangeOf(const nlohmann::json& parameter) {
    std::string text;
    if (parameter.contains("choices")) {
        for (const auto& [key, label] : parameter["choices"].items()) text += (text.empty() ? "" : " | ") + key;
    } else if (parameter.contains("min") && !parameter["min"].is_null()) {
        text = fmt::format("{} to {}", parameter["min"].dump(),
                           parameter.contains("max") ? parameter["max"].dump() : "any");
    }
    return text;
}

int run(const QCommandLineParser& parser) {
    if (parser.isSet("reference")) {
        fmt::print("{}", scriptReference());
        return kDone;
    }
    auto all = nlohmann::json::array();
    bool broken = false;
    for (const auto& source : ProtocolLibrary().list()) {
        const auto declaration = readDeclaration(source);
        if (!declaration) {
            fmt::print(stderr, "tactoscope-cli: {} is left out: {}\n", source.name, declaration.error().message);
            broken = true;
            continue;
        }
        all.push_back(toJson(*declaration));
    }
    if (parser.isSet("json")) {
        printJson(all);
        return broken ? kCouldNotRun : kDone;
    }
    for (const auto& protocol : all) {
        fmt::print("{}: {}\n", protocol["name"].get<std::string>(), protocol["title"].get<std::string>());
        for (const auto& parameter : protocol["parameters"]) {
            fmt::print(
                "    --set {}={}{}{}   {}  {}\n", parameter["name"].get<std::string>(),
                parameter["value"].is_string() ? parameter["value"].get<std::string>() : parameter["value"].dump(),
                parameter.value("unit", "").empty() ? "" : " ", parameter.value("unit", ""),
                parameter.value("label", ""), rangeOf(parameter).empty() ? "" : "(" + rangeOf(parameter) + ")");
        }
    }
    return broken ? kCouldNotRun : kDone;
}

}  // namespace

const Command kProtocols{
    "protocols", "[--json] [--reference]", "Shipped and user protocols with their parameters", false, declare, run};

}  // namespace tacto::cli
