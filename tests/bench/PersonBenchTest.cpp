// Person mode on the bench: which devices and calibrations are allowed, and how high a level may go.
#include <gmock/gmock.h>
#include <limits>

#include "core/devices/Stimulator.h"
#include "core/electrode/Load.h"
#include "core/session/SessionReader.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/bench/PersonFixture.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using test::accepted;
using test::refusedSaying;
using testing::HasSubstr;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A fake that can be simulated or not, and that states its own calibration.
class StatingStimulator final : public Stimulator, public StatesCalibration {
public:
    StatingStimulator(const Clock& clock, bool simulated) : fake(clock) {
        identity_.simulated = simulated;
        fake.traits_.drive = Drive::Current;
        fake.traits_.amplitudeStep = 0.5;
        fake.impedance = Ohms(2000);
    }
    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return fake.traits(); }
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override { return fake.deliver(std::move(train)); }
    [[nodiscard]] Result<StimulatorStatus> status() override { return fake.status(); }
    [[nodiscard]] Result<void> keepAlive() override { return fake.keepAlive(); }
    void forceOff() noexcept override { fake.forceOff(); }
    [[nodiscard]] const KnownLines& statedCalibration() const noexcept override { return stated_; }

    test::FakeStimulator fake;

private:
    DeviceIdentity identity_{"fake:", Role::Stimulator, "a stating unit", "S1", "1", true};
    KnownLines stated_ = StimulatorCalibration{{1, 0, 0.5, 50},
                                               CalibrationLine{1, 0, 0.01, 10},
                                               CalibrationLine{1, 0, 10e-6, 1e-3},
                                               CalibrationLine{1, 0, 10e-6, 1e-3}};
};

class PersonBenchTest : public test::PersonFixture {
protected:
    /// Opens a bench with a stimulator that states its calibration.
    [[nodiscard]] Result<std::unique_ptr<Bench>> openStating(bool simulated, bool virtualParticipant,
                                                             bool rehearsal = false) {
        clock_ = std::make_shared<VirtualClock>();
        auto device = std::make_unique<StatingStimulator>(*clock_, simulated);
        device_ = device.get();
        BenchConfig config;
        config.devices.stimulator = std::move(device);
        config.clock = clock_;
        config.profile = profile_;
        config.limits = {test::generousLimits()};
        config.person = person_;
        config.mode = OutputMode::Person;
        config.virtualParticipant = virtualParticipant;
        config.rehearsal = rehearsal;
        return Bench::create(std::move(config));
    }
    [[nodiscard]] static Result<void> armed(Bench& bench) {
        return bench.arm({.load = "2 kohm",
                          .operatorConfirmed = true,
                          .confirmed = bench.outputIsReal() ? bench.armingText(parseLoad("2 kohm").value()) : ""});
    }

    StatingStimulator* device_ = nullptr;
};

TEST_F(PersonBenchTest, TheSimulatedStimulatorStatesItsOwnCalibration) {
    RecordProperty("hazard", "H9");
    openPerson();
    ASSERT_TRUE(bench_->calibration());
    EXPECT_TRUE(bench_->calibration()->complete());
    ASSERT_TRUE(bench_->calibration()->amplitude.spread);
    EXPECT_GT(bench_->calibration()->amplitude.spread->relative, 0) << "unknown is not zero";
    ASSERT_TRUE(arm());
    EXPECT_FALSE(bench_->telemetry().uncalibratedStimulator);
    EXPECT_NEAR(bench_->telemetry().impedance_ohm, 3100, 100);
}

TEST_F(PersonBenchTest, OneThatIsOutOfOrderStatesNothingAndIsNotArmed) {
    RecordProperty("hazard", "H9");
    for (const char* off : {"&gain=1.3", "&widthgain=1.22"}) {
        openPerson(off);
        EXPECT_FALSE(bench_->calibration()) << off;
        const auto refused = arm();
        ASSERT_FALSE(refused) << off;
        EXPECT_THAT(refused.error().message, HasSubstr("is not calibrated")) << off;
    }
}

TEST_F(PersonBenchTest, TheWordOfADeviceIsNoCalibration) {
    RecordProperty("hazard", "H9");
    auto simulated = accepted(openStating(true, true));
    EXPECT_TRUE(armed(*simulated));
    auto real = accepted(openStating(false, false));
    EXPECT_FALSE(real->calibration());
    EXPECT_THAT(armed(*real), refusedSaying("is not calibrated"));
    EXPECT_EQ(device_->fake.delivered, 0);
}

TEST_F(PersonBenchTest, ABenchLoadTakesNoStatement) {
    person_.reset();
    openPerson();
    EXPECT_FALSE(bench_->calibration());
}

TEST_F(PersonBenchTest, AVirtualParticipantIsOnSimulationsAndAPersonOnDevices) {
    RecordProperty("hazard", "H9");
    EXPECT_THAT(openStating(false, true),
                refusedSaying(testing::Eq(
                    "a virtual participant cannot use the real device a stating unit; use a simulated one")));
    EXPECT_THAT(openStating(true, false),
                refusedSaying(testing::Eq(
                    "a person on a stating unit, which delivers nothing; a device is accepted, a simulated one in a "
                    "rehearsal")));
    EXPECT_TRUE(openStating(true, false, true)) << "a rehearsal";
    EXPECT_FALSE(openStating(false, true, true)) << "a rehearsal makes no device of a simulation";
    EXPECT_TRUE(openStating(true, true));
    EXPECT_TRUE(openStating(false, false));
}

