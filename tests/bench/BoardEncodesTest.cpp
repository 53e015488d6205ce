// A board that encodes: the bench plays its trains and no others, each once, on time and through the gate, and arms
// only for a board with the bench's own profile.
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/base/Random.h"
#include "core/devices/EncodingSensor.h"
#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/bench/PersonFixture.h"
#include "tests/bench/TapedFinger.h"
#include "tests/support/Allocations.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A finger whose board says what the test says.
class EncodingFinger : public TactileSensor, public EncodingSensor {
public:
    EncodingFinger(const Clock& clock, BoardEncoder encoder) : encoder_(encoder), finger_(clock) {}
    const DeviceIdentity& identity() const noexcept override { return finger_.identity(); }
    std::span<const StreamInfo> streams() const noexcept override { return finger_.streams(); }
    Result<void> read(std::span<SampleBlock> blocks) override {
        encoded_ = std::exchange(next, {});
        return silent ? Result<void>{} : finger_.read(blocks);
    }
    std::optional<BoardEncoder> encoder() const noexcept override { return encoder_; }
    const Encoded& encoded() const noexcept override { return encoded_; }
    void keepBoardTime() noexcept override {}
    std::uint64_t lostOnTheWay() const noexcept override { return 0; }

    Encoded next;         ///< comes with the next read()
    bool silent = false;  ///< true: no samples come any more

protected:
    BoardEncoder encoder_;

private:
    TapedFinger finger_;
    Encoded encoded_;
};

/// One whose board takes a profile: four bytes, its hash.
class WritableFinger final : public EncodingFinger, public EncoderLoader {
public:
    using EncodingFinger::EncodingFinger;
    bool wantsProfile() const noexcept override { return true; }
    Result<void> load(std::string_view profile, bool rested) override {
        if (onLoad) onLoad(rested);
        if (refuses) return fail(ErrorCode::Device, "its memory is worn out");
        std::memcpy(&encoder_.hash, profile.data(), sizeof encoder_.hash);
        return {};
    }

    std::function<void(bool rested)> onLoad;
    bool refuses = false;
};

/// A control loop that is armed and driven by the finger, on a virtual clock in steps of a millisecond.
struct BoardRig {
    explicit BoardRig(bool drives = true, const Profile& chosen = {}, const SourceTraits& source = voltageSource())
        : profile(chosen), finger(clock, {drives, 0x1234}) {
        device.traits_ = source;
        const ControlLoop::Parts parts{clock,       gate,    interlock, heartbeat, OutputMode::BenchLoad,
                                       &stimulator, nullptr, 0,         {},        &tap};
        loop = std::make_unique<ControlLoop>(parts, FingerInput::create(*sensor, profile.roughness).value(),
                                             std::make_unique<TrainPlanner>(profile.encoding, source, gate));
        armFake(*loop, interlock, device, clock);
        loop->drive({DriveSource::Sensor, 0, 0});
        pass(1);  // the finger touches from 0.5 s on
        EXPECT_EQ(interlock.state(), drives ? InterlockState::Armed : InterlockState::Delivering);
        static_cast<void>(played());
    }
    static SourceTraits voltageSource() {
        SourceTraits traits;
        traits.amplitudeMax = 60;
        traits.compliance = Volts(60);
        return traits;
    }
    void pass(double seconds) {
        for (const Instant until = clock.now() + toInstant(seconds); clock.now() < until;) {
            clock.advanceTo(clock.now() + std::chrono::milliseconds(1));
            const auto ms = clock.now() / std::chrono::milliseconds(1);
            if (ms % 2 == 0) sensor->serve(clock.now());
            stimulator.serve(clock.now());
            if (ms % 5 != 0) continue;
            const auto before = allocationsOfThisThread();
            loop->step(clock.now());
            allocated += allocationsOfThisThread() - before;
        }
    }
    /// A train of the profile's form with its onset `in_s` from now.
    EncodedTrain train(double volts, double interval_s, double in_s = 0) const {
        return {toSeconds(clock.now()) + in_s, Seconds(interval_s), Volts(volts), volts, profile.encoding.train};
    }
    void send(const EncodedTrain& train) { finger.next.trains.push_back(train); }
    /// The trains that were delivered since the last call.
    std::vector<TrainReport> played() {
        std::vector<TrainReport> all;
        while (const auto report = tap.trains.pop())
            if (!report->isCheck && report->outcome == TrainOutcome::Delivered) all.push_back(*report);
        return all;
    }
    /// Sends one train and returns why it is refused; empty if it is played.
    std::string refusalOf(const EncodedTrain& train) {
        const auto before = loop->refusals();
        send(train);
        pass(0.6);  // longer than the profile's shortest interval
        const auto delivered = played();
        if (loop->refusals() == before) return delivered.size() == 1 ? "" : "nothing came";
        EXPECT_TRUE(delivered.empty());
        return std::string(loop->telemetry().lastRefusal.view());
    }

