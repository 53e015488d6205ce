#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/cli/Command.h"
#include "app/cli/TextTable.h"
#include "app/run/AllDrivers.h"
#include "app/run/SignalStop.h"

namespace tacto::cli {

namespace {

constexpr std::chrono::milliseconds kPollInterval(250);

void declareDevices(QCommandLineParser& parser) {
    parser.addOption({"json", "Prints one JSON value."});
    parser.addOption(
        {"watch", "Runs until Ctrl+C: prints + for a device that is plugged in, - for one that is unplugged."});
}

TextTable devicesTable() { return TextTable({"", "", ""}); }

void addDevice(TextTable& table, const DeviceIdentity& device, const char* mark) {
    table.add(
        {mark + device.uri, std::string(nameOf(device.role)), device.name + (device.simulated ? "  (simulated)" : "")});
    if (!device.obstacle.empty()) table.addLine("    " + device.obstacle);
}

nlohmann::json toJson(const std::vector<DeviceIdentity>& found) {
    auto all = nlohmann::json::array();
    for (const auto& device : found) {
        all.push_back(
            {{"uri", device.uri},
             {"kind", nameOf(device.role)},
             {"name", device.name},
             {"serial", device.serial},
             {"simulated", device.simulated},
             {"obstacle", device.obstacle.empty() ? nlohmann::json(nullptr) : nlohmann::json(device.obstacle)}});
    }
    return all;
}

/// A device with a changed permission is shown as removed and added.
void watch(const Registry& registry, std::vector<DeviceIdentity> known, const SignalStop& interrupts) {
    const auto addMissing = [](TextTable& table, const auto& from, const auto& in, const char* mark) {
        for (const auto& device : from) {
            if (std::ranges::find(in, device) == in.end()) addDevice(table, device, mark);
        }
    };
    while (!interrupts.signalled()) {
        std::this_thread::sleep_for(kPollInterval);
        auto now = registry.list();
        auto changes = devicesTable();
        addMissing(changes, known, now, "- ");
        addMissing(changes, now, known, "+ ");
        changes.print();
        std::fflush(stdout);
        known = std::move(now);
    }
}

int runDevices(const QCommandLineParser& parser) {
    if (!parser.positionalArguments().isEmpty()) {
        return usage(fmt::format("devices takes no argument, and \"{}\" is one",
                                 parser.positionalArguments().front().toStdString()));
    }
    if (parser.isSet("watch") && parser.isSet("json"))
        return usage("devices --watch goes on and --json prints one value: give one of them");
    const SignalStop interrupts;
    const auto registry = allDrivers()();
    const auto found = registry.list();
    if (parser.isSet("json")) {
        printJson(toJson(found));
        return kDone;
    }
    auto table = devicesTable();
    for (const auto& device : found) addDevice(table, device, parser.isSet("watch") ? "  " : "");
    table.print();
    if (parser.isSet("watch")) {
        std::fflush(stdout);
        watch(registry, found, interrupts);
    } else {
        say(stderr, "sim: alone fills every role that a protocol still needs.\n");
    }
    return kDone;
}

}  // namespace

const Command kDevices{"devices", "[--watch | --json]", "What can be opened, as URIs", declareDevices, runDevices};

}  // namespace tacto::cli
