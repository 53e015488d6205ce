// Output compared with the command: output ends if a train was not read back, did not come, or was larger than asked
// for. The time of a reading tells which command it belongs to.
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "core/bench/sensing/CaptureLoad.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "drivers/simulated/SimulatedStimulator.h"
#include "tests/bench/BenchFixture.h"
#include "tests/support/Refused.h"
#include "tests/support/Trials.h"
#include "tests/support/WrappedTwin.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// From train number `from` on (check pulses included), reports wrong readings or trains that it did not deliver.
class LyingStimulator final : public WrappedStimulator {
public:
    struct Lie {
        int from = 0;
        bool swallows = false;  ///< puts nothing out, and repeats the last train's status
        std::function<void(StimulatorStatus&)> said = {};
    };
    LyingStimulator(std::unique_ptr<Stimulator> inner, Lie lie, int& trains)
        : WrappedStimulator(std::move(inner)), lie_(std::move(lie)), trains_(trains) {}
    Result<void> deliver(ApprovedTrain&& train) override {
        ++trains_;
        if (lie_.swallows && trains_ >= lie_.from) {
            [[maybe_unused]] const ApprovedTrain gone = std::move(train);
            return {};
        }
        return WrappedStimulator::deliver(std::move(train));
    }
    Result<StimulatorStatus> status() override {
        auto status = WrappedStimulator::status();
        if (status && lie_.swallows) status->amplitude.reset();  // a swallowed train would show in the amplitude
        if (status && lie_.said && trains_ >= lie_.from) lie_.said(*status);
        return status;
    }

private:
    const Lie lie_;
    int& trains_;
};

/// Puts out additional pulses between the trains that it is given.
class UnaskedStimulator final : public WrappedStimulator {
public:
    UnaskedStimulator(std::unique_ptr<Stimulator> inner, Volts volts, int from)
        : WrappedStimulator(std::move(inner)), volts_(volts), from_(from) {}
    Result<void> keepAlive() override {
        const Instant now = world()->clock().now();
        if (auto& circuit = world()->circuit(); ++asked_ >= from_ && !circuit.active(now)) {
            PulseTrain train;
            train.amplitude = volts_;
            sim::DrivenTrain driven;
            driven.pulse = dynamic_cast<const sim::SimulatedStimulator&>(inner()).drivenPulse(train, now);
            driven.onset_s = toSeconds(now) + 1e-4;
            driven.limits.compliance_V = 100;
            circuit.play(driven, now, Instant::max());
        }
        return WrappedStimulator::keepAlive();
    }

private:
    const Volts volts_;
    const int from_;
    int asked_ = 0;
};

class DeliveredTruth : public BenchFixture {
protected:
    void lies(LyingStimulator::Lie lie) {
        trains_ = 0;
        wrap_ = [this, lie](std::unique_ptr<Stimulator> inner) {
            return std::make_unique<LyingStimulator>(std::move(inner), lie, trains_);
        };
    }
    [[nodiscard]] std::string reason() const { return bench_->telemetry().reason.c_str(); }

    int trains_ = 0;  // number of trains given to the device
    std::mt19937 draw_{47};
};

TEST_F(DeliveredTruth, ATrainThatWasNotReadIsTheLast) {
    RecordProperty("hazard", "H3");
    const std::function<void(StimulatorStatus&)> lies_[] = {
        [](auto& said) { said.impedance.reset(); },
        [](auto& said) { said.amplitude.reset(); },
        [](auto& said) {
            said.impedance.reset();
            said.amplitude.reset();
            said.electrode = ElectrodeState::NotMeasured;
        },
        [](auto& said) {
            const auto at = said.at;
            said = {};
            said.at = at;
            said.electrode = ElectrodeState::Ok;
        },
    };
    for (int trial = 0; trial < 40; ++trial) {
        const int from = std::uniform_int_distribution(2, 12)(draw_);
        const auto& lie = lies_[static_cast<std::size_t>(trial) % std::size(lies_)];
        lies({from, false, lie});
        open({trial % 3 == 0 ? "sim:stimulator?mode=current" : "sim:stimulator"}, {Role::Stimulator});
        ASSERT_TRUE(arm());
        const double strength = std::uniform_real_distribution(0.0, 1.0)(draw_);
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, strength, 1));
        EXPECT_FALSE(bench_->wait(Seconds(20)));
        EXPECT_EQ(state(), InterlockState::Faulted) << trial;
        EXPECT_EQ(trains_, from) << "lie " << trial % 4 << ": " << reason();
        EXPECT_TRUE(bench_->faultPersists(FaultCause::StatusMissing)) << reason();
    }
}

