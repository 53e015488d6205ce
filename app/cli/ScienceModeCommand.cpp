// sciencemode: checks of a ScienceMode stimulator that a technician makes before using it.
#include <array>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/ScienceModePulse.h"
#include "app/cli/TextTable.h"
#include "app/run/AllDrivers.h"
#include "core/base/Clock.h"
#include "drivers/sciencemode/ScienceModeDriver.h"

namespace tacto::cli {

namespace {

using nlohmann::json;
using sciencemode::HighVoltage;
using sciencemode::Stimulation;

void declareScienceMode(QCommandLineParser& parser) {
    parser.addOption({"device", "The stimulator (sciencemode:, the one that answers).", "URI"});
    declarePulse(parser);
    parser.addOption({"json", "Prints one JSON value."});
}

Result<sciencemode::Sighting> look(const QCommandLineParser& parser) {
    const auto uri = scienceModeUri(parser);
    if (!uri) return failure(uri);
    const SteadyClock clock;
    const auto ports = scienceModePorts();
    return sciencemode::lookAt(*uri, ports.get(), clock);
}

int identifyIt(const QCommandLineParser& parser) {
    const auto seen = look(parser);
    if (!seen) return failWith(seen.error());
    const auto& who = seen->identification;
    if (parser.isSet("json")) {
        printJson({{"id", who.id},
                   {"firmware", who.firmware.text()},
                   {"protocol", who.protocol.text()},
                   {"place", seen->place},
                   {"simulated", seen->simulated}});
        return kDone;
    }
    TextTable table({"", ""});
    table.add({"identity", who.id + (seen->simulated ? "  (simulated)" : "")});
    table.add({"firmware", who.firmware.text()});
    table.add({"protocol", fmt::format("ScienceMode {}", who.protocol.text())});
    table.add({"plugged in", seen->place});
    table.print();
    return kDone;
}

struct Words {
    const char* name;  ///< key in JSON
    const char* sentence;
};
Words wordsFor(Stimulation status) noexcept {
    switch (status) {
        case Stimulation::None:
            return {"none", "not initialised: it puts nothing out"};
        case Stimulation::LowLevel:
            return {"low level", "initialised for single pulses (low level): it puts out only what it is sent"};
        case Stimulation::MidLevel:
            return {"mid level", "initialised for repeating channels (mid level), none of which runs"};
        case Stimulation::MidLevelRunning:
            return {"mid level running", "RUNNING: its mid-level channels repeat by themselves"};
    }
    return {"unknown", "unknown"};
}

/// Returns the volts of a fixed level, or nothing.
std::optional<int> voltsOf(std::uint8_t level) noexcept {
    const auto first = static_cast<std::uint8_t>(HighVoltage::V30);
    const auto last = static_cast<std::uint8_t>(HighVoltage::V150);
    if (level < first || level > last) return std::nullopt;
    return 30 * (level - first + 1);
}

std::string highVoltageText(std::uint8_t level) {
    if (const auto volts = voltsOf(level)) return fmt::format("{} V", *volts);
    if (level == static_cast<std::uint8_t>(HighVoltage::Default)) return "the device's own";
    if (level == static_cast<std::uint8_t>(HighVoltage::Off)) return "off";
    return fmt::format("unknown (level {}; 0 to 6 are described)", level);
}

int statusOf(const QCommandLineParser& parser) {
    const auto seen = look(parser);
    if (!seen) return failWith(seen.error());
    const auto& status = seen->status;
    const auto words = wordsFor(status.status);
    if (parser.isSet("json")) {
        const auto volts = voltsOf(status.highVoltage);
        printJson({{"id", seen->identification.id},
                   {"place", seen->place},
                   {"simulated", seen->simulated},
                   {"stimulation", words.name},
                   {"running", status.status == Stimulation::MidLevelRunning},
                   {"high_voltage_level", status.highVoltage},
                   {"high_voltage_v", volts ? json(*volts) : json(nullptr)},
                   {"high_voltage", highVoltageText(status.highVoltage)}});
        return kDone;
    }
    TextTable table({"", ""});
    table.add({"stimulator", fmt::format("{} at {}{}", seen->identification.id, seen->place,
                                         seen->simulated ? "  (simulated)" : "")});
    table.add({"stimulation", words.sentence});
    table.add({"high voltage", highVoltageText(status.highVoltage)});
    table.print();
    return kDone;
}

int runScienceMode(const QCommandLineParser& parser) {
    const auto given = parser.positionalArguments();
    if (given.size() != 1) {
        return usage(given.isEmpty() ? std::string("sciencemode: identify, status or pulse is missing")
                                     : fmt::format("sciencemode: one of identify, status and pulse is expected, and "
                                                   "\"{}\" is a second word",
                                                   given.at(1).toStdString()));
    }
    const auto word = given.front().toStdString();
    if (word == "pulse") return pulse(parser);
    if (word != "identify" && word != "status") {
        return usage(fmt::format("sciencemode: there is no \"{}\"; identify, status or pulse is expected", word));
    }
    for (const auto* option : kPulseOptions) {
        if (parser.isSet(option)) return usage(fmt::format("sciencemode {}: --{} belongs to pulse", word, option));
    }
    return word == "identify" ? identifyIt(parser) : statusOf(parser);
}

}  // namespace

const Command kScienceMode{"sciencemode",
                           "{identify | status | pulse --current MA --width US --gap US --load OHM [--yes-bench-load] "
                           "[--reset-fault] [--out FILE.csv]} [--device URI] [--json]",
                           "A ScienceMode stimulator by hand: its identity, its state, one pulse into a bench load",
                           declareScienceMode, runScienceMode};

}  // namespace tacto::cli
