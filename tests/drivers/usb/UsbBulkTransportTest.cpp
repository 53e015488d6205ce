#include <atomic>
#include <gmock/gmock.h>
#include <limits>

#include "drivers/usb/UsbBulkTransport.h"
#include "tests/drivers/usb/UsbFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class UsbBulk : public UsbTest {};

TEST_F(UsbBulk, CarriesBytesThereAndBack) {
    const EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {.onBytes = echo});
    const auto transport = open(device);
    ASSERT_IN_TIME(transport);
    ASSERT_IN_TIME(transport->write(bytesOf("hello"), kLong));
    EXPECT_EQ(readAll(*transport, 5), bytesOf("hello"));
    EXPECT_EQ(transport->dropped(), 0u);
    EXPECT_EQ(transport->info().serial, "S");
}

TEST_F(UsbBulk, AWriteIsOneTransferHoweverLong) {
    const EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S", 64), {.onBytes = echo});
    const auto transport = open(device);
    ASSERT_IN_TIME(transport);
    UsbBytes large(5000);
    for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<std::uint8_t>(i * 7);
    ASSERT_IN_TIME(transport->write(large, kLong));
    EXPECT_THAT(device.waitForReceived(1), ElementsAre(large));
    EXPECT_EQ(readAll(*transport, large.size()), large);
}

TEST_F(UsbBulk, AnAnswerOfExactlyOneFullPacketArrivesAtOnce) {
    // Without an empty packet after it, a larger buffer would make libusb wait for more.
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S", 64), {});
    const auto transport = open(device);
    ASSERT_IN_TIME(transport);
    const UsbBytes full(64, 0xAA);
    device.send(kIn, full);
    EXPECT_EQ(readAll(*transport, 64), full);
}

TEST_F(UsbBulk, ASerialPortGetsItsLineCodingAndThatTheHostListens) {
    std::vector<UsbBytes> codings;
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x2341, 0x003E, "S"),
                             {.onRequest = [&](const UsbSetup& setup, auto data) -> std::optional<UsbBytes> {
                                 if (setup.request == 0x20) codings.emplace_back(data.begin(), data.end());
                                 return UsbBytes{};
                             }});
    auto transport = open(device);
    ASSERT_IN_TIME(transport);
    EXPECT_THAT(device.requests(), ElementsAre(UsbSetup{0x21, 0x20, 0, 0, 7}, UsbSetup{0x21, 0x22, 3, 0, 0}));
    EXPECT_THAT(codings, ElementsAre(UsbBytes{0x00, 0xC2, 0x01, 0x00, 0, 0, 8}));  // 115200 8N1
    transport.reset();
    EXPECT_EQ(device.requests().back(), (UsbSetup{0x21, 0x22, 0, 0, 0}));
}

TEST_F(UsbBulk, DataTerminalReadyIsLeftAloneWhereItIsNotAskedFor) {
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {});
    auto transport = open(device, {.dataTerminalReady = false});
    ASSERT_IN_TIME(transport);
    transport.reset();
    for (const auto& setup : device.requests()) EXPECT_NE(setup.request, 0x22);
}

TEST_F(UsbBulk, ADeviceWithoutLineCodingIsUsedOneThatRefusesReadyIsNot) {
    std::atomic<std::uint8_t> broken = 0x20;
    const EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"),
                                   {.onRequest = [&](const UsbSetup& setup, auto) -> std::optional<UsbBytes> {
                                       if (setup.request == broken) return std::nullopt;
                                       return UsbBytes{};
                                   }});
    EXPECT_IN_TIME(open(device));
    broken = 0x22;
    EXPECT_THAT(UsbBulkTransport::open(context, context->devices().front(), {}), refused(ErrorCode::Device));
}

TEST_F(UsbBulk, TheKernelsDriverStepsAsideAndComesBack) {
    const EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {.onBytes = echo});
    ASSERT_TRUE(device.kernelDriverBound());
    auto transport = open(device);
    ASSERT_IN_TIME(transport);
    EXPECT_FALSE(device.kernelDriverBound());
    transport.reset();
    EXPECT_TRUE(device.kernelDriverBound());
}

TEST_F(UsbBulk, TheKernelsDriverComesBackAfterARefusalToo) {
    const EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"),
                                   {.onRequest = [](const UsbSetup&, auto) { return std::nullopt; }});
    ASSERT_IN_TIME(waitForDevices(1));
    EXPECT_FALSE(UsbBulkTransport::open(context, context->devices().front(), {}));
    EXPECT_TRUE(device.kernelDriverBound());
}

TEST_F(UsbBulk, ADeviceThatAnotherProgramUsesIsRefused) {
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {});
    ASSERT_IN_TIME(waitForDevices(1));
    device.claimElsewhere(1);
    EXPECT_THAT(UsbBulkTransport::open(context, context->devices().front(), {}),
                refused(ErrorCode::Io, "close that program first"));
    EXPECT_FALSE(UsbBulkTransport::open(context, context->devices().front(), {}))
        << "the first try took its claim away";
}

TEST_F(UsbBulk, ADeviceIsNotTakenFromAProgramThatUsesItsTerminalAndThatProgramIsNamed) {
    RecordProperty("hazard", "H4");
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {.onBytes = echo});
    ASSERT_IN_TIME(waitForDevices(1));
    {
        const OtherProgram other(device.addTerminal("ttyACM0"));
        EXPECT_THAT(UsbBulkTransport::open(context, context->devices().front(), {}),
                    refused(ErrorCode::Io, testing::AllOf(HasSubstr("/dev/ttyACM0"), HasSubstr(other.text()),
                                                          HasSubstr("close that program"))));
        EXPECT_TRUE(device.kernelDriverBound());
        EXPECT_TRUE(device.requests().empty()) << "it was not spoken to either";
    }
    EXPECT_IN_TIME(UsbBulkTransport::open(context, context->devices().front(), {}));
}