TEST_F(DeliveredTruth, AReadBackOfNothingIsNoTrain) {
    RecordProperty("hazard", "H3");
    // The command is one smallest step of the device, by which the reading may be off.
    profile_.encoding.amplitudeMin = Volts(0.53);
    for (const double share : {0.0, 0.04, 0.09}) {
        lies({3, false, [share](StimulatorStatus& said) {
                  if (said.amplitude) *said.amplitude *= share;
              }});
        open({"sim:stimulator?mode=current&step=0.5mA"}, {Role::Stimulator});
        ASSERT_TRUE(armAndDrive(0, 1));
        EXPECT_FALSE(bench_->wait(Seconds(5))) << share;
        EXPECT_EQ(trains_, 3) << share << ": " << reason();
        EXPECT_THAT(reason(), HasSubstr("the stimulator reads back"));
    }
}

TEST_F(DeliveredTruth, AnAcknowledgedTrainThatTheOscilloscopeDoesNotShowIsAFault) {
    RecordProperty("hazard", "H3");
    for (const auto* source : {"sim:stimulator?readback=no", "sim:stimulator?readback=no&mode=current"}) {
        for (const int from : {2, 3, 7}) {
            lies({from, true, {}});
            open({source});
            ASSERT_TRUE(arm());
            ScopeSettings settings;
            settings.sampleRate = Hertz(1e6);
            settings.samples = 200'000;
            ASSERT_TRUE(bench_->requestCaptures(64, settings, Seconds(0.02)));
            ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.5, 1));
            EXPECT_FALSE(bench_->wait(Seconds(10)));
            EXPECT_EQ(state(), InterlockState::Faulted) << source;
            EXPECT_LE(trains_, from + 3) << source << " " << from << ": " << reason();
            EXPECT_THAT(reason(), HasSubstr("the oscilloscope shows"));
        }
    }
}

TEST_F(DeliveredTruth, TrainsThatComeAreNoFaultHoweverTheyAreRecorded) {
    RecordProperty("hazard", "H3");
    for (int trial = 0; trial < 24; ++trial) {
        open({trial % 2 == 0 ? "sim:stimulator?readback=no" : "sim:stimulator?mode=current"});
        ASSERT_TRUE(arm());
        ScopeSettings settings;
        settings.sampleRate = Hertz(std::uniform_real_distribution(2e5, 2e6)(draw_));
        settings.samples = std::uniform_int_distribution<std::size_t>(2000, 100'000)(draw_);
        settings.preTrigger = std::uniform_real_distribution(0.0, 1.0)(draw_);
        settings.triggerLevel = std::exp(std::uniform_real_distribution(std::log(0.3), std::log(60.0))(draw_));
        ASSERT_TRUE(bench_->requestCaptures(64, settings, Seconds(0.013)));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.3, 1));
        const auto waited = bench_->wait(Seconds(6));
        EXPECT_TRUE(waited) << trial << ": " << reason();
    }
}

