// The HID driver on the real hidapi, and the Trance Vibrator on the real libusb, with emulated devices.
#include <cerrno>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "drivers/hid_massager/HidDriver.h"
#include "drivers/hid_massager/HidMassager.h"
#include "drivers/hid_massager/HidapiBackend.h"
#include "drivers/hid_massager/TrancePort.h"
#include "drivers/system/KernelNodes.h"
#include "tests/drivers/conformance/MassagerConformance.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/Comes.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/usb_emulation/EmulatedHidDevice.h"

namespace tacto::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t kLength = 48;
const UsbBytes kOn = [] {
    UsbBytes report{2, 3, 0, 0xFF, 0xFF};
    report.resize(kLength);
    return report;
}();
const UsbBytes kOff = [] {
    UsbBytes report{2, 3};
    report.resize(kLength);
    return report;
}();

std::unique_ptr<Driver> systemDriver(UsbProvider usb = {}) {
    return hid::makeHidDriver(hid::systemHid(sourceDir() / "resources" / "massagers", std::move(usb)));
}

class HidSystem : public testing::Test {
protected:
    Result<void> open() {
        return systemDriver()->open(DeviceUri::parse("hid:054c:0ce6").value(), {}, OpenContext{clock}, devices);
    }
    Result<void> vibrate(double intensity, Seconds duration) {
        auto burst = gate.approve(VibrationBurst{intensity, duration});
        return devices.massager->vibrate(std::move(*burst));
    }

    UsbTestbed bed;
    const SteadyClock clock;
    SafetyGate gate{clock};
    DeviceSet devices;
};

TEST_F(HidSystem, ABurstGoesOutAndEndsByItselfAndClosingStops) {
    RecordProperty("hazard", "H2");
    const EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {});
    const auto opened = open();
    ASSERT_IN_TIME(opened);
    EXPECT_EQ(devices.massager->identity().serial, "SN7");
    ASSERT_IN_TIME(vibrate(1, Seconds(0.1)));
    const auto burst = pad.waitForReports(3);
    ASSERT_IN_TIME(burst.size() >= 3U);
    EXPECT_THAT(burst, testing::ElementsAre(kOff, kOn, kOff));
    ASSERT_IN_TIME(vibrate(1, Seconds(1)));
    // A stop within 4 ms (the shortest time between two writes) of the previous report would be sent twice.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    devices = {};
    const auto stopped = pad.waitForReports(5);
    ASSERT_IN_TIME(stopped.size() >= 5U);
    EXPECT_THAT(stopped, testing::ElementsAre(kOff, kOn, kOff, kOn, kOff));
}

TEST_F(HidSystem, AShortWriteAndARefusalAreFaults) {
    RecordProperty("hazard", "H2");
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {});
    ASSERT_IN_TIME(open());
    pad.takeOnly(10);
    EXPECT_THAT(vibrate(1, Seconds(0.1)),
                refused(ErrorCode::Device, AllOf(HasSubstr("10 bytes"), HasSubstr("48 were expected"))));
    auto again = vibrate(1, Seconds(0.1));  // opens the device again
    // On a busy computer the watchdog may start too late for the approval of 100 ms; the next try finds it running.
    if (!again && again.error().message.find("approval expired") != std::string::npos) again = vibrate(1, Seconds(0.1));
    ASSERT_IN_TIME(again);
    pad.refuseWrites(EIO);
    EXPECT_THAT(vibrate(1, Seconds(0.1)), refused(ErrorCode::Device));
}

TEST_F(HidSystem, ASlowDeviceIsATimeoutAndIsStopped) {
    RecordProperty("hazard", "H2");
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {});
    ASSERT_IN_TIME(open());
    pad.hold(true);
    EXPECT_THAT(vibrate(1, Seconds(1)), refused(ErrorCode::Timeout));
    pad.hold(false);
    const auto all = pad.waitForReports(3);
    ASSERT_IN_TIME(all.size() >= 3U);
    EXPECT_EQ(all.size(), 3U);
    EXPECT_EQ(all.back(), kOff);
}

TEST_F(HidSystem, UnpluggedInABurstIsAFaultAndTheSameDeviceServesAgain) {
    RecordProperty("hazard", "H2");
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {});
    ASSERT_IN_TIME(open());
    ASSERT_IN_TIME(vibrate(1, Seconds(1)));
    pad.unplug();
    devices.massager->forceOff();
    const auto gone = vibrate(1, Seconds(0.1));
    ASSERT_FALSE(gone);
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    pad.plug();
    // On a busy computer the watchdog may start too late for the approval of 100 ms; it is then running at a later try.
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    Result<void> again;
    do {
        again = vibrate(1, Seconds(0.1));
    } while (!again && std::chrono::steady_clock::now() < deadline);
    EXPECT_IN_TIME(again);
}

TEST_F(HidSystem, WhoMayNotOpenItIsTold) {
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {});
    const auto backend = hid::hidapiBackend();
    ASSERT_EQ(backend->devices().size(), 1u);
    std::filesystem::permissions(bed.root() / "dev" / "hidraw0", std::filesystem::perms::owner_read);
    const UnprivilegedUser user(bed);
    const auto list = backend->devices();
    ASSERT_EQ(list.size(), 1u);
    EXPECT_FALSE(list[0].permitted);
    EXPECT_THAT(list[0].obstacle(), HasSubstr("./dev install-rules --device 054c:0ce6"));
}

TEST_F(HidSystem, AProgramThatUsesItThroughTheKernelLosesNothing) {
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {});
    const OtherProgram other(pad.usb().addTerminal("ttyACM0", 1));
    EXPECT_IN_TIME(open()) << "hidraw shares";
    EXPECT_TRUE(pad.usb().kernelDriverBound());
}