TEST_F(UsbBulk, AProgramThatHasClaimedTheDeviceIsNamed) {
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {});
    ASSERT_IN_TIME(waitForDevices(1));
    device.claimElsewhere(0);
    const OtherProgram other(device.nodeFile());
    EXPECT_THAT(UsbBulkTransport::open(context, context->devices().front(), {}),
                refusedSaying(testing::AllOf(HasSubstr("/dev/bus/usb/001/002"), HasSubstr(other.text()))));
}

TEST_F(UsbBulk, TheKernelsDriverThatAKilledProgramTookAwayIsBackAfterTheNextClosing) {
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "S"), {.onBytes = echo});
    device.loseKernelDriver();
    auto transport = open(device);
    ASSERT_IN_TIME(transport);
    EXPECT_FALSE(device.kernelDriverBound());
    transport.reset();
    EXPECT_TRUE(device.kernelDriverBound());
}

TEST_F(UsbBulk, AReadEndsWithItsTimeAndAZeroTimeOnlyLooks) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    std::array<std::uint8_t, 8> into{};
    const auto [late, took] = timed([&] { return transport->read(into, kShort); });
    ASSERT_FALSE(late);
    EXPECT_EQ(late.error().code, ErrorCode::Timeout);
    EXPECT_GE(took, kShort);
    EXPECT_EQ(transport->read(into, Seconds(0)).error().code, ErrorCode::Timeout);
    device.send(kIn, bytesOf("x"));
    EXPECT_EQ(transport->read(into, kLong).value(), 1u);
}

TEST_F(UsbBulk, AWriteThatTheDeviceDoesNotTakeIsCancelledAndTheNextIsWhole) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {.onBytes = echo});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    device.hold(kOut, true);
    const auto [late, took] = timed([&] { return transport->write(bytesOf("first"), kShort); });
    ASSERT_FALSE(late);
    EXPECT_EQ(late.error().code, ErrorCode::Timeout);
    EXPECT_IN_TIME(took < Seconds(2));
    device.hold(kOut, false);
    ASSERT_IN_TIME(transport->write(bytesOf("second"), kLong));
    EXPECT_THAT(device.waitForReceived(1), ElementsAre(bytesOf("second")));
}

TEST_F(UsbBulk, AWriteThatIsTakenInPartIsAFault) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    device.takeOnly(kOut, 3);
    EXPECT_THAT(transport->write(bytesOf("hello"), kLong),
                refused(ErrorCode::Device, "took 3 bytes of a write; 5 were expected"));
}

TEST_F(UsbBulk, AStalledWriteIsAFaultAndTheNextOneWorks) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {.onBytes = echo});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    device.stall(kOut);
    EXPECT_THAT(transport->write(bytesOf("hello"), kLong), refused(ErrorCode::Device, "stall"));
    ASSERT_IN_TIME(transport->write(bytesOf("again"), kLong));
    EXPECT_EQ(readAll(*transport, 5), bytesOf("again"));
}

TEST_F(UsbBulk, AStalledReadIsToldOnceAndReadingGoesOn) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {.onBytes = echo});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    device.stall(kIn);
    std::array<std::uint8_t, 8> into{};
    EXPECT_THAT(transport->read(into, kLong), refused(ErrorCode::Device));
    EXPECT_EQ(device.cleared(), 1);
    ASSERT_IN_TIME(transport->write(bytesOf("after"), kLong));
    EXPECT_EQ(readAll(*transport, 5), bytesOf("after"));
}

TEST_F(UsbBulk, APacketLargerThanTheDeviceSaidIsAFaultAndReadingGoesOn) {
    RecordProperty("hazard", "H10");
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S", 64), {});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    device.sendPacket(kIn, UsbBytes(100, 1));
    UsbBytes into(256);
    ASSERT_EQ(transport->read(into, kLong).value(), 64u);  // the bytes that fitted are returned
    EXPECT_THAT(transport->read(into, kLong), refused(ErrorCode::Device, "more than was asked for"));
    device.send(kIn, bytesOf("fine"));
    EXPECT_EQ(readAll(*transport, 4), bytesOf("fine"));
}

TEST_F(UsbBulk, RefusesWhatItCannotCarry) {
    const EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "S"), {});
    const auto transport = open(device, {.function = UsbFunction::Vendor});
    ASSERT_IN_TIME(transport);
    const auto nan = Seconds(std::numeric_limits<double>::quiet_NaN());
    std::array<std::uint8_t, 1> one{};
    const auto invalid = refused(ErrorCode::InvalidArgument);
    EXPECT_THAT(transport->write({}, kLong), invalid);
    EXPECT_THAT(transport->write(UsbBytes(65537), kLong), invalid);
    EXPECT_THAT(transport->write(one, nan), invalid);
    EXPECT_THAT(transport->write(one, Seconds(-1)), invalid);
    EXPECT_THAT(transport->read({}, kLong), invalid);
    EXPECT_THAT(transport->read(one, nan), invalid);
    EXPECT_THAT(transport->read(one, Seconds(3601)), invalid);
    const auto info = context->devices().front();
    EXPECT_THAT(UsbBulkTransport::open(context, info, {.inTransfers = 0}), invalid);
    EXPECT_THAT(UsbBulkTransport::open(context, info, {.ringBytes = 0}), invalid);
    EXPECT_EQ(device.waitForReceived(0).size(), 0u);
}

}  // namespace
}  // namespace tacto::test