    std::uint64_t allocated = 0;  ///< by steps of the loop
    VirtualClock clock;
    SafetyGate gate{clock};
    Interlock interlock;
    Heartbeat heartbeat;
    FakeStimulator device{clock};
    StimulatorSession stimulator{device, gate, heartbeat, clock, {}};
    Profile profile;
    EncodingFinger finger;
    std::unique_ptr<SensorSession> sensor = SensorSession::create(finger).value();
    BenchTap tap;
    std::unique_ptr<ControlLoop> loop;
};

TEST(BoardEncodes, ItsTrainsArePlayedOnceWithTheirAmplitudesAndIntervals) {
    RecordProperty("hazard", "H4");
    BoardRig rig;
    Random random(3, "trains");
    std::vector<EncodedTrain> sent;
    for (int i = 0; i < 40; ++i) {
        const auto train = rig.train(10 + 30 * random.uniform(), 0.5 + 1.5 * random.uniform(), 0.004);
        sent.push_back(train);
        rig.send(train);
        rig.pass(train.interval.count());
    }
    const auto played = rig.played();
    ASSERT_EQ(played.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
        EXPECT_DOUBLE_EQ(played[i].amplitude, sent[i].amplitude);
        EXPECT_DOUBLE_EQ(played[i].interval_s, sent[i].interval.count());
        // 10 ms after the board's onset, at the next millisecond of this clock.
        EXPECT_NEAR(toSeconds(played[i].onset) - sent[i].onset_s, 0.010, 0.0011) << i;
    }
    EXPECT_EQ(rig.loop->telemetry().trainsSkipped, 0U);
}

TEST(BoardEncodes, TheLoopPlaysItsTrainsAndAllocatesNothing) {
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    BoardRig rig;
    const auto play = [&rig] {
        for (int i = 0; i < 20; ++i) {
            rig.send(rig.train(20 + i, 0.5, i % 5 == 4 ? -1 : 0));
            rig.finger.next.frames.push_back({toSeconds(rig.clock.now()), true, true});
            rig.pass(0.5);
        }
    };
    play();
    rig.allocated = 0;
    play();
    EXPECT_EQ(rig.allocated, 0U);
    EXPECT_EQ(rig.played().size(), 32U);
}

TEST(BoardEncodes, NothingIsPlayedThatItDoesNotSend) {
    RecordProperty("hazard", "H7");
    BoardRig rig;
    rig.pass(5);
    EXPECT_TRUE(rig.played().empty()) << "though the finger slides, and the bench's own encoder would play";
    EXPECT_GT(rig.loop->telemetry().roughness, 0);
    rig.send(rig.train(20, 0.5));
    rig.pass(5);
    EXPECT_EQ(rig.played().size(), 1U) << "its silence is silence";
    EXPECT_TRUE(std::isnan(rig.loop->telemetry().amplitude_v));
}

TEST(BoardEncodes, ShownTrainsAreNotPlayedButTheBenchsOwn) {
    BoardRig rig(false);
    const auto before = rig.loop->telemetry().trainsDelivered;
    EncodedTrain odd = rig.train(33.25, 0.5);
    for (int i = 0; i < 20; ++i) {
        odd.onset_s = toSeconds(rig.clock.now());
        rig.send(odd);
        rig.pass(0.25);
    }
    EXPECT_GT(rig.loop->telemetry().trainsDelivered, before);
    for (const auto& report : rig.played()) EXPECT_NE(report.amplitude, odd.amplitude);
    std::size_t shown = 0;
    while (rig.tap.boardTrains.pop()) ++shown;
    EXPECT_EQ(shown, 20U);
}

