#include "core/devices/TransportPorts.h"

#include <algorithm>

namespace tacto {

std::string addressOf(const TransportPort& port, std::span<const TransportPort> all) {
    const bool fits = !port.serial.empty() && port.serial.find('?') == std::string::npos;
    return fits && std::ranges::count(all, port.serial, &TransportPort::serial) <= 1 ? port.serial : port.place;
}

std::vector<TransportPort> portsNamed(std::string_view path, std::span<const TransportPort> all) {
    std::vector<TransportPort> found;
    for (const auto& port : all) {
        if (!path.empty() && (port.serial == path || port.place == path)) found.push_back(port);
    }
    return found;
}

std::vector<std::string> addressesOf(std::string_view scheme, std::span<const TransportPort> ports,
                                     std::span<const TransportPort> all) {
    std::vector<std::string> addresses;
    for (const auto& port : ports) addresses.push_back(fmt::format("{}:{}", scheme, addressOf(port, all)));
    return addresses;
}

std::vector<DeviceIdentity> identitiesAt(const TransportPorts& ports, std::string_view scheme, Role role,
                                         std::string_view name) {
    std::vector<DeviceIdentity> found;
    const auto all = ports.list();
    for (const auto& port : all) {
        found.push_back({fmt::format("{}:{}", scheme, addressOf(port, all)), role, std::string(name), port.serial, "",
                         false, port.obstacle});
    }
    return found;
}

Result<std::unique_ptr<Transport>> openPort(TransportPorts& ports, const TransportPort& port) {
    if (!port.obstacle.empty()) return fail(ErrorCode::Io, "{}", port.obstacle);
    return ports.open(port);
}

Connect connectTo(std::shared_ptr<TransportPorts> ports, std::string address, std::string name) {
    return [ports = std::move(ports), address = std::move(address),
            name = std::move(name)]() -> Result<std::unique_ptr<Transport>> {
        const auto found = portsNamed(address, ports->list());
        if (found.size() != 1) return fail(ErrorCode::NotFound, "{} {} is not plugged in", name, address);
        return openPort(*ports, found.front());
    };
}

}  // namespace tacto
