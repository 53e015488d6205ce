// A bench with a calibrated stimulator delivers what is asked, and the session records the calibration.
#include <random>

#include "core/measure/PulseMeasurement.h"
#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using test::accepted;
using test::refused;
using test::refusedSaying;

class CalibratedBenchTest : public test::BenchFixture {
protected:
    /// Returns the amplitude across the load of the trains at full roughness and pressure.
    [[nodiscard]] double deliveredAtFull() {
        const auto captures = bench_->capture(3, ScopeSettings{});
        if (!captures) {
            ADD_FAILURE() << captures.error().message;
            return 0;
        }
        return measureTrains(*captures, "voltage")->amplitude.mean;
    }
    const StimulatorCalibration weak_{{.gain = 0.95, .offset = 0, .lowest = 10, .highest = 40}};
};

TEST_F(CalibratedBenchTest, TellsAWeakStimulatorMoreAndStaysWithinTheCommand) {
    RecordProperty("hazard", "H1");
    open({"sim:stimulator?gain=0.95", "sim:oscilloscope?gain=1"});
    ASSERT_TRUE(armAndDrive(1, 1));
    EXPECT_NEAR(deliveredAtFull(), 38, 0.3);

    calibration_ = weak_;
    open({"sim:stimulator?gain=0.95", "sim:oscilloscope?gain=1"});
    ASSERT_TRUE(armAndDrive(1, 1));
    EXPECT_NEAR(deliveredAtFull(), 40, 0.3) << "programmed 42.1 V, and the paper's 40 V are judged by what comes out";
    EXPECT_NEAR(bench_->telemetry().trainAmplitude, 40 / 0.95, 0.01);
    const auto seen = bench_->telemetry();
    for (const auto& row : seen.exposure()) {
        EXPECT_TRUE(row.within || !row.evaluated) << titleOf(row.quantity);
    }
}

TEST_F(CalibratedBenchTest, PhaseGapAndIntervalComeOutAsTheProfileSays) {
    RecordProperty("hazard", "H1");
    // Each phase is 0.97 times as long as programmed plus 4.2 us, each gap 6.4 us too short; the computer's clock is
    // 0.4 % slow. So 201 us and 106 us, which the device's step of 1 us allows, give 200 us and 100 us.
    const std::vector<std::string> off{"sim:stimulator?widthgain=0.97&widtherror=4.233us&gaperror=-6.398us",
                                       "sim:oscilloscope?timebase=1.004"};
    const auto measured = [&] {
        open(off);
        EXPECT_TRUE(arm());
        EXPECT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
        const auto captures = bench_->capture(6, ScopeSettings{});
        return captures ? measureTrains(*captures, "voltage").value() : ChannelMeasurement{};
    };
    const auto plain = measured();
    EXPECT_NEAR(plain.width_s.mean, (0.97 * 200e-6 + 4.233e-6) * 1.004, 0.3e-6);
    EXPECT_NEAR(plain.gap_s.mean, 93.602e-6 * 1.004, 0.3e-6);
    EXPECT_NEAR(plain.interval_s.mean, 0.5 * 1.004, 5e-6);

    calibration_ = StimulatorCalibration{{1, 0, 10, 40},
                                         CalibrationLine{1.004, 0, 0.5, 2},
                                         CalibrationLine{0.97 * 1.004, 4.23e-6, 100e-6, 400e-6},
                                         CalibrationLine{1.004, -6.44e-6, 50e-6, 400e-6}};
    const auto programmed = measured();
    EXPECT_NEAR(programmed.width_s.mean, 200e-6, 0.3e-6);
    EXPECT_NEAR(programmed.gap_s.mean, 100e-6, 0.3e-6);
    EXPECT_NEAR(programmed.interval_s.mean, 0.5, 5e-6);
    EXPECT_NEAR(bench_->telemetry().interval_s, 0.5, 1e-12) << "the command is what is wanted";

    // Without the calibration, all values are off.
    bench_->disarm();
    ASSERT_TRUE(bench_->useCalibration(false));
    ASSERT_TRUE(armAndDrive(1, 1));
    const auto captures = accepted(bench_->capture(3, ScopeSettings{}));
    EXPECT_NEAR(measureTrains(captures, "voltage")->gap_s.mean, 93.602e-6 * 1.004, 0.3e-6);
}