TEST(BoardEncodes, ATrainThatIsLateOrAheadIsNotPlayed) {
    RecordProperty("hazard", "H7");
    for (const double in_s : {-0.5, -0.11, 0.11, 10.0, -1e9, 1e9, kNan}) {
        BoardRig rig;
        rig.send(rig.train(20, 0.5, in_s));
        rig.pass(1);
        EXPECT_TRUE(rig.played().empty()) << in_s;
        EXPECT_EQ(rig.loop->telemetry().trainsSkipped, 1U) << in_s;
    }
    BoardRig rig;
    rig.send(rig.train(20, 0.5, -0.08));
    rig.pass(1);
    EXPECT_EQ(rig.played().size(), 1U);
}

TEST(BoardEncodes, OfTwoThatWaitTheNewerIsPlayed) {
    RecordProperty("hazard", "H7");
    BoardRig rig;
    rig.send(rig.train(30, 0.5));
    rig.send(rig.train(20, 0.5, 0.001));
    rig.pass(1);
    const auto played = rig.played();
    ASSERT_EQ(played.size(), 1U);
    EXPECT_EQ(played[0].amplitude, 20);
    EXPECT_EQ(rig.loop->telemetry().trainsSkipped, 1U);
}

TEST(BoardEncodes, ASilenceTakesBackATrainThatWaits) {
    RecordProperty("hazard", "H7");
    BoardRig rig;
    rig.send(rig.train(30, 0.5, 0.06));
    rig.pass(0.03);
    rig.finger.next.silences.push_back({toSeconds(rig.clock.now()), "data that are older than 100 ms"});
    rig.pass(1);
    EXPECT_TRUE(rig.played().empty());
    EXPECT_EQ(rig.loop->telemetry().boardSilent.view(), "data that are older than 100 ms");
}

TEST(BoardEncodes, StaleSamplesEndItsOutputWhateverItSays) {
    RecordProperty("hazard", "H7");
    BoardRig rig;
    rig.finger.silent = true;
    rig.pass(0.3);
    for (int i = 0; i < 5; ++i) {
        rig.send(rig.train(20, 0.5));
        rig.pass(0.5);
    }
    EXPECT_TRUE(rig.played().empty());
}

TEST(BoardEncodes, NothingComesAfterAStopOrWhilePausedOrDrivenByHand) {
    RecordProperty("hazard", "H2");
    BoardRig rig;
    rig.loop->pauseOutput(true);
    rig.send(rig.train(20, 0.5));
    rig.pass(0.5);
    EXPECT_TRUE(rig.played().empty());
    rig.loop->pauseOutput(false);
    rig.pass(0.5);
    EXPECT_TRUE(rig.played().empty()) << "the train of the pause is gone";
    rig.loop->drive({DriveSource::Manual, 0, 1});
    rig.send(rig.train(20, 0.5));
    rig.pass(0.4);
    for (const auto& report : rig.played()) EXPECT_EQ(report.amplitude, 10);
    rig.loop->drive({DriveSource::Sensor, 0, 0});
    rig.send(rig.train(20, 0.5, 0.05));
    rig.pass(0.02);
    rig.interlock.disarm("stop");
    rig.gate.latchStop();
    rig.pass(1);
    EXPECT_TRUE(rig.played().empty());
    rig.send(rig.train(20, 0.5));
    rig.pass(1);
    EXPECT_TRUE(rig.played().empty());
}

