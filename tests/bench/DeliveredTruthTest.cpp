// What came out beside what was set: a train that was not read, one that never came, and one that is more than was
// asked for end the output; a reading belongs to one command by its time.
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "core/bench/CaptureLoad.h"
#include "core/session/Marks.h"
#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"
#include "tests/support/Trials.h"
#include "tests/support/WrappedTwin.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// From its train number `from` on (check pulses count) it lies: of what it read, or of having delivered at all.
class LyingStimulator final : public WrappedStimulator {
public:
    struct Lie {
        int from = 0;
        bool swallows = false;  ///< nothing is put out, and the status of the train before is given again
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
        if (status && lie_.swallows) status->amplitude.reset();  // it would tell
        if (status && lie_.said && trains_ >= lie_.from) lie_.said(*status);
        return status;
    }

private:
    const Lie lie_;
    int& trains_;
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

    int trains_ = 0;  // that the device was given
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
    // The device's smallest step, which the reading may be off by, is all that was asked for.
    profile_.encoding.amplitudeMin = Volts(0.53);
    for (const double share : {0.0, 0.04, 0.09}) {
        lies({3, false, [share](StimulatorStatus& said) {
                  if (said.amplitude) *said.amplitude *= share;
              }});
        open({"sim:stimulator?mode=current&step=0.5mA"}, {Role::Stimulator});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0, 1));
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

/// The first train begins 5 to 9 s after arming: a second check pulse goes before it.
TEST_F(DeliveredTruth, ACheckPulseAtAnyTimeBeforeATrainIsNotTakenForIt) {
    RecordProperty("hazard", "H12");
    profile_.encoding.intervalMin = Seconds(0.02);
    for (int trial = 0; trial < 120; ++trial) {
        open({"sim:stimulator?readback=yes"});
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

/// Every offset between a check pulse and a train, by an oracle that counts samples.
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
        const auto distance = [&](const ProgrammedTrain& train) {  // 0: they overlap
            return std::max({0.0, toSeconds(train.from) - end_s, capture.start_s - toSeconds(train.until)});
        };
        const double toCheck = distance(known[3]), toTrain = distance(known[7]);
        const auto shown = commandShownIn(capture, known);
        // 2 ms beyond what is stated are the output's own; near that edge either answer is right.
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
        EXPECT_LE(toSeconds(bench_->clock().now()), 0.5 + from + 10) << strength << ", " << pressure;
    }
}

/// However slowly it gathers speed and runs down.
TEST_F(DeliveredTruth, ASlowMassagerIsAFaultOnlyWhereItGoesOn) {
    RecordProperty("hazard", "H2");
    for (int trial = 0; trial < 16; ++trial) {
        const bool stuck = trial % 2 == 0;
        const double spinUp = std::uniform_real_distribution(0.1, 0.5)(draw_);
        open({fmt::format("sim:massager?spinup={:.3f}s{}", spinUp, stuck ? "&fault=stuck-on@3s" : ""),
              "sim:finger?on=motor"},
             {Role::Massager, Role::Sensor});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->wait(Seconds(0.5)));
        const double strength = std::uniform_real_distribution(0.3, 1.0)(draw_);
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, strength, std::uniform_real_distribution(0.0, 1.0)(draw_)));
        const auto waited = bench_->wait(Seconds(30));
        EXPECT_EQ(waited.has_value(), !stuck) << spinUp << " s, " << strength << ": " << reason();
    }
}

TEST_F(DeliveredTruth, AMassagerThatRestsIsNoFaultWhateverTheSensorFeels) {
    RecordProperty("hazard", "H2");
    const char* const fingers[] = {"sim:finger?on=motor", "sim:finger?material=P60&force=3N",
                                   "sim:finger?material=glass&stroke=1.3s&lift=0.4s",
                                   "sim:finger?material=P120&stroke=0.7s&lift=0.6s&tremor=0"};
    for (int trial = 0; trial < 16; ++trial) {
        seed_ = static_cast<std::uint64_t>(trial);
        open({"sim:massager", fingers[trial % 4]}, {Role::Massager, Role::Sensor});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, std::uniform_real_distribution(0.0, 1.0)(draw_),
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
        auto writer = SessionWriter::create(file, SessionAbout{}, ownClock);
        ASSERT_TRUE(writer) << writer.error().message;
        session_ = writer->get();
        open({"sim:stimulator?gain=1.15"});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->requestCaptures(8, ScopeSettings{}));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.2, 1));
        ASSERT_TRUE(bench_->wait(Seconds(3)));
        bench_.reset();
        ASSERT_TRUE((*writer)->close());
    }
    const auto marks = sessionMarks(*SessionReader::open(file));
    ASSERT_TRUE(marks);
    EXPECT_THAT(*marks, testing::Contains(HasSubstr("V where 16 V was set")).Times(1));
}

}  // namespace
}  // namespace tacto::test
