// HidDriver: which device a URI names, and which reports it gets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/hid_massager/HidDriver.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class HidDriverTest : public testing::Test {
protected:
    std::shared_ptr<FakeHidDevice> plug(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                        Bytes descriptor, hid::Usage usage = 0x00010005) {
        const auto path = fmt::format("/dev/hidraw{}", hidraw->plugged.size());
        hidraw->plugged.push_back(std::make_shared<FakeHidDevice>(
            clock, hid::HidDeviceInfo{vendor, product, std::move(serial), "Pad", path, usage, true},
            std::move(descriptor)));
        return hidraw->plugged.back();
    }
    std::unique_ptr<Driver> driver() const {
        return hid::makeHidDriver({hidraw, sourceDir() / "resources" / "massagers", {}});
    }
    Result<void> open(const std::string& uri) {
        devices = {};
        auto opened = driver()->open(DeviceUri::parse(uri).value(), {}, OpenContext{clock}, devices);
        EXPECT_EQ(opened.has_value(), devices.massager != nullptr);
        return opened;
    }

    const SteadyClock clock;
    const std::shared_ptr<FakeHidBackend> hidraw = std::make_shared<FakeHidBackend>();
    DeviceSet devices;
};

TEST_F(HidDriverTest, ADualSenseIsListedAndOpenedAndGetsItsOwnReport) {
    const auto pad = plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 48));
    plug(0x046D, 0xC077, "", outputDescriptor(1, 8), 0x00010002);  // a mouse is not a massager
    const auto list = driver()->list();
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].uri, "hid:054c:0ce6?serial=A1");
    EXPECT_EQ(list[0].name, "DualSense");
    EXPECT_EQ(list[0].role, Role::Massager);
    EXPECT_FALSE(list[0].simulated);
    ASSERT_IN_TIME(open(list[0].uri));
    ASSERT_NE(devices.massager, nullptr);
    EXPECT_EQ(devices.massager->identity().uri, list[0].uri);
    SafetyGate gate(clock);
    auto burst = gate.approve(VibrationBurst{1, Seconds(0.5)});
    ASSERT_IN_TIME(devices.massager->vibrate(std::move(*burst)));
    Bytes expected{2, 3, 0, 0xFF, 0xFF};
    expected.resize(48);
    EXPECT_EQ(pad->last(), expected);
    devices = {};
    expected[3] = expected[4] = 0;
    EXPECT_EQ(pad->last(), expected);
}

TEST_F(HidDriverTest, ADeviceWithAHapticsPageNeedsNoTemplate) {
    RecordProperty("hazard", "H4");
    const auto pad = plug(0x1234, 0x5678, "H", hapticDescriptor(), 0x000E0001);
    pad->setFeature({2, 0x03, 0x10, 0x04, 0x10, 50, 0, 0, 0});  // ordinal 3 is a click of 50 ms
    ASSERT_EQ(driver()->list().size(), 1u);
    const auto opened = open("hid:");
    ASSERT_IN_TIME(opened);
    SafetyGate gate(clock);
    auto burst = gate.approve(VibrationBurst{1, Seconds(0.5)});
    ASSERT_IN_TIME(devices.massager->vibrate(std::move(*burst)));
    EXPECT_EQ(pad->last(), (Bytes{1, 0xFF, 0xFF, 3, 9}));  // plays 10 times, then ends by itself
    devices.massager->forceOff();
    EXPECT_IN_TIME(pad->waitForLast({1, 0, 0, 2, 0}));
}

TEST_F(HidDriverTest, OneThatMayNotBeOpenedIsListedWithTheSentenceThatHelps) {
    plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 48))->setPermitted(false);
    const auto list = driver()->list();
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].name, "DualSense");
    EXPECT_THAT(list[0].obstacle, AllOf(HasSubstr("./dev install-rules"), HasSubstr("hidraw0")));
    EXPECT_THAT(open("hid:"), refused(ErrorCode::Io, "./dev install-rules"));
}

TEST_F(HidDriverTest, OfTwoTheSerialNumberChooses) {
    RecordProperty("hazard", "H4");
    plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 48));
    const auto second = plug(0x054C, 0x0CE6, "A2", outputDescriptor(2, 48));
    EXPECT_THAT(open("hid:054c:0ce6"), refused(ErrorCode::InvalidArgument, AllOf(HasSubstr("A1"), HasSubstr("A2"))));
    ASSERT_IN_TIME(open("hid:054c:0ce6?serial=A2"));
    EXPECT_EQ(second->openNow(), 1);
    EXPECT_THAT(open("hid:054c:0ce6?serial=A3"), refused(ErrorCode::NotFound, "A3"));
}