TEST(BoardEncodes, ATrainOfAnotherFormOrRangeThanTheProfilesIsRefused) {
    RecordProperty("hazard", "H4");
    BoardRig rig;
    const auto with = [&](auto change) {
        auto train = rig.train(20, 0.5);
        change(train);
        return rig.refusalOf(train);
    };
    using T = EncodedTrain;
    EXPECT_EQ(with([](T&) {}), "");
    EXPECT_EQ(with([](T& t) { t.form.phaseWidth = Micros(static_cast<double>(200.0F)); }), "");
    EXPECT_THAT(with([](T& t) { t.form.phaseWidth = Micros(201); }), HasSubstr("a phase width in us of 201"));
    EXPECT_THAT(with([](T& t) { t.form.interPhaseGap = Micros(0); }), HasSubstr("a gap in us of 0"));
    EXPECT_THAT(with([](T& t) { t.form.rechargeRatio = 5; }), HasSubstr("a recharge ratio of 5"));
    EXPECT_THAT(with([](T& t) { ++t.form.pulses; }), HasSubstr("a number of pulses of"));
    EXPECT_THAT(with([](T& t) { t.form.rate = Hertz(99); }), HasSubstr("a pulse rate in Hz of 99"));
    EXPECT_THAT(with([](T& t) { t.form.shape = PulseShape::Monophasic; }), HasSubstr("another shape or polarity"));
    EXPECT_THAT(with([](T& t) { t.form.polarity = Polarity::Negative; }), HasSubstr("another shape or polarity"));
    EXPECT_THAT(with([](T& t) { t.command = Volts(9.9); }), HasSubstr("commands 9.9 V; 10 to 40 V"));
    EXPECT_THAT(with([](T& t) { t.command = Volts(41); }), HasSubstr("commands 41 V"));
    EXPECT_THAT(with([](T& t) { t.command = Volts(kNan); }), HasSubstr("commands nan V"));
    EXPECT_THAT(with([](T& t) { t.interval = Seconds(0.49); }), HasSubstr("an interval of 0.49 s; 0.5 to 2 s"));
    EXPECT_THAT(with([](T& t) { t.interval = Seconds(kNan); }), HasSubstr("an interval of nan s"));
    EXPECT_THAT(with([](T& t) { t.amplitude = 22.1; }), HasSubstr("makes 22.1 V of 20 V, and the bench 20"));
    EXPECT_THAT(with([](T& t) { t.amplitude = 17.9; }), HasSubstr("within 10 % is expected"));
    EXPECT_THAT(with([](T& t) { t.amplitude = kNan; }), HasSubstr("within 10 % is expected"));
}

TEST(BoardEncodes, AmplitudesInSinglePrecisionAreThoseOfTheDevicesStep) {
    RecordProperty("hazard", "H4");
    SourceTraits source = BoardRig::voltageSource();
    source.amplitudeStep = 0.1;
    BoardRig rig(true, {}, source);
    for (const int steps : {101, 167, 205, 333, 399}) {
        auto train = rig.train(0.1 * steps, 0.5);
        train.command = Volts(static_cast<double>(0.1F * static_cast<float>(steps)));
        train.amplitude = train.command.value();
        rig.send(train);
        rig.pass(0.5);
        const auto played = rig.played();
        ASSERT_EQ(played.size(), 1U) << rig.loop->telemetry().lastRefusal.view();
        EXPECT_NEAR(played[0].amplitude, 0.1 * steps, 1e-9);
    }
    EXPECT_THAT(rig.refusalOf(rig.train(20.05, 0.5)), HasSubstr("multiples of the device's step, 0.1, are accepted"));
}

TEST(BoardEncodes, VoltsThatReachACurrentSourceAsMilliampsAreRefused) {
    RecordProperty("hazard", "H4");
    SourceTraits source;
    source.drive = Drive::Current;
    source.amplitudeMax = 100;
    source.compliance = Volts(300);
    BoardRig rig(true, {}, source);
    rig.device.impedance = Ohms(1150);
    auto train = rig.train(20, 0.5);
    EXPECT_EQ(rig.refusalOf(train), "") << "20 mA of 20 V, as the declared kiloohm says";
    train = rig.train(20, 0.5);
    train.amplitude = 40;
    EXPECT_THAT(rig.refusalOf(train), HasSubstr("makes 40 mA of 20 V"));
}

TEST(BoardEncodes, AStepThatTheProfileForbidsIsRefusedAfterATrainThatDidNotCome) {
    RecordProperty("hazard", "H6");
    Profile profile;
    profile.encoding.amplitudeRatioPerTrain = 1.2;
    BoardRig rig(true, profile);
    EXPECT_EQ(rig.refusalOf(rig.train(15, 0.5)), "");
    rig.pass(0.3);
    // 18 V was lost on the way.
    EXPECT_THAT(rig.refusalOf(rig.train(21.6, 0.5)), HasSubstr("a larger step from the last train"));
    EXPECT_EQ(rig.refusalOf(rig.train(10, 0.5)), "") << "a fall";
    EXPECT_EQ(rig.refusalOf(rig.train(12, 0.5)), "");
    EXPECT_THAT(rig.refusalOf(rig.train(40, 0.5)), HasSubstr("a larger step from the last train"));
    rig.pass(4);
    EXPECT_EQ(rig.refusalOf(rig.train(40, 0.5)), "") << "a new series begins";
}

