// Acks: answers are accepted only in their documented length and range.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/drivers/sciencemode/Bytes.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/sciencemode/DeviceSide.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using sciencemode::Command;

ChannelConfigAck measuredAck() {
    ChannelConfigAck ack;
    ack.complete = ack.measured = true;
    ack.channel = 2;
    ack.connector = 1;
    ack.measurement = Measurement::Voltage;
    ack.sampleTime_us = 0x1234;
    for (std::size_t i = 0; i < kSamples; ++i) ack.samples[i] = static_cast<std::uint16_t>(257 * i);
    return ack;
}

TEST(ScienceModeAck, ChannelConfigPutsEachValueInItsPlace) {
    RecordProperty("hazard", "H4");
    const auto payload = payloadOf(measuredAck());
    ASSERT_EQ(payload.size, 261U);
    EXPECT_EQ(payload.bytes[0], 0);
    EXPECT_EQ(payload.bytes[1], 0x12) << "channel, connector << 4";
    EXPECT_EQ(payload.bytes[2], 2);
    EXPECT_EQ(payload.bytes[3], 0x12);
    EXPECT_EQ(payload.bytes[4], 0x34);
    EXPECT_EQ(payload.bytes[5 + 2 * 3], 3);
    EXPECT_EQ(payload.bytes[6 + 2 * 3], 3);
    ChannelConfigAck read;
    ASSERT_TRUE(readChannelConfigAck(payload.view(), read).has_value());
    EXPECT_TRUE(read.complete && read.measured);
    EXPECT_EQ(read.channel, 2);
    EXPECT_EQ(read.connector, 1);
    EXPECT_EQ(read.sampleTime_us, 0x1234);
    EXPECT_EQ(read.samples, measuredAck().samples);
}

TEST(ScienceModeAck, ChannelConfigOfAnyOtherLengthIsRefused) {
    RecordProperty("hazard", "H10");
    const auto payload = payloadOf(measuredAck());
    for (std::size_t length = 0; length <= kMaxPayload; ++length) {
        std::vector<std::uint8_t> bytes(length);
        std::copy_n(payload.bytes.begin(), std::min(length, payload.size), bytes.begin());
        ChannelConfigAck read;
        const bool accepted = readChannelConfigAck(bytes, read).has_value();
        EXPECT_EQ(accepted, length == 3 || length == 261) << length;
        if (length == 3) {
            EXPECT_FALSE(read.measured) << "no samples came";
        }
    }
    ChannelConfigAck read;
    EXPECT_TRUE(readChannelConfigAck(bytesOf("0A"), read).has_value()) << "a refusal is a result alone";
    EXPECT_EQ(read.result, ResultCode::Electrode);
    EXPECT_FALSE(readChannelConfigAck(bytesOf("00 00 04"), read).has_value()) << "measurement 4";
}

TEST(ScienceModeAck, AnOldReadBackDoesNotSurviveInAReusedAck) {
    ChannelConfigAck read;
    ASSERT_TRUE(readChannelConfigAck(payloadOf(measuredAck()).view(), read).has_value());
    ASSERT_TRUE(readChannelConfigAck(bytesOf("04"), read).has_value());
    EXPECT_FALSE(read.complete);
    EXPECT_FALSE(read.measured);
    EXPECT_EQ(read.measurement, Measurement::None);
}

TEST(ScienceModeAck, StatusIdentityAndVersionComeBack) {
    RecordProperty("hazard", "H4");
    const auto status = accepted(readStimStatusAck(payloadOf(StimStatusAck{Stimulation::MidLevelRunning, 6}).view()));
    EXPECT_EQ(status.status, Stimulation::MidLevelRunning);
    EXPECT_EQ(status.highVoltage, 6);
    const auto id = accepted(readDeviceIdAck(payloadOf(DeviceIdAck{"P24-000123"}).view()));
    EXPECT_EQ(id.id, "P24-000123");
    const auto version = accepted(readExtendedVersionAck(payloadOf(ExtendedVersionAck{{1, 2, 3}, {4, 5, 6}}).view()));
    EXPECT_EQ(version.firmware.text(), "1.2.3");
    EXPECT_EQ(version.protocol.text(), "4.5.6");
}

TEST(ScienceModeAck, WrongLengthsAndValuesAreRefused) {
    RecordProperty("hazard", "H10");
    for (const auto* wrong : {"", "00", "00 01", "00 04 00", "00 01 00 00"}) {
        EXPECT_FALSE(readStimStatusAck(bytesOf(wrong)).has_value()) << wrong;
    }
    for (const auto* wrong :
         {"", "00", "00 41 42", "00 41 42 43 44 45 46 47 48 49 1B", "00 41 42 43 44 45 46 47 48 49 4A 4B"}) {
        EXPECT_FALSE(readDeviceIdAck(bytesOf(wrong)).has_value()) << wrong;
    }
    for (const auto* wrong : {"", "00", "00 01 02 03 04 05", "00 01 02 03 04 05 06 07"}) {
        EXPECT_FALSE(readExtendedVersionAck(bytesOf(wrong)).has_value()) << wrong;
    }
    EXPECT_FALSE(readPlainAck(Command::LowLevelInit, {}).has_value());
    EXPECT_FALSE(readPlainAck(Command::LowLevelInit, bytesOf("00 00")).has_value());
}

TEST(ScienceModeAck, NoPayloadAtAllBreaksAParser) {
    RecordProperty("hazard", "H10");
    const bool held = rc::check("ack parsers", [](const std::vector<std::uint8_t>& payload) {
        ChannelConfigAck ack;
        if (readChannelConfigAck(payload, ack) && ack.measured) RC_ASSERT(payload.size() == 261U);
        if (const auto id = readDeviceIdAck(payload)) RC_ASSERT(id->id.size() <= 10U);
        static_cast<void>(readStimStatusAck(payload));
        static_cast<void>(readExtendedVersionAck(payload));
        static_cast<void>(readPlainAck(Command::Reset, payload));
    });
    EXPECT_TRUE(held);
}

TEST(ScienceModeAck, EveryCodeHasASentenceOfItsOwn) {
    std::vector<std::string> seen;
    for (int code = 0; code < 256; ++code) {
        const auto text = refusal(Command::ChannelConfig, static_cast<ResultCode>(code)).value().message;
        EXPECT_THAT(text, testing::HasSubstr(fmt::format("(result {})", code)));
        const auto meaning = std::string(meaningOf(static_cast<ResultCode>(code)));
        if (meaning.find("no name") == std::string::npos) seen.push_back(meaning);
    }
    EXPECT_EQ(seen.size(), 12U);
    std::ranges::sort(seen);
    EXPECT_EQ(std::ranges::adjacent_find(seen), seen.end());
}

}  // namespace
}  // namespace tacto::test