/// With random calibrations, the output is at most half a step too low, and never above the limit.
TEST_F(CalibratedBenchTest, ACorrectionGoesToTheNearestStep) {
    RecordProperty("hazard", "H1");
    std::mt19937 draw(13);
    const auto near1 = [&draw] {
        const double size = std::pow(10, std::uniform_real_distribution(-6.0, -1.2)(draw));
        return 1 + (draw() % 2 == 0 ? size : -size);
    };
    for (int trial = 0; trial < 120; ++trial) {
        const bool first = trial == 0;
        const double gain = first ? 1.000016 : near1(), width = first ? 1.000016 : near1(), gap = near1();
        calibration_ = StimulatorCalibration{{.gain = gain, .offset = 0, .lowest = 1, .highest = 60},
                                             CalibrationLine{1, 0, 0.5, 2},
                                             CalibrationLine{width, 0, 100e-6, 400e-6},
                                             CalibrationLine{gap, 0, 50e-6, 400e-6}};
        const bool current = trial % 2 == 1;
        open({fmt::format("sim:stimulator?gain={:.9f}&widthgain={:.9f}&step={}{}", gain, width,
                          current ? "0.5mA" : "0.1V", current ? "&mode=current" : "")});
        ASSERT_TRUE(arm());
        const double strength = first ? 1 : std::uniform_real_distribution(0.2, 1.0)(draw);
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, strength, 1));
        const auto captures = bench_->capture(2, ScopeSettings{});
        ASSERT_TRUE(captures) << trial << ": " << captures.error().message;
        const auto measured = measureTrains(*captures, current ? "current" : "voltage").value();
        const auto seen = bench_->telemetry();
        const double ohm = current ? seen.impedance_ohm : 1;
        const double step = current ? 0.5e-3 : 0.1;
        const double asked = (10 + 30 * strength) / ohm;
        const double noise = current ? 0.01 * asked : 1e-9;  // noise of |Z| in each train's reading
        const double programmed = seen.trainAmplitude * (current ? 1e-3 : 1);
        const bool atTheTop = gain * std::round(asked / gain / step) * step > 40 / ohm;
        EXPECT_GE(gain * programmed, asked - (atTheTop ? 1 : 0.5) * gain * step - noise) << trial;
        EXPECT_LE(gain * programmed, std::min(asked + 0.5 * gain * step, 40 / ohm) + noise) << trial;
        EXPECT_NEAR(measured.width_s.mean, 200e-6, 0.5e-6 * width + 0.1e-6) << width;
    }
}

TEST_F(CalibratedBenchTest, AWrongCalibrationCannotPassALimit) {
    RecordProperty("hazard", "H1");
    // By the calibration the stimulator is weak, but in truth it is not. The programmed value must keep every limit
    // too: 42.1 V would give 10.2 mA RMS.
    calibration_ = weak_;
    open({}, {Role::Stimulator, Role::Oscilloscope}, false, "140 ohm");
    ASSERT_TRUE(armAndDrive(1, 1, "140 ohm"));
    EXPECT_THAT(bench_->wait(Seconds(3)), refusedSaying("RMS current over 5 s"));
}

TEST_F(CalibratedBenchTest, OneThatNoLongerHoldsIsNotAppliedAndStillJudgedBy) {
    RecordProperty("hazard", "H1");
    // 40 V is programmed, but by the old calibration 47.2 V come out; judged by 40 V alone, 8.4 mA RMS would pass.
    calibration_ = StimulatorCalibration{{1.18, 0, 10, 40}};
    calibrationHolds_ = false;
    open({}, {Role::Stimulator, Role::Oscilloscope}, false, "150 ohm");
    ASSERT_TRUE(armAndDrive(1, 1, "150 ohm"));
    EXPECT_THAT(bench_->wait(Seconds(3)), refusedSaying("RMS current over 5 s"));
    EXPECT_FALSE(bench_->calibration());

    // The programmed value equals the command: 40 V into 1 kohm are delivered uncorrected.
    open({});
    ASSERT_TRUE(armAndDrive(1, 1));
    EXPECT_NEAR(deliveredAtFull(), 40, 0.3);
    EXPECT_NEAR(bench_->telemetry().trainAmplitude, 40, 1e-9);
}

TEST_F(CalibratedBenchTest, LeavesItAsideOnlyWhileDisarmedAndRecordsIt) {
    test::ScratchDir folder;
    VirtualClock recording;
    SessionAbout about;
    auto writer = accepted(SessionWriter::create(folder.path() / "a.tacto", about, recording));
    session_ = writer.get();
    calibration_ = weak_;
    open({"sim:stimulator?gain=0.95"});
    ASSERT_TRUE(arm());
    EXPECT_THAT(bench_->useCalibration(false), refused(ErrorCode::NotArmed));
    bench_->disarm();
    ASSERT_TRUE(bench_->useCalibration(false));
    EXPECT_FALSE(bench_->calibration());
    ASSERT_TRUE(armAndDrive(1, 1));
    EXPECT_NEAR(deliveredAtFull(), 38, 0.4);
    bench_.reset();
    ASSERT_TRUE(writer->close());
    const auto reader = accepted(SessionReader::open(folder.path() / "a.tacto"));
    std::vector<std::string> said;
    const auto events = accepted(reader.events());
    for (const auto& event : events) {
        if (event.name == "calibration") said.push_back(event.body.dump());
    }
    ASSERT_EQ(said.size(), 2U);
    EXPECT_NE(said[0].find("\"gain\":0.95"), std::string::npos) << said[0];
    EXPECT_NE(said[1].find("left aside"), std::string::npos) << said[1];
}

