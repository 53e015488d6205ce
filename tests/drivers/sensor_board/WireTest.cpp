// Frames from a stream of arbitrary bytes: every wrong bit is noticed, junk costs only the frame that follows it
// without a delimiter, and the decoder never stores more than one frame.
#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>

#include "drivers/sensor_board/Messages.h"
#include "resources/firmware/sensor_board/tsb_board.h"
#include "tests/drivers/sensor_board/Golden.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using sensorboard::Command;
using Bytes = std::vector<std::uint8_t>;

struct Taken {
    std::uint8_t type;
    Bytes payload;
    bool operator==(const Taken&) const = default;
};

/// Decodes all frames of `bytes`, passed to the decoder in pieces of `piece` bytes.
std::vector<Taken> takeAll(FrameDecoder& decoder, std::span<const std::uint8_t> bytes, std::size_t piece = 4096) {
    std::vector<Taken> all;
    while (!bytes.empty()) {
        auto part = bytes.first(std::min(piece, bytes.size()));
        bytes = bytes.subspan(part.size());
        while (const auto frame = decoder.take(part)) {
            all.push_back({frame->type, {frame->payload.begin(), frame->payload.end()}});
        }
    }
    return all;
}

Bytes operator+(Bytes a, const Bytes& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(SensorBoardWire, ReadsEveryGoldenFrameInPiecesOfAnySize) {
    Bytes all;
    for (const auto& frame : goldenFrames()) all = all + frame.bytes;
    for (std::size_t piece : {1U, 2U, 3U, 7U, 64U, 4096U}) {
        FrameDecoder decoder;
        const auto taken = takeAll(decoder, all, piece);
        ASSERT_EQ(taken.size(), goldenFrames().size());
        for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i].type, goldenFrames()[i].typeByte());
        EXPECT_EQ(decoder.counts().bad(), 0U);
        EXPECT_EQ(decoder.counts().bytes, all.size());
    }
}

TEST(SensorBoardWire, EveryWrongBitOfEveryFrameIsNoticedAndCostsNoOtherFrame) {
    RecordProperty("hazard", "H7");
    for (const auto& frame : goldenFrames()) {
        for (std::size_t bit = 0; bit < 8 * frame.bytes.size(); ++bit) {
            auto spoilt = frame.bytes;
            spoilt[bit / 8] = static_cast<std::uint8_t>(spoilt[bit / 8] ^ (1U << (bit % 8)));
            const bool delimiter = bit / 8 == spoilt.size() - 1;
            FrameDecoder decoder;
            const auto taken = takeAll(decoder, golden("STOP") + spoilt + golden("START") + golden("HELLO"));
            // Without its delimiter the frame also spoils the next one.
            const std::size_t kept = delimiter ? 2 : 3;
            ASSERT_EQ(taken.size(), kept) << frame.text << ", bit " << bit;
            EXPECT_EQ(taken.front().type, TSB_STOP);
            EXPECT_EQ(taken.back().type, TSB_HELLO);
            EXPECT_GE(decoder.counts().bad(), 1U);
        }
    }
}

TEST(SensorBoardWire, EveryPairOfWrongBitsInADataFrameIsNoticed) {
    RecordProperty("hazard", "H7");
    const auto& frame = golden("DATA: stream 0");
    for (std::size_t a = 0; a < 8 * frame.size(); ++a) {
        for (std::size_t b = a + 1; b < 8 * frame.size(); ++b) {
            auto spoilt = frame;
            for (const auto bit : {a, b}) {
                spoilt[bit / 8] = static_cast<std::uint8_t>(spoilt[bit / 8] ^ (1U << (bit % 8)));
            }
            FrameDecoder decoder;
            ASSERT_TRUE(takeAll(decoder, spoilt).empty()) << a << " and " << b;
        }
    }
}

TEST(SensorBoardWire, FindsTheNextFrameAfterJunkThatEndedWithAZero) {
    std::mt19937 engine(11);
    for (int round = 0; round < 500; ++round) {
        Bytes junk(engine() % 600);
        for (auto& byte : junk) byte = static_cast<std::uint8_t>(engine());
        junk.push_back(0);
        FrameDecoder decoder;
        const auto taken = takeAll(decoder, junk + golden("STATUS"), 1 + engine() % 97);
        ASSERT_EQ(taken.size(), 1U);
        EXPECT_EQ(taken[0].type, TSB_STATUS);
    }
}

