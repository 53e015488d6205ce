// The Pulse Pal driver on the real libusb, with an emulated CDC-ACM device and the emulated firmware behind it.
#include <gtest/gtest.h>
#include <mutex>

#include "drivers/pulsepal/PulsePalDriver.h"
#include "tests/drivers/pulsepal/PulsePalLine.h"
#include "tests/drivers/usb/UsbFixture.h"
#include "tests/support/BenchGate.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

class PulsePalUsb : public UsbTest {
protected:
    /// Carries one transfer and advances the time, because the firmware needs some cycles to answer it.
    UsbBytes carry(std::span<const std::uint8_t> bytes) {
        const std::scoped_lock lock(mutex);
        time = std::max(time, clock.now());
        device.receive(bytes, time);
        time += Instant(std::chrono::milliseconds(1));
        UsbBytes answer(256);
        answer.resize(device.transmit(answer, time));
        return answer;
    }
    UsbBehaviour behaviour() {
        return {.onBytes = [this](auto bytes) { return carry(bytes); },
                .onRequest = [this](const UsbSetup& setup, auto) -> std::optional<UsbBytes> {
                    const std::scoped_lock lock(mutex);
                    if (setup.request == 0x22) device.setReady((setup.value & 1) != 0);
                    return UsbBytes{};
                }};
    }
    Connect connector(bool ready) {
        return [this, ready]() -> Result<std::unique_ptr<Transport>> {
            const auto info = context->find({kPulsePalVendor, kPulsePalProduct});
            if (!info) return failure(info);
            auto opened = UsbBulkTransport::open(context, *info, {.dataTerminalReady = ready});
            if (!opened) return failure(opened);
            return std::move(*opened);
        };
    }

    const SteadyClock clock;
    std::mutex mutex;
    Instant time{0};
    pulsepal::EmulatedPulsePal device;
};

TEST_F(PulsePalUsb, OpensDeliversAndClosesSilent) {
    RecordProperty("hazard", "H2");
    const EmulatedUsbDevice usb(bed, cdcAcmDevice(kPulsePalVendor, kPulsePalProduct, "PP1"), behaviour());
    ASSERT_IN_TIME(waitForDevices(1));
    auto opened = pulsepal::PulsePalStimulator::open(connector(true), "pulsepal:PP1", "PP1", 1, clock);
    ASSERT_IN_TIME(opened);
    const auto gate = benchGate(clock, (*opened)->traits());
    auto approval = approve(*gate, clock, pulseTrain(5, 100));
    const auto before = std::chrono::steady_clock::now();
    const auto delivered = (*opened)->deliver(std::move(approval));
    const Seconds took = std::chrono::steady_clock::now() - before;
    ASSERT_IN_TIME(delivered);
    RecordProperty("deliver_us", static_cast<int>(took.count() * 1e6));
    const auto begun = (*opened)->status();
    ASSERT_IN_TIME(begun);
    EXPECT_IN_TIME(begun->delivering);
    (*opened)->forceOff();
    const auto stopped = (*opened)->status();
    ASSERT_IN_TIME(stopped);
    EXPECT_FALSE(stopped->delivering);
    opened->reset();
    const std::scoped_lock lock(mutex);
    EXPECT_FALSE(device.active(time));
    EXPECT_EQ(device.commands(0x4D), 1u);
    EXPECT_EQ(device.commands(0x51), 1u);
}

TEST_F(PulsePalUsb, WithoutDtrItIsNotHeard) {
    const EmulatedUsbDevice usb(bed, cdcAcmDevice(kPulsePalVendor, kPulsePalProduct, "PP1"), behaviour());
    ASSERT_IN_TIME(waitForDevices(1));
    EXPECT_THAT(pulsepal::PulsePalStimulator::open(connector(false), "pulsepal:PP1", "PP1", 1, clock),
                refused(ErrorCode::Timeout));
}

TEST_F(PulsePalUsb, UnpluggedIsAFaultAndComesBackByIdentity) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice usb(bed, cdcAcmDevice(kPulsePalVendor, kPulsePalProduct, "PP1"), behaviour());
    ASSERT_IN_TIME(waitForDevices(1));
    auto opened = pulsepal::PulsePalStimulator::open(connector(true), "pulsepal:PP1", "PP1", 1, clock);
    ASSERT_IN_TIME(opened);
    usb.unplug();
    const auto gone = (*opened)->status();
    ASSERT_FALSE(gone);
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    ASSERT_IN_TIME(waitForDevices(0));
    usb.plug();
    ASSERT_IN_TIME(waitForDevices(1));
    const auto back = (*opened)->status();
    EXPECT_IN_TIME(back);
}

}  // namespace
}  // namespace tacto::test