// Static, since the bench's function for the date takes no context.
std::chrono::sys_days pretended;

TEST_F(CalibratedBenchTest, OneThatEndsWhileTheBenchIsOpenPermitsNoArming) {
    RecordProperty("hazard", "H9");
    using namespace std::chrono_literals;
    calibration_ = StimulatorCalibration{{.gain = 1, .offset = 0, .lowest = 0.1, .highest = 40},
                                         CalibrationLine{1, 0, 0.5, 2},
                                         CalibrationLine{1, 0, 100e-6, 400e-6},
                                         CalibrationLine{1, 0, 50e-6, 400e-6}};
    profile_.electrodeArea = SquareCentimetres(3);
    calibratedUntil_ = 2026y / 11 / 30;
    today_ = [] { return pretended; };
    person_ = PersonSetup{.participant = "P7",
                          .consentRecorded = true,
                          .discomfortLimit = Milliamps(20),
                          .rampStep = Milliamps(1),
                          .impedanceLow = Ohms(500),
                          .impedanceHigh = Ohms(10'000)};
    pretended = 2026y / 11 / 30;
    open({"sim:stimulator?mode=current"}, {Role::Stimulator});
    accepted(arm());
    bench_->disarm();
    pretended = 2026y / 12 / 1;
    EXPECT_THAT(arm(), refused(ErrorCode::NotArmed, "ended on 2026-11-30 and today is 2026-12-01"));
    EXPECT_EQ(state(), InterlockState::Disarmed);

    // For a bench load the date does not matter.
    person_.reset();
    open({"sim:stimulator"}, {Role::Stimulator});
    EXPECT_TRUE(arm());
}

TEST_F(CalibratedBenchTest, WhatIsReadBackIsComparedWithTheCommandAndNotWithWhatWasTold) {
    RecordProperty("hazard", "H1");
    // By the calibration the stimulator is weak; it is strong. 47.05 V are programmed for 40 V, and 49.4 V come out.
    calibration_ = StimulatorCalibration{{0.85, 0, 10, 40}};
    open({"sim:stimulator?gain=1.05"});
    ASSERT_TRUE(armAndDrive(1, 1));
    EXPECT_THAT(bench_->wait(Seconds(3)), refusedSaying("the stimulator reads back 49."));
    EXPECT_EQ(state(), InterlockState::Faulted);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 1U);
}

TEST_F(CalibratedBenchTest, ACalibrationThatWouldTellMoreThanAFifthBesideTheCommandDeliversNothing) {
    RecordProperty("hazard", "H1");
    calibration_ = StimulatorCalibration{{0.81, 0, 10, 40}};  // programs 49.4 V for 40 V
    open({});
    ASSERT_TRUE(armAndDrive(1, 1));
    EXPECT_THAT(bench_->wait(Seconds(3)), refusedSaying("turns the amplitude 40 into 49.38"));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

TEST_F(CalibratedBenchTest, ACaptureThatShowsAnotherAmplitudeThanTheCommandFaults) {
    RecordProperty("hazard", "H1");
    for (const auto& [gain, off] : {std::pair{"1.3", "51."}, std::pair{"0.7", "2"}}) {
        open({fmt::format("sim:oscilloscope?gain={}&noise=0", gain)});
        ASSERT_TRUE(armAndDrive(1, 1));
        ScopeSettings settings;
        settings.voltageRange = Volts(80);
        // The capture may arrive before the fault that it causes; the next wait must fail.
        const auto capture = bench_->capture(1, settings);
        if (!capture) {
            EXPECT_EQ(capture.error().code, ErrorCode::Device) << capture.error().message;
        }
        EXPECT_THAT(bench_->wait(Seconds(0.1)), refused(ErrorCode::Device)) << gain;
        EXPECT_EQ(state(), InterlockState::Faulted) << gain;
        const std::string reason(bench_->telemetry().reason.view());
        EXPECT_NE(reason.find(fmt::format("the oscilloscope shows {}", off)), std::string::npos) << reason;
    }
}

TEST_F(CalibratedBenchTest, AnImpossibleCalibrationArmsNothing) {
    RecordProperty("hazard", "H9");
    calibration_ = StimulatorCalibration{{0.1, 0, 10, 40}};
    open({});
    EXPECT_THAT(arm(), refusedSaying("out of order"));
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

}  // namespace
}  // namespace tacto