TEST(SensorBoardWire, LosesOneFrameToJunkThatRunsIntoIt) {
    FrameDecoder decoder;
    EXPECT_EQ(takeAll(decoder, Bytes{1, 2, 3} + golden("START") + golden("STOP")).size(), 1U);
    EXPECT_EQ(decoder.counts().bad(), 1U);
}

TEST(SensorBoardWire, NothingBetweenZerosIsNoError) {
    FrameDecoder decoder;
    EXPECT_EQ(takeAll(decoder, Bytes(100, 0) + golden("START") + Bytes(100, 0)).size(), 1U);
    EXPECT_EQ(decoder.counts().bad(), 0U);
}

TEST(SensorBoardWire, WhatIsTooLongIsPassedOverAndCountedOnce) {
    RecordProperty("hazard", "H10");
    FrameDecoder decoder;
    EXPECT_EQ(takeAll(decoder, Bytes(1'000'000, 7) + Bytes{0} + golden("START"), 333).size(), 1U);
    EXPECT_EQ(decoder.counts().tooLong, 1U);
    EXPECT_EQ(decoder.counts().bad(), 1U);
}

TEST(SensorBoardWire, TheLongestFrameFitsAndAByteMoreDoesNot) {
    // Content without a zero forms one full group.
    Bytes content{1, 0x7F};
    while (content.size() < kMaxContent - 4) content.push_back(0x33);
    for (std::uint8_t last = 1; last < 255; ++last) {
        content.back() = last;
        auto sealed = content;
        const auto crc = crcOf(content);
        for (unsigned s = 0; s < 32; s += 8) sealed.push_back(static_cast<std::uint8_t>(crc >> s));
        if (std::ranges::find(sealed, 0) != sealed.end()) continue;
        FrameDecoder decoder;
        EXPECT_EQ(takeAll(decoder, Bytes{0xFF} + sealed + Bytes{0}).size(), 1U);
        EXPECT_EQ(takeAll(decoder, Bytes{0xFF} + sealed + Bytes{1, 0}).size(), 0U) << "256 bytes before the zero";
        // The firmware must produce the same frame.
        std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
        tsb_writer writer{};
        tsb_begin(&writer, frame.data(), 1, 0x7F);
        for (std::size_t i = 2; i < content.size(); ++i) tsb_put_u8(&writer, content[i]);
        ASSERT_EQ(tsb_seal(&writer), TSB_FRAME_MOST);
        EXPECT_EQ(Bytes(frame.begin(), frame.end()), Bytes{0xFF} + sealed + Bytes{0});
        return;
    }
    FAIL() << "no content without a zero was found";
}

TEST(SensorBoardWire, GarbageOfAnyKindMakesNoFrame) {
    RecordProperty("hazard", "H10");
    std::mt19937 engine(5);
    FrameDecoder decoder;
    Bytes noise(1 << 20);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(engine());
    EXPECT_TRUE(takeAll(decoder, noise, 4096).empty());
    EXPECT_GT(decoder.counts().bad(), 3000U);
}

TEST(SensorBoardWire, WhatTheFirmwareEncodesIsWhatTheHostDecodes) {
    EXPECT_TRUE(rc::check("blocks", [] {
        tsb_block block{};
        block.stream = *rc::gen::inRange<std::uint8_t>(0, 8);
        block.columns = *rc::gen::inRange<std::uint8_t>(1, 17);
        const bool wide = *rc::gen::arbitrary<bool>();
        const auto format = static_cast<std::uint8_t>(wide ? TSB_FORMAT_INT32 : TSB_FORMAT_INT16);
        block.count =
            *rc::gen::inRange<std::uint8_t>(1, static_cast<std::uint8_t>(tsb_block_most(block.columns, format) + 1));
        block.sequence = *rc::gen::arbitrary<std::uint32_t>();
        block.index = *rc::gen::arbitrary<std::uint32_t>();
        block.time_us = *rc::gen::arbitrary<std::uint64_t>();
        block.interval_ns = *rc::gen::arbitrary<std::uint32_t>();
        const auto values = static_cast<std::size_t>(block.count) * block.columns;
        const auto raw = *rc::gen::container<std::vector<std::int32_t>>(values, rc::gen::arbitrary<std::int32_t>());
        std::vector<std::int16_t> narrow(raw.begin(), raw.end());
        std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
        const auto size = wide ? tsb_encode_int32(frame.data(), &block, raw.data())
                               : tsb_encode_int16(frame.data(), &block, narrow.data());
        RC_ASSERT(size > 0U);
        RC_ASSERT(std::count(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size), 0) == 1);

        FrameDecoder decoder;
        std::span<const std::uint8_t> bytes(frame.data(), size);
        const auto got = decoder.take(bytes);
        RC_ASSERT(got.has_value());
        const auto read = readBlock(*got);
        RC_ASSERT(read.has_value());
        RC_ASSERT(read->stream == block.stream);
        RC_ASSERT(read->count == block.count);
        RC_ASSERT(read->sequence == block.sequence);
        RC_ASSERT(read->index == block.index);
        RC_ASSERT(read->time_us == block.time_us);
        RC_ASSERT(read->interval_ns == block.interval_ns);
        Bytes expected;
        for (std::size_t i = 0; i < values; ++i) {
            const auto value = static_cast<std::uint32_t>(wide ? raw[i] : narrow[i]);
            for (unsigned s = 0; s < (wide ? 32U : 16U); s += 8)
                expected.push_back(static_cast<std::uint8_t>(value >> s));
        }
        RC_ASSERT(Bytes(read->samples.begin(), read->samples.end()) == expected);
    }));
}

