#include "core/devices/DeviceUri.h"

#include <fmt/ranges.h>

#include "core/base/Text.h"

namespace tacto {

Result<DeviceUri> DeviceUri::parse(std::string_view text) {
    const auto colon = text.find(':');
    if (colon == std::string_view::npos || colon == 0) {
        return fail(ErrorCode::InvalidArgument,
                    "device \"{}\" has no scheme: write scheme:path, for example sim: or recording:FOLDER", text);
    }
    DeviceUri uri;
    uri.scheme = text.substr(0, colon);
    const auto rest = text.substr(colon + 1);
    const auto mark = rest.find('?');
    uri.path = rest.substr(0, mark);
    if (mark == std::string_view::npos) return uri;
    for (const auto parameter : split(rest.substr(mark + 1), '&')) {
        const auto equals = parameter.find('=');
        if (equals == std::string_view::npos || equals == 0) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": parameter \"{}\" is not written key=value", text,
                        parameter);
        }
        uri.parameters.emplace_back(parameter.substr(0, equals), parameter.substr(equals + 1));
    }
    return uri;
}

std::string DeviceUri::text() const {
    std::string out = scheme + ":" + path;
    char separator = '?';
    for (const auto& [key, value] : parameters) {
        out += separator;
        out.append(key).append("=").append(value);
        separator = '&';
    }
    return out;
}

tl::unexpected<Error> DeviceUri::refuseChoice(const std::vector<std::string>& addresses) const {
    return fail(ErrorCode::InvalidArgument, "device \"{}\" could be {}: name one", text(),
                fmt::join(addresses, " or "));
}

std::string unitOf(std::string_view serial, std::string_view uri) {
    if (serial.empty()) return std::string(uri);
    return fmt::format("{} {}", uri.substr(0, uri.find(':')), serial);
}

std::string calibratedOutput(std::string_view serial, std::string_view uri) {
    std::string output(serial);
    const auto parsed = DeviceUri::parse(uri);
    if (output.empty() || !parsed) return output;
    for (const std::string_view chosen : {"connector", "channel"}) {
        for (const auto& [key, value] : parsed->parameters) {
            if (key == chosen) output += fmt::format(" {}={}", key, value);
        }
    }
    return output;
}

}  // namespace tacto