TEST(BoardEncodes, WhateverItSendsWhatIsPlayedIsOneOfItsTrainsInOrderAndWithinTheProfile) {
    RecordProperty("hazard", "H1");
    Random random(11, "board");
    BoardRig rig;
    std::vector<EncodedTrain> sent;
    std::vector<TrainReport> played;
    const auto odd = [&](double& value) {
        const double choices[] = {kNan, 0, -1, 1e30, std::numeric_limits<double>::infinity(), value * 3, value};
        value = choices[random.below(std::size(choices))];
    };
    for (int i = 0; i < 3000; ++i) {
        double volts = 5 + 40 * random.uniform(), interval = 0.3 + 2 * random.uniform();
        double in_s = 0.25 * random.uniform() - 0.15, amplitude = volts * (0.86 + 0.28 * random.uniform());
        const auto spoilt = random.below(12);
        if (spoilt == 0) odd(volts);
        if (spoilt == 1) odd(interval);
        if (spoilt == 2) odd(in_s);
        if (spoilt == 3) odd(amplitude);
        auto train = rig.train(volts, interval, in_s);
        train.amplitude = amplitude;
        if (spoilt == 4) train.form.pulses += 1;
        sent.push_back(train);
        rig.send(train);
        if (random.below(20) == 0)
            rig.finger.next.silences.push_back({toSeconds(rig.clock.now()), random.below(2) == 0 ? "a stop" : ""});
        rig.pass(0.01 * static_cast<double>(random.below(60)));
        for (const auto& report : rig.played()) played.push_back(report);
    }
    std::size_t next = 0;
    double lastOnset_s = -1;
    for (const auto& report : played) {
        while (next < sent.size() && sent[next].amplitude != report.amplitude) ++next;
        ASSERT_LT(next, sent.size()) << report.amplitude << " V was not sent, or not after the one before";
        const auto& train = sent[next++];
        EXPECT_EQ(report.interval_s, train.interval.count());
        EXPECT_LE(std::abs(toSeconds(report.onset) - train.onset_s), 0.12);
        EXPECT_TRUE(train.command >= Volts(10) && train.command <= Volts(40));
        EXPECT_TRUE(train.interval >= Seconds(0.5) && train.interval <= Seconds(2));
        EXPECT_NEAR(report.amplitude / train.command.value(), 1, 0.1 + 1e-9);
        EXPECT_GE(train.onset_s - lastOnset_s, 0.498);
        lastOnset_s = train.onset_s;
    }
    EXPECT_GT(played.size(), 300U);
    EXPECT_GT(rig.loop->telemetry().trainsSkipped, 300U);
    EXPECT_GT(rig.loop->refusals(), 300U);
}

class BoardEncodesBench : public BenchFixture {
protected:
    template <class Finger = EncodingFinger>
    Finger& openWith(BoardEncoder encoder) {
        Finger* opened = nullptr;
        wrapSensor_ = [&](std::unique_ptr<TactileSensor>) {
            auto made = std::make_unique<Finger>(*clock_, encoder);
            opened = made.get();
            return made;
        };
        open({}, {Role::Stimulator, Role::Sensor});
        finger_ = opened;
        return *opened;
    }
    [[nodiscard]] Result<void> armDriven(const std::string& load = "1 kohm") {
        if (auto driven = bench_->drive(DriveSource::Sensor); !driven) return driven;
        return armOn(load);
    }
    [[nodiscard]] Result<void> armOn(const std::string& load) {
        if (state() == InterlockState::Disarmed) static_cast<void>(bench_->devices().load->fitLoad(load));
        return arm(load);
    }
    static std::uint32_t hashFor(double ohms, const Profile& profile) {
        return static_cast<std::uint32_t>(100 * ohms + profile.encoding.amplitudeMax.value());
    }
    /// Each load and largest amplitude has a hash of its own.
    void profileByLoad() {
        boardProfile_ = [](const TactileSensor&, const Profile& profile,
                           const GateSetup& setup) -> Result<BoardProfile> {
            const auto hash = hashFor(setup.load.nominal.series.value(), profile);
            std::string bytes(sizeof hash, 0);
            std::memcpy(bytes.data(), &hash, sizeof hash);
            return BoardProfile{hash, bytes};
        };
    }
    /// The board sends a train; returns whether the bench delivered one.
    bool playsOne(double volts = 20) {
        finger_->next.trains.push_back(
            {toSeconds(clock_->now()), Seconds(0.5), Volts(volts), volts, profile_.encoding.train});
        const auto before = bench_->telemetry().trainsDelivered;
        EXPECT_TRUE(bench_->wait(Seconds(0.6)).has_value());
        return bench_->telemetry().trainsDelivered != before;
    }

