#include "drivers/sensor_board/SensorBoardDriver.h"

#include <algorithm>
#include <optional>

#include "core/base/Text.h"
#include "drivers/sensor_board/PluggedBoard.h"

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

using Opened = Result<std::unique_ptr<SensorBoard>>;

Opened tryPort(SensorBoardPorts& ports, const TransportPort& port, const Wanted& wanted, const Clock& clock) {
    if (!port.obstacle.empty()) return fail(ErrorCode::Io, "{}", port.obstacle);
    auto transport = ports.open(port);
    if (!transport) return failure(transport);
    return SensorBoard::open(std::move(*transport), wanted.settings, clock);
}

Opened openPort(SensorBoardPorts& ports, const Wanted& wanted, const Clock& clock) {
    const auto& path = wanted.settings.serial;
    const auto all = ports.list();
    const auto named = portsNamed(path, all);
    if (named.size() > 1) {
        return fail(ErrorCode::InvalidArgument, "device \"{}\" could be {}: name one", wanted.settings.uri,
                    choiceOf("sensor", named, all));
    }
    std::optional<Error> problem;
    for (const auto& port : named.empty() ? all : named) {
        // Without a serial number in its USB descriptor a board is asked for it.
        if (named.empty() && !path.empty() && !port.serial.empty()) continue;
        auto one = wanted;
        if (port.place == path) one.settings.serial.clear();
        auto opened = tryPort(ports, port, one, clock);
        if (opened) return opened;
        if (!problem) problem = opened.error();
    }
    if (problem) return tl::unexpected<Error>(*problem);
    return fail(ErrorCode::NotFound, "device \"{}\": no such sensor board is plugged in (USB {:04x}:{:04x} \"{}\")",
                wanted.settings.uri, kSensorBoardVendor, kSensorBoardProduct, kSensorBoardName);
}

class SensorBoardDriver final : public Driver {
public:
    explicit SensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "sensor"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        const auto all = ports_->list();
        for (const auto& port : all) {
            found.push_back({"sensor:" + addressOf(port, all), Role::Sensor, "sensor board", port.serial, "", false,
                             port.obstacle});
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (into.has(Role::Sensor)) {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\": a sensor is open already, and a bench has one of each", uri.text());
        }
        auto opened = openSensorBoard(ports_, uri, context.clock);
        if (!opened) return failure(opened);
        into.sensor = std::make_unique<PluggedBoard>(
            std::move(*opened), [ports = ports_, uri, &clock = context.clock](const std::string& serial) {
                auto same = uri;
                same.path = serial;
                return openSensorBoard(ports, same, clock);
            });
        return {};
    }

private:
    const std::shared_ptr<SensorBoardPorts> ports_;
};

}  // namespace
}  // namespace sensorboard

Result<std::unique_ptr<SensorBoard>> openSensorBoard(const std::shared_ptr<SensorBoardPorts>& ports,
                                                     const DeviceUri& uri, const Clock& clock) {
    const auto wanted = sensorboard::readUri(uri);
    if (!wanted) return failure(wanted);
    if (!wanted->terminal) return sensorboard::openPort(*ports, *wanted, clock);
    auto transport = ports->openTerminal(*wanted->terminal);
    if (!transport) return failure(transport);
    return SensorBoard::open(std::move(*transport), wanted->settings, clock);
}

std::unique_ptr<Driver> makeSensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports) {
    return std::make_unique<sensorboard::SensorBoardDriver>(std::move(ports));
}

}  // namespace tacto
