// A board that encodes: it is asked to only where the address says so, what it says comes once and in order, and one
// that cannot, or has a profile that its encoder refuses, is not opened.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/Random.h"
#include "drivers/sensor_board/BoardReport.h"
#include "drivers/sensor_board/PluggedBoard.h"
#include "resources/firmware/tactile_encoder/tactile_encoder.h"
#include "tests/drivers/sensor_board/SensorBoardBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using testing::HasSubstr;

EmulatedBoardSettings encoding(std::uint8_t refusal = 0, std::uint32_t layout = TE_LAYOUT) {
    EmulatedBoardSettings settings;
    settings.highestVersion = 2;
    settings.encoder = tsb_encoder{0, refusal, layout, 0x1234ABCD};
    return settings;
}

SensorBoardSettings asked(Encodes encodes) {
    SensorBoardSettings settings;
    settings.encodes = encodes;
    return settings;
}

template <class Message>
void send(SensorBoardBench& bench, std::size_t (*encode)(std::uint8_t*, const Message*), const Message& message) {
    std::array<std::uint8_t, TSB_FRAME_MOST> frame{};
    const auto size = encode(frame.data(), &message);
    bench.line->inspect([&](EmulatedBoard& board, Instant now) {
        board.send(std::span(frame).first(size), now);
        return 0;
    });
}

std::uint64_t boardTime(SensorBoardBench& bench) {
    return bench.line->inspect([](EmulatedBoard& board, Instant now) { return board.time_us(now); });
}

tsb_train trainAt(std::uint32_t sequence, std::uint64_t onset_us) {
    return {sequence, onset_us, 0.5F, 20.0F, 20.0F, TE_SYMMETRIC, 0, 200.0F, 100.0F, 10.0F, 10, 100.0F, 2500};
}

/// Reads once, a moment later, and returns what the encoder said.
Encoded readLater(SensorBoardBench& bench) {
    bench.clock.advanceTo(bench.clock.now() + std::chrono::milliseconds(2));
    EXPECT_TRUE(bench.board->read(bench.blocks).has_value());
    return bench.board->encoded();
}

TEST(SensorBoardEncoding, IsAskedForByTheAddressAlone) {
    const auto modeAfter = [](Encodes encodes, std::uint8_t before) {
        SensorBoardBench bench(encoding());
        if (before != 0) {
            bench.open(asked(Encodes::Shown));
            bench.board.reset();
        }
        bench.open(asked(encodes));
        EXPECT_EQ(bench.board->encoder().has_value(), encodes != Encodes::No);
        return bench.line->inspect([](EmulatedBoard& board, Instant) { return board.mode(); });
    };
    EXPECT_EQ(modeAfter(Encodes::No, 0), 0);
    EXPECT_EQ(modeAfter(Encodes::No, 1), 0) << "another program left it encoding";
    EXPECT_EQ(modeAfter(Encodes::Shown, 0), 1);
    SensorBoardBench bench(encoding());
    bench.open(asked(Encodes::Drives));
    EXPECT_EQ(bench.board->encoder(), (BoardEncoder{true, 0x1234ABCD}));
}

TEST(SensorBoardEncoding, ABoardThatCannotIsRefusedInOneSentence) {
    RecordProperty("hazard", "H4");
    const auto refusal = [](const EmulatedBoardSettings& settings) {
        SensorBoardBench bench(settings);
        return bench.tryOpen(asked(Encodes::Drives));
    };
    EXPECT_THAT(refusal({}), refusedSaying("speaks version 1 of the sensor board protocol and does not encode"));
    EmulatedBoardSettings without;
    without.highestVersion = 2;
    EXPECT_THAT(refusal(without), refusedSaying("refuses SET_ENCODER: it does not know this command"));
    EXPECT_THAT(refusal(encoding(0, 2)), refusedSaying("profiles of layout 2; 1 was expected"));
    EXPECT_THAT(refusal(encoding(TE_BAD_STREAM)),
                refusedSaying("are accepted, with the rates and channels that the board's sensors have now"));
    EXPECT_THAT(refusal(encoding(TE_BAD_HASH)), refusedSaying("the profile in it has the hash of another content"));
}

TEST(SensorBoardEncoding, BoardsOfBothVersionsGoOnAsBefore) {
    for (const auto highest : {std::uint8_t{1}, std::uint8_t{2}}) {
        EmulatedBoardSettings settings;
        settings.highestVersion = highest;
        SensorBoardBench bench(settings);
        bench.openFor(Seconds(1));
        EXPECT_GT(bench.blocks[0].samples(), 3900U);
        EXPECT_EQ(lossesOf(bench.board->report()), 0U);
    }
}