TEST(SensorBoardWire, ATrainOfAnyNumbersComesAsItWasSent) {
    RecordProperty("hazard", "H4");
    EXPECT_TRUE(rc::check("trains", [] {
        const auto above = [] { return static_cast<float>(*rc::gen::inRange(1, 1 << 24)) / 1024.0F; };
        const tsb_train train{*rc::gen::arbitrary<std::uint32_t>(),
                              *rc::gen::arbitrary<std::uint64_t>(),
                              above(),
                              above(),
                              above(),
                              *rc::gen::inRange<std::uint8_t>(0, 3),
                              *rc::gen::inRange<std::uint8_t>(0, 2),
                              above(),
                              above(),
                              above(),
                              *rc::gen::inRange<std::uint32_t>(1, 0xFFFFFFFFU),
                              above(),
                              *rc::gen::arbitrary<std::uint16_t>()};
        std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
        FrameDecoder decoder;
        std::span<const std::uint8_t> bytes(frame.data(), tsb_encode_train(frame.data(), &train));
        const auto got = decoder.take(bytes);
        RC_ASSERT(got.has_value() && got->is(Reply::Train));
        const auto read = readTrain(*got);
        RC_ASSERT(read.has_value());
        RC_ASSERT(read->sequence == train.sequence && read->onset_us == train.onset_us);
        RC_ASSERT(read->interval_s == train.interval_s && read->command_v == train.command_v);
        RC_ASSERT(read->amplitude == train.amplitude && read->shape == train.shape);
        RC_ASSERT(read->negative == (train.negative == 1) && read->width_us == train.width_us);
        RC_ASSERT(read->gap_us == train.gap_us && read->rechargeRatio == train.recharge_ratio);
        RC_ASSERT(read->pulses == train.pulses && read->rate_hz == train.pulse_hz);
        RC_ASSERT(read->ahead_us == train.ahead_us);
    }));
}

TEST(SensorBoardWire, WhatTheHostSendsIsWhatTheFirmwareHears) {
    EXPECT_TRUE(rc::check("commands", [] {
        const auto type = *rc::gen::element(Command::Hello, Command::GetConfiguration, Command::GetCalibration,
                                            Command::Start, Command::Stop, Command::GetStatus, Command::GetEncoder);
        const auto token = *rc::gen::arbitrary<std::uint8_t>();
        const auto stream = *rc::gen::arbitrary<std::uint8_t>();
        const bool names = type == Command::GetConfiguration || type == Command::GetCalibration;
        const auto bytes = encodeCommand(type, token, names ? Bytes{stream} : Bytes{});
        tsb_receiver receiver{};
        tsb_command command{};
        int heard = 0;
        // The line carried arbitrary bytes before.
        const auto before = *rc::gen::arbitrary<Bytes>();
        for (const auto byte : before) (void)tsb_receive(&receiver, byte, &command);
        for (const auto byte : bytes) heard += tsb_receive(&receiver, byte, &command);
        RC_ASSERT(heard == 1);
        RC_ASSERT(command.type == static_cast<std::uint8_t>(type));
        RC_ASSERT(command.token == token);
        RC_ASSERT(command.stream == (names ? stream : 0));
    }));
}

}  // namespace
}  // namespace tacto::test
