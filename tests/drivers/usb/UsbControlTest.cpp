#include <atomic>
#include <gmock/gmock.h>

#include "drivers/usb/UsbControl.h"
#include "tests/drivers/usb/UsbFixture.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

constexpr UsbRequest kSpeed{.type = 0x43, .request = 1};

UsbSetup speed(std::uint16_t value) { return {0x43, 1, value, 0, 0}; }

class UsbControlTest : public UsbTest {
protected:
    [[nodiscard]] std::unique_ptr<UsbControl> openControl() const {
        if (!waitForDevices(1)) return nullptr;
        auto opened = UsbControl::open(context, context->devices().front(), kSpeed);
        EXPECT_IN_TIME(opened);
        return opened ? std::move(*opened) : nullptr;
    }
    UsbDescription vibrator() const {
        auto description = vendorDevice(0x0B49, 0x064F, "");
        description.kernelInterfaces = {0};
        description.kernelDriver = "trancevibrator";
        return description;
    }
};

TEST_F(UsbControlTest, SendsTheVibratorsRequestWithTheValue) {
    const EmulatedUsbDevice device(bed, vibrator(), {});
    auto control = openControl();
    ASSERT_IN_TIME(control);
    EXPECT_FALSE(device.kernelDriverBound());
    ASSERT_IN_TIME(control->send(0, kLong));
    ASSERT_IN_TIME(control->send(255, kLong));
    EXPECT_THAT(device.requests(), ElementsAre(speed(0), speed(255)));
    control.reset();
    EXPECT_TRUE(device.kernelDriverBound());
}

TEST_F(UsbControlTest, AnUrgentValueIsBehindTheOneInFlightAndAheadOfTheNext) {
    RecordProperty("hazard", "H2");
    EmulatedUsbDevice device(bed, vibrator(), {});
    const auto control = openControl();
    ASSERT_IN_TIME(control);
    device.hold(0, true);
    auto sending = std::async(std::launch::async, [&] { return control->send(200, kLong); });
    ASSERT_IN_TIME(device.waitForWaiting(0, 1));
    control->sendUrgent(0);
    control->sendUrgent(0);
    ASSERT_IN_TIME(device.waitForWaiting(0, 2));
    device.hold(0, false);
    ASSERT_IN_TIME(sending.get());
    ASSERT_IN_TIME(control->send(7, kLong));
    EXPECT_THAT(device.requests(), ElementsAre(speed(200), speed(0), speed(0), speed(7)));
    EXPECT_EQ(control->urgentDelivered(), 2u);
}

TEST_F(UsbControlTest, ARefusalATimeOutAndAnUnplugAreToldApart) {
    std::atomic<bool> refuse = true;
    EmulatedUsbDevice device(bed, vibrator(), {.onRequest = [&](const UsbSetup&, auto) -> std::optional<UsbBytes> {
                                 if (refuse) return std::nullopt;
                                 return UsbBytes{};
                             }});
    const auto control = openControl();
    ASSERT_IN_TIME(control);
    EXPECT_CODE_IN_TIME(control->send(1, kLong).error().code, ErrorCode::Device);
    refuse = false;
    EXPECT_IN_TIME(control->send(1, kLong));
    device.hold(0, true);
    EXPECT_EQ(control->send(2, kShort).error().code, ErrorCode::Timeout);
    auto sending = std::async(std::launch::async, [&] { return control->send(3, kLong); });
    ASSERT_IN_TIME(device.waitForWaiting(0, 1));
    device.unplug();
    const auto sent = sending.get();
    ASSERT_FALSE(sent);
    EXPECT_CODE_IN_TIME(sent.error().code, ErrorCode::Device);
}

TEST_F(UsbControlTest, ARequestForInputIsRefused) {
    const EmulatedUsbDevice device(bed, vibrator(), {});
    ASSERT_IN_TIME(waitForDevices(1));
    EXPECT_THAT(UsbControl::open(context, context->devices().front(), {.type = 0xC3, .request = 1}),
                refused(ErrorCode::InvalidArgument));
}

}  // namespace
}  // namespace tacto::test
