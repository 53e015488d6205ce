// The frames of ScienceMode4: the vendor's own bytes, and all kinds of faulty streams.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <rapidcheck.h>

#include "drivers/sciencemode/ScienceModeCommands.h"
#include "tests/drivers/sciencemode/Bytes.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using sciencemode::Command;

std::vector<std::uint8_t> frameOf(std::uint16_t command, std::uint8_t number, std::span<const std::uint8_t> payload) {
    FrameBytes frame;
    const auto encoded = encodeFrame({command, number, payload}, frame);
    EXPECT_TRUE(encoded.has_value()) << encoded.error().message;
    return {frame.view().begin(), frame.view().end()};
}

std::vector<std::uint8_t> frameOf(Command command, std::uint8_t number, std::span<const std::uint8_t> payload = {}) {
    return frameOf(static_cast<std::uint16_t>(command), number, payload);
}

/// A packet with its own copy of the payload.
struct Taken {
    std::uint16_t command;
    std::uint8_t number;
    std::vector<std::uint8_t> payload;
    bool operator==(const Taken&) const = default;
};

/// Decodes all packets of `bytes`, passed to the decoder in pieces of `piece` bytes.
std::vector<Taken> takeAll(FrameDecoder& decoder, std::span<const std::uint8_t> bytes, std::size_t piece = 4096) {
    std::vector<Taken> all;
    while (!bytes.empty()) {
        auto part = bytes.first(std::min(piece, bytes.size()));
        bytes = bytes.subspan(part.size());
        while (const auto packet = decoder.take(part)) {
            all.push_back({packet->command, packet->number, {packet->payload.begin(), packet->payload.end()}});
        }
    }
    return all;
}

Points goldenPoints() {
    Points points;
    EXPECT_TRUE(points.add({Micros(200), Milliamps(5)}));
    EXPECT_TRUE(points.add({Micros(100), Milliamps(0)}));
    EXPECT_TRUE(points.add({Micros(200), Milliamps(-5)}));
    return points;
}

// Checks the frames in resources/design/wire/sciencemode4.md.
TEST(ScienceModeFrame, GoldenFramesByteForByte) {
    RecordProperty("hazard", "H4");
    EXPECT_EQ(frameOf(Command::LowLevelInit, 1, payloadOf(LowLevelInit{}).view()),
              bytesOf("F0 81 55 81 58 81 89 81 95 04 00 00 0F"));
    EXPECT_EQ(frameOf(Command::LowLevelInit, 1, payloadOf(LowLevelInit{HighVoltage::V60, Measurement::None}).view()),
              bytesOf("F0 81 55 81 58 81 E9 81 53 04 00 06 0F"));
    const auto config = accepted(payloadOf(ChannelConfig{0, 0, true, goldenPoints()}));
    EXPECT_EQ(frameOf(Command::ChannelConfig, 2, config.view()),
              bytesOf("F0 81 55 81 4C 81 60 81 02 08 02 82 0C 84 D8 00 06 44 B0 00 0C 84 88 00 0F"));
    EXPECT_EQ(frameOf(Command::MidLevelStop, 6), bytesOf("F0 81 55 81 59 81 DB 81 AF 18 22 0F"));
    EXPECT_EQ(frameOf(Command::MidLevelStop, 60), bytesOf("F0 81 55 81 58 81 BF 81 94 81 A5 22 0F"));
}

TEST(ScienceModeFrame, CrcIsXmodem) {
    const std::string_view check = "123456789";
    EXPECT_EQ(crc16({reinterpret_cast<const std::uint8_t*>(check.data()), check.size()}),
              figuresOf("digests").at("crc16_xmodem").at(check).get<std::uint16_t>());
}

TEST(ScienceModeFrame, EveryPacketNumberComesBack) {
    for (unsigned round = 0; round < 3; ++round) {
        for (std::uint8_t number = 0; number <= kMaxNumber; ++number) {
            FrameDecoder decoder;
            const auto all = takeAll(decoder, frameOf(Command::MidLevelStop, number));
            ASSERT_EQ(all.size(), 1U) << static_cast<int>(number);
            EXPECT_EQ(all[0].number, number);
            EXPECT_EQ(all[0].command, 34);
        }
    }
}

