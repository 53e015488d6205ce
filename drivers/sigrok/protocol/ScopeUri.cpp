#include "drivers/sigrok/protocol/ScopeUri.h"

#include "core/devices/DeviceUri.h"

namespace tacto::sigrok_driver {

namespace {

Result<void> readPath(const DeviceUri& uri, ScopeUri& into) {
    std::size_t from = uri.path.find(':');
    into.driver = uri.path.substr(0, from);
    if (into.driver.empty()) {
        return uri.refuse(ErrorCode::InvalidArgument,
                          "no driver is named; sigrok:demo or sigrok:DRIVER:conn=... was expected "
                          "(sigrok-cli -L lists the drivers)");
    }
    while (from != std::string::npos) {
        const std::size_t to = uri.path.find(':', from + 1);
        const std::string part = uri.path.substr(from + 1, to == std::string::npos ? to : to - from - 1);
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == part.size()) {
            return uri.refuse(ErrorCode::InvalidArgument, "\"{}\" is not an option; key=value was expected", part);
        }
        into.options.emplace_back(part.substr(0, equals), part.substr(equals + 1));
        from = to;
    }
    return {};
}

}  // namespace

Result<ScopeUri> ScopeUri::parse(const DeviceUri& uri) {
    ScopeUri read;
    if (const auto path = readPath(uri, read); !path) return failure(path);
    UriParameters from(uri);
    read.voltage = from.text("voltage");
    read.current = from.text("current");
    read.shunt = Ohms(from.quantity("shunt", "ohm", 0, 1e-3, 1e6));
    const auto probe = [&](std::string_view key) -> std::optional<std::uint64_t> {
        const auto factor = from.integer(key, 1, 10000);
        return factor ? std::optional(static_cast<std::uint64_t>(*factor)) : std::nullopt;
    };
    read.voltageProbe = probe("probe");
    read.currentProbe = probe("currentprobe");
    read.falling = from.choice("slope", "rise", {"rise", "fall"}) == "fall";
    read.ownTrigger = from.choice("trigger", "set", {"set", "instrument"}) == "instrument";
    read.live = from.choice("record", "memory", {"memory", "live"}) == "live";
    if (const auto taken = from.finish(); !taken) return failure(taken);
    if (read.current.has_value() != (read.shunt.value() > 0)) {
        return uri.refuse(ErrorCode::InvalidArgument,
                          "{} is given without {}; both are expected, as current=CH2&shunt=100",
                          read.current ? "current" : "shunt", read.current ? "shunt" : "current");
    }
    if (read.currentProbe && !read.current) {
        return uri.refuse(ErrorCode::InvalidArgument, "currentprobe is given without current");
    }
    if (read.current && read.current == read.voltage) {
        return uri.refuse(ErrorCode::InvalidArgument, "{} is both voltage and current; two are expected",
                          *read.current);
    }
    return read;
}

std::optional<std::pair<std::string, std::string>> ScopeUri::tcp() const {
    for (const auto& [key, value] : options) {
        if (key != "conn" || !(value.starts_with("tcp-raw/") || value.starts_with("tcp-rigol/"))) continue;
        const std::size_t host = value.find('/') + 1;
        const std::size_t port = value.find('/', host);
        if (port == std::string::npos) return std::nullopt;
        return std::pair(value.substr(host, port - host), value.substr(port + 1));
    }
    return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> ScopeUri::optionsVia(const std::string& host,
                                                                      std::uint16_t port) const {
    auto changed = options;
    for (auto& [key, value] : changed) {
        if (key == "conn") value = fmt::format("{}/{}/{}", value.substr(0, value.find('/')), host, port);
    }
    return changed;
}

}  // namespace tacto::sigrok_driver