    EncodingFinger* finger_ = nullptr;
};

TEST_F(BoardEncodesBench, IsArmedOnlyWithTheBenchsOwnProfileInTheBoard) {
    RecordProperty("hazard", "H4");
    std::vector<double> loads;
    boardProfile_ = [&](const TactileSensor&, const Profile& profile, const GateSetup& setup) -> Result<BoardProfile> {
        loads.push_back(setup.load.nominal.series.value());
        if (profile.encoding.hold != Hold::Voltage) return fail(ErrorCode::Unsupported, "it holds the charge");
        return BoardProfile{0xABCD, {}};
    };
    openWith({true, 0x1234});
    EXPECT_THAT(armDriven("2 kohm"),
                refused(ErrorCode::NotArmed, HasSubstr("not armed: the board encodes by a profile with hash 00001234, "
                                                       "and the profile \"default\" with this stimulator and load has "
                                                       "0000abcd")));
    EXPECT_EQ(loads, (std::vector<double>{2000}));
    EXPECT_EQ(state(), InterlockState::Disarmed);
    openWith({false, 0x1234});
    EXPECT_TRUE(arm().has_value()) << "its trains are only shown";
    openWith({true, 0xABCD});
    ASSERT_TRUE(armDriven().has_value());
    auto changed = profile_;
    changed.roughness.spectralWeight = 0.25;
    EXPECT_THAT(bench_->setProfile(changed), refused(ErrorCode::NotArmed, HasSubstr("the fingertip's board encodes")));
    bench_->disarm();
    EXPECT_TRUE(bench_->setProfile(changed).has_value());
    changed.encoding.hold = Hold::Charge;
    EXPECT_TRUE(bench_->setProfile(changed).has_value());
    EXPECT_THAT(armDriven(), refusedSaying("is not for a board that encodes: it holds the charge"));
}

TEST_F(BoardEncodesBench, IsNotArmedWhereNobodyKnowsItsProfile) {
    RecordProperty("hazard", "H4");
    openWith({true, 0});
    EXPECT_THAT(armDriven(), refused(ErrorCode::NotArmed, HasSubstr("cannot tell whose profile the board has")));
}

TEST_F(BoardEncodesBench, ByHandItsProfileIsNotAskedForAndItsTrainsAreNotPlayed) {
    RecordProperty("hazard", "H4");
    profileByLoad();
    openWith({true, hashFor(1000, profile_)});
    ASSERT_TRUE(armOn("2 kohm").has_value());
    const auto isRefused =
        refused(ErrorCode::NotArmed, HasSubstr("the fingertip does not drive: the board encodes by a profile"));
    EXPECT_THAT(bench_->drive(DriveSource::Sensor), isRefused);
    EXPECT_FALSE(arm("1 kohm").has_value()) << "it is armed";
    EXPECT_THAT(bench_->drive(DriveSource::Sensor), isRefused) << "it is armed for 2 kohm";
    EXPECT_FALSE(playsOne());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0, 0).has_value());
    for (int i = 0; i < 20; ++i) {
        static_cast<void>(playsOne(30));
        EXPECT_LE(bench_->telemetry().trainAmplitude, 10.5) << "the bench's own, at R 0";
    }
    EXPECT_GE(bench_->telemetry().trainsDelivered, 4U);
    EXPECT_THAT(bench_->drive(DriveSource::Sensor), isRefused);
    bench_->disarm();
    ASSERT_TRUE(armDriven("1 kohm").has_value());
    EXPECT_TRUE(playsOne());
}

