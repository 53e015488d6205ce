// The emulated HID device under the real hidapi: the basis for the tests of HID drivers.
#include <cerrno>
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hidapi/hidapi.h>
#include <memory>

#include "tests/support/InTime.h"
#include "tests/support/usb_emulation/EmulatedHidDevice.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

/// A vendor page: 64-byte input and output reports and an 8-byte feature report, without numbers.
const UsbBytes kPlain{0x06, 0x00, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x40,
                      0x09, 0x01, 0x81, 0x02, 0x09, 0x02, 0x91, 0x02, 0x95, 0x08, 0x09, 0x03, 0xB1, 0x02, 0xC0};
/// Similar reports, all with the number 5.
const UsbBytes kNumbered{0x06, 0x00, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, 0x05, 0x15, 0x00,
                         0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x1F, 0x09, 0x01, 0x81, 0x02,
                         0x09, 0x02, 0x91, 0x02, 0x95, 0x08, 0x09, 0x03, 0xB1, 0x02, 0xC0};

struct CloseHid {
    void operator()(hid_device* device) const { hid_close(device); }
};
using Hid = std::unique_ptr<hid_device, CloseHid>;

class EmulatedHid : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(hid_init(), 0); }
    void TearDown() override { hid_exit(); }
    static Hid open() { return Hid(hid_open(0x1234, 0x5679, nullptr)); }
    static UsbBytes read(const Hid& hid, int milliseconds = 5000) {
        UsbBytes report(65);
        const int length = hid_read_timeout(hid.get(), report.data(), report.size(), milliseconds);
        report.resize(static_cast<std::size_t>(std::max(length, 0)));
        return report;
    }
    UsbTestbed bed;
};

UsbBytes numbered(std::uint8_t number, std::size_t size, std::uint8_t first) {
    UsbBytes report(size);
    report[0] = number;
    report[1] = first;
    return report;
}

std::vector<UsbBytes> inverted(std::span<const std::uint8_t> report) {
    UsbBytes answer(report.begin(), report.end());
    for (auto& byte : answer) byte = static_cast<std::uint8_t>(~byte);
    return {answer};
}

TEST_F(EmulatedHid, IsEnumeratedWithItsSerialNumber) {
    const EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kPlain, {});
    auto* list = hid_enumerate(0x1234, 0x5679);
    ASSERT_NE(list, nullptr);
    EXPECT_EQ(std::wstring(list->serial_number), L"SN7");
    EXPECT_EQ(std::wstring(list->product_string), L"Loopback");
    EXPECT_EQ(std::string(list->path), "/dev/hidraw0");
    EXPECT_EQ(list->next, nullptr);
    hid_free_enumeration(list);
}

TEST_F(EmulatedHid, ReportsGoOutAndComeBackWhole) {
    const EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kPlain, {.onReport = inverted});
    const auto hid = open();
    ASSERT_IN_TIME(hid);
    UsbBytes out(65, 0x11);
    out[0] = 0;  // the report has no number
    ASSERT_EQ(hid_write(hid.get(), out.data(), out.size()), 65);
    EXPECT_THAT(device.waitForReports(1), ElementsAre(UsbBytes(64, 0x11)));
    EXPECT_EQ(read(hid), UsbBytes(64, 0xEE));
}

TEST_F(EmulatedHid, NumberedReportsKeepTheirNumber) {
    const EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kNumbered, {});
    const auto hid = open();
    ASSERT_IN_TIME(hid);
    const auto out = numbered(5, 32, 0x77);
    ASSERT_EQ(hid_write(hid.get(), out.data(), out.size()), 32);
    EXPECT_THAT(device.waitForReports(1), ElementsAre(out));
    const auto feature = numbered(5, 9, 0x42);
    ASSERT_EQ(hid_send_feature_report(hid.get(), feature.data(), feature.size()), 9);
    EXPECT_THAT(device.featuresSet(), ElementsAre(feature));
    auto back = numbered(5, 9, 0);
    ASSERT_EQ(hid_get_feature_report(hid.get(), back.data(), back.size()), 9);
    EXPECT_EQ(back, feature);
}

TEST_F(EmulatedHid, ABurstKeepsItsReportsApartAndInOrder) {
    EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kNumbered, {});
    const auto hid = open();
    ASSERT_IN_TIME(hid);
    for (std::uint8_t i = 0; i < 5; ++i) device.send(numbered(5, 32, i));
    for (std::uint8_t i = 0; i < 5; ++i) EXPECT_EQ(read(hid), numbered(5, 32, i));
    EXPECT_TRUE(read(hid, 30).empty());
}

TEST_F(EmulatedHid, AShortWriteAndARefusedOneAreSeen) {
    EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kNumbered, {});
    const auto hid = open();
    ASSERT_IN_TIME(hid);
    const auto out = numbered(5, 32, 1);
    device.takeOnly(10);
    EXPECT_EQ(hid_write(hid.get(), out.data(), out.size()), 10);
    device.refuseWrites(EIO);
    EXPECT_EQ(hid_write(hid.get(), out.data(), out.size()), -1);
}

TEST_F(EmulatedHid, ASlowDeviceIsWaitedFor) {
    EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kNumbered, {});
    const auto hid = open();
    ASSERT_IN_TIME(hid);
    const auto out = numbered(5, 32, 1);
    device.hold(true);
    auto writing = std::async(std::launch::async, [&] { return hid_write(hid.get(), out.data(), out.size()); });
    EXPECT_EQ(writing.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
    EXPECT_TRUE(device.waitForReports(0).empty());
    device.hold(false);
    EXPECT_IN_TIME(writing.get() == 32);
    EXPECT_IN_TIME(device.waitForReports(1).size() == 1u);
}

TEST_F(EmulatedHid, AnUnpluggedDeviceEndsAReadAndComesBack) {
    EmulatedHidDevice device(bed, 0x1234, 0x5679, "SN7", kNumbered, {});
    auto hid = open();
    ASSERT_IN_TIME(hid);
    std::promise<void> started;
    auto reading = std::async(std::launch::async, [&] {
        UsbBytes report(64);
        started.set_value();
        return hid_read_timeout(hid.get(), report.data(), report.size(), 5000);
    });
    started.get_future().wait();
    device.unplug();
    EXPECT_IN_TIME(reading.get() == -1);
    const auto out = numbered(5, 32, 1);
    EXPECT_EQ(hid_write(hid.get(), out.data(), out.size()), -1);
    hid.reset();
    device.plug();
    hid = open();
    ASSERT_IN_TIME(hid);
    EXPECT_IN_TIME(hid_write(hid.get(), out.data(), out.size()) == 32);
}

}  // namespace
}  // namespace tacto::test