TEST_F(PersonBenchTest, WithoutAcceptanceTheNextLevelIsRefused) {
    RecordProperty("hazard", "H6");
    openArmed();
    EXPECT_EQ(presentTest(1).end, PresentationEnd::Complete) << "one ramp step";
    const auto refused = presentTest(2);
    EXPECT_EQ(refused.end, PresentationEnd::Refused) << "delivered is not accepted";
    EXPECT_THAT(refused.reason, HasSubstr("the ramp rule"));
    EXPECT_TRUE(refused.trains.empty());
    EXPECT_EQ(state(), InterlockState::Delivering) << "a refusal is not a fault";
    ASSERT_FALSE(bench_->accept(Milliamps(2))) << "what was not delivered cannot be accepted";
    ASSERT_EQ(presentTest(1).end, PresentationEnd::Complete);
    ASSERT_TRUE(bench_->accept(Milliamps(1)));
    EXPECT_EQ(presentTest(2).end, PresentationEnd::Complete);
    EXPECT_EQ(presentTest(0.5).end, PresentationEnd::Complete);
    EXPECT_EQ(presentTest(3).end, PresentationEnd::Refused) << "2 mA were delivered, 1 mA accepted";
}

TEST_F(PersonBenchTest, OnlyWhatWasPresentedLastIsAccepted) {
    RecordProperty("hazard", "H6");
    openArmed();
    EXPECT_FALSE(bench_->accept(Milliamps(0.5))) << "nothing was presented";
    ASSERT_EQ(presentTest(0).end, PresentationEnd::Complete);
    EXPECT_FALSE(bench_->accept(Milliamps(0))) << "an empty presentation is not a level";
    EXPECT_FALSE(bench_->accept(Milliamps(0.5)));
    ASSERT_EQ(presentTest(0.5).end, PresentationEnd::Complete);
    EXPECT_FALSE(bench_->accept(Milliamps(1))) << "permitted, and never felt";
    EXPECT_FALSE(bench_->accept(Milliamps(kNoNumber)));
    EXPECT_TRUE(bench_->accept(Milliamps(0.5)));
    EXPECT_TRUE(bench_->levelCeiling().value() == StimulusLevel(Milliamps(1.5)));
}

TEST_F(PersonBenchTest, AnAscendingSeriesStartsFromNothing) {
    RecordProperty("hazard", "H6");
    openArmed();
    rampTo(3);
    EXPECT_EQ(presentTest(3.5).end, PresentationEnd::Complete);
    ASSERT_TRUE(bench_->beginAscending());
    EXPECT_TRUE(bench_->levelCeiling().value() == StimulusLevel(Milliamps(1)));
    EXPECT_EQ(presentTest(2).end, PresentationEnd::Refused) << "accepted before, but not in this series";
    ASSERT_EQ(presentTest(1).end, PresentationEnd::Complete);
    ASSERT_TRUE(bench_->accept(Milliamps(1)));
    EXPECT_TRUE(bench_->levelCeiling().value() == StimulusLevel(Milliamps(2)));
    ASSERT_TRUE(bench_->endAscending());
    EXPECT_TRUE(bench_->levelCeiling().value() == StimulusLevel(Milliamps(4)));
    EXPECT_EQ(presentTest(3).end, PresentationEnd::Complete) << "an accepted level may be entered in one step";
}

TEST_F(PersonBenchTest, NothingExceedsWhatWasTooStrongAgain) {
    RecordProperty("hazard", "H6");
    openArmed();
    rampTo(3);
    ASSERT_TRUE(bench_->reportDiscomfort(Milliamps(2.5)));
    const auto refused = presentTest(3);
    EXPECT_EQ(refused.end, PresentationEnd::Refused);
    EXPECT_THAT(refused.reason, HasSubstr("discomfort limit is 2.5 mA"));
    EXPECT_EQ(presentTest(2.5).end, PresentationEnd::Complete);
    ASSERT_TRUE(bench_->reportDiscomfort(Milliamps(10)));
    EXPECT_EQ(presentTest(3).end, PresentationEnd::Refused) << "a later, higher report does not raise it";

    bench_->pause();
    bench_->resume();
    EXPECT_EQ(presentTest(3).end, PresentationEnd::Refused);
    bench_->stop("test");
    ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
    ASSERT_TRUE(arm());
    EXPECT_EQ(presentTest(3).end, PresentationEnd::Refused) << "armed again";
    EXPECT_EQ(presentTest(2.5).end, PresentationEnd::Complete) << "what was accepted stays so";
    EXPECT_FALSE(bench_->reportDiscomfort(Milliamps(kNoNumber)));
    EXPECT_FALSE(bench_->reportDiscomfort(Milliamps(-1)));
}

