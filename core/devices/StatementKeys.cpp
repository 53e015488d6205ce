#include "core/devices/StatementKeys.h"

#include <algorithm>
#include <array>

#include "core/base/GivenOnce.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

struct Key {
    std::string_view name;
    double scale;  ///< to what a statement holds
    double most;   ///< as written
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
            return fail(ErrorCode::InvalidArgument, "device \"{}:{}\": {}", uri.scheme, uri.path, why);
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
    // A gain that is stated of full scale alone leaves nothing of the reading.
    for (auto* channel : {&out.voltage, &out.current}) {
        if (channel->linearity.known() && !channel->gain.known()) channel->gain = {0, channel->linearity.by};
    }
    return seen.empty() ? std::optional<InstrumentStatement>() : std::optional(out);
}

}  // namespace tacto
