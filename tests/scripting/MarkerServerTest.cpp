// Markers over TCP: each recorder gets each line in order, and no recorder delays anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/run/MarkerServer.h"
#include "tests/support/InTime.h"
#include "tests/support/MarkerRecorder.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

[[nodiscard]] bool comes(const std::function<bool()>& isSo,
                         std::chrono::milliseconds within = std::chrono::seconds(20)) {
    const auto until = std::chrono::steady_clock::now() + within;
    while (!isSo()) {
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

class Markers : public testing::Test {
protected:
    Markers() {
        clock_->advanceTo(std::chrono::milliseconds(1500));
        auto listens = MarkerServer::listen(at_);
        if (listens) server_ = std::move(*listens);
    }
    void SetUp() override {
        ASSERT_NE(server_, nullptr);
        server_->begin(clock_);
    }
    /// Returns a recorder that is connected and known to the server.
    [[nodiscard]] std::unique_ptr<MarkerRecorder> recorder(
        MarkerRecorder::Reads reads = MarkerRecorder::Reads::Everything) const {
        auto made = std::make_unique<MarkerRecorder>(at_.port, reads);
        EXPECT_IN_TIME(comes([&] { return made->connected(); }));
        if (reads == MarkerRecorder::Reads::Everything) {
            EXPECT_IN_TIME(comes([&] { return !made->lines().empty(); }));
        }
        return made;
    }
    void send(int number) const { server_->send(std::chrono::milliseconds(2000 + number), "answer"); }

    const MarkerAddress at_{"127.0.0.1", freePort()};
    const std::shared_ptr<VirtualClock> clock_ = std::make_shared<VirtualClock>();
    std::unique_ptr<MarkerServer> server_;
};

TEST(MarkerAddress, IsAPortOfThisComputerUnlessAnAddressIsNamed) {
    RecordProperty("hazard", "H11");
    EXPECT_EQ(MarkerAddress::parse("5005").value(), (MarkerAddress{"127.0.0.1", 5005}));
    EXPECT_EQ(MarkerAddress::parse("192.168.1.20:5005").value(), (MarkerAddress{"192.168.1.20", 5005}));
    EXPECT_EQ(MarkerAddress::parse("localhost:5005").value(), (MarkerAddress{"127.0.0.1", 5005}));
    EXPECT_EQ(MarkerAddress::parse("[::1]:5005").value().text(), "[::1]:5005");
    for (const char* wrong : {"", "x", "80", "1023", "65536", "5005x", "-5005", "0", " 5005", "::1:5005", ":5005",
                              "nohost:5005", "127.0.0.1:", "127.0.0.1", "1.2.3.4.5:5005"}) {
        const auto refused = MarkerAddress::parse(wrong);
        ASSERT_FALSE(refused) << wrong;
        EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(refused.error().message, HasSubstr("\"" + std::string(wrong) + "\""));
        EXPECT_THAT(refused.error().message, HasSubstr("1024 to 65535"));
    }
}

TEST(MarkerAddress, OneThatCannotBeHadIsASentence) {
    const HeldPort held;
    const auto taken = MarkerServer::listen({"127.0.0.1", held.port()});
    ASSERT_FALSE(taken);
    EXPECT_EQ(taken.error().code, ErrorCode::Io);
    EXPECT_THAT(taken.error().message, HasSubstr(std::to_string(held.port())));
    EXPECT_THAT(taken.error().message, HasSubstr("another program has that port"));
    const auto elsewhere = MarkerServer::listen({"192.0.2.7", freePort()});
    ASSERT_FALSE(elsewhere);
    EXPECT_EQ(elsewhere.error().code, ErrorCode::Io);
    EXPECT_THAT(elsewhere.error().message, HasSubstr("an address of this computer is expected"));
}

TEST_F(Markers, ReachEachRecorderInOrderWithTheTimeOfTheRecord) {
    const auto one = recorder(), other = recorder();
    server_->send(std::chrono::nanoseconds(1'234'567'891), "trial-begin");
    server_->send(std::chrono::seconds(2), "presentation");
    const auto tally = server_->end();
    EXPECT_EQ(tally, (MarkerTally{2, 0, 0, 2}));
    for (const auto* each : {&one, &other}) {
        ASSERT_IN_TIME(comes([&] { return (*each)->ended(); }));
        EXPECT_THAT((*each)->lines(),
                    ElementsAre("0 1.500000000 connected", "1 1.234567891 trial-begin", "2 2.000000000 presentation"));
    }
}

TEST_F(Markers, OneThatConnectsLaterLearnsHowManyCameBefore) {
    send(1);
    send(2);
    ASSERT_IN_TIME(comes([this] {
        const MarkerRecorder looks(at_.port);
        return comes([&] { return !looks.lines().empty(); }) && looks.lines().front().starts_with("2 ");
    }));
    const auto late = recorder();
    send(3);
    const auto tally = server_->end();
    EXPECT_EQ(tally.made, 3U);
    EXPECT_EQ(tally.unheard, 2U);
    EXPECT_EQ(tally.lost, 0U);
    ASSERT_IN_TIME(comes([&] { return late->ended(); }));
    EXPECT_THAT(late->lines(), ElementsAre("2 1.500000000 connected", "3 2.003000000 answer"));
    EXPECT_THAT(markersSentence(tally), HasSubstr("2 were made while none was connected"));
}

TEST_F(Markers, OneThatDoesNotReadDelaysNothingAndWhatItLosesIsCounted) {
    RecordProperty("hazard", "H2");
    const auto hangs = recorder(MarkerRecorder::Reads::Nothing);
    const auto reads = recorder();
    constexpr int kBursts = 60, kOfBurst = 1000;
    std::vector<std::chrono::nanoseconds> took;
    for (int burst = 0; burst < kBursts; ++burst) {
        for (int i = 1; i <= kOfBurst; ++i) {
            const auto before = std::chrono::steady_clock::now();
            send(burst * kOfBurst + i);
            took.emplace_back(std::chrono::steady_clock::now() - before);
        }
        const auto sofar = std::size_t(burst + 1) * kOfBurst + 1;
        ASSERT_IN_TIME(comes([&] { return reads->lines().size() == sofar; })) << "beside it the other gets each line";
    }
    std::ranges::sort(took);
    EXPECT_IN_TIME(took[took.size() * 999 / 1000] < std::chrono::milliseconds(1)) << "of a thousand one is interrupted";
    const auto before = std::chrono::steady_clock::now();
    const auto tally = server_->end();
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - before < std::chrono::seconds(1));
    EXPECT_EQ(tally.made, std::uint64_t(kBursts * kOfBurst));
    EXPECT_EQ(tally.unheard, 0U);
    EXPECT_GT(tally.lost, tally.made / 4) << "no more than the system's own buffers is taken";
    EXPECT_LT(tally.lost, tally.made);
    EXPECT_THAT(markersSentence(tally), HasSubstr(fmt::format("{} lines were not taken", tally.lost)));
}

TEST_F(Markers, OneThatGoesMidwayTakesNoOtherAlong) {
    RecordProperty("hazard", "H2");
    auto goes = recorder();
    const auto stays = recorder();
    send(1);
    ASSERT_IN_TIME(comes([&] { return goes->lines().size() == 2 && stays->lines().size() == 2; }));
    goes.reset();
    for (int i = 2; i <= 50; ++i) send(i);
    ASSERT_IN_TIME(comes([&] { return stays->lines().size() == 51; }));
    const auto tally = server_->end();
    EXPECT_EQ(tally.made, 50U);
    EXPECT_EQ(tally.unheard, 0U);
    EXPECT_EQ(tally.recorders, 2U);
}

TEST_F(Markers, WhatARecorderSaysIsNotReadAndOneTooManyIsHungUpOn) {
    RecordProperty("hazard", "H10");
    std::vector<std::unique_ptr<MarkerRecorder>> all;
    for (std::size_t i = 0; i < MarkerServer::kMaxRecorders; ++i) all.push_back(recorder());
    for (int i = 0; i < 100; ++i) all.front()->say(std::string(1000, 'x') + "\r\nGET / HTTP/1.1\r\n");
    const MarkerRecorder many(at_.port);
    ASSERT_IN_TIME(comes([&] { return many.ended(); }));
    EXPECT_TRUE(many.lines().empty());
    send(1);
    for (const auto& each : all) ASSERT_IN_TIME(comes([&] { return each->lines().size() == 2; }));
    EXPECT_EQ(server_->end(), (MarkerTally{1, 0, 0, MarkerServer::kMaxRecorders}));
}

TEST_F(Markers, AfterTheEndNothingIsSentAndThePortIsFree) {
    const auto one = recorder();
    const auto tally = server_->end();
    send(1);
    EXPECT_EQ(server_->end(), tally) << "and it ends once";
    ASSERT_IN_TIME(comes([&] { return one->ended(); }));
    EXPECT_EQ(one->lines().size(), 1U);
    EXPECT_TRUE(MarkerServer::listen(at_));
}

}  // namespace
}  // namespace tacto::test
