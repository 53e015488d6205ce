// A whole bench with a plugged-in stimulator: found, driven, unplugged in the middle of a train, found again.
#include "drivers/sciencemode/ScienceModeDriver.h"
#include "drivers/usb/UsbPorts.h"
#include "tests/drivers/UsbBench.h"
#include "tests/drivers/sciencemode/EmulatedOnUsb.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

class ScienceModeOnUsb : public UsbBench {
protected:
    [[nodiscard]] Registry registry() override {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeScienceModeDriver(makeUsbPorts(usb_, {{0x0483, 0x5740}}, {})));
        return Registry(std::move(drivers));
    }
    void open() {
        ASSERT_IN_TIME(comes([&] { return registry().list().size() == 1; }));
        UsbBench::open({*DeviceUri::parse("sciencemode:?emulated=yes")}, {Role::Stimulator});
    }

    EmulatedOnUsb device_{bed_, *clock_};
};

TEST_F(ScienceModeOnUsb, IsFoundAndDrivenThroughTheRealLibusb) {
    RecordProperty("hazard", "H4");
    open();
    const auto& identity = bench_->devices().stimulator->identity();
    EXPECT_TRUE(identity.simulated) << "the address says so";
    const auto armed = arm();
    ASSERT_IN_TIME(armed);
    EXPECT_EQ(device_.pulses(), 1U) << "the impedance check";
    EXPECT_NEAR(bench_->telemetry().impedance_ohm, 1000, 50);
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    const auto waited = bench_->wait(Seconds(2.2));
    ASSERT_IN_TIME(waited);
    EXPECT_IN_TIME(bench_->telemetry().trainsDelivered >= 4U);
    const auto currents = device_.inspect([](auto& device, Instant now) {
        std::vector<double> all;
        for (const auto& pulse : device.pulses(now)) all.push_back(pulse.points.items[0].current.value());
        return all;
    });
    EXPECT_DOUBLE_EQ(currents.front(), 0.5) << "the check is the smallest pulse";
    EXPECT_NEAR(currents.back(), 40, 2) << "40 V over the measured |Z|, never volts";
}

TEST_F(ScienceModeOnUsb, StopSilencesItAtOnce) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_IN_TIME(bench_->wait(Seconds(0.8)));
    bench_->stop("test");
    std::this_thread::sleep_for(50ms);
    const auto pulses = device_.pulses();
    std::this_thread::sleep_for(1500ms);
    EXPECT_EQ(device_.pulses(), pulses);
    EXPECT_IN_TIME(device_.inspect(
                       [](auto& device, Instant) { return device.requests(sciencemode::Command::LowLevelStop); }) > 0U);
}

TEST_F(ScienceModeOnUsb, UnpluggedInMidDeliveryFaultsKeepsTheSessionAndComesBackAfterAReset) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_IN_TIME(bench_->wait(Seconds(0.8)));
    device_.unplug();
    const auto waited = bench_->wait(Seconds(3));
    ASSERT_FALSE(waited);
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Faulted) << waited.error().message;
    EXPECT_FALSE(bench_->resetFault()) << "the cause is still there";
    EXPECT_IN_TIME(comes([&] { return registry().list().empty(); }));

    device_.plug();
    ASSERT_IN_TIME(comes([&] { return registry().list().size() == 1; }));
    const auto before = device_.pulses();
    std::this_thread::sleep_for(700ms);
    EXPECT_EQ(device_.pulses(), before) << "nothing goes on by itself";
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Faulted);
    ASSERT_IN_TIME(comes([&] { return bench_->resetFault().has_value(); })) << "explicitly, found by its identity";
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Disarmed);
    const auto armed = arm();
    ASSERT_IN_TIME(armed);
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 0, 1));
    ASSERT_IN_TIME(bench_->wait(Seconds(0.8)));
    EXPECT_IN_TIME(device_.pulses() > before);

    bench_.reset();
    ASSERT_TRUE(session_->close());
    const auto verified = accepted(verifySession(file()));
    EXPECT_EQ(verified.status, SessionStatus::Intact);
}

}  // namespace
}  // namespace tacto::test
