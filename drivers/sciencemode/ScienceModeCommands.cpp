#include "drivers/sciencemode/ScienceModeCommands.h"

#include <cmath>

#include "core/base/Words.h"

namespace tacto::sciencemode {
namespace {

constexpr int kZeroCurrent = 300;        // the code for 0 mA in the protocol
constexpr double kStepTolerance = 1e-6;  // as a share of a step: decimal steps are inexact in binary

/// Returns `value` in steps, if it is a whole number of steps.
std::optional<long> stepsOf(double value, double step) noexcept {
    const double steps = value / step;
    if (!(std::abs(steps) <= 1e9)) return std::nullopt;
    const double whole = std::round(steps);
    if (!(std::abs(steps - whole) <= kStepTolerance)) return std::nullopt;
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

Result<void> checkCount(const Points& points) {
    if (points.count >= 1 && points.count <= kMaxPoints) return {};
    return fail(ErrorCode::InvalidArgument, "a ScienceMode pulse has {} points: 1 to {} fit", points.count, kMaxPoints);
}

constexpr Word<Command> kCommandWords[] = {
    {"LL_INIT", Command::LowLevelInit},           {"LL_CHANNEL_CONFIG", Command::ChannelConfig},
    {"LL_STOP", Command::LowLevelStop},           {"ML_STOP", Command::MidLevelStop},
    {"GET_DEVICE_ID", Command::DeviceId},         {"RESET", Command::Reset},
    {"GET_STIM_STATUS", Command::StimStatus},     {"GENERAL_ERROR", Command::GeneralError},
    {"UNKNOWN_COMMAND", Command::UnknownCommand}, {"GET_EXTENDED_VERSION", Command::ExtendedVersion}};

}  // namespace

std::string_view nameOf(Command command) noexcept { return wordFor(kCommandWords, command, "an unknown command"); }

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
    if (!time || *time < kMinPoint_us || *time > kMaxPoint_us) {
        return fail(ErrorCode::InvalidArgument, "a ScienceMode point of {} µs cannot be sent: whole µs from {} to {}",
                    point.time.count(), kMinPoint_us, kMaxPoint_us);
    }
    const auto half = stepsOf(point.current.value(), kCurrentStep_mA);
    if (!half || !(std::abs(point.current.value()) <= kMaxCurrent_mA)) {
        return fail(ErrorCode::InvalidArgument,
                    "a ScienceMode point of {} mA cannot be sent: steps of {} mA from -{} to {} mA",
                    point.current.value(), kCurrentStep_mA, kMaxCurrent_mA, kMaxCurrent_mA);
    }
    const auto t = static_cast<unsigned>(*time);
    const auto c = static_cast<unsigned>(*half + kZeroCurrent);
    return PointBytes{static_cast<std::uint8_t>(t >> 4U), static_cast<std::uint8_t>((t & 0xFU) << 4U | c >> 6U),
                      static_cast<std::uint8_t>((c & 0x3FU) << 2U), 0};
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

}  // namespace tacto::sciencemode
