// A person at a massager: accepted levels and too strong levels bound the next burst; nothing else is put out.
#include <gmock/gmock.h>

#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"
#include "tests/bench/FakeMassager.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using test::accepted;
using test::refusedSaying;
using testing::HasSubstr;

class VibratedPersonTest : public testing::Test {
protected:
    void SetUp() override {
        clock_ = std::make_shared<VirtualClock>();
        writer_ = SessionWriter::create(dir_.path() / "session.tacto", {}, *clock_).value();
        BenchConfig config;
        auto device = std::make_unique<test::FakeMassager>(*clock_);
        device_ = device.get();
        config.devices.massager = std::move(device);
        config.clock = clock_;
        config.limits = {test::generousLimits()};
        config.session = writer_.get();
        config.mode = OutputMode::Person;
        config.person = PersonSetup{.participant = "P-7K3M",
                                    .consentRecorded = true,
                                    .vibration = PersonVibration{.discomfortLimit = 1, .rampStep = 0.05}};
        config.virtualParticipant = true;
        bench_ = Bench::create(std::move(config)).value();
        accepted(arm());
    }
    ~VibratedPersonTest() override { bench_.reset(); }
    [[nodiscard]] Result<void> arm() { return bench_->arm(ArmRequest{"1 kohm", true, true}); }
    [[nodiscard]] Presented present(double intensity) {
        auto presented = bench_->present(ascendingPresentation(VibrationIntensity{intensity}, Seconds(0.5)));
        EXPECT_TRUE(presented) << presented.error().message;
        return presented ? std::move(*presented) : Presented{};
    }
    [[nodiscard]] PresentationEnd endOf(double intensity) { return present(intensity).end; }
    /// Raises the level from 0.05; each level is presented and accepted.
    void rampTo(int steps) {
        for (int k = 1; k <= steps; ++k) {
            ASSERT_EQ(endOf(0.05 * k), PresentationEnd::Complete) << k;
            accepted(bench_->accept(VibrationIntensity{0.05 * k}));
        }
    }

    test::ScratchDir dir_;
    std::shared_ptr<Clock> clock_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<Bench> bench_;
    test::FakeMassager* device_ = nullptr;
};

TEST_F(VibratedPersonTest, NothingIsStrongerThanOneStepAboveWhatWasAccepted) {
    RecordProperty("hazard", "H6");
    const auto jump = present(0.1);
    EXPECT_EQ(jump.end, PresentationEnd::Refused);
    EXPECT_THAT(jump.reason, HasSubstr("the ramp rule allows at most 0.05"));
    EXPECT_TRUE(device_->sent().empty()) << "refused, and nothing weaker in its place";
    rampTo(3);
    EXPECT_TRUE(bench_->levelCeiling().value() == StimulusLevel(VibrationIntensity{0.05 * 3 + 0.05}));
    EXPECT_EQ(endOf(0.05 * 4), PresentationEnd::Complete);
    EXPECT_EQ(endOf(0.05 * 5), PresentationEnd::Refused) << "presented is not accepted";
    ASSERT_TRUE(bench_->beginAscending());
    EXPECT_EQ(endOf(0.1), PresentationEnd::Refused) << "a series starts from nothing";
    EXPECT_EQ(endOf(0.05), PresentationEnd::Complete);
    ASSERT_TRUE(bench_->endAscending());
    EXPECT_EQ(endOf(0.05 * 3), PresentationEnd::Complete) << "an accepted one in one step";
}

