// Requests: each parameter is encoded at its own place, or refused if it does not fit.
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

#include "core/base/Statistics.h"
#include "tests/drivers/sciencemode/Bytes.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/sciencemode/DeviceSide.h"

namespace tacto::test {
namespace {

using namespace sciencemode;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::vector<std::uint8_t> vectorOf(const Payload& payload) { return {payload.view().begin(), payload.view().end()}; }

Points onePoint(double us = 200, double mA = 5) {
    Points points;
    EXPECT_TRUE(points.add({Micros(us), Milliamps(mA)}));
    return points;
}

TEST(ScienceModePoint, EveryTimeAndCurrentComesBack) {
    RecordProperty("hazard", "H4");
    for (int us = kMinPoint_us; us <= kMaxPoint_us; ++us) {
        // Tries all 521 currents at times near multiples of 16 and 256, and some currents at the other times.
        const int stride = us % 256 < 2 || us % 16 == 15 ? 1 : 29;
        for (int half = -260; half <= 260; half += stride) {
            const Point point{Micros(us), Milliamps(half / 2.0)};
            const auto bytes = accepted(encodePoint(point));
            ASSERT_EQ(decodePoint(bytes), point);
        }
    }
}

TEST(ScienceModePoint, TimeAndCurrentHaveBitsOfTheirOwn) {
    RecordProperty("hazard", "H4");
    // 12 bits of time, 10 bits of current + 300, ten zero bits: checked bit by bit, only from the protocol document.
    const bool held = rc::check("point layout", [] {
        const int us = *rc::gen::inRange(kMinPoint_us, kMaxPoint_us + 1);
        const int half = *rc::gen::inRange(-260, 261);
        const auto bytes = encodePoint({Micros(us), Milliamps(half * 0.5)});
        RC_ASSERT(bytes.has_value());
        const auto word = (static_cast<std::uint32_t>((*bytes)[0]) << 24U) |
                          (static_cast<std::uint32_t>((*bytes)[1]) << 16U) |
                          (static_cast<std::uint32_t>((*bytes)[2]) << 8U) | (*bytes)[3];
        RC_ASSERT((word >> 20U) == static_cast<std::uint32_t>(us));
        RC_ASSERT((word >> 10U & 0x3FFU) == static_cast<std::uint32_t>(half + 300));
        RC_ASSERT((word & 0x3FFU) == 0U);
    });
    EXPECT_TRUE(held);
}

TEST(ScienceModePoint, RefusesWhatWouldWrap) {
    RecordProperty("hazard", "H1");
    for (const double mA : {130.5, -130.5, 131.0, 212.0, 1e9, -1e300, 0.25, 4.9, kNaN, kInfinite, -kInfinite}) {
        EXPECT_FALSE(encodePoint({Micros(200), Milliamps(mA)}).has_value()) << mA << " mA";
    }
    for (const double us : {4096.0, 9.0, 0.0, -200.0, 200.5, 1e12, kNaN, kInfinite}) {
        EXPECT_THAT(encodePoint({Micros(us), Milliamps(5)}), refused(ErrorCode::InvalidArgument)) << us << " µs";
    }
}

TEST(ScienceModeRequest, LowLevelInitPutsVoltageAndMeasurementInTheirBits) {
    RecordProperty("hazard", "H4");
    for (unsigned voltage = 0; voltage <= 6; ++voltage) {
        for (unsigned measurement = 0; measurement <= 3; ++measurement) {
            const LowLevelInit request{static_cast<HighVoltage>(voltage), static_cast<Measurement>(measurement)};
            const auto payload = payloadOf(request);
            ASSERT_EQ(vectorOf(payload),
                      std::vector<std::uint8_t>{static_cast<std::uint8_t>(2 * voltage + 16 * measurement)});
            EXPECT_EQ(readLowLevelInit(payload.view()), request);
        }
    }
    for (const auto* wrong : {"", "00 00", "0E", "40", "01", "80"}) {
        EXPECT_FALSE(readLowLevelInit(bytesOf(wrong)).has_value()) << wrong;
    }
}

TEST(ScienceModeRequest, ChannelConfigPutsEachParameterInItsPlace) {
    RecordProperty("hazard", "H4");
    for (int channel = 0; channel < 4; ++channel) {
        for (int connector = 0; connector < 2; ++connector) {
            for (const bool execute : {false, true}) {
                Points points;
                for (std::size_t count = 1; count <= kMaxPoints; ++count) {
                    ASSERT_TRUE(points.add({Micros(10.0 * static_cast<double>(count)), Milliamps(0.5)}));
                    const auto payload = accepted(payloadOf(ChannelConfig{channel, connector, execute, points}));
                    ASSERT_EQ(payload.size, 1 + 4 * count);
                    const auto head = static_cast<int>(payload.bytes[0]);
                    EXPECT_EQ(head, static_cast<int>(count - 1) + 16 * connector + 32 * channel + (execute ? 128 : 0));
                    const auto read = accepted(readChannelConfig(payload.view()));
                    EXPECT_EQ(read.channel, channel);
                    EXPECT_EQ(read.connector, connector);
                    EXPECT_EQ(read.execute, execute);
                    EXPECT_TRUE(std::ranges::equal(read.points.span(), points.span()));
                }
                EXPECT_FALSE(points.add({Micros(10), Milliamps(0)})) << "a 17th point";
            }
        }
    }
}

TEST(ScienceModeRequest, ChannelConfigRefusesWhatDoesNotFit) {
    RecordProperty("hazard", "H4");
    for (const auto& [channel, connector] : {std::pair{4, 0}, {-1, 0}, {0, 2}, {0, -1}}) {
        EXPECT_FALSE(payloadOf(ChannelConfig{channel, connector, true, onePoint()}).has_value());
    }
    EXPECT_FALSE(payloadOf(ChannelConfig{0, 0, true, {}}).has_value()) << "no points";
    EXPECT_FALSE(payloadOf(ChannelConfig{0, 0, true, onePoint(5000)}).has_value());
    EXPECT_FALSE(payloadOf(ChannelConfig{0, 0, true, onePoint(200, 130.5)}).has_value());
    for (const auto* wrong : {"", "80", "82 0C 84 D8 00", "80 0C 84 D8 00 00", "80 00 04 D8 00", "80 0C 80 00 00"}) {
        EXPECT_FALSE(readChannelConfig(bytesOf(wrong)).has_value()) << wrong;
    }
}

}  // namespace
}  // namespace tacto::test
