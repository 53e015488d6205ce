#include "core/devices/DeviceUri.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/ranges.h>

#include "core/base/LocaleFreeText.h"
#include "core/base/QuantityText.h"

namespace tacto {

Result<DeviceUri> DeviceUri::parse(std::string_view text) {
    const auto colon = text.find(':');
    if (colon == std::string_view::npos || colon == 0) {
        return invalid("device \"{}\" has no scheme: write scheme:path, for example sim: or recording:FOLDER", text);
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
            return invalid("device \"{}\": parameter \"{}\" is not written key=value", text, parameter);
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
    return invalid("device \"{}\" could be {}: name one", text(), fmt::join(addresses, " or "));
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

std::vector<std::string_view> UriParameters::each(std::string_view key) {
    known_.push_back(key);
    std::vector<std::string_view> values;
    for (const auto& [name, value] : uri_.parameters) {
        if (name == key) values.push_back(value);
    }
    return values;
}

std::optional<std::string_view> UriParameters::take(std::string_view key) {
    const auto values = each(key);
    if (values.size() > 1) refuse(givenTwice("{}", key));
    return values.empty() ? std::nullopt : std::optional(values.back());
}

void UriParameters::refuse(std::string_view key, std::string_view value, std::string_view accepted) {
    refuse(fmt::format("{}={} is not accepted: {}", key, value, accepted));
}

void UriParameters::refuse(std::string_view sentence) {
    if (!problem_) problem_ = uri_.refuse(ErrorCode::InvalidArgument, "{}", sentence).value();
}

std::optional<double> UriParameters::quantity(std::string_view key, std::string_view unit, double low, double high) {
    const auto text = take(key);
    if (!text) return std::nullopt;
    const auto value = parseQuantity(*text, unit);
    if (value && *value >= low && *value <= high) return value;
    refuse(key, *text, fmt::format("{} to {}", low == 0 ? "0" : exactText(low, unit), exactText(high, unit)));
    return std::nullopt;
}

std::optional<int> UriParameters::integer(std::string_view key, int low, int high) {
    const auto text = take(key);
    if (!text) return std::nullopt;
    const auto value = parseQuantity(*text, "");
    if (value && *value >= low && *value <= high && *value == std::floor(*value)) return static_cast<int>(*value);
    refuse(key, *text, fmt::format("a whole number from {} to {}", low, high));
    return std::nullopt;
}

std::optional<std::string> UriParameters::text(std::string_view key) {
    const auto found = take(key);
    return found ? std::optional(std::string(*found)) : std::nullopt;
}

std::string UriParameters::choice(std::string_view key, std::string_view otherwise,
                                  std::initializer_list<std::string_view> accepted) {
    const auto text = take(key);
    if (!text) return std::string(otherwise);
    if (std::ranges::find(accepted, *text) != accepted.end()) return std::string(*text);
    const auto last = accepted.end() - 1;
    refuse(key, *text, fmt::format("{} or {}", fmt::join(accepted.begin(), last, ", "), *last));
    return std::string(otherwise);
}

Result<void> UriParameters::finish() const {
    if (problem_) return tl::unexpected<Error>(*problem_);
    for (const auto& [name, value] : uri_.parameters) {
        if (std::ranges::find(known_, name) != known_.end()) continue;
        return uri_.refuse(ErrorCode::InvalidArgument, "there is no parameter \"{}\" (={}): it takes {}", name, value,
                           fmt::join(known_, ", "));
    }
    return {};
}

namespace {

struct Key {
    std::string_view name;
    double scale;  ///< factor from the written unit to the stored unit
    double most;   ///< largest value, in the written unit
    std::string_view accepted;
};
constexpr std::array<Key, 10> kKeys{{{"gain_pct", 1e-2, 50, "0 to 50 %"},
                                     {"fs_pct", 1e-2, 50, "0 to 50 % of full scale"},
                                     {"offset_v", 1, 100, "0 to 100 V"},
                                     {"offset_a", 1, 10, "0 to 10 A"},
                                     {"probe_pct", 1e-2, 50, "0 to 50 %; 0 for a plain cable"},
                                     {"shunt_pct", 1e-2, 50, "0 to 50 %"},
                                     {"timebase_ppm", 1e-6, 1e5, "0 to 100000 ppm"},
                                     {"stamp_s", 1, 10, "0 to 10 s"},
                                     {"lsb_v", 1, 100, "0 to 100 V"},
                                     {"lsb_a", 1, 10, "0 to 10 A"}}};

void put(InstrumentStatement& into, std::string_view key, double value) {
    const Stated stated{value, "the device's address"};
    if (key == "gain_pct") into.voltage.gain = into.current.gain = stated;
    if (key == "fs_pct") into.voltage.linearity = into.current.linearity = stated;
    if (key == "offset_v") into.voltage.offset = stated;
    if (key == "offset_a") into.current.offset = stated;
    if (key == "probe_pct") into.voltage.probe = stated;
    if (key == "shunt_pct") into.current.probe = stated;
    if (key == "timebase_ppm") into.timeBase = stated;
    if (key == "stamp_s") into.stamp_s = stated;
    if (key == "lsb_v") into.voltage.resolution = stated;
    if (key == "lsb_a") into.current.resolution = stated;
}

}  // namespace

bool statesAccuracy(std::string_view key) noexcept { return std::ranges::find(kKeys, key, &Key::name) != kKeys.end(); }

Result<std::optional<InstrumentStatement>> takeStatement(DeviceUri& uri) {
    InstrumentStatement out;
    std::vector<std::string_view> seen;
    std::vector<std::pair<std::string, std::string>> others;
    for (auto& parameter : uri.parameters) {
        const auto known = std::ranges::find(kKeys, parameter.first, &Key::name);
        if (known == kKeys.end()) {
            others.push_back(std::move(parameter));
            continue;
        }
        const auto refuse = [&](std::string_view why) {
            return invalid("device \"{}:{}\": {}", uri.scheme, uri.path, why);
        };
        seen.push_back(known->name);
        if (secondIn(seen)) return refuse(givenTwice("{}", known->name));
        const auto value = parseNumber(parameter.second);
        if (!value || !(*value >= 0) || !(*value <= known->most)) {
            return refuse(fmt::format("{} is \"{}\"; {} is accepted", known->name, parameter.second, known->accepted));
        }
        put(out, known->name, *value * known->scale);
    }
    uri.parameters = std::move(others);
    // If only an error of full scale is stated, the gain has no error relative to the reading.
    for (auto* channel : {&out.voltage, &out.current}) {
        if (channel->linearity.known() && !channel->gain.known()) channel->gain = {0, channel->linearity.by};
    }
    return seen.empty() ? std::optional<InstrumentStatement>() : std::optional(out);
}

}  // namespace tacto