TEST_F(PersonBenchTest, TooStrongIsHeardAfterAStopAndBeforeTheFirstArming) {
    RecordProperty("hazard", "H6");
    openPerson();
    ASSERT_TRUE(bench_->reportDiscomfort(Milliamps(1.5))) << "from a part of the session before this one";
    ASSERT_TRUE(arm());
    rampTo(1.5);
    EXPECT_EQ(presentTest(2).end, PresentationEnd::Refused);
    bench_->stop("the participant");
    ASSERT_TRUE(bench_->reportDiscomfort(Milliamps(1)));
    ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
    ASSERT_TRUE(arm());
    EXPECT_EQ(presentTest(1.5).end, PresentationEnd::Refused);
    EXPECT_EQ(presentTest(1).end, PresentationEnd::Complete);
}

TEST_F(PersonBenchTest, TheCapOfTheStudyHolds) {
    RecordProperty("hazard", "H6");
    person_->cap = Milliamps(2);
    openArmed();
    rampTo(2);
    const auto refused = presentTest(2.5);
    EXPECT_EQ(refused.end, PresentationEnd::Refused);
    EXPECT_THAT(refused.reason, HasSubstr("the study's cap is 2 mA"));
    EXPECT_TRUE(bench_->levelCeiling().value() == StimulusLevel(Milliamps(2)));
    const auto limit = accepted(bench_->levelLimit(kShortest));
    EXPECT_TRUE(limit.level == Milliamps(2));
    EXPECT_EQ(limit.limitedBy, "the study's cap");
}

TEST_F(PersonBenchTest, TheLargestLevelIsTheOneTheGateStopsAt) {
    RecordProperty("hazard", "H6");
    skin_ = "300 ohm + (8 kohm || 20 nF)";  // needs 40 V at about 6 mA
    openArmed();
    const auto limit = accepted(bench_->levelLimit(kShortest));
    EXPECT_THAT(limit.limitedBy, HasSubstr("commanded voltage (paper)"));
    EXPECT_GT(limit.level.value(), 4);
    EXPECT_LT(limit.level.value(), 8);
    rampTo(limit.level.value());
    EXPECT_EQ(presentTest(limit.level.value(), 0.5, 4).end, PresentationEnd::Complete);
    const auto beyond = presentTest(limit.level.value() + 0.5);
    EXPECT_EQ(beyond.end, PresentationEnd::Refused);
    EXPECT_THAT(beyond.reason, HasSubstr("commanded voltage"));
    ASSERT_TRUE(bench_->reportDiscomfort(Milliamps(3)));
    const auto after = bench_->levelLimit(kShortest);
    ASSERT_TRUE(after);
    EXPECT_TRUE(after->level == Milliamps(3));
    EXPECT_EQ(after->limitedBy, "what was too strong");
    EXPECT_FALSE(bench_->levelLimit(Seconds(kNoNumber)));
    bench_->disarm();
    ASSERT_TRUE(bench_->wait(Seconds(0.1)));
    EXPECT_FALSE(bench_->levelLimit(kShortest)) << "no impedance is known";
}

TEST_F(PersonBenchTest, LevelsBelongToPersonMode) {
    person_.reset();
    openArmed();
    EXPECT_EQ(bench_->accept(Milliamps(0.5)).error().code, ErrorCode::NotArmed);
    EXPECT_EQ(bench_->reportDiscomfort(Milliamps(0.5)).error().code, ErrorCode::NotArmed);
    EXPECT_EQ(bench_->beginAscending().error().code, ErrorCode::NotArmed);
    EXPECT_EQ(bench_->levelCeiling().error().code, ErrorCode::NotArmed);
    EXPECT_EQ(bench_->levelLimit(kShortest).error().code, ErrorCode::NotArmed);
}

TEST_F(PersonBenchTest, WhatTheParticipantSaysIsInTheSession) {
    RecordProperty("hazard", "H8");
    const test::ScratchDir folder;
    VirtualClock recording;
    SessionAbout about;
    auto writer = accepted(SessionWriter::create(folder.path() / "a.tacto", about, recording));
    session_ = writer.get();
    openArmed();
    rampTo(1);
    ASSERT_TRUE(bench_->reportDiscomfort(Milliamps(1)));
    bench_.reset();
    ASSERT_TRUE(writer->close());
    const auto reader = accepted(SessionReader::open(folder.path() / "a.tacto"));
    const auto events = accepted(reader.events());
    std::vector<std::string> said;
    for (const auto& event : events) {
        if (event.name.starts_with("level-")) said.push_back(event.name + event.body.dump());
    }
    EXPECT_THAT(said, testing::ElementsAre(R"(level-accepted{"ceiling_ma":1.5,"level_ma":0.5})",
                                           R"(level-accepted{"ceiling_ma":2.0,"level_ma":1.0})",
                                           R"(level-too-strong{"ceiling_ma":1.0,"level_ma":1.0})"));
}

TEST_F(PersonBenchTest, TheImpedanceCheckEndsDisarmed) {
    openPerson();
    const auto seen = accepted(bench_->checkImpedance({.operatorConfirmed = true}));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->value(), 3100, 100);
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

}  // namespace
}  // namespace tacto