TEST(ScienceModeFrame, WhatIsEncodedDecodesToTheSameWhateverItsBytes) {
    const bool held = rc::check("frame round trip", [] {
        const auto command = *rc::gen::inRange<int>(0, kMaxCommand + 1);
        const auto number = *rc::gen::inRange<int>(0, kMaxNumber + 1);
        const auto length = *rc::gen::inRange<std::size_t>(0, kMaxPayload + 1);
        // Half of the bytes are ones that must be stuffed.
        const auto payload = *rc::gen::container<std::vector<std::uint8_t>>(
            length, rc::gen::oneOf(rc::gen::arbitrary<std::uint8_t>(),
                                   rc::gen::element<std::uint8_t>(0xF0, 0x0F, 0x81, 0x55, 0xA5, 0x5A)));
        const auto piece = *rc::gen::inRange<std::size_t>(1, 40);
        const Taken wanted{static_cast<std::uint16_t>(command), static_cast<std::uint8_t>(number), payload};
        FrameDecoder decoder;
        const auto all = takeAll(decoder, frameOf(wanted.command, wanted.number, payload), piece);
        RC_ASSERT(all.size() == 1U);
        RC_ASSERT(all[0] == wanted);
        RC_ASSERT(decoder.junkBytes() == 0U);
    });
    EXPECT_TRUE(held);
}

TEST(ScienceModeFrame, RefusesWhatTheFrameCannotCarry) {
    FrameBytes frame;
    EXPECT_FALSE(encodeFrame({1024, 0, {}}, frame).has_value());
    EXPECT_FALSE(encodeFrame({0, 64, {}}, frame).has_value());
    const std::vector<std::uint8_t> tooLong(kMaxPayload + 1);
    EXPECT_FALSE(encodeFrame({0, 0, tooLong}, frame).has_value());
    const std::vector<std::uint8_t> worst(kMaxPayload, 0xF0);
    EXPECT_TRUE(encodeFrame({1023, 63, worst}, frame).has_value());
    EXPECT_LE(frame.size, kMaxFrame);
}

TEST(ScienceModeDecoder, FindsTheNextFrameAfterAnyJunk) {
    RecordProperty("hazard", "H10");
    const bool held = rc::check("resynchronisation", [] {
        // Junk made of the bytes that frames use, which is the hardest case.
        const auto junk = *rc::gen::container<std::vector<std::uint8_t>>(
            rc::gen::oneOf(rc::gen::arbitrary<std::uint8_t>(),
                           rc::gen::element<std::uint8_t>(0xF0, 0x81, 0x55, 0x54, 0x51, 0x58, 0x0F, 0xF0, 0x81)));
        const std::vector<std::uint8_t> payload = {0xF0, 1, 2, 0x0F, 0x81};
        const auto frame = frameOf(Command::ChannelConfig, 60, payload);
        auto bytes = junk;
        bytes.insert(bytes.end(), frame.begin(), frame.end());
        // A second frame makes the decoder finish whatever the junk had begun.
        bytes.insert(bytes.end(), frame.begin(), frame.end());
        FrameDecoder decoder;
        const auto all = takeAll(decoder, bytes, *rc::gen::inRange<std::size_t>(1, 30));
        RC_ASSERT(all.size() == 2U);
        RC_ASSERT(all[1].payload == payload);
        RC_ASSERT(decoder.junkBytes() == junk.size());
    });
    EXPECT_TRUE(held);
}

TEST(ScienceModeDecoder, DoesNotWaitForWhatALyingLengthClaims) {
    const auto good = frameOf(Command::MidLevelStop, 6);
    for (unsigned claimed = 0; claimed <= 0xFFFF; ++claimed) {
        auto liar = good;
        liar[2] = static_cast<std::uint8_t>((claimed >> 8U) ^ 0x55U);
        liar[4] = static_cast<std::uint8_t>((claimed & 0xFFU) ^ 0x55U);
        liar.insert(liar.end(), good.begin(), good.end());
        FrameDecoder decoder;
        const auto all = takeAll(decoder, liar);
        ASSERT_EQ(all.size(), claimed == good.size() ? 2U : 1U) << "a length of " << claimed;
        ASSERT_EQ(all.back().number, 6);
    }
}

