// Tests the text of the fault banner: time, cause, what was delivered, and what it must not claim.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/theme/Theme.h"
#include "app/gui/window/FaultBanner.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class BannerOfAFault : public testing::Test {
protected:
    BannerOfAFault() { RecordProperty("hazard", "H9"); }
    void limit(Quantity quantity, double value, double limit, bool evaluated = true) {
        auto& row = now.exposureRows[now.exposureCount++];
        row.quantity = quantity;
        row.value = value;
        row.limit = limit;
        row.unit = unitOf(quantity);
        row.evaluated = evaluated;
        row.within = evaluated && value <= limit;
    }
    /// Refreshes a third of a second later.
    void refresh(InterlockState state, std::uint64_t trains, std::optional<FaultCause> cause = {}) {
        now.at += std::chrono::milliseconds(333);
        now.state = state;
        now.trainsDelivered = trains;
        now.fault = cause;
        if (state == InterlockState::Faulted) now.reason = "the electrode is open: |Z| rose above 50 kohm";
        banner.refresh(now, QTime(10, 42, 7));
    }
    void fault(FaultCause cause = FaultCause::OpenElectrode) {
        refresh(InterlockState::Delivering, 6);
        refresh(InterlockState::Faulted, 7, cause);
    }
    [[nodiscard]] std::string line(int index) { return banner.text().split('\n').value(index).toStdString(); }
    Telemetry now;
    gui::FaultBanner banner{nullptr};
};

TEST_F(BannerOfAFault, SaysWhenItCame) {
    RecordProperty("hazard", "H12");
    refresh(InterlockState::Delivering, 7);
    EXPECT_FALSE(banner.isVisible());
    refresh(InterlockState::Faulted, 7, FaultCause::OpenElectrode);
    EXPECT_TRUE(banner.isVisible());
    EXPECT_EQ(line(0), "10:42:07 · The electrode is open: |Z| rose above 50 kΩ.");
    banner.refresh(now, QTime(10, 50));
    EXPECT_THAT(line(0), StartsWith("10:42:07")) << "not the time at which it is looked at";
    refresh(InterlockState::Disarmed, 7);
    EXPECT_FALSE(banner.isVisible());
    now.reason = "the electrode is open: |Z| rose above 50 kohm";
    now.state = InterlockState::Faulted;
    banner.refresh(now, QTime(11, 0));
    EXPECT_THAT(line(0), StartsWith("11:00:00")) << "the next fault has its own";
}

TEST_F(BannerOfAFault, SaysNoTimeOfAFaultThatWasThereBefore) {
    refresh(InterlockState::Disconnected, 0);
    refresh(InterlockState::Faulted, 0, FaultCause::OpenElectrode);
    EXPECT_THAT(line(0), StartsWith("The electrode is open"));
    EXPECT_EQ(line(1), "Output is off and stays off. No train was delivered.");
}

TEST_F(BannerOfAFault, SaysThatLimitsWereKeptWhereTheGateFoundSo) {
    limit(Quantity::CommandVoltage, 39, 40);
    fault();
    EXPECT_EQ(line(1), "Output is off and stays off. 7 trains were delivered, within all limits.");
}

TEST_F(BannerOfAFault, CountsNoLimitThatWasNotEvaluated) {
    limit(Quantity::CommandVoltage, 39, 40);
    limit(Quantity::PowerDensity, 0, 0.25, false);
    fault();
    EXPECT_EQ(line(1), "Output is off and stays off. 7 trains were delivered, within every limit that was evaluated.");
}

TEST_F(BannerOfAFault, ClaimsNothingOfLimitsAfterOneWasBroken) {
    limit(Quantity::CommandVoltage, 41, 40);
    refresh(InterlockState::Delivering, 5);
    now.exposureRows[0].value = 20;
    now.exposureRows[0].within = true;
    fault();
    EXPECT_EQ(line(1), "Output is off and stays off. 7 trains were delivered.") << "also when it is in the past";
}

TEST_F(BannerOfAFault, ClaimsNothingOfLimitsWhereTheGateDidNotSeeThemAll) {
    fault();
    EXPECT_EQ(line(1), "Output is off and stays off. 7 trains were delivered.") << "it judged nothing";
    limit(Quantity::CommandVoltage, 39, 40);
    refresh(InterlockState::Delivering, 8);
    now.at += std::chrono::seconds(6);
    refresh(InterlockState::Delivering, 20);
    refresh(InterlockState::Faulted, 20, FaultCause::OpenElectrode);
    EXPECT_THAT(line(1), Not(HasSubstr("limit"))) << "the window stood still: trains left the table unseen";
}

TEST_F(BannerOfAFault, ClaimsNothingOfLimitsWhereTheFaultTellsOtherwise) {
    limit(Quantity::CommandVoltage, 39, 40);
    for (const auto cause : {FaultCause::LimitBroken, FaultCause::NetCharge, FaultCause::DeviceFault,
                             FaultCause::ShortElectrode, FaultCause::StatusMissing, FaultCause::Internal}) {
        fault(cause);
        EXPECT_THAT(line(1), Not(HasSubstr("limit"))) << int(cause);
    }
    now.fault.reset();
    banner.refresh(now, QTime(10, 50));
    EXPECT_THAT(line(1), Not(HasSubstr("limit"))) << "a cause that is not known";
}

TEST_F(BannerOfAFault, AnotherBenchBeginsAnew) {
    limit(Quantity::CommandVoltage, 41, 40);
    refresh(InterlockState::Delivering, 5);
    now = Telemetry{};
    refresh(InterlockState::Disconnected, 0);
    limit(Quantity::CommandVoltage, 39, 40);
    fault();
    EXPECT_THAT(line(1), HasSubstr("within all limits"));
}

}  // namespace
}  // namespace tacto::test
