#include "drivers/sigrok/ScopeUri.h"

#include <algorithm>
#include <set>

#include "core/base/Text.h"

namespace tacto::sigrok_driver {

namespace {

Result<std::uint64_t> probeOf(const DeviceUri& uri, const std::string& key, const std::string& value) {
    const auto number = parseNumber(value);
    if (!number || !(*number >= 1 && *number <= 10000) || *number != static_cast<double>(static_cast<int>(*number))) {
        return fail(ErrorCode::InvalidArgument, "device \"{}\": {}={} is not accepted: a whole number from 1 to 10000",
                    uri.text(), key, value);
    }
    return static_cast<std::uint64_t>(*number);
}

Result<Ohms> shuntOf(const DeviceUri& uri, std::string text) {
    if (text.ends_with("ohm")) text.resize(text.size() - 3);
    while (text.ends_with(' ')) text.pop_back();
    const auto number = parseNumber(text);
    if (!number || !(*number >= 1e-3 && *number <= 1e6)) {
        return fail(ErrorCode::InvalidArgument,
                    "device \"{}\": shunt={} is not accepted: 0.001 to 1000000 ohm, as shunt=100", uri.text(), text);
    }
    return Ohms(*number);
}

Result<bool> choiceOf(const DeviceUri& uri, const std::string& key, const std::string& value, const char* no,
                      const char* yes) {
    if (value == yes) return true;
    if (value == no) return false;
    return fail(ErrorCode::InvalidArgument, "device \"{}\": {}={} is not accepted: {} or {}", uri.text(), key, value,
                no, yes);
}

Result<void> readPath(const DeviceUri& uri, ScopeUri& into) {
    std::size_t from = uri.path.find(':');
    into.driver = uri.path.substr(0, from);
    if (into.driver.empty()) {
        return fail(ErrorCode::InvalidArgument,
                    "device \"{}\": no driver is named; sigrok:demo or sigrok:DRIVER:conn=... was expected "
                    "(sigrok-cli -L lists the drivers)",
                    uri.text());
    }
    while (from != std::string::npos) {
        const std::size_t to = uri.path.find(':', from + 1);
        const std::string part = uri.path.substr(from + 1, to == std::string::npos ? to : to - from - 1);
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == part.size()) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": \"{}\" is no option; key=value was expected",
                        uri.text(), part);
        }
        into.options.emplace_back(part.substr(0, equals), part.substr(equals + 1));
        from = to;
    }
    return {};
}

Result<void> readParameter(const DeviceUri& uri, const std::string& key, const std::string& value, ScopeUri& into) {
    if (key == "voltage") {
        into.voltage = value;
    } else if (key == "current") {
        into.current = value;
    } else if (key == "shunt") {
        const auto shunt = shuntOf(uri, value);
        if (!shunt) return failure(shunt);
        into.shunt = *shunt;
    } else if (key == "probe" || key == "currentprobe") {
        const auto probe = probeOf(uri, key, value);
        if (!probe) return failure(probe);
        (key == "probe" ? into.voltageProbe : into.currentProbe) = *probe;
    } else if (key == "slope") {
        const auto falling = choiceOf(uri, key, value, "rise", "fall");
        if (!falling) return failure(falling);
        into.falling = *falling;
    } else if (key == "trigger") {
        const auto own = choiceOf(uri, key, value, "set", "instrument");
        if (!own) return failure(own);
        into.ownTrigger = *own;
    } else if (key == "record") {
        const auto live = choiceOf(uri, key, value, "memory", "live");
        if (!live) return failure(live);
        into.live = *live;
    } else {
        return fail(ErrorCode::InvalidArgument,
                    "device \"{}\": there is no parameter \"{}\" (={}): it takes voltage, current, shunt, probe, "
                    "currentprobe, slope, trigger and record",
                    uri.text(), key, value);
    }
    return {};
}

}  // namespace

Result<ScopeUri> ScopeUri::parse(const DeviceUri& uri) {
    ScopeUri read;
    if (const auto path = readPath(uri, read); !path) return failure(path);
    std::set<std::string> seen;
    for (const auto& [key, value] : uri.parameters) {
        if (!seen.insert(key).second) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": {} is given twice; once is expected", uri.text(),
                        key);
        }
        if (const auto one = readParameter(uri, key, value, read); !one) return failure(one);
    }
    if (read.current.has_value() != (read.shunt.value() > 0)) {
        return fail(ErrorCode::InvalidArgument,
                    "device \"{}\": {} is given without {}; both are expected, as current=CH2&shunt=100", uri.text(),
                    read.current ? "current" : "shunt", read.current ? "shunt" : "current");
    }
    if (read.currentProbe && !read.current) {
        return fail(ErrorCode::InvalidArgument, "device \"{}\": currentprobe is given without current", uri.text());
    }
    if (read.current && read.current == read.voltage) {
        return fail(ErrorCode::InvalidArgument, "device \"{}\": {} is both voltage and current; two are expected",
                    uri.text(), *read.current);
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