/// The first train begins 5 to 9 s after arming, after a second check pulse.
TEST_F(DeliveredTruth, ACheckPulseAtAnyTimeBeforeATrainIsNotTakenForIt) {
    RecordProperty("hazard", "H12");
    profile_.encoding.intervalMin = Seconds(0.02);
    for (int trial = 0; trial < 120; ++trial) {
        // Without stated time stamps, the amplitude decides if the time allows both.
        open(
            {"sim:stimulator?readback=yes", trial % 3 == 0 ? "sim:oscilloscope?accuracy=unknown" : "sim:oscilloscope"});
        ASSERT_TRUE(arm());
        ScopeSettings settings;
        settings.samples = std::uniform_int_distribution<std::size_t>(2000, 120'000)(draw_);
        settings.preTrigger = std::uniform_real_distribution(0.0, 1.0)(draw_);
        settings.triggerLevel = 0.5;
        ASSERT_TRUE(bench_->requestCaptures(64, settings));
        ASSERT_TRUE(bench_->wait(Seconds(4.9 + 4.1 * trial / 120)));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, std::uniform_real_distribution(0.0, 1.0)(draw_), 0.9));
        const auto waited = bench_->wait(Seconds(0.4));
        ASSERT_TRUE(waited) << trial << ": " << reason();
        const auto captures = bench_->takeCaptures();
        ASSERT_TRUE(captures);
        for (const auto& capture : *captures) {
            if (std::isnan(capture.programmed)) continue;
            const auto& volts = capture.channels[0].samples;
            const double peak = *std::max_element(volts.begin(), volts.end());
            EXPECT_NEAR(peak, capture.programmed, 0.05 * capture.programmed + 0.1) << trial;
        }
    }
}

/// Tries every offset between a check pulse and a train, and compares with a direct count of samples.
TEST(CommandShownIn, IsTheOnlyOneWhosePulsesTheRecordMayShow) {
    std::mt19937 draw(12);
    int alone = 0, both = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        const auto time = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
        const double slack = trial % 2 == 0 ? 0 : time(0, 0.02);
        Capture capture;
        capture.rate_hz = 1e5;
        capture.start_s = 1 + time(-0.05, 0.05);
        capture.channels.push_back({"voltage", "V", std::vector<float>(static_cast<std::size_t>(time(1, 6000)))});
        capture.stampTolerance_s = slack;
        const double end_s = capture.start_s + static_cast<double>(capture.samples()) / capture.rate_hz;
        std::array<ProgrammedTrain, 16> known{};
        const double offset = -0.08 + 0.16 * trial / 20'000;
        const auto fill = [&](ProgrammedTrain& into, double from, double length, double volts, bool isCheck) {
            into.onset = into.from = toInstant(Seconds(from));
            into.until = toInstant(Seconds(from + length));
            into.amplitude = into.expected = volts;
            into.isCheck = isCheck;
        };
        fill(known[3], 1, 0.0005, 1, true);
        fill(known[7], 1 + offset, time(0.0005, 0.03), 10, false);
        const auto distance = [&](const ProgrammedTrain& train) {  // 0 if they overlap
            return std::max({0.0, toSeconds(train.from) - end_s, capture.start_s - toSeconds(train.until)});
        };
        const double toCheck = distance(known[3]), toTrain = distance(known[7]);
        const auto shown = commandShownIn(capture, known);
        // The program allows 2 ms beyond the stated time; close to that edge either answer is right.
        const auto may = [&](double far) { return far < slack + 0.0019; };
        const auto mayNot = [&](double far) { return far > slack + 0.0021; };
        if (may(toCheck) && may(toTrain)) {
            EXPECT_FALSE(shown) << trial;
            ++both;
        } else if (may(toTrain) && mayNot(toCheck)) {
            ASSERT_TRUE(shown) << trial;
            EXPECT_FALSE(shown->isCheck) << trial;
            ++alone;
        } else if (may(toCheck) && mayNot(toTrain)) {
            ASSERT_TRUE(shown) << trial;
            EXPECT_TRUE(shown->isCheck) << trial;
            ++alone;
        } else if (mayNot(toCheck) && mayNot(toTrain)) {
            EXPECT_FALSE(shown) << trial;
        }
    }
    EXPECT_GT(alone, 1000);
    EXPECT_GT(both, 1000);
}