TEST_F(BoardEncodesBench, OfARealStimulatorNobodyKnowsWhatCameOutBeforeTheBenchWasOpened) {
    RecordProperty("hazard", "H4");
    profileByLoad();
    for (const bool real : {false, true}) {
        looksReal_ = real;
        auto& finger = openWith<WritableFinger>({true, 0});
        std::vector<bool> said;
        finger.onLoad = [&said](bool rested) { said.push_back(rested); };
        for (const auto* load : {"2 kohm", "1 kohm"}) {
            EXPECT_TRUE(bench_->wait(Seconds(said.empty() ? 0.1 : 8)).has_value());
            static_cast<void>(bench_->devices().load->fitLoad(load));
            ASSERT_TRUE(bench_->drive(DriveSource::Sensor).has_value());
            const auto armed = bench_->arm({load, true, true, real ? bench_->armingText(parseLoad(load).value()) : ""});
            ASSERT_TRUE(armed) << armed.error().message;
            bench_->disarm();
        }
        EXPECT_THAT(said, testing::ElementsAre(!real, true));
    }
}

TEST_F(BoardEncodesBench, AProfileIsWrittenIntoABoardThatTakesOneAndNeverWhileArmed) {
    RecordProperty("hazard", "H4");
    profileByLoad();
    auto& finger = openWith<WritableFinger>({true, 0});
    ASSERT_TRUE(armDriven("2 kohm").has_value());
    EXPECT_EQ(finger.encoder()->hash, hashFor(2000, profile_));
    EXPECT_THAT(armDriven("1 kohm"),
                refused(ErrorCode::NotArmed, HasSubstr("written only while the output is disarmed, not while")));
    EXPECT_EQ(finger.encoder()->hash, hashFor(2000, profile_));
    EXPECT_TRUE(playsOne());
    bench_->disarm();
    finger.refuses = true;
    EXPECT_THAT(armDriven("1 kohm"), refused(ErrorCode::NotArmed, HasSubstr("board: its memory is worn out")));
    finger.refuses = false;
    bench_->disarm();

    int written = 0;
    Instant last{0};  // a train
    finger.onLoad = [&](bool rested) {
        ++written;
        EXPECT_EQ(rested, last == Instant(0) || clock_->now() - last > std::chrono::seconds(8));
        EXPECT_EQ(state(), InterlockState::Disarmed);
    };
    Random random(7, "orders");
    const auto toss = [&](std::uint64_t sides) { return random.below(sides); };
    double ohms = 0;  // of the load that is armed
    int played = 0;
    for (int i = 0; i < 400; ++i) {
        auto changed = bench_->profile();
        switch (toss(6)) {
            case 0:
                bench_->disarm();
                break;
            case 1:
            case 2:
                if (const auto kohm = 1 + toss(3); armOn(fmt::format("{} kohm", kohm)))
                    ohms = 1000 * static_cast<double>(kohm);
                break;
            case 3:
                changed.encoding.amplitudeMax = Volts(31 + static_cast<double>(toss(3)));
                static_cast<void>(bench_->setProfile(changed));
                break;
            default:
                static_cast<void>(bench_->drive(DriveSource::Sensor));
        }
        if (!playsOne()) continue;
        ++played;
        last = clock_->now() - toInstant(Seconds(0.55));
        EXPECT_EQ(finger.encoder()->hash, hashFor(ohms, bench_->profile()));
    }
    EXPECT_GT(written, 20);
    EXPECT_GT(played, 30);
}

TEST_F(BoardEncodesBench, TheGateRefusesItsTrainAsAnyOther) {
    RecordProperty("hazard", "H1");
    boardProfile_ = [](const TactileSensor&, const Profile&, const GateSetup&) -> Result<BoardProfile> {
        return BoardProfile{1, {}};
    };
    profile_.ceilings = {{Quantity::PeakCurrent, 25}};
    openWith({true, 1});
    ASSERT_TRUE(arm().has_value());
    ASSERT_TRUE(bench_->drive(DriveSource::Sensor).has_value());
    ASSERT_TRUE(bench_->wait(Seconds(1)).has_value());
    const auto send = [&](double volts) {
        finger_->next.trains.push_back(
            {toSeconds(clock_->now()), Seconds(1), Volts(volts), volts, profile_.encoding.train});
        return bench_->wait(Seconds(1)).has_value();
    };
    ASSERT_TRUE(send(15));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 1U);
    EXPECT_EQ(bench_->telemetry().trainsRefused, 0U);
    ASSERT_TRUE(send(30));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 1U);
    EXPECT_EQ(bench_->telemetry().trainsRefused, 1U);
    EXPECT_THAT(std::string(bench_->telemetry().lastRefusal.view()), HasSubstr("peak current"));
}