TEST(ScienceModeDecoder, EverySingleBitErrorIsFoundAndTheNextFrameKept) {
    RecordProperty("hazard", "H10");
    Points points = goldenPoints();
    const auto payload = payloadOf(ChannelConfig{0, 0, true, points});
    const auto good = frameOf(Command::ChannelConfig, 2, payload->view());
    for (std::size_t byte = 0; byte < good.size(); ++byte) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            auto bytes = good;
            bytes[byte] = static_cast<std::uint8_t>(bytes[byte] ^ (1U << bit));
            bytes.insert(bytes.end(), good.begin(), good.end());
            FrameDecoder decoder;
            ASSERT_EQ(takeAll(decoder, bytes).size(), 1U) << "bit " << bit << " of byte " << byte;
        }
    }
}

TEST(ScienceModeDecoder, TruncatedFramesLoseOnlyThemselves) {
    const auto good = frameOf(Command::ExtendedVersion, 9, bytesOf("00 01 02 F0 04 00 0F"));
    for (std::size_t kept = 0; kept < good.size(); ++kept) {
        std::vector<std::uint8_t> bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(kept));
        bytes.insert(bytes.end(), good.begin(), good.end());
        FrameDecoder decoder;
        EXPECT_EQ(takeAll(decoder, bytes).size(), 1U) << kept;
    }
}

TEST(ScienceModeDecoder, LengthAndCrcMayThemselvesLookLikeStartAndEnd) {
    // A length of 165 gives the low byte A5, which is escaped as F0; a length of 90 gives 5A, escaped as 0F.
    for (const std::size_t length : {165U, 90U}) {
        const std::vector<std::uint8_t> payload(length - kFrameOverhead - 2, 7);
        const auto frame = frameOf(Command::ChannelConfig, 1, payload);
        ASSERT_EQ(frame.size(), length);
        ASSERT_EQ(frame[4], length == 165U ? 0xF0 : 0x0F);
        FrameDecoder decoder;
        EXPECT_EQ(takeAll(decoder, frame).size(), 1U);
        EXPECT_EQ(decoder.junkBytes(), 0U);
    }
}

TEST(ScienceModeDecoder, RefusesStuffingThatNoEncoderMakes) {
    // Two bodies with a correct CRC: one escapes an ordinary byte, one ends in the middle of an escape.
    for (const auto* stuffed : {"04 00 81 54", "04 00 81"}) {
        auto body = bytesOf(stuffed);
        const auto crc = crc16(body);
        const auto length = kFrameOverhead + body.size();
        std::vector<std::uint8_t> frame{0xF0};
        for (const unsigned byte : {0U, static_cast<unsigned>(length), static_cast<unsigned>(crc) >> 8U,
                                    static_cast<unsigned>(crc) & 0xFFU}) {
            frame.push_back(0x81);
            frame.push_back(static_cast<std::uint8_t>(byte ^ 0x55U));
        }
        frame.insert(frame.end(), body.begin(), body.end());
        frame.push_back(0x0F);
        FrameDecoder decoder;
        EXPECT_TRUE(takeAll(decoder, frame).empty()) << stuffed;
        EXPECT_GE(decoder.brokenFrames(), 1U);
    }
}

TEST(ScienceModeDecoder, AMegabyteOfNoiseLeavesNothingBehind) {
    std::mt19937 random(1);
    FrameDecoder decoder;
    std::vector<std::uint8_t> noise(1 << 20);
    for (auto& byte : noise) {
        const auto drawn = random();
        byte = static_cast<std::uint8_t>(drawn % 4 == 0 ? 0xF0 : drawn % 4 == 1 ? 0x81 : drawn >> 8U);
    }
    EXPECT_TRUE(takeAll(decoder, noise, 512).empty());
    const auto good = frameOf(Command::MidLevelStop, 6);
    auto twice = good;
    twice.insert(twice.end(), good.begin(), good.end());
    EXPECT_GE(takeAll(decoder, twice).size(), 1U);
}

}  // namespace
}  // namespace tacto::test