TEST_F(HidDriverTest, EachOfTwoIsListedWithAnAddressThatOpensItAndNoOther) {
    RecordProperty("hazard", "H4");
    plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 48));
    plug(0x054C, 0x0CE6, "A2", outputDescriptor(2, 48));
    plug(0x054C, 0x05C4, "", outputDescriptor(5, 32));  // the second hardware version has no serial number
    plug(0x054C, 0x05C4, "", outputDescriptor(5, 32));
    plug(0x054C, 0x0DF2, "same", outputDescriptor(2, 63));
    plug(0x054C, 0x0DF2, "same", outputDescriptor(2, 63));
    const auto list = driver()->list();
    std::vector<std::string> uris;
    for (const auto& one : list) uris.push_back(one.uri);
    EXPECT_THAT(uris, testing::ElementsAre("hid:054c:0ce6?serial=A1", "hid:054c:0ce6?serial=A2",
                                           "hid:054c:05c4?at=/dev/hidraw2", "hid:054c:05c4?at=/dev/hidraw3",
                                           "hid:054c:0df2?serial=same&at=/dev/hidraw4",
                                           "hid:054c:0df2?serial=same&at=/dev/hidraw5"));
    for (std::size_t i = 0; i < uris.size(); ++i) {
        ASSERT_IN_TIME(open(uris[i])) << uris[i];
        EXPECT_EQ(devices.massager->identity().uri, uris[i]);
        for (std::size_t other = 0; other < uris.size(); ++other) {
            EXPECT_EQ(hidraw->plugged[other]->openNow(), other == i ? 1 : 0) << uris[i];
        }
    }
    // The error message offers these addresses as a choice.
    for (const auto& uri : uris) EXPECT_THAT(open("hid:"), refused(ErrorCode::InvalidArgument, uri));
    EXPECT_THAT(open("hid:054c:05c4"), refused(ErrorCode::InvalidArgument, uris[2] + " or " + uris[3]));
    EXPECT_THAT(open("hid:054c:05c4?at=/dev/hidraw9"), refused(ErrorCode::NotFound, "hidraw9"));
}

TEST_F(HidDriverTest, ADeviceThatItsTemplateDoesNotFitIsRefused) {
    RecordProperty("hazard", "H4");
    const auto pad = plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 60));
    EXPECT_THAT(open("hid:"), refused(ErrorCode::Unsupported, AllOf(HasSubstr("60 bytes"), HasSubstr("48 or 63"))));
    pad->setDescriptor({0x26});
    EXPECT_THAT(open("hid:"), refused(ErrorCode::ParseError, "cut off"));
    EXPECT_EQ(pad->openings(), 0);
}

TEST_F(HidDriverTest, AnotherDeviceInItsPlaceIsNotTakenForIt) {
    RecordProperty("hazard", "H4");
    const auto pad = plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 48));
    ASSERT_IN_TIME(open("hid:"));
    SafetyGate gate(clock);
    pad->unplug();
    const auto burst = [&] {
        return devices.massager->vibrate(std::move(*gate.approve(VibrationBurst{1, Seconds(0.1)})));
    };
    EXPECT_FALSE(burst());
    pad->setDescriptor(outputDescriptor(2, 63));
    pad->plug();
    EXPECT_FALSE(burst());
    pad->setDescriptor(outputDescriptor(2, 48));
    EXPECT_IN_TIME(burst());
}

TEST_F(HidDriverTest, ATemplateOfOnesOwnServesADeviceThatNoOtherDescribes) {
    const auto pad = plug(0x1111, 0x2222, "X", outputDescriptor(5, 32), 0);
    EXPECT_TRUE(driver()->list().empty());
    EXPECT_THAT(open("hid:1111:2222?template=wheel"),
                refused(ErrorCode::NotFound, AllOf(HasSubstr("wheel"), HasSubstr("dualsense"))));
    ASSERT_IN_TIME(open("hid:1111:2222?template=dualshock4"));
    EXPECT_EQ(pad->openNow(), 1);
    const auto file = (sourceDir() / "resources" / "massagers" / "dualshock4.json").string();
    ASSERT_IN_TIME(open("hid:1111:2222?template=" + file));
}

TEST_F(HidDriverTest, WhatIsNoUriOfOursIsRefusedByName) {
    EXPECT_THAT(open("hid:dualsense"),
                refused(ErrorCode::InvalidArgument, AllOf(HasSubstr("dualsense"), HasSubstr("054c:0ce6"))));
    EXPECT_THAT(open("hid:054c:0ce6:9"), refused(ErrorCode::InvalidArgument, "four hexadecimal"));
    EXPECT_THAT(open("hid:?motor=left"),
                refused(ErrorCode::InvalidArgument, AllOf(HasSubstr("motor"), HasSubstr("serial"))));
    plug(0x054C, 0x0CE6, "A1", outputDescriptor(2, 48));
    ASSERT_IN_TIME(open("hid:"));
    EXPECT_THAT(driver()->open(DeviceUri::parse("hid:").value(), {}, OpenContext{clock}, devices),
                refusedSaying("open already"));
}

}  // namespace
}  // namespace tacto::test