TEST(SensorBoardEncoding, WhatItSaysComesOnceWithTheSessionsTime) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench(encoding());
    bench.open(asked(Encodes::Drives));
    ASSERT_TRUE(bench.run(Seconds(3)).has_value());
    const auto now_us = boardTime(bench);
    send(bench, tsb_encode_reading,
         {0, now_us - 50'000, TSB_READING_CONTACT | TSB_READING_SLIDING, 0, 0.5F, 0.25F, 9000, 0.2F, 0.1F});
    send(bench, tsb_encode_train, trainAt(0, now_us + 4000));
    send(bench, tsb_encode_silence, {0, now_us, TE_FAULT_STALE, 0});
    const double now_s = toSeconds(bench.clock.now());
    const auto encoded = readLater(bench);
    ASSERT_EQ(encoded.frames.size(), 1U);
    // A line that is read every 2 ms makes stamps early by up to that (ClockFit.h).
    EXPECT_NEAR(encoded.frames[0].t_s, now_s - 0.05, 2.5e-3);
    EXPECT_TRUE(encoded.frames[0].contact && encoded.frames[0].sliding && !encoded.frames[0].slidingAssumed);
    EXPECT_EQ(encoded.frames[0].R, 0.5);
    EXPECT_EQ(encoded.frames[0].P, 0.25);
    ASSERT_EQ(encoded.trains.size(), 1U);
    EXPECT_NEAR(encoded.trains[0].onset_s, now_s + 0.004, 2.5e-3);
    EXPECT_EQ(encoded.trains[0].amplitude, 20);
    EXPECT_EQ(encoded.trains[0].form.phaseWidth, Micros(200));
    EXPECT_EQ(encoded.trains[0].form.pulses, 10);
    ASSERT_EQ(encoded.silences.size(), 1U);
    EXPECT_EQ(encoded.silences[0].why.view(), "data that are older than 100 ms");
    const auto after = readLater(bench);
    EXPECT_TRUE(after.frames.empty() && after.trains.empty() && after.silences.empty());
    EXPECT_EQ(lossesOf(bench.board->report()), 0U);
}

TEST(SensorBoardEncoding, ATrainThatRepeatsOrGoesBackIsNotHandedOver) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench(encoding());
    bench.open(asked(Encodes::Drives));
    ASSERT_TRUE(bench.run(Seconds(3)).has_value());
    Random random(7, "trains");
    std::uint32_t newest = 0xFFFFFFF0U;  // it wraps on the way
    std::uint64_t newest_us = 0, lost = 0, late = 0;
    bool begun = false;
    for (int i = 0; i < 500; ++i) {
        const auto sequence = static_cast<std::uint32_t>(newest + random.below(5) - 1);
        const auto onset_us = boardTime(bench) - 2000 + random.below(6000);
        send(bench, tsb_encode_train, trainAt(sequence, onset_us));
        const auto ahead = static_cast<std::int32_t>(sequence - newest);
        const bool inOrder = !begun || ahead > 0;
        const bool next = inOrder && onset_us > newest_us;
        if (inOrder) {
            lost += begun ? static_cast<std::uint64_t>(ahead - 1) : 0;
            newest = sequence;
            begun = true;
        }
        if (next) newest_us = onset_us;
        late += next ? 0 : 1;
        ASSERT_EQ(readLater(bench).trains.size(), next ? 1U : 0U) << i;
    }
    EXPECT_EQ(bench.board->report().encodedLost, lost);
    EXPECT_EQ(bench.board->report().encodedLate, late);
    EXPECT_GT(lost, 100U);
    EXPECT_GT(late, 100U);
}

TEST(SensorBoardEncoding, ATimeThatCannotBeIsNotUsed) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench(encoding());
    bench.open(asked(Encodes::Drives));
    ASSERT_TRUE(bench.run(Seconds(3)).has_value());
    std::uint32_t sequence = 0;
    for (const std::uint64_t onset_us : {std::uint64_t{0}, boardTime(bench) + 1'100'000, ~std::uint64_t{0}}) {
        send(bench, tsb_encode_train, trainAt(sequence++, onset_us));
        EXPECT_TRUE(readLater(bench).trains.empty()) << onset_us;
    }
    EXPECT_EQ(bench.board->report().encodedLate, 3U);
}

TEST(SensorBoardEncoding, ABoardThatComesBackWithAnotherProfileIsRefused) {
    RecordProperty("hazard", "H4");
    SensorBoardBench first(encoding());
    auto other = encoding();
    const auto opened = [](SensorBoardBench& bench) { return bench.tryOpen(asked(Encodes::Drives)); };
    for (const std::uint32_t hash : {0x1234ABCDU, 0x1234ABCEU}) {
        other.encoder->hash = hash;
        SensorBoardBench second(other);
        PluggedBoard board(opened(first).value(), [&](const std::string& serial) {
            EXPECT_EQ(serial, "EMU-0001");
            return opened(second);
        });
        EXPECT_EQ(board.encoder(), (BoardEncoder{true, 0x1234ABCD}));
        const auto again = board.reconnect();
        if (hash == 0x1234ABCDU)
            EXPECT_TRUE(again.has_value());
        else
            EXPECT_THAT(again, refusedSaying("came back with another profile in its encoder"));
    }
}

TEST(SensorBoardEncoding, ABoardThatWasNotAskedSaysNothingThatIsUsed) {
    RecordProperty("hazard", "H4");
    SensorBoardBench bench(encoding());
    bench.openFor(Seconds(1));
    send(bench, tsb_encode_train, trainAt(0, boardTime(bench)));
    EXPECT_TRUE(readLater(bench).trains.empty());
    EXPECT_EQ(bench.board->report().foreign, 1U);
}

}  // namespace
}  // namespace tacto::test
