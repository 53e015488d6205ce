// Requests: each parameter in its own place on the wire, and refused where it does not fit.
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

#include "core/base/NaN.h"
#include "drivers/sciencemode/Commands.h"
#include "tests/drivers/sciencemode/Bytes.h"

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
    for (int us = kPointLeast_us; us <= kPointMost_us; ++us) {
        // All 521 currents at the ends of each nibble, some elsewhere.
        const int stride = us % 256 < 2 || us % 16 == 15 ? 1 : 29;
        for (int half = -260; half <= 260; half += stride) {
            const Point point{Micros(us), Milliamps(half / 2.0)};
            const auto bytes = encodePoint(point);
            ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
            ASSERT_EQ(decodePoint(*bytes), point);
        }
    }
}

TEST(ScienceModePoint, TimeAndCurrentHaveBitsOfTheirOwn) {
    RecordProperty("hazard", "H4");
    // Time 12 bits, current 10 bits + 300, ten bits of nothing: read here bit by bit, from the wire description alone.
    const bool held = rc::check("point layout", [] {
        const int us = *rc::gen::inRange(kPointLeast_us, kPointMost_us + 1);
        const int half = *rc::gen::inRange(-260, 261);
        const auto bytes = encodePoint({Micros(us), Milliamps(half * 0.5)});
        RC_ASSERT(bytes.has_value());
        const auto word = (static_cast<std::uint32_t>((*bytes)[0]) << 24U) |
                          (static_cast<std::uint32_t>((*bytes)[1]) << 16U) |
                          (static_cast<std::uint32_t>((*bytes)[2]) << 8U) | (*bytes)[3];
        RC_ASSERT(word >> 20U == static_cast<std::uint32_t>(us));
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
        const auto refused = encodePoint({Micros(us), Milliamps(5)});
        ASSERT_FALSE(refused.has_value()) << us << " µs";
        EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    }
}

TEST(ScienceModePeriod, IsInHalfMillisecondsOrQuartersWhereOnlyThoseFit) {
    EXPECT_EQ(*encodePeriod(Seconds(0.5)), 0x07D0);
    EXPECT_EQ(*encodePeriod(Seconds(2)), 0x1F40);
    EXPECT_EQ(*encodePeriod(Seconds(16.3835)), 0xFFFE);
    EXPECT_EQ(*encodePeriod(Seconds(0.00025)), 0x0003);
    EXPECT_EQ(*encodePeriod(Seconds(8.19175)), 0xFFFF);
    for (unsigned bits = 2; bits <= 0xFFFF; ++bits) {
        const auto word = static_cast<std::uint16_t>(bits);
        const auto again = encodePeriod(decodePeriod(word));
        ASSERT_TRUE(again.has_value()) << bits;
        ASSERT_DOUBLE_EQ(decodePeriod(*again).count(), decodePeriod(word).count());
    }
}

TEST(ScienceModePeriod, RefusesWhatDoesNotFit) {
    RecordProperty("hazard", "H1");
    for (const double s :
         {16.384, 16.3840001, 20.0, 32.768, 8.19225, 0.0, -0.5, 0.0001, 0.5001, 1e9, kNaN, kInfinite}) {
        EXPECT_FALSE(encodePeriod(Seconds(s)).has_value()) << s;
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
                    const auto payload = payloadOf(ChannelConfig{channel, connector, execute, points});
                    ASSERT_TRUE(payload.has_value());
                    ASSERT_EQ(payload->size, 1 + 4 * count);
                    const auto head = static_cast<int>(payload->bytes[0]);
                    EXPECT_EQ(head, static_cast<int>(count - 1) + 16 * connector + 32 * channel + (execute ? 128 : 0));
                    const auto read = readChannelConfig(payload->view());
                    ASSERT_TRUE(read.has_value());
                    EXPECT_EQ(read->channel, channel);
                    EXPECT_EQ(read->connector, connector);
                    EXPECT_EQ(read->execute, execute);
                    EXPECT_TRUE(std::ranges::equal(read->points.span(), points.span()));
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

TEST(ScienceModeRequest, MidLevelUpdateOfAnyChannelsComesBack) {
    RecordProperty("hazard", "H4");
    const bool held = rc::check("ML_UPDATE round trip", [] {
        MidLevelUpdate update;
        const auto mask = *rc::gen::inRange(0, 256);
        for (std::size_t i = 0; i < kMidChannels; ++i) {
            if ((mask >> i & 1) == 0) continue;
            MidLevelChannel channel;
            channel.channel = static_cast<int>(i);
            channel.ramp = *rc::gen::inRange(0, 16);
            channel.period = Seconds(0.0005 * *rc::gen::inRange(140, 0x8000));
            const int count = *rc::gen::inRange(1, 17);
            for (int p = 0; p < count; ++p) {
                RC_ASSERT(channel.points.add(
                    {Micros(*rc::gen::inRange(10, 4096)), Milliamps(*rc::gen::inRange(-260, 261) * 0.5)}));
            }
            update.channels[i] = channel;
        }
        const auto payload = payloadOf(update);
        RC_ASSERT(payload.has_value());
        RC_ASSERT(payload->bytes[0] == mask);
        const auto read = readMidLevelUpdate(payload->view());
        RC_ASSERT(read.has_value());
        for (std::size_t i = 0; i < kMidChannels; ++i) {
            RC_ASSERT(read->channels[i].has_value() == update.channels[i].has_value());
            if (!read->channels[i]) continue;
            RC_ASSERT(read->channels[i]->ramp == update.channels[i]->ramp);
            RC_ASSERT(std::abs((read->channels[i]->period - update.channels[i]->period).count()) < 1e-9);
            RC_ASSERT(std::ranges::equal(read->channels[i]->points.span(), update.channels[i]->points.span()));
        }
    });
    EXPECT_TRUE(held);
}

TEST(ScienceModeRequest, MidLevelUpdateRefusesWhatDoesNotFit) {
    RecordProperty("hazard", "H1");
    const auto refused = [](const MidLevelChannel& channel) {
        MidLevelUpdate update;
        update.channels[0] = channel;
        return !payloadOf(update).has_value();
    };
    EXPECT_FALSE(refused({0, 0, Seconds(0.5), onePoint()}));
    EXPECT_TRUE(refused({1, 0, Seconds(0.5), onePoint()})) << "a channel in another's place";
    EXPECT_TRUE(refused({0, 16, Seconds(0.5), onePoint()}));
    EXPECT_TRUE(refused({0, -1, Seconds(0.5), onePoint()}));
    EXPECT_TRUE(refused({0, 0, Seconds(16.384), onePoint()}));
    EXPECT_TRUE(refused({0, 0, Seconds(0.5), {}}));
    EXPECT_TRUE(refused({0, 0, Seconds(0.004), onePoint(4000)})) << "a pulse as long as its period";
    for (const auto* wrong : {"", "01", "01 20 07 D0 0C 84 D8 00", "01 00 07 D0 0C 84 D8 00 00", "00 00"}) {
        EXPECT_FALSE(readMidLevelUpdate(bytesOf(wrong)).has_value()) << wrong;
    }
}

TEST(ScienceModeRequest, MidLevelInitIsOneByte) {
    for (const bool stop : {false, true}) EXPECT_EQ(readMidLevelInit(midLevelInitPayload(stop).view()), stop);
    EXPECT_FALSE(readMidLevelInit(bytesOf("02")).has_value());
    EXPECT_FALSE(readMidLevelInit({}).has_value());
}

}  // namespace
}  // namespace tacto::test
