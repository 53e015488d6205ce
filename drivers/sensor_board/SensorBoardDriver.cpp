#include "drivers/sensor_board/SensorBoardDriver.h"

#include <optional>

#include "core/devices/DeviceUri.h"
#include "drivers/sensor_board/PluggedBoard.h"

namespace tacto {
namespace sensorboard {
namespace {

struct Wanted {
    SensorBoardSettings settings;
    std::optional<std::string> terminal;
};

Result<Wanted> readUri(const DeviceUri& uri) {
    UriParameters from(uri);
    Wanted wanted;
    wanted.settings.uri = uri.text();
    wanted.settings.serial = uri.path;
    // The range of rates that the roughness analysis accepts (core/dsp/SensorScales.h).
    wanted.settings.accelerationRate_hz = from.quantity("rate", "Hz", 0, 100, 20'000);
    // At less than 20 Hz, data would count as stale between two samples (H7).
    wanted.settings.slowRate_hz = from.quantity("slowrate", "Hz", 0, 20, 2000);
    wanted.settings.emulated = from.choice("emulated", "no", {"yes", "no"}) == "yes";
    const auto encodes = from.choice("encodes", "no", {"no", "shown", "drives"});
    wanted.settings.encodes = encodes == "drives" ? Encodes::Drives : encodes == "shown" ? Encodes::Shown : Encodes::No;
    wanted.terminal = from.text("tty");
    if (wanted.terminal == "") from.refuse("tty", "", "a terminal's path, as /dev/ttyACM0");
    if (const auto read = from.finish(); !read) return failure(read);
    return wanted;
}

using Opened = Result<std::unique_ptr<SensorBoard>>;

Opened tryPort(SensorBoardPorts& ports, const TransportPort& port, const Wanted& wanted, const Clock& clock) {
    auto transport = openPort(ports, port);
    if (!transport) return failure(transport);
    return SensorBoard::open(std::move(*transport), wanted.settings, clock);
}

Opened findBoard(SensorBoardPorts& ports, const DeviceUri& uri, const Wanted& wanted, const Clock& clock) {
    const auto& path = wanted.settings.serial;
    const auto all = ports.list();
    const auto named = portsNamed(path, all);
    if (named.size() > 1) return uri.refuseChoice(addressesOf("sensor", named, all));
    std::optional<Error> problem;
    for (const auto& port : named.empty() ? all : named) {
        // If the USB descriptor has no serial number, the board itself is asked for it.
        if (named.empty() && !path.empty() && !port.serial.empty()) continue;
        auto one = wanted;
        if (port.place == path) one.settings.serial.clear();
        auto opened = tryPort(ports, port, one, clock);
        if (opened) return opened;
        if (!problem) problem = opened.error();
    }
    if (problem) return tl::unexpected<Error>(*problem);
    return uri.refuse(ErrorCode::NotFound, "no such sensor board is plugged in (USB {:04x}:{:04x} \"{}\")",
                      kSensorBoardVendor, kSensorBoardProduct, kSensorBoardName);
}

class SensorBoardDriver final : public Driver {
public:
    explicit SensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "sensor"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        return identitiesAt(*ports_, "sensor", Role::Sensor, "sensor board");
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (auto free = into.checkFree(Role::Sensor, uri); !free) return free;
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
    if (!wanted->terminal) return sensorboard::findBoard(*ports, uri, *wanted, clock);
    auto transport = ports->openTerminal(*wanted->terminal);
    if (!transport) return failure(transport);
    return SensorBoard::open(std::move(*transport), wanted->settings, clock);
}

std::unique_ptr<Driver> makeSensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports) {
    return std::make_unique<sensorboard::SensorBoardDriver>(std::move(ports));
}

}  // namespace tacto
