// PulsePalDriver: which device a URI opens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/pulsepal/PulsePalDriver.h"
#include "tests/drivers/pulsepal/PulsePalLine.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class PulsePalDriverTest : public testing::Test {
protected:
    std::shared_ptr<PulsePalLine> plug(const std::string& serial, const std::string& obstacle = "") {
        auto line = std::make_shared<PulsePalLine>(clock, &clock);
        ports->plugged.push_back({{serial, fmt::format("1-{}", ports->plugged.size() + 1), obstacle}, line});
        return line;
    }
    Result<void> open(const std::string& uri) {
        devices = {};
        return makePulsePalDriver(ports)->open(DeviceUri::parse(uri).value(), {}, OpenContext{clock}, devices);
    }

    VirtualClock clock;
    const std::shared_ptr<PulsePalPorts> ports = std::make_shared<PulsePalPorts>();
    DeviceSet devices;
};

TEST_F(PulsePalDriverTest, ListsAndOpensByUri) {
    plug("A1");
    plug("");
    const auto list = makePulsePalDriver(ports)->list();
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].uri, "pulsepal:A1");
    EXPECT_EQ(list[1].uri, "pulsepal:1-2");
    EXPECT_EQ(list[0].role, Role::Stimulator);
    for (const auto& identity : list) {
        accepted(open(identity.uri + "?channel=2"));
        EXPECT_EQ(devices.stimulator->identity().uri, identity.uri + "?channel=2");
        // The socket must not serve as serial number: a calibration would then apply to any device in that socket (H4).
        EXPECT_EQ(devices.stimulator->identity().serial, identity.serial);
    }
    EXPECT_FALSE(makePulsePalDriver(ports)->runsOnVirtualClock());
}

TEST_F(PulsePalDriverTest, TwoWithTheSameSerialNumberAreToldApartByTheirSockets) {
    RecordProperty("hazard", "H4");
    plug("A1");
    const auto second = plug("A1");
    const auto list = makePulsePalDriver(ports)->list();
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].uri, "pulsepal:1-1");
    EXPECT_EQ(list[1].uri, "pulsepal:1-2");
    for (const auto* both : {"pulsepal:", "pulsepal:A1"}) {
        EXPECT_THAT(open(both), refused(ErrorCode::InvalidArgument, "pulsepal:1-1 or pulsepal:1-2"));
    }
    ASSERT_TRUE(open("pulsepal:1-2"));
    second->unplug();
    EXPECT_FALSE(devices.stimulator->status()) << "another one was opened";
}

TEST_F(PulsePalDriverTest, WhatCannotBeOpenedIsRefusedByName) {
    EXPECT_THAT(open("pulsepal:"), refused(ErrorCode::NotFound, "2341:003e"));
    plug("A1");
    plug("A2", "A2 is there, but this user may not open it: run \"./dev install-rules\" once.");
    EXPECT_THAT(open("pulsepal:"), refused(ErrorCode::InvalidArgument, AllOf(HasSubstr("A1"), HasSubstr("A2"))));
    EXPECT_THAT(open("pulsepal:A2"), refused(ErrorCode::Io, "./dev install-rules"));
    EXPECT_THAT(makePulsePalDriver(ports)->list().at(1).obstacle, HasSubstr("./dev install-rules"));
    EXPECT_THAT(open("pulsepal:A3"), refused(ErrorCode::NotFound, "A3"));
    EXPECT_THAT(open("pulsepal:A1?channel=5"), refused(ErrorCode::InvalidArgument, "1 to 4"));
    EXPECT_THAT(open("pulsepal:A1?channel=1.5"), refused(ErrorCode::InvalidArgument, "1 to 4"));
    EXPECT_THAT(open("pulsepal:A1?output=1"),
                refused(ErrorCode::InvalidArgument, AllOf(HasSubstr("output"), HasSubstr("channel"))));
    ASSERT_TRUE(open("pulsepal:A1"));
    EXPECT_THAT(
        makePulsePalDriver(ports)->open(DeviceUri::parse("pulsepal:A1").value(), {}, OpenContext{clock}, devices),
        refusedSaying("open already"));
}

TEST_F(PulsePalDriverTest, ThePluggedInDeviceOfTheSameSerialNumberIsFoundInAnotherSocket) {
    RecordProperty("hazard", "H4");
    const auto line = plug("A1");
    plug("A2");
    ASSERT_TRUE(open("pulsepal:A1"));
    line->unplug();
    EXPECT_FALSE(devices.stimulator->status());
    line->plug();
    ports->plugged.front().first.place = "1-7";
    EXPECT_TRUE(devices.stimulator->status());
}

}  // namespace
}  // namespace tacto::test
