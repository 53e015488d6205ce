#include "drivers/sensor_board/SensorBoardDriver.h"

#include <algorithm>
#include <optional>

#include "core/base/Text.h"
#include "drivers/sensor_board/SensorBoard.h"

namespace tacto {
namespace sensorboard {
namespace {

struct Wanted {
    SensorBoardSettings settings;
    std::optional<std::string> terminal;
};

/// Takes one parameter. Nothing when it is well; else what is accepted.
std::optional<std::string> take(std::string_view key, std::string_view value, Wanted& into) {
    const auto rate = [&](double low, double high) -> std::optional<double> {
        const auto hertz = parseQuantity(value, "Hz");
        if (!hertz || !(*hertz >= low && *hertz <= high)) return std::nullopt;
        return hertz;
    };
    if (key == "rate") {
        const auto hertz = rate(100, 20'000);  // what the roughness chain takes (core/dsp/StreamCheck.h)
        if (!hertz) return "100 Hz to 20 kHz";
        into.settings.accelerationRate_hz = *hertz;
    } else if (key == "slowrate") {
        const auto hertz = rate(20, 2000);  // slower than 20 Hz is stale between two samples (H7)
        if (!hertz) return "20 Hz to 2 kHz";
        into.settings.slowRate_hz = *hertz;
    } else if (key == "tty") {
        if (value.empty()) return "a terminal's path, as /dev/ttyACM0";
        into.terminal = value;
    } else {
        return "there is no such parameter: it takes rate, slowrate, tty";
    }
    return std::nullopt;
}

Result<Wanted> readUri(const DeviceUri& uri) {
    Wanted wanted;
    wanted.settings.uri = uri.text();
    wanted.settings.serial = uri.path;
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

class SensorBoardDriver final : public Driver {
public:
    explicit SensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "board"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        for (const auto& port : ports_->list()) {
            auto name =
                port.obstacle.empty() ? std::string("sensor board") : fmt::format("sensor board: {}", port.obstacle);
            found.push_back({"board:" + port.serial, Role::Sensor, std::move(name), port.serial, "", false});
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (into.has(Role::Sensor)) {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\": a sensor is open already, and a bench has one of each", uri.text());
        }
        const auto wanted = readUri(uri);
        if (!wanted) return failure(wanted);
        auto opened = wanted->terminal ? openTerminal(*wanted, context) : openPort(*wanted, context);
        if (!opened) return failure(opened);
        into.sensor = std::move(*opened);
        return {};
    }

private:
    using Opened = Result<std::unique_ptr<SensorBoard>>;

    Opened openTerminal(const Wanted& wanted, const OpenContext& context) const {
        auto transport = ports_->openTerminal(*wanted.terminal);
        if (!transport) return failure(transport);
        return SensorBoard::open(std::move(*transport), wanted.settings, context.clock);
    }

    Opened openPort(const Wanted& wanted, const OpenContext& context) const {
        std::optional<Error> problem;
        for (const auto& port : ports_->list()) {
            if (!wanted.settings.serial.empty() && port.serial != wanted.settings.serial) continue;
            auto opened = tryPort(port, wanted, context);
            if (opened) return opened;
            if (!problem) problem = opened.error();
        }
        if (problem) return tl::unexpected<Error>(*problem);
        return fail(ErrorCode::NotFound, "device \"{}\": no such sensor board is plugged in (USB {:04x}:{:04x} \"{}\")",
                    wanted.settings.uri, kSensorBoardVendor, kSensorBoardProduct, kSensorBoardName);
    }

    Opened tryPort(const SensorBoardPort& port, const Wanted& wanted, const OpenContext& context) const {
        if (!port.obstacle.empty()) return fail(ErrorCode::Io, "{}", port.obstacle);
        auto transport = ports_->open(port);
        if (!transport) return failure(transport);
        return SensorBoard::open(std::move(*transport), wanted.settings, context.clock);
    }

    const std::shared_ptr<SensorBoardPorts> ports_;
};

}  // namespace
}  // namespace sensorboard

std::unique_ptr<Driver> makeSensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports) {
    return std::make_unique<sensorboard::SensorBoardDriver>(std::move(ports));
}

}  // namespace tacto
