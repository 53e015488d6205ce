#include <nlohmann/json.hpp>

#include "app/cli/Command.h"

namespace tacto::cli {

namespace {

void declare(QCommandLineParser& parser) { parser.addOption({"json", "Prints one JSON value."}); }

int run(const QCommandLineParser& parser) {
    if (!parser.positionalArguments().isEmpty()) {
        return usage(fmt::format("devices takes no argument, and \"{}\" is one",
                                 parser.positionalArguments().front().toStdString()));
    }
    const auto found = makeRegistry().list();
    if (parser.isSet("json")) {
        auto all = nlohmann::json::array();
        for (const auto& device : found) {
            all.push_back({{"uri", device.uri},
                           {"kind", nameOf(device.role)},
                           {"name", device.name},
                           {"serial", device.serial},
                           {"simulated", device.simulated}});
        }
        printJson(all);
        return kDone;
    }
    for (const auto& device : found) {
        fmt::print("{:<20} {:<13} {}{}\n", device.uri, nameOf(device.role), device.name,
                   device.simulated ? "  (simulated)" : "");
    }
    fmt::print(stderr, "sim: alone fills every role that a protocol still needs.\n");
    return kDone;
}

}  // namespace

const Command kDevices{"devices", "[--json]", "What can be opened, as URIs", false, declare, run};

}  // namespace tacto::cli