TEST_F(HidSystem, TheNodesByWhichAnotherProgramMayUseItAreKnown) {
    const EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {}, 3);
    EXPECT_THAT(kernelNodesOf("1-3"), testing::ElementsAre("/dev/hidraw2"));
    EXPECT_TRUE(kernelNodesOf("1-1").empty());
}

class TranceTest : public testing::Test {
protected:
    void waitForDevice() {
        const auto usb = provider().value();
        ASSERT_IN_TIME(comes([&] { return !usb->devices().empty(); }));
    }
    static std::vector<int> speeds(const EmulatedUsbDevice& device) {
        std::vector<int> all;
        for (const auto& setup : device.requests()) {
            EXPECT_EQ(setup.type, 0x43);
            EXPECT_EQ(setup.request, 1);
            EXPECT_EQ(setup.length, 0);
            all.push_back(setup.value);
        }
        return all;
    }

    UsbTestbed bed;
    const UsbProvider provider = makeUsbProvider();
    std::shared_ptr<UsbContext> context = provider().value();  // kept, so that the whole test uses one context
    const SteadyClock clock;
    SafetyGate gate{clock};
    DeviceSet devices;
};

TEST_F(TranceTest, IsListedAndVibratesByItsOneRequest) {
    RecordProperty("hazard", "H2");
    const EmulatedUsbDevice device(bed, vendorDevice(hid::kTranceVendor, hid::kTranceProduct, "T1"), {});
    waitForDevice();
    const auto driver = systemDriver(provider);
    const auto list = driver->list();
    ASSERT_IN_TIME(list.size() == 1u);
    EXPECT_EQ(list[0].uri, "hid:0b49:064f?serial=T1");
    const auto opened = driver->open(DeviceUri::parse(list[0].uri).value(), {}, OpenContext{clock}, devices);
    ASSERT_IN_TIME(opened);
    EXPECT_EQ(speeds(device), (std::vector<int>{0}));
    ASSERT_IN_TIME(devices.massager->vibrate(std::move(*gate.approve(VibrationBurst{0.5, Seconds(1)}))));
    EXPECT_EQ(speeds(device), (std::vector<int>{0, 128}));
    devices.massager->forceOff();
    devices = {};
    const auto all = speeds(device);
    ASSERT_IN_TIME(all.size() >= 3u);
    for (std::size_t i = 2; i < all.size(); ++i) EXPECT_EQ(all[i], 0);
}

TEST_F(TranceTest, EachOfTwoIsListedWithAnAddressThatOpensItAndNoOther) {
    RecordProperty("hazard", "H4");
    const EmulatedUsbDevice first(bed, vendorDevice(hid::kTranceVendor, hid::kTranceProduct, ""), {});
    const EmulatedUsbDevice second(bed, vendorDevice(hid::kTranceVendor, hid::kTranceProduct, ""), {}, 2);
    ASSERT_IN_TIME(comes([&] { return context->devices().size() == 2u; }));
    const auto driver = systemDriver(provider);
    const auto list = driver->list();
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].uri, "hid:0b49:064f?at=1-1");
    EXPECT_EQ(list[1].uri, "hid:0b49:064f?at=1-2");
    const auto opened = driver->open(DeviceUri::parse(list[1].uri).value(), {}, OpenContext{clock}, devices);
    ASSERT_IN_TIME(opened);
    EXPECT_TRUE(speeds(first).empty());
    EXPECT_EQ(speeds(second), (std::vector<int>{0}));
}

TEST_F(TranceTest, AStopPassesARequestThatTheDeviceDoesNotTake) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(hid::kTranceVendor, hid::kTranceProduct, "T1"), {});
    waitForDevice();
    const auto driver = systemDriver(provider);
    ASSERT_IN_TIME(driver->open(DeviceUri::parse("hid:").value(), {}, OpenContext{clock}, devices));
    device.hold(0, true);
    EXPECT_THAT(devices.massager->vibrate(std::move(*gate.approve(VibrationBurst{1, Seconds(1)}))),
                refused(ErrorCode::Timeout));
    const auto before = std::chrono::steady_clock::now();
    devices.massager->forceOff();
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - before <= std::chrono::milliseconds(50));
    device.hold(0, false);
    devices = {};
    EXPECT_EQ(speeds(device).back(), 0);
}

/// Rig for the conformance suite on the real hidapi.
class SystemRig final : public MassagerRig {
public:
    SystemRig() {
        const auto opened = systemDriver()->open(DeviceUri::parse("hid:").value(), {}, OpenContext{clock_}, devices_);
        EXPECT_IN_TIME(opened);
    }
    [[nodiscard]] bool open() const { return devices_.massager != nullptr; }
    Massager& device() override { return *devices_.massager; }
    const Clock& clock() const override { return clock_; }
    void wait(Seconds duration) override { std::this_thread::sleep_for(duration); }
    std::optional<bool> vibrating() override {
        const auto all = pad_.waitForReports(0);
        return !all.empty() && all.back()[3] > 0;
    }
    bool unplug() override {
        pad_.unplug();
        return true;
    }

private:
    UsbTestbed bed_;
    EmulatedHidDevice pad_{bed_, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kLength), {}};
    const SteadyClock clock_;
    DeviceSet devices_;
};

INSTANTIATE_TEST_SUITE_P(HidSystem, MassagerConformance,
                         testing::Values(MassagerKind{"Hidraw",
                                                      []() -> std::unique_ptr<MassagerRig> {
                                                          auto rig = std::make_unique<SystemRig>();
                                                          if (!rig->open()) return nullptr;
                                                          return rig;
                                                      }}),
                         [](const testing::TestParamInfo<MassagerKind>& kind) { return kind.param.name; });

}  // namespace
}  // namespace tacto::test