TEST_F(DeliveredTruth, MoreThanALimitIsAFaultAndBesideTheCommandAMark) {
    RecordProperty("hazard", "H1");
    int faults = 0, marks = 0, neither = 0;
    for (int trial = 0; trial < 80; ++trial) {
        const double gain = std::uniform_real_distribution(0.84, 1.17)(draw_);
        const double strength = std::uniform_real_distribution(0.0, 1.0)(draw_);
        const double set = profile_.encoding.amplitudeMin.value() +
                           strength * (profile_.encoding.amplitudeMax - profile_.encoding.amplitudeMin).value();
        open({fmt::format("sim:stimulator?gain={:.6f}{}", gain, trial % 2 == 0 ? "" : "&readback=no")});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->requestCaptures(8, ScopeSettings{}));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, strength, 1));
        const auto waited = bench_->wait(Seconds(1.2));
        const auto seen = bench_->telemetry();
        const double out = gain * set;
        if (out > 40 * 1.05 * 1.01) {
            EXPECT_FALSE(waited) << gain << " at " << set;
            EXPECT_TRUE(bench_->faultPersists(FaultCause::LimitBroken)) << reason();
            EXPECT_THAT(reason(), HasSubstr("more than the limit"));
            ++faults;
        } else if (out < 40) {
            ASSERT_TRUE(waited) << gain << " at " << set << ": " << reason();
            EXPECT_NEAR(seen.measured.amplitude, out, 0.02 * out);
            EXPECT_NEAR(seen.measured.set, set, 0.01 * set);
            if (std::abs(gain - 1) > 0.075) {
                EXPECT_TRUE(seen.measured.beyond) << gain << " at " << set;
                ++marks;
            } else if (std::abs(gain - 1) < 0.04) {
                EXPECT_FALSE(seen.measured.beyond) << gain << " at " << set;
                ++neither;
            }
            bool stands = false;
            for (const auto& row : seen.exposure()) {
                if (row.quantity != Quantity::CommandVoltage) continue;
                stands = true;
                EXPECT_NEAR(row.measured, out, 0.02 * out);
                EXPECT_EQ(row.beyond, seen.measured.beyond);
            }
            EXPECT_TRUE(stands);
        }
    }
    EXPECT_GT(std::min({faults, marks, neither}), 3) << faults << " " << marks << " " << neither;
}

/// Pulses that a record shows only in part, compared with the known pulses.
TEST(AmplitudeSeenIn, SaysNothingUntrueOfARecordThatCannotShowItsPulsesWhole) {
    testing::Test::RecordProperty("hazard", "H1");
    std::mt19937 draw(147);
    const auto time = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    SourceTraits source;
    source.drive = Drive::Voltage;
    int least = 0, whole = 0, absent = 0, nothing = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const double volts = trial % 5 == 0 ? 0 : time(3, 60), range = time(5, 80);
        const double width_s = time(50e-6, 400e-6), gap_s = time(0, 200e-6), offset = time(-0.5, 0.5);
        const bool biphasic = trial % 3 != 0;
        Capture capture;
        capture.rate_hz = std::exp(time(std::log(2e3), std::log(2e6)));
        capture.start_s = 1;
        capture.stampTolerance_s = 0;
        const double onset_s = 1 + time(0.003, 0.01), end_s = onset_s + 2 * width_s + gap_s + time(0.003, 0.01);
        const auto count = static_cast<std::size_t>((end_s - 1) * capture.rate_hz);
        CaptureChannel voltage{"voltage", "V", {}, -range, range, 2 * range / 4096};
        std::normal_distribution<double> noise(0, voltage.lsb);
        for (std::size_t i = 0; i < count; ++i) {
            const double t = 1 + static_cast<double>(i) / capture.rate_hz - onset_s;
            const bool first = t >= 0 && t < width_s;
            const bool second = biphasic && t >= width_s + gap_s && t < 2 * width_s + gap_s;
            const double level = offset + (first ? volts : second ? -volts : 0) + noise(draw);
            voltage.samples.push_back(
                static_cast<float>(std::round(std::clamp(level, -range, range) / voltage.lsb) * voltage.lsb));
        }
        capture.channels = {voltage, voltage};
        capture.channels[1].name = "current";
        capture.channels[1].unit = "A";
        ProgrammedTrain command;
        command.expected = command.amplitude = volts > 0 ? volts * time(0.5, 1.5) : time(5, 40);
        command.onset = command.from = toInstant(Seconds(onset_s));
        command.until = toInstant(Seconds(onset_s + 2 * width_s + gap_s));
        command.acknowledged = true;
        const auto seen = amplitudeSeenIn(capture, source, command);
        if (!seen) {
            ++nothing;
            continue;
        }
        const double apart = 0.03 * volts + 12 * voltage.lsb + std::abs(offset);
        if (std::string_view(seen->by).ends_with("at least")) {
            EXPECT_LE(seen->amplitude, volts + apart) << trial;
            EXPECT_GE(volts + apart, command.expected) << trial << ": less may come of the range alone";
            ++least;
        } else {
            EXPECT_NEAR(seen->amplitude, volts, apart) << trial << ": " << capture.rate_hz << " Hz, " << range << " V";
            ++(volts > 0 ? whole : absent);
        }
    }
    EXPECT_GT(std::min({least, whole, absent, nothing}), 20)
        << least << " " << whole << " " << absent << " " << nothing;
}

