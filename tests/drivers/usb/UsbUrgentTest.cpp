#include <atomic>
#include <gmock/gmock.h>
#include <thread>

#include "tests/drivers/usb/UsbFixture.h"
#include "tests/support/Allocations.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

class UsbUrgent : public UsbTest {
protected:
    const UsbBulkOptions vendor{.function = UsbFunction::Vendor};
};

TEST_F(UsbUrgent, GoesOutBehindTheWriteInFlightAndAheadOfTheNext) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    device.hold(kOut, true);
    auto writing = std::async(std::launch::async, [&] { return transport->write(bytesOf("train"), kLong); });
    ASSERT_IN_TIME(device.waitForWaiting(kOut, 1));
    transport->writeUrgent(bytesOf("stop"));
    ASSERT_IN_TIME(device.waitForWaiting(kOut, 2));  // both are queued before the call returns
    device.hold(kOut, false);
    ASSERT_IN_TIME(writing.get());
    ASSERT_IN_TIME(transport->write(bytesOf("next"), kLong));
    EXPECT_THAT(device.waitForReceived(3), ElementsAre(bytesOf("train"), bytesOf("stop"), bytesOf("next")));
    EXPECT_EQ(transport->urgentDelivered(), 1u);
}

TEST_F(UsbUrgent, ReturnsAtOnceWhileTheDeviceTakesNothing) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    device.hold(kOut, true);
    const auto stop = bytesOf("stop");
    const auto before = allocationsOfThisThread();
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 100; ++i) transport->writeUrgent(stop);
    const Seconds took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(allocationsOfThisThread() - before, 0u);
    EXPECT_IN_TIME(took < Seconds(0.5));
    device.hold(kOut, false);
}

TEST_F(UsbUrgent, WhileItIsUnderWayTheNewestIsSentBehindIt) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    device.hold(kOut, true);
    transport->writeUrgent(bytesOf("stop 1"));
    transport->writeUrgent(bytesOf("stop 2"));
    transport->writeUrgent(bytesOf("stop 3"));
    auto writing = std::async(std::launch::async, [&] { return transport->write(bytesOf("later"), kLong); });
    device.hold(kOut, false);
    ASSERT_IN_TIME(writing.get());
    EXPECT_THAT(device.waitForReceived(3), ElementsAre(bytesOf("stop 1"), bytesOf("stop 3"), bytesOf("later")));
    EXPECT_EQ(transport->urgentDelivered(), 2u);
}

TEST_F(UsbUrgent, AStallDoesNotLoseIt) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, vendor);
    ASSERT_TRUE(transport);
    device.stall(kOut);
    std::array<std::uint8_t, 8> into{};
    auto reading = std::async(std::launch::async, [&] { return transport->read(into, kLong); });
    transport->writeUrgent(bytesOf("stop"));
    // The thread that waits for a reply clears the stall and sends the stop again.
    EXPECT_THAT(device.waitForReceived(1), ElementsAre(bytesOf("stop")));
    device.send(kIn, bytesOf("ok"));
    EXPECT_EQ(reading.get().value(), 2u);
    EXPECT_EQ(device.cleared(), 1);
}

TEST_F(UsbUrgent, LeavesBeforeTheTransportCloses) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    transport->writeUrgent(bytesOf("stop 1"));
    transport->writeUrgent(bytesOf("stop 2"));
    transport.reset();
    EXPECT_EQ(device.waitForReceived(2).back(), bytesOf("stop 2"));
}

TEST_F(UsbUrgent, ManyThreadsMayStopWhileOneWritesAndReads) {
    const EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {.onBytes = echo});
    const auto transport = open(device, vendor);
    ASSERT_IN_TIME(transport);
    std::atomic<bool> ending{false};
    std::vector<std::thread> stoppers;
    for (int i = 0; i < 3; ++i) {
        stoppers.emplace_back([&] {
            while (!ending) transport->writeUrgent(bytesOf("S"));
        });
    }
    for (int i = 0; i < 300; ++i) ASSERT_IN_TIME(transport->write(bytesOf("work"), kLong)) << i;
    ending = true;
    for (auto& stopper : stoppers) stopper.join();
    std::size_t works = 0;
    for (const auto& transfer : device.waitForReceived(301)) {
        ASSERT_TRUE(transfer == bytesOf("work") || transfer == bytesOf("S"));  // the two messages are never mixed
        works += transfer == bytesOf("work") ? 1 : 0;
    }
    EXPECT_EQ(works, 300u);
    EXPECT_GT(transport->urgentDelivered(), 0u);
}

}  // namespace
}  // namespace tacto::test