TEST_F(BoardEncodesBench, TheSessionTellsWhatTheBoardSaid) {
    RecordProperty("hazard", "H8");
    const ScratchDir folder;
    const VirtualClock sessionClock;
    const auto file = folder.path() / "run.tacto";
    const auto writer = SessionWriter::create(file, {}, sessionClock).value();
    session_ = writer.get();
    boardProfile_ = [](const TactileSensor&, const Profile&, const GateSetup&) -> Result<BoardProfile> {
        return BoardProfile{0xA, {}};
    };
    openWith({true, 0xA});
    ASSERT_TRUE(arm().has_value());
    ASSERT_TRUE(bench_->drive(DriveSource::Sensor).has_value());
    ASSERT_TRUE(bench_->wait(Seconds(1)).has_value());
    const double now = toSeconds(clock_->now());
    auto& next = finger_->next;
    next.frames.push_back({now, true, true, false, 0.5, 0.25, 0.75, 8000, 0.125});
    next.silences.push_back({now, "a sensor that repeats itself"});
    ASSERT_TRUE(bench_->wait(Seconds(0.1)).has_value());
    next.silences.push_back({now + 0.1, ""});
    next.trains.push_back({now - 3, Seconds(1), Volts(20), 20, profile_.encoding.train});
    ASSERT_TRUE(bench_->wait(Seconds(0.1)).has_value());
    next.trains.push_back({toSeconds(clock_->now()), Seconds(1), Volts(20), 20, profile_.encoding.train});
    ASSERT_TRUE(bench_->wait(Seconds(0.5)).has_value());
    bench_.reset();
    ASSERT_TRUE(writer->close());
    const auto reader = SessionReader::open(file).value();
    std::vector<std::string> said;
    const auto events = reader.events().value();
    for (const auto& row : events) {
        if (row.name == "board encodes") said.push_back(row.body["hash"].get<std::string>());
        if (row.name == "board silent") said.push_back(row.body["text"].get<std::string>());
        if (row.name == "board train skipped") EXPECT_NEAR(row.body["late_s"].get<double>(), 3.1, 0.02);
        if (row.name == "board train skipped") said.push_back("late");
    }
    EXPECT_THAT(said, testing::ElementsAre("0000000a", "a sensor that repeats itself",
                                           "nothing keeps the board's trains back", "late"));
    std::vector<double> frame;
    const auto streams = reader.streams().value();
    for (const auto& stream : streams)
        if (stream.stream.kind == "board_frames") frame = reader.samples(stream.id).value().values;
    EXPECT_EQ(frame, (std::vector<double>{1, 1, 0.5, 0.25, 0.75, 8000, 0.125}));
    int planned = 0;
    const auto commands = reader.commands().value();
    for (const auto& row : commands) {
        if (row.name != "train") continue;
        ++planned;
        EXPECT_EQ(row.body["roughness"], 0.75) << "R of the encoder that made the train";
        EXPECT_EQ(row.body["pressure"], 0.125);
    }
    EXPECT_EQ(planned, 1);
}

class PersonAtABoard : public PersonFixture {};

TEST_F(PersonAtABoard, IsNotStimulatedByItsTrains) {
    RecordProperty("hazard", "H1");
    boardProfile_ = [](const TactileSensor&, const Profile&, const GateSetup&) -> Result<BoardProfile> {
        return BoardProfile{1, {}};
    };
    wrapSensor_ = [this](std::unique_ptr<TactileSensor>) {
        return std::make_unique<EncodingFinger>(*clock_, BoardEncoder{true, 1});
    };
    open({}, {Role::Stimulator, Role::Sensor});
    EXPECT_THAT(arm(), refused(ErrorCode::NotArmed, HasSubstr("for loads on a bench, not for a person")));
}

}  // namespace
}  // namespace tacto::test