TEST_F(DeliveredTruth, ARecordThatCannotShowATrainWholeIsNoFaultOfTheTrain) {
    RecordProperty("hazard", "H1");
    for (int trial = 0; trial < 16; ++trial) {
        open({trial % 2 == 0 ? "sim:stimulator?readback=no" : "sim:stimulator?mode=current"});
        ASSERT_TRUE(arm());
        ScopeSettings settings;
        const bool narrow = trial % 4 < 2;
        settings.sampleRate = Hertz(narrow ? 1e6 : std::uniform_real_distribution(4e3, 40e3)(draw_));
        settings.samples = static_cast<std::size_t>(settings.sampleRate.value() * 0.1);
        settings.triggerLevel = 2;
        if (narrow) {
            settings.voltageRange = Volts(std::uniform_real_distribution(5.0, 38.0)(draw_));
            settings.currentRange = Milliamps(settings.voltageRange.value());
        }
        ASSERT_TRUE(bench_->requestCaptures(64, settings, Seconds(0.02)));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
        EXPECT_TRUE(bench_->wait(Seconds(4))) << trial << ": " << reason();
    }
}

TEST_F(DeliveredTruth, WhatTheRangeCutsOffIsAtLeastAsLarge) {
    RecordProperty("hazard", "H1");
    open({"sim:stimulator?readback=no&gain=1.1"});
    ASSERT_TRUE(arm());
    ScopeSettings settings;
    settings.voltageRange = Volts(42.5);
    ASSERT_TRUE(bench_->requestCaptures(8, settings));
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.99, 1));
    static_cast<void>(bench_->wait(Seconds(1.2)));
    EXPECT_TRUE(bench_->telemetry().measured.beyond);
}

TEST_F(DeliveredTruth, WhatWasAskedOfNoCommandAndIsOverTheLimitIsAFault) {
    RecordProperty("hazard", "H1");
    for (int trial = 0; trial < 12; ++trial) {
        const bool over = trial % 3 != 0;
        const double volts =
            over ? std::uniform_real_distribution(44.0, 90.0)(draw_) : std::uniform_real_distribution(5.0, 40.0)(draw_);
        wrap_ = [&](std::unique_ptr<Stimulator> inner) {
            return std::make_unique<UnaskedStimulator>(std::move(inner), Volts(volts), 4 + trial % 5);
        };
        open({"sim:stimulator?readback=no"});
        ASSERT_TRUE(arm());
        ScopeSettings settings;
        settings.voltageRange = Volts(trial % 2 == 0 ? 100 : 50);
        ASSERT_TRUE(bench_->requestCaptures(64, settings));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0, 0));
        const auto waited = bench_->wait(Seconds(6));
        EXPECT_EQ(waited.has_value(), !over) << volts << " V: " << reason();
        if (over) {
            EXPECT_THAT(reason(), HasSubstr("beside what was set: more than the limit"));
        }
    }
}