TEST_F(VibratedPersonTest, WhatWasTooStrongHoldsAtEveryArming) {
    RecordProperty("hazard", "H6");
    rampTo(4);
    ASSERT_TRUE(bench_->reportDiscomfort(VibrationIntensity{0.1}));
    bench_->disarm();
    ASSERT_TRUE(arm());
    const auto strong = present(0.05 * 4);
    EXPECT_EQ(strong.end, PresentationEnd::Refused);
    EXPECT_THAT(strong.reason, HasSubstr("discomfort limit is 0.1"));
    EXPECT_EQ(endOf(0.1), PresentationEnd::Complete);
    ASSERT_TRUE(bench_->reportDiscomfort(VibrationIntensity{0.9}));
    EXPECT_EQ(endOf(0.05 * 3), PresentationEnd::Refused) << "it only falls";
    std::vector<std::string> said;
    bench_.reset();
    ASSERT_TRUE(writer_->close());
    const auto rows = SessionReader::open(dir_.path() / "session.tacto").value().events().value();
    for (const auto& row : rows) {
        if (row.name == "level-too-strong") said.push_back(row.body.dump());
    }
    ASSERT_EQ(said.size(), 2U);
    EXPECT_THAT(said[0], HasSubstr("\"level_intensity\":0.1"));
    EXPECT_THAT(said[0], testing::Not(HasSubstr("_ma")));
}

TEST_F(VibratedPersonTest, OnlyWhatWasPresentedLastCanBeAccepted) {
    RecordProperty("hazard", "H6");
    EXPECT_EQ(bench_->accept(VibrationIntensity{0.05}).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(endOf(0.05), PresentationEnd::Complete);
    EXPECT_THAT(bench_->accept(VibrationIntensity{0.1}),
                refusedSaying(testing::Eq("intensity 0.1 accepted; intensity 0.05 is what can be accepted")));
    EXPECT_EQ(endOf(0), PresentationEnd::Complete) << "an empty one";
    EXPECT_FALSE(bench_->accept(VibrationIntensity{0}));
    EXPECT_FALSE(bench_->accept(VibrationIntensity{0.05}));
}

TEST_F(VibratedPersonTest, TakesNoCurrentAndNoNumberOutsideItsRange) {
    RecordProperty("hazard", "H4");
    EXPECT_EQ(bench_->present(testPresentation(Milliamps(1), Seconds(0.5))).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(bench_->reportDiscomfort(Milliamps(1)).error().code, ErrorCode::Unsupported);
    for (const double wrong : {-0.05, 1.05, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(bench_->present(testPresentation(VibrationIntensity{wrong}, Seconds(0.5)))) << wrong;
        EXPECT_FALSE(bench_->reportDiscomfort(VibrationIntensity{wrong})) << wrong;
        EXPECT_FALSE(bench_->accept(VibrationIntensity{wrong})) << wrong;
    }
    EXPECT_TRUE(device_->sent().empty());
    EXPECT_EQ(endOf(0.05), PresentationEnd::Complete) << "nothing of it lowered the limit";
}

TEST_F(VibratedPersonTest, AStopEndsThePresentationAndNothingFollows) {
    RecordProperty("hazard", "H2");
    device_->onVibrate = [this] { bench_->stop("participant"); };
    const int offs = device_->offs;
    EXPECT_EQ(endOf(0.05), PresentationEnd::Stopped);
    EXPECT_EQ(device_->sent().size(), 1U);
    EXPECT_GT(device_->offs, offs);
    device_->onVibrate = nullptr;
    EXPECT_FALSE(bench_->present(ascendingPresentation(VibrationIntensity{0.05}, Seconds(0.5))));
    EXPECT_EQ(device_->sent().size(), 1U);
}

TEST_F(VibratedPersonTest, OutsidePersonModeNothingIsAccepted) {
    bench_.reset();
    BenchConfig config;
    config.devices.massager = std::make_unique<test::FakeMassager>(*clock_);
    config.clock = clock_;
    config.limits = {test::generousLimits()};
    bench_ = Bench::create(std::move(config)).value();
    ASSERT_TRUE(arm());
    EXPECT_EQ(endOf(1), PresentationEnd::Complete);
    EXPECT_EQ(bench_->accept(VibrationIntensity{1}).error().code, ErrorCode::NotArmed);
    EXPECT_EQ(bench_->reportDiscomfort(VibrationIntensity{1}).error().code, ErrorCode::NotArmed);
}

}  // namespace
}  // namespace tacto
