#include "drivers/sciencemode/ScienceModeDriver.h"

#include <algorithm>
#include <optional>

#include "core/base/Text.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "drivers/sciencemode/TtyTransport.h"

namespace tacto {
namespace sciencemode {
namespace {

struct Wanted {
    StimulatorSettings settings;
    std::optional<std::string> terminal;
};

std::optional<HighVoltage> highVoltageOf(std::string_view text) {
    const auto volts = parseQuantity(text, "V");
    if (!volts) return std::nullopt;
    for (const auto& [level, name] : {std::pair{30.0, HighVoltage::V30},
                                      {60.0, HighVoltage::V60},
                                      {90.0, HighVoltage::V90},
                                      {120.0, HighVoltage::V120},
                                      {150.0, HighVoltage::V150}}) {
        if (*volts == level) return name;
    }
    return std::nullopt;
}

/// Takes one parameter. Nothing when it is well; else what is accepted.
std::optional<std::string> take(std::string_view key, std::string_view value, Wanted& into) {
    auto& settings = into.settings;
    if (key == "channel") {
        const auto number = parseNumber(value);
        if (!number || !(*number == 0 || *number == 1 || *number == 2 || *number == 3)) return "0, 1, 2 or 3";
        settings.channel = static_cast<int>(*number);
    } else if (key == "connector") {
        if (value != "yellow" && value != "green") return "yellow or green";
        settings.connector = value == "green" ? 1 : 0;
    } else if (key == "level") {
        if (value != "low" && value != "mid") return "low or mid";
        settings.midLevel = value == "mid";
    } else if (key == "measure") {
        if (value != "voltage" && value != "current") return "voltage or current";
        settings.measurement = value == "voltage" ? Measurement::Voltage : Measurement::Current;
    } else if (key == "voltage") {
        const auto level = highVoltageOf(value);
        if (!level) return "30, 60, 90, 120 or 150 V";
        settings.highVoltage = *level;
    } else if (key == "tty") {
        if (value.empty()) return "a terminal's path, as /dev/ttyACM0";
        into.terminal = value;
    } else {
        return "there is no such parameter: it takes channel, connector, level, measure, voltage, tty";
    }
    return std::nullopt;
}

Result<Wanted> readUri(const DeviceUri& uri) {
    Wanted wanted;
    std::vector<std::string_view> seen;
    for (const auto& [key, value] : uri.parameters) {
        if (std::ranges::find(seen, key) != seen.end()) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": {} is given twice", uri.text(), key);
        }
        seen.push_back(key);
        if (const auto accepted = take(key, value, wanted)) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": {}={} is not accepted: {}", uri.text(), key, value,
                        *accepted);
        }
    }
    return wanted;
}

/// Opens the port that was opened before, wherever it is plugged in now.
Connect connectTo(std::shared_ptr<TransportPorts> ports, TransportPort port) {
    return [ports = std::move(ports), port = std::move(port)]() -> Result<std::unique_ptr<Transport>> {
        const auto all = ports->list();
        const auto found = std::ranges::find_if(all, [&](const TransportPort& other) {
            return other.serial == port.serial && (!port.serial.empty() || other.place == port.place);
        });
        if (found == all.end()) {
            return fail(ErrorCode::NotFound, "the stimulator with USB serial number \"{}\" is not plugged in",
                        port.serial);
        }
        if (!found->obstacle.empty()) return fail(ErrorCode::Io, "{}", found->obstacle);
        return ports->open(*found);
    };
}

class ScienceModeDriver final : public Driver {
public:
    explicit ScienceModeDriver(std::shared_ptr<TransportPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "sciencemode"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        if (!ports_) return found;
        for (const auto& port : ports_->list()) {
            auto name = port.obstacle.empty() ? std::string("ScienceMode stimulator, or another STM32 serial port")
                                              : fmt::format("ScienceMode stimulator? {}", port.obstacle);
            found.push_back({"sciencemode:" + port.serial, Role::Stimulator, std::move(name), port.serial, "", false});
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (into.has(Role::Stimulator)) {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\": a stimulator is open already, and a bench has one of each", uri.text());
        }
        const auto wanted = readUri(uri);
        if (!wanted) return failure(wanted);
        auto opened = wanted->terminal ? openTerminal(uri, *wanted, context) : openPort(uri, *wanted, context);
        if (!opened) return failure(opened);
        into.stimulator = std::move(*opened);
        return {};
    }

private:
    using Opened = Result<std::unique_ptr<ScienceModeStimulator>>;

    static Opened openTerminal(const DeviceUri& uri, const Wanted& wanted, const OpenContext& context) {
        const auto connect = [path = *wanted.terminal] { return TtyTransport::open(path); };
        return ScienceModeStimulator::open(connect, uri.text(), uri.path, wanted.settings, context.clock);
    }

    Opened openPort(const DeviceUri& uri, const Wanted& wanted, const OpenContext& context) const {
        auto all = ports_ ? ports_->list() : std::vector<TransportPort>{};
        const auto named = [&](const TransportPort& port) { return !uri.path.empty() && port.serial == uri.path; };
        // The one with that USB serial number before those that may have that identity.
        std::ranges::stable_partition(all, named);
        std::optional<Error> problem;
        for (const auto& port : all) {
            auto opened = tryPort(port, uri, named(port), wanted, context);
            if (opened) return opened;
            // The first reason is told, but what a port of the right serial number says before all others.
            if (!problem || named(port)) problem = opened.error();
            if (named(port)) break;
        }
        const auto what = uri.path.empty() ? std::string("no stimulator answers")
                                           : fmt::format("no stimulator \"{}\" answers", uri.path);
        if (problem) return fail(problem->code, "device \"{}\": {}: {}", uri.text(), what, problem->message);
        return fail(ErrorCode::NotFound, "device \"{}\": {}: none is plugged in (USB 0483:5740)", uri.text(), what);
    }

    Opened tryPort(const TransportPort& port, const DeviceUri& uri, bool named, const Wanted& wanted,
                   const OpenContext& context) const {
        if (!port.obstacle.empty()) return fail(ErrorCode::Io, "{}", port.obstacle);
        const std::string_view identity = named ? std::string_view{} : std::string_view(uri.path);
        return ScienceModeStimulator::open(connectTo(ports_, port), uri.text(), identity, wanted.settings,
                                           context.clock);
    }

    const std::shared_ptr<TransportPorts> ports_;
};

}  // namespace
}  // namespace sciencemode

std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<TransportPorts> ports) {
    return std::make_unique<sciencemode::ScienceModeDriver>(std::move(ports));
}

}  // namespace tacto