TEST_F(DeliveredTruth, AMassagerThatGoesOnWhenItShouldRestIsAFault) {
    RecordProperty("hazard", "H2");
    for (int trial = 0; trial < 24; ++trial) {
        const double strength = std::uniform_real_distribution(0.0, 1.0)(draw_);
        const double pressure = std::uniform_real_distribution(0.0, 1.0)(draw_);
        const double from = trial % 3 == 0 ? 0 : std::uniform_real_distribution(1.0, 9.0)(draw_);
        open({fmt::format("sim:massager?fault=stuck-on@{:.3f}s", from), "sim:finger?on=motor"},
             {Role::Massager, Role::Sensor});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->wait(Seconds(0.5)));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, strength, pressure));
        EXPECT_FALSE(bench_->wait(Seconds(25))) << strength << ", " << pressure << " from " << from;
        EXPECT_EQ(state(), InterlockState::Faulted);
        EXPECT_THAT(reason(), HasSubstr("goes on after its bursts"));
        EXPECT_EQ(bench_->telemetry().fault, FaultCause::StuckOn) << "and none says that the output is off";
        EXPECT_LE(toSeconds(bench_->clock().now()), 0.5 + from + 10) << strength << ", " << pressure;
    }
}

/// A massager may start and stop slowly without limit.
TEST_F(DeliveredTruth, ASlowMassagerIsAFaultOnlyWhereItGoesOn) {
    RecordProperty("hazard", "H2");
    int found = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const bool stuck = trial % 2 == 0;
        const double spinUp = std::uniform_real_distribution(0.05, stuck ? 0.3 : 0.7)(draw_);
        open({fmt::format("sim:massager?spinup={:.3f}s{}", spinUp, stuck ? "&fault=stuck-on@3s" : ""),
              "sim:finger?on=motor"},
             {Role::Massager, Role::Sensor});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->wait(Seconds(0.5)));
        const double strength = std::uniform_real_distribution(0.3, 1.0)(draw_);
        // At the shortest intervals a slow motor never rests, stuck or not.
        const double pressure = std::uniform_real_distribution(0.0, stuck ? 0.5 : 1.0)(draw_);
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, strength, pressure));
        const auto waited = bench_->wait(Seconds(30));
        if (stuck)
            found += waited ? 0 : 1;
        else
            EXPECT_TRUE(waited) << spinUp << " s, " << strength << ", " << pressure << ": " << reason();
    }  // some stuck motors look like a slow motor that is driven again before it rests
    EXPECT_GE(found, 13) << "of 15";
}

TEST_F(DeliveredTruth, AMassagerThatRestsIsNoFaultWhateverTheSensorFeels) {
    RecordProperty("hazard", "H2");
    const char* const fingers[] = {"sim:finger?on=motor", "sim:finger?material=P60&force=3N",
                                   "sim:finger?material=glass&stroke=1.3s&lift=0.4s",
                                   "sim:finger?material=P120&stroke=0.7s&lift=0.6s&tremor=0"};
    for (int trial = 0; trial < 16; ++trial) {
        seed_ = static_cast<std::uint64_t>(trial);
        open({"sim:massager", fingers[trial % 4]}, {Role::Massager, Role::Sensor});
        ASSERT_TRUE(armAndDrive(std::uniform_real_distribution(0.0, 1.0)(draw_),
                                std::uniform_real_distribution(0.0, 1.0)(draw_)));
        EXPECT_TRUE(bench_->wait(Seconds(40))) << fingers[trial % 4] << ": " << reason();
    }
}

TEST_F(DeliveredTruth, WhatWasMeasuredBesideTheCommandIsAMarkOfTheSession) {
    RecordProperty("hazard", "H9");
    const ScratchDir dir;
    const auto file = dir.path() / "session.tacto";
    {
        const VirtualClock ownClock;
        auto writer = accepted(SessionWriter::create(file, SessionAbout{}, ownClock));
        session_ = writer.get();
        open({"sim:stimulator?gain=1.15"});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->requestCaptures(8, ScopeSettings{}));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.2, 1));
        ASSERT_TRUE(bench_->wait(Seconds(3)));
        bench_.reset();
        ASSERT_TRUE(writer->close());
    }
    const auto marks = sessionMarks(*SessionReader::open(file));
    ASSERT_TRUE(marks);
    EXPECT_THAT(*marks, testing::Contains(HasSubstr("V where 16 V was set")).Times(1));
}

}  // namespace
}  // namespace tacto::test
