// A request and its ack over a faulty line.
#include <chrono>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/sciencemode/Acks.h"
#include "tests/drivers/sciencemode/EmulatedLine.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using sciencemode::Command;
using std::chrono::milliseconds;

class ScienceModeExchange : public testing::Test {
protected:
    ScienceModeExchange() : transport_(std::move(*line_->connect())), exchange_(*transport_, clock_) {}

    Result<std::span<const std::uint8_t>> askStatus() { return exchange_.ask(Command::StimStatus); }
    void misbehave(AckFault fault, int times = 1) {
        line_->inspect([&](auto& device, Instant) { device.misbehave(fault, times); });
    }

    VirtualClock clock_;
    std::shared_ptr<EmulatedLine> line_ = std::make_shared<EmulatedLine>(clock_, &clock_);
    std::unique_ptr<Transport> transport_;
    Exchange exchange_;
};

TEST_F(ScienceModeExchange, TwoHundredRequestsEachGetTheirOwnAck) {
    RecordProperty("hazard", "H4");
    std::set<unsigned> numbers;
    for (int i = 0; i < 200; ++i) {
        const auto answer = askStatus();
        ASSERT_TRUE(answer.has_value()) << i << ": " << answer.error().message;
        EXPECT_EQ(answer->size(), 3U);
    }
    for (const auto& bytes : line_->written()) {
        FrameDecoder decoder;
        std::span<const std::uint8_t> view(bytes);
        numbers.insert(decoder.take(view)->number);
    }
    EXPECT_EQ(numbers.size(), 62U);
    EXPECT_TRUE(numbers.contains(60)) << "the number that is stuffed";
    EXPECT_FALSE(numbers.contains(62) || numbers.contains(63)) << "kept for the stop frames";
    EXPECT_EQ(exchange_.counts().junkBytes, 0U);
    EXPECT_EQ(exchange_.counts().strayAcks, 0U);
}

TEST_F(ScienceModeExchange, AMissingAckIsATimeoutAfter50Milliseconds) {
    misbehave(AckFault::Drop);
    const Instant before = clock_.now();
    EXPECT_THAT(askStatus(), refused(ErrorCode::Timeout));
    EXPECT_EQ(clock_.now() - before, milliseconds(50));
    EXPECT_TRUE(askStatus().has_value());
}

TEST_F(ScienceModeExchange, ALateAckIsNotTakenForTheNextOne) {
    RecordProperty("hazard", "H10");
    misbehave(AckFault::Delay);
    ASSERT_EQ(askStatus().error().code, ErrorCode::Timeout);
    clock_.advanceTo(clock_.now() + milliseconds(40));  // now the answer is there
    const auto id = accepted(exchange_.ask(Command::DeviceId));
    EXPECT_EQ(id.size(), 11U);
    EXPECT_EQ(exchange_.counts().strayAcks, 1U);
}

TEST_F(ScienceModeExchange, ADuplicateAckIsNotTakenForTheNextOne) {
    misbehave(AckFault::Duplicate, 20);
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(askStatus().has_value());
    ASSERT_TRUE(exchange_.ask(Command::DeviceId).has_value());
    EXPECT_EQ(exchange_.counts().strayAcks, 20U);
}

TEST_F(ScienceModeExchange, JunkBeforeAnAckCostsNothing) {
    misbehave(AckFault::Junk, 20);
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(askStatus().has_value()) << i;
    EXPECT_EQ(exchange_.counts().junkBytes, 20U * 8U);
}

TEST_F(ScienceModeExchange, ABrokenAckIsGarbageAndTheNextOneIsFine) {
    for (const auto fault : {AckFault::WrongCrc, AckFault::WrongLength}) {
        misbehave(fault);
        EXPECT_THAT(askStatus(),
                    refusedSaying(testing::AnyOf(testing::HasSubstr("garbage"), testing::HasSubstr("in time"))));
        EXPECT_TRUE(askStatus().has_value());
    }
    EXPECT_GE(exchange_.counts().brokenFrames, 2U);
}

TEST_F(ScienceModeExchange, AnAckOfAnotherNumberOrCommandIsNotTaken) {
    RecordProperty("hazard", "H4");
    for (const auto fault : {AckFault::WrongNumber, AckFault::WrongCommand}) {
        misbehave(fault);
        EXPECT_THAT(askStatus(), refused(ErrorCode::Timeout));
    }
    EXPECT_EQ(exchange_.counts().strayAcks, 2U);
}

TEST_F(ScienceModeExchange, AnUnknownCommandIsARefusalAndNotATimeout) {
    EXPECT_THAT(exchange_.ask(static_cast<Command>(100)), refused(ErrorCode::Device, "does not know"));
}

TEST_F(ScienceModeExchange, AnUnpluggedDeviceIsGone) {
    line_->unplug();
    EXPECT_EQ(askStatus().error().code, ErrorCode::Device);
    EXPECT_TRUE(exchange_.gone());
}

TEST_F(ScienceModeExchange, AMinuteOfGarbageCostsAMinuteAndNoMore) {
    RecordProperty("hazard", "H10");
    line_->inspect([](auto& device, Instant) { device.talkGarbage(3000); });
    const Instant begin = clock_.now();
    int asked = 0;
    while (clock_.now() - begin < std::chrono::minutes(1)) {
        const Instant before = clock_.now();
        EXPECT_THAT(askStatus(), refused(ErrorCode::Device));
        ASSERT_LE(clock_.now() - before, milliseconds(50));
        ++asked;
    }
    EXPECT_EQ(asked, 1200);
    EXPECT_GT(exchange_.counts().junkBytes, 1200U * 2000U);
    line_->inspect([](auto& device, Instant) { device.talkGarbage(0); });
    // An incomplete command in the garbage may still spoil the first answer.
    static_cast<void>(askStatus());
    EXPECT_TRUE(askStatus().has_value());
}

/// Sends endless garbage while no time passes.
class EndlessNoise final : public Transport {
public:
    Result<void> write(std::span<const std::uint8_t>, Seconds) override { return {}; }
    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds) override {
        std::ranges::fill(into, std::uint8_t{0xF0});
        given += into.size();
        return into.size();
    }
    std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t>) noexcept override {}
    std::size_t given = 0;
};

TEST(ScienceModeExchangeBounds, NoiseWithoutAPauseEndsEvenIfTheClockStands) {
    RecordProperty("hazard", "H10");
    VirtualClock still;
    EndlessNoise noise;
    Exchange exchange(noise, still);
    EXPECT_THAT(exchange.ask(Command::StimStatus), refusedSaying("garbage"));
    EXPECT_LE(noise.given, 300'000U);
}

TEST(ScienceModeStopFrames, AreReadyAndFitOneUrgentTransfer) {
    RecordProperty("hazard", "H2");
    for (const auto& [frame, command] : {std::pair{stopFrames().lowLevel, 4}, {stopFrames().midLevel, 34}}) {
        EXPECT_LE(frame.size, Transport::kMaxUrgent);
        FrameDecoder decoder;
        auto view = frame.view();
        const auto packet = accepted(decoder.take(view));
        EXPECT_EQ(packet.command, command);
        EXPECT_TRUE(packet.payload.empty());
    }
}

}  // namespace
}  // namespace tacto::test
