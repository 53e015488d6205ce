#include "tests/drivers/usb/UsbFixture.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// Limit for a waiting call to notice; without sanitizers the measured time is below 2 ms.
constexpr Seconds kNoticed{0.25};

class UsbUnplug : public UsbTest {
protected:
    const UsbBulkOptions vendor{.function = UsbFunction::Vendor};
};

TEST_F(UsbUnplug, AWaitingReadReturnsAtOnce) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    std::chrono::steady_clock::time_point returned;
    auto reading = std::async(std::launch::async, [&] {
        std::array<std::uint8_t, 8> into{};
        auto read = transport->read(into, kLong);
        returned = std::chrono::steady_clock::now();
        return read;
    });
    ASSERT_IN_TIME(device.waitForWaiting(kIn, 8));
    const auto pulled = std::chrono::steady_clock::now();
    device.unplug();
    const auto read = reading.get();
    ASSERT_FALSE(read);
    EXPECT_CODE_IN_TIME(read.error().code, ErrorCode::Device);
    EXPECT_IN_TIME(Seconds(returned - pulled) < kNoticed);
    RecordProperty("noticed_ms", std::to_string(Seconds(returned - pulled).count() * 1e3));
}

TEST_F(UsbUnplug, AWriteInFlightReturnsAtOnce) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    device.hold(kOut, true);
    auto writing = std::async(std::launch::async,
                              [&] { return timed([&] { return transport->write(bytesOf("train"), kLong); }); });
    ASSERT_IN_TIME(device.waitForWaiting(kOut, 1));
    device.unplug();
    const auto [written, took] = writing.get();
    ASSERT_FALSE(written);
    EXPECT_CODE_IN_TIME(written.error().code, ErrorCode::Device);
    EXPECT_IN_TIME(took < kLong);
    const auto [after, immediate] = timed([&] { return transport->write(bytesOf("more"), kLong); });
    ASSERT_FALSE(after);
    EXPECT_CODE_IN_TIME(after.error().code, ErrorCode::Device);
    EXPECT_IN_TIME(immediate < kNoticed);
    transport->writeUrgent(bytesOf("stop"));  // harmless without a device
}

TEST_F(UsbUnplug, WhatArrivedBeforeIsStillRead) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {.onBytes = echo});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    device.send(kIn, bytesOf("last words"));
    std::array<std::uint8_t, 4> first{};
    ASSERT_EQ(transport->read(first, kLong).value(), 4u);
    device.unplug();
    EXPECT_EQ(readAll(*transport, 6), bytesOf(" words"));
    EXPECT_EQ(transport->read(first, kLong).error().code, ErrorCode::Device);
}

TEST_F(UsbUnplug, TheSameDeviceIsFoundAgainAndWorks) {
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "P24-17"), {.onBytes = echo});
    auto transport = open(device);
    ASSERT_IN_TIME(transport);
    const auto who = transport->info().identity();
    device.unplug();
    ASSERT_IN_TIME(waitForDevices(0));
    device.plug();
    ASSERT_IN_TIME(waitForDevices(1));
    const auto found = context->find(who);
    ASSERT_IN_TIME(found);
    // The old transport may still exist while the new one works.
    auto again = UsbBulkTransport::open(context, *found, {});
    ASSERT_IN_TIME(again);
    ASSERT_IN_TIME((*again)->write(bytesOf("back"), kLong));
    EXPECT_EQ(readAll(**again, 4), bytesOf("back"));
    EXPECT_EQ(transport->write(bytesOf("old"), kLong).error().code, ErrorCode::Device);
}

TEST_F(UsbUnplug, ATransportIsDestroyedWithTransfersInFlight) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    for (int round = 0; round < 20; ++round) {
        auto transport = open(device, vendor);
        ASSERT_IN_TIME(transport);
        device.hold(kOut, true);
        transport->writeUrgent(bytesOf("stop"));
        ASSERT_IN_TIME(device.waitForWaiting(kIn, 8));
        ASSERT_IN_TIME(device.waitForWaiting(kOut, 1));
        transport.reset();
        device.hold(kOut, false);
    }
    EXPECT_TRUE(device.waitForReceived(0).empty());  // all transfers were cancelled
}

TEST_F(UsbUnplug, PullingThePlugAtAnyMomentIsAnErrorAndNothingWorse) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {.onBytes = echo});
    for (int round = 0; round < 30; ++round) {
        auto transport = open(device, vendor);
        ASSERT_IN_TIME(transport);
        // One thread works and another sends stops until the device is gone.
        auto working = std::async(std::launch::async, [&] {
            std::array<std::uint8_t, 64> into{};
            for (;;) {
                const auto written = transport->write(bytesOf("work"), kLong);
                if (!written) return written.error().code;
                const auto read = transport->read(into, kLong);
                if (!read) return read.error().code;
            }
        });
        const auto busy = static_cast<std::size_t>(round % 7) + 1;
        ASSERT_IN_TIME(device.waitForReceived(busy).size() >= busy);
        transport->writeUrgent(bytesOf("stop"));
        device.unplug();
        transport->writeUrgent(bytesOf("stop"));
        EXPECT_CODE_IN_TIME(working.get(), ErrorCode::Device);
        transport.reset();
        ASSERT_IN_TIME(waitForDevices(0));
        device.plug();
    }
}

}  // namespace
}  // namespace tacto::test
