#include "drivers/sciencemode/Commands.h"

#include <cmath>

namespace tacto::sciencemode {
namespace {

constexpr int kZeroCurrent = 300;  // what 0 mA is on the wire
constexpr double kHair = 1e-6;     // of a step: the representation of decimal steps in binary

/// `value` in steps, when it lies on one.
std::optional<long> stepsOf(double value, double step) noexcept {
    const double steps = value / step;
    if (!(std::abs(steps) <= 1e9)) return std::nullopt;
    const double whole = std::round(steps);
    if (!(std::abs(steps - whole) <= kHair)) return std::nullopt;
    return static_cast<long>(whole);
}

Result<void> putPoints(const Points& points, Payload& into) {
    for (const auto& point : points.span()) {
        const auto bytes = encodePoint(point);
        if (!bytes) return failure(bytes);
        for (const auto byte : *bytes) into.push(byte);
    }
    return {};
}

/// Points from the front of `bytes`, which is moved past them.
std::optional<Points> takePoints(std::span<const std::uint8_t>& bytes, std::size_t count) noexcept {
    if (bytes.size() < 4 * count) return std::nullopt;
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto point = decodePoint(bytes.first<4>());
        bytes = bytes.subspan(4);
        if (point.time.count() < kPointLeast_us || !(std::abs(point.current.value()) <= kCurrentMost_mA)) {
            return std::nullopt;
        }
        static_cast<void>(points.add(point));  // at most 16 are asked for
    }
    return points;
}

Result<void> checkCount(const Points& points) {
    if (points.count >= 1 && points.count <= kMaxPoints) return {};
    return fail(ErrorCode::InvalidArgument, "a ScienceMode pulse has {} points: 1 to {} fit", points.count, kMaxPoints);
}

}  // namespace

std::string_view nameOf(Command command) noexcept {
    switch (command) {
        case Command::LowLevelInit:
            return "LL_INIT";
        case Command::ChannelConfig:
            return "LL_CHANNEL_CONFIG";
        case Command::LowLevelStop:
            return "LL_STOP";
        case Command::MidLevelInit:
            return "ML_INIT";
        case Command::MidLevelUpdate:
            return "ML_UPDATE";
        case Command::MidLevelStop:
            return "ML_STOP";
        case Command::CurrentData:
            return "ML_GET_CURRENT_DATA";
        case Command::DeviceId:
            return "GET_DEVICE_ID";
        case Command::Reset:
            return "RESET";
        case Command::StimStatus:
            return "GET_STIM_STATUS";
        case Command::GeneralError:
            return "GENERAL_ERROR";
        case Command::UnknownCommand:
            return "UNKNOWN_COMMAND";
        case Command::ExtendedVersion:
            return "GET_EXTENDED_VERSION";
    }
    return "an unknown command";
}

Micros Points::duration() const noexcept {
    Micros sum{0};
    for (const auto& point : span()) sum += point.time;
    return sum;
}

bool Points::add(const Point& point) noexcept {
    if (count == items.size()) return false;
    items[count++] = point;
    return true;
}

Result<PointBytes> encodePoint(const Point& point) {
    const auto time = stepsOf(point.time.count(), 1);
    if (!time || *time < kPointLeast_us || *time > kPointMost_us) {
        return fail(ErrorCode::InvalidArgument, "a ScienceMode point of {} µs cannot be sent: whole µs from {} to {}",
                    point.time.count(), kPointLeast_us, kPointMost_us);
    }
    const auto half = stepsOf(point.current.value(), kCurrentStep_mA);
    if (!half || !(std::abs(point.current.value()) <= kCurrentMost_mA)) {
        return fail(ErrorCode::InvalidArgument,
                    "a ScienceMode point of {} mA cannot be sent: steps of {} mA from -{} to {} mA",
                    point.current.value(), kCurrentStep_mA, kCurrentMost_mA, kCurrentMost_mA);
    }
    const auto t = static_cast<unsigned>(*time);
    const auto c = static_cast<unsigned>(*half + kZeroCurrent);
    return PointBytes{static_cast<std::uint8_t>(t >> 4U), static_cast<std::uint8_t>((t & 0xFU) << 4U | c >> 6U),
                      static_cast<std::uint8_t>((c & 0x3FU) << 2U), 0};
}

Point decodePoint(std::span<const std::uint8_t, 4> bytes) noexcept {
    const int t = (bytes[0] << 4) | (bytes[1] >> 4);
    const int c = ((bytes[1] & 0xF) << 6) | (bytes[2] >> 2);
    return {Micros(t), Milliamps((c - kZeroCurrent) * kCurrentStep_mA)};
}

Result<std::uint16_t> encodePeriod(Seconds period) {
    const double ms = period.count() * 1e3;
    const auto halves = stepsOf(ms, 0.5);
    const auto quarters = stepsOf(ms, 0.25);
    if (halves && *halves > 0 && *halves <= 0x7FFF) return static_cast<std::uint16_t>(*halves << 1);
    if (!halves && quarters && *quarters > 0 && *quarters <= 0x7FFF) {
        return static_cast<std::uint16_t>((*quarters << 1) | 1);
    }
    return fail(ErrorCode::InvalidArgument,
                "a ScienceMode repetition period of {} ms cannot be sent: steps of 0.5 ms up to 16383.5 ms, or of 0.25 "
                "ms up to 8191.75 ms",
                ms);
}

