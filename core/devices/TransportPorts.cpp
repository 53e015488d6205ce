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

std::string choiceOf(std::string_view scheme, std::span<const TransportPort> ports,
                     std::span<const TransportPort> all) {
    std::string text;
    for (const auto& port : ports) {
        text += fmt::format("{}{}:{}", text.empty() ? "" : " or ", scheme, addressOf(port, all));
    }
    return text;
}

}  // namespace tacto
