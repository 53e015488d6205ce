#include <gmock/gmock.h>

#include "drivers/usb/UsbContext.h"
#include "tests/drivers/usb/UsbFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class UsbContext_ : public UsbTest {};

TEST_F(UsbContext_, ListsADeviceWithItsIdentityAndSocket) {
    const EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "P24-17"), {}, 3);
    ASSERT_IN_TIME(waitForDevices(1));
    const auto info = context->devices().front();
    EXPECT_EQ(info.vendor, 0x0483);
    EXPECT_EQ(info.product, 0x5740);
    EXPECT_EQ(info.serial, "P24-17");
    EXPECT_EQ(info.maker, "Acme");
    EXPECT_EQ(info.name, "Loopback");
    EXPECT_EQ(info.path, "1-3");
    EXPECT_TRUE(info.permitted);
    EXPECT_EQ(info.obstacle(), "");
    EXPECT_EQ(info.label(), "USB device 0483:5740 at 1-3 (serial P24-17)");
}

TEST_F(UsbContext_, FindsDevicesThatWereThereBeforeIt) {
    const EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "B1"), {});
    const auto later = UsbContext::start();
    ASSERT_IN_TIME(later);
    EXPECT_IN_TIME((*later)->devices().size() == 1u);
    EXPECT_IN_TIME((*later)->find({0x1209, 1}));
}

TEST_F(UsbContext_, ADeviceThatIsNotPermittedIsListedWithTheSentenceThatFixesIt) {
    EmulatedUsbDevice device(bed, cdcAcmDevice(0x0483, 0x5740, "P24-17"), {});
    ASSERT_IN_TIME(waitForDevices(1));
    device.permit(false);
    {
        const UnprivilegedUser user(bed);
        const auto list = context->devices();
        ASSERT_EQ(list.size(), 1u);
        EXPECT_FALSE(list.front().permitted);
        EXPECT_EQ(list.front().serial, "P24-17");
        EXPECT_THAT(list.front().obstacle(), HasSubstr("./dev install-rules"));
        EXPECT_THAT(context->find({0x0483, 0x5740}), refused(ErrorCode::Io, testing::Eq(list.front().obstacle())));
        EXPECT_THAT(UsbBulkTransport::open(context, list.front(), {}), refused(ErrorCode::Io, "./dev install-rules"));
    }
    // Permission can change without a re-plug: the next look-up shows that the same device can be opened.
    device.permit(true);
    const UnprivilegedUser user(bed);
    const auto list = context->devices();
    EXPECT_TRUE(list.front().permitted);
    EXPECT_IN_TIME(UsbBulkTransport::open(context, list.front(), {}));
}

TEST_F(UsbContext_, ListsWhatIsPluggedInAndNoLongerWhatWasUnplugged) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "B1"), {}, 1, false);
    EXPECT_TRUE(context->devices().empty());
    device.plug();
    ASSERT_IN_TIME(waitForDevices(1));
    device.unplug();
    EXPECT_IN_TIME(waitForDevices(0));
}

TEST_F(UsbContext_, FindsADeviceAgainBySerialInAnotherSocket) {
    auto first = std::make_unique<EmulatedUsbDevice>(bed, vendorDevice(0x1209, 1, "B1"), UsbBehaviour{}, 1);
    const EmulatedUsbDevice other(bed, vendorDevice(0x1209, 1, "B2"), {}, 2);
    ASSERT_IN_TIME(waitForDevices(2));
    const auto before = context->find({0x1209, 1, "B1"});
    ASSERT_IN_TIME(before);
    first.reset();
    ASSERT_IN_TIME(waitForDevices(1));
    EXPECT_EQ(context->find({0x1209, 1, "B1"}).error().code, ErrorCode::NotFound);
    const EmulatedUsbDevice again(bed, vendorDevice(0x1209, 1, "B1"), {}, 4);
    ASSERT_IN_TIME(waitForDevices(2));
    const auto after = context->find(before->identity());
    ASSERT_IN_TIME(after);
    EXPECT_EQ(after->path, "1-4");
    EXPECT_NE(after->address, before->address);
}

TEST_F(UsbContext_, ANameThatFitsTwoDevicesIsRefusedWithTheirSerialNumbers) {
    const EmulatedUsbDevice first(bed, vendorDevice(0x1209, 1, "B1"), {}, 1);
    const EmulatedUsbDevice second(bed, vendorDevice(0x1209, 1, "B2"), {}, 2);
    ASSERT_IN_TIME(waitForDevices(2));
    EXPECT_THAT(context->find({0x1209, 1}),
                refused(ErrorCode::InvalidArgument, testing::AllOf(HasSubstr("B1"), HasSubstr("B2"))));
}

TEST_F(UsbContext_, ADeviceThatWasReplacedSinceTheListWasMadeIsNotOpened) {
    EmulatedUsbDevice device(bed, vendorDevice(0x1209, 1, "B1"), {});
    ASSERT_IN_TIME(waitForDevices(1));
    const auto old = context->devices().front();
    device.unplug();
    ASSERT_IN_TIME(waitForDevices(0));
    device.plug();
    ASSERT_IN_TIME(waitForDevices(1));
    EXPECT_THAT(UsbBulkTransport::open(context, old, {.function = UsbFunction::Vendor}), refused(ErrorCode::NotFound));
}

TEST_F(UsbContext_, WhatADeviceCallsItselfIsMadePrintable) {
    auto rogue = vendorDevice(0x1209, 1, "B\x1b[31m1");
    const EmulatedUsbDevice device(bed, rogue, {});
    ASSERT_IN_TIME(waitForDevices(1));
    EXPECT_EQ(context->devices().front().serial, "B?[31m1");
}

}  // namespace
}  // namespace tacto::test
