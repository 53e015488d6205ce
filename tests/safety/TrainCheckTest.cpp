#include <gtest/gtest.h>
#include <limits>

#include "core/safety/TrainCheck.h"

namespace tacto {

namespace {
using namespace std::chrono_literals;
constexpr Instant kEnd = 1s;

TrainReadBack goodStatus() {
    TrainReadBack status;
    status.at = kEnd + 5ms;
    status.electrode = ElectrodeReading::Ok;
    status.imbalance = 0.002;
    status.imbalanceUncertainty = 0.001;
    return status;
}
TrainJudgement judge(const TrainReadBack& status, OutputMode mode = OutputMode::Person) {
    return judgeTrain(mode, status, kEnd, kEnd + 10ms);
}
}  // namespace

TEST(TrainCheck, AGoodAnswerReleasesTheNextTrain) {
    const auto judgement = judge(goodStatus());
    EXPECT_EQ(judgement.finding, TrainFinding::Ok);
    EXPECT_FALSE(judgement.stops());
    EXPECT_EQ(judgement.balance, ChargeBalance::Green);
    EXPECT_TRUE(judgement.reason.empty());
}

TEST(TrainCheck, OpenAndShortStopBeforeTheNextTrain) {
    RecordProperty("hazard", "H3");
    for (const auto mode : {OutputMode::BenchLoad, OutputMode::Person}) {
        TrainReadBack status = goodStatus();
        status.electrode = ElectrodeReading::Open;
        EXPECT_EQ(judge(status, mode).finding, TrainFinding::Open);
        EXPECT_TRUE(judge(status, mode).stops());
        status.electrode = ElectrodeReading::Short;
        EXPECT_EQ(judge(status, mode).finding, TrainFinding::Short);
        // The same holds if it is read while the train still runs.
        status.at = kEnd - 1ms;
        status.delivering = true;
        EXPECT_TRUE(judge(status, mode).stops());
    }
}

TEST(TrainCheck, NetChargeAboveOnePercentBeyondItsUncertaintyFaultsForAPerson) {
    RecordProperty("hazard", "H5");
    const auto with = [](std::optional<double> imbalance, std::optional<double> u,
                         OutputMode mode = OutputMode::Person) {
        TrainReadBack status = goodStatus();
        status.imbalance = imbalance;
        status.imbalanceUncertainty = u;
        return judge(status, mode);
    };
    EXPECT_EQ(with(0.0149, 0.005).finding, TrainFinding::Ok) << "not beyond its uncertainty";
    EXPECT_EQ(with(0.0151, 0.005).finding, TrainFinding::NetCharge);
    EXPECT_EQ(with(0.5, 0.02).finding, TrainFinding::NetCharge) << "a poor reading does not excuse a gross imbalance";
    EXPECT_EQ(with(0.02, std::nullopt).finding, TrainFinding::NetCharge) << "nothing excuses it";
    EXPECT_EQ(with(0.58, 0.001, OutputMode::BenchLoad).finding, TrainFinding::Ok) << "on a bench load it is reported";
    EXPECT_EQ(with(0.58, 0.001, OutputMode::BenchLoad).balance, ChargeBalance::Red);
    EXPECT_FALSE(with(0.02, 0.001).reason.empty());
}

TEST(TrainCheck, AnUncertaintyAboveHalfAPercentReadsNotEvaluated) {
    RecordProperty("hazard", "H5");
    EXPECT_EQ(chargeBalance(0.002, 0.005), ChargeBalance::Green);
    EXPECT_EQ(chargeBalance(0.002, 0.00501), ChargeBalance::NotEvaluated);
    EXPECT_EQ(chargeBalance(0.002, std::nullopt), ChargeBalance::NotEvaluated);
    EXPECT_EQ(chargeBalance(std::nullopt, 0.001), ChargeBalance::NotEvaluated);
    EXPECT_EQ(chargeBalance(0.0099, 0.001), ChargeBalance::Green);
    EXPECT_EQ(chargeBalance(0.01, 0.001), ChargeBalance::Amber);
    EXPECT_EQ(chargeBalance(0.1, 0.001), ChargeBalance::Red);
    EXPECT_EQ(chargeBalance(std::numeric_limits<double>::quiet_NaN(), 0.001), ChargeBalance::NotEvaluated);
}

TEST(TrainCheck, NoStatusWithin50MillisecondsFaults) {
    RecordProperty("hazard", "H3");
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, std::nullopt, kEnd, kEnd + 50ms).finding, TrainFinding::Pending);
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, std::nullopt, kEnd, kEnd + 50ms + 1ns).finding,
              TrainFinding::StatusMissing);
    TrainReadBack status = goodStatus();
    status.at = kEnd + 51ms;
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, status, kEnd, kEnd + 52ms).finding, TrainFinding::StatusMissing)
        << "late";
    status.at = kEnd - 1ms;
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, status, kEnd, kEnd + 10ms).finding, TrainFinding::Pending)
        << "of before its end";
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, status, kEnd, kEnd + 51ms).finding, TrainFinding::StatusMissing);
}

TEST(TrainCheck, ADeviceThatStillDeliversIsStuckOn) {
    RecordProperty("hazard", "H2");
    TrainReadBack status = goodStatus();
    status.delivering = true;
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, status, kEnd, kEnd + 20ms).finding, TrainFinding::Pending);
    status.at = kEnd + 49ms;
    EXPECT_EQ(judgeTrain(OutputMode::BenchLoad, status, kEnd, kEnd + 51ms).finding, TrainFinding::StuckOn);
}

TEST(TrainCheck, ReadingsThatAreNoMeasurementFault) {
    RecordProperty("hazard", "H10");
    for (const double wrong :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -0.01}) {
        TrainReadBack status = goodStatus();
        status.imbalance = wrong;
        EXPECT_EQ(judge(status, OutputMode::BenchLoad).finding, TrainFinding::Garbage) << wrong;
        status = goodStatus();
        status.imbalanceUncertainty = wrong;
        EXPECT_EQ(judge(status, OutputMode::BenchLoad).finding, TrainFinding::Garbage) << wrong;
    }
}

}  // namespace tacto