Seconds decodePeriod(std::uint16_t bits) noexcept {
    return Seconds((bits >> 1) * ((bits & 1U) != 0 ? 0.25e-3 : 0.5e-3));
}

Payload payloadOf(const LowLevelInit& request) noexcept {
    Payload payload;
    payload.push(static_cast<unsigned>(request.highVoltage) << 1U | static_cast<unsigned>(request.measurement) << 4U);
    return payload;
}

Result<Payload> payloadOf(const ChannelConfig& request) {
    if (request.channel < 0 || request.channel >= static_cast<int>(kChannels) || request.connector < 0 ||
        request.connector > 1) {
        return fail(ErrorCode::InvalidArgument,
                    "ScienceMode channel {} of connector {} cannot be sent: channels 0 to 3, connectors 0 and 1",
                    request.channel, request.connector);
    }
    if (auto counted = checkCount(request.points); !counted) return failure(counted);
    Payload payload;
    payload.push(static_cast<unsigned>(request.points.count - 1) | static_cast<unsigned>(request.connector) << 4U |
                 static_cast<unsigned>(request.channel) << 5U | (request.execute ? 0x80U : 0U));
    if (auto put = putPoints(request.points, payload); !put) return failure(put);
    return payload;
}

Payload midLevelInitPayload(bool stopAllOnError) noexcept {
    Payload payload;
    payload.push(stopAllOnError ? 1 : 0);
    return payload;
}

Result<Payload> payloadOf(const MidLevelUpdate& request) {
    Payload payload;
    unsigned mask = 0;
    for (std::size_t i = 0; i < kMidChannels; ++i) {
        if (request.channels[i]) mask |= 1U << i;
    }
    payload.push(mask);
    for (std::size_t i = 0; i < kMidChannels; ++i) {
        if (!request.channels[i]) continue;
        const auto& channel = *request.channels[i];
        if (channel.channel != static_cast<int>(i)) {
            return fail(ErrorCode::InvalidArgument, "ScienceMode channel {} stands in the place of channel {}",
                        channel.channel, i);
        }
        if (channel.ramp < 0 || channel.ramp > 15) {
            return fail(ErrorCode::InvalidArgument, "a ScienceMode ramp of {} does not fit 4 bits: 0 to 15",
                        channel.ramp);
        }
        if (auto counted = checkCount(channel.points); !counted) return failure(counted);
        const auto period = encodePeriod(channel.period);
        if (!period) return failure(period);
        if (!(channel.period > Seconds(channel.points.duration()))) {
            return fail(ErrorCode::InvalidArgument,
                        "a ScienceMode pulse of {} µs does not fit into its repetition period of {} ms",
                        channel.points.duration().count(), channel.period.count() * 1e3);
        }
        payload.push(static_cast<unsigned>(channel.points.count - 1) << 4U | static_cast<unsigned>(channel.ramp));
        payload.push(static_cast<unsigned>(*period) >> 8U);
        payload.push(*period);
        if (auto put = putPoints(channel.points, payload); !put) return failure(put);
    }
    return payload;
}

Payload currentDataPayload() noexcept {
    Payload payload;
    payload.push(4);  // the errors of all channels
    return payload;
}

std::optional<LowLevelInit> readLowLevelInit(std::span<const std::uint8_t> payload) noexcept {
    if (payload.size() != 1) return std::nullopt;
    const unsigned voltage = (payload[0] >> 1U) & 7U;
    const unsigned measurement = (payload[0] >> 4U) & 7U;
    if (voltage > 6 || measurement > 3 || (payload[0] & 0x81U) != 0) return std::nullopt;
    return LowLevelInit{static_cast<HighVoltage>(voltage), static_cast<Measurement>(measurement)};
}

std::optional<ChannelConfig> readChannelConfig(std::span<const std::uint8_t> payload) noexcept {
    if (payload.empty()) return std::nullopt;
    const unsigned head = payload[0];
    auto rest = payload.subspan(1);
    const auto points = takePoints(rest, (head & 0xFU) + 1);
    if (!points || !rest.empty()) return std::nullopt;
    return ChannelConfig{static_cast<int>((head >> 5U) & 3U), static_cast<int>((head >> 4U) & 1U), (head & 0x80U) != 0,
                         *points};
}

std::optional<bool> readMidLevelInit(std::span<const std::uint8_t> payload) noexcept {
    if (payload.size() != 1 || payload[0] > 1) return std::nullopt;
    return payload[0] == 1;
}

std::optional<MidLevelUpdate> readMidLevelUpdate(std::span<const std::uint8_t> payload) noexcept {
    if (payload.empty()) return std::nullopt;
    const unsigned mask = payload[0];
    auto rest = payload.subspan(1);
    MidLevelUpdate update;
    for (std::size_t i = 0; i < kMidChannels; ++i) {
        if ((mask >> i & 1U) == 0) continue;
        if (rest.size() < 3) return std::nullopt;
        MidLevelChannel channel;
        channel.channel = static_cast<int>(i);
        channel.ramp = rest[0] & 0xF;
        channel.period = decodePeriod(static_cast<std::uint16_t>(rest[1] << 8 | rest[2]));
        const std::size_t count = (rest[0] >> 4U) + 1U;
        rest = rest.subspan(3);
        const auto points = takePoints(rest, count);
        if (!points || !(channel.period > Seconds(points->duration()))) return std::nullopt;
        channel.points = *points;
        update.channels[i] = channel;
    }
    if (!rest.empty()) return std::nullopt;
    return update;
}

}  // namespace tacto::sciencemode
