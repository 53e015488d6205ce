#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/simulated/FaultSchedule.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {
namespace {

using sim::Fault;
using testing::HasSubstr;

const std::set<Role> kAll{Role::Sensor, Role::Stimulator, Role::Oscilloscope, Role::Massager};

struct BadUri {
    const char* uri;
    const char* names;     // text that the message must contain
    const char* accepted;  // the accepted values, as the message states them
};

class RefusedUris : public testing::TestWithParam<BadUri> {};

TEST_P(RefusedUris, SayWhichKeyWhatItWasAndWhatIsAccepted) {
    SimBench bench;
    const auto opened = bench.tryOpen(GetParam().uri, kAll);
    ASSERT_FALSE(opened.has_value()) << GetParam().uri;
    EXPECT_THAT(opened.error().message, HasSubstr(GetParam().names));
    EXPECT_THAT(opened.error().message, HasSubstr(GetParam().accepted));
    EXPECT_EQ(opened.error().message.find('\n'), std::string::npos);
    EXPECT_TRUE(bench.devices.identities().empty() || std::string(GetParam().uri).starts_with("sim:?"));
}

INSTANTIATE_TEST_SUITE_P(Uris, RefusedUris,
                         testing::Values(BadUri{"sim:finger?material=velvet", "material=velvet", "P120"},
                                         BadUri{"sim:finger?speed=fast", "speed=fast", "mm/s"},
                                         BadUri{"sim:finger?speed=-3", "speed=-3", "0 to 1000 mm/s"},
                                         BadUri{"sim:finger?force=nan", "force=nan", "0 to 20 N"},
                                         BadUri{"sim:finger?colour=red", "colour", "material, speed"},
                                         BadUri{"sim:finger?rate=4010", "rate=4010Hz", "whole multiple"},
                                         BadUri{"sim:finger?bits=12.5", "bits=12.5", "whole number"},
                                         BadUri{"sim:finger?force=1&force=2", "force", "twice"},
                                         BadUri{"sim:finger?fault=open@1s", "open", "unplug, stale"},
                                         BadUri{"sim:finger?fault=stale@soon", "stale@soon", "stale@12s"},
                                         BadUri{"sim:finger?fault=stale@5s..3s", "stale@5s..3s", "..15s"},
                                         BadUri{"sim:stimulator?mode=power", "mode=power", "voltage or current"},
                                         BadUri{"sim:stimulator?load=500 volts", "load=500 volts", "ohm"},
                                         BadUri{"sim:stimulator?gain=inf", "gain=inf", "0.1 to 10"},
                                         BadUri{"sim:stimulator?fault=melted", "melted", "stuck-on"},
                                         BadUri{"sim:oscilloscope?bits=99", "bits=99", "6 to 16"},
                                         BadUri{"sim:oscilloscope?rate=1GHz", "rate=1GHz", "1 kHz to 10 MHz"},
                                         BadUri{"sim:massager?spinup=1h", "spinup=1h", "s"},
                                         BadUri{"sim:toaster", "toaster", "sim:stimulator"},
                                         BadUri{"sim:?gain=2", "gain", "sim:stimulator?gain=2"},
                                         BadUri{"sim:?nonsense=2", "nonsense", "no single"}));

TEST(SimulatedDriver, ListsOneOfEachAndSaysThatTheyAreSimulated) {
    const auto found = makeSimulatedDriver()->list();
    ASSERT_EQ(found.size(), 4U);
    std::set<Role> roles;
    for (const auto& identity : found) {
        EXPECT_TRUE(identity.simulated);
        EXPECT_TRUE(DeviceUri::parse(identity.uri).has_value());
        roles.insert(identity.role);
        SimBench bench;
        EXPECT_TRUE(bench.tryOpen(identity.uri).has_value()) << identity.uri;
    }
    EXPECT_EQ(roles, kAll);
}

TEST(SimulatedDriver, FillsOnlyTheWantedRolesThatAreStillEmpty) {
    SimBench bench;
    bench.open("sim:stimulator?mode=current");
    const auto* first = bench.devices.stimulator.get();
    bench.open("sim:", {Role::Stimulator, Role::Sensor});
    EXPECT_EQ(bench.devices.stimulator.get(), first);
    EXPECT_TRUE(bench.devices.has(Role::Sensor));
    EXPECT_FALSE(bench.devices.has(Role::Oscilloscope));
    EXPECT_NE(bench.devices.surface, nullptr);
    EXPECT_NE(bench.devices.load, nullptr);
}

TEST(SimulatedDriver, IsAVoltageSourceOnTheDeclaredLoadUnlessToldOtherwise) {
    SimBench declared("500 ohm");
    declared.open("sim:", kAll);
    EXPECT_EQ(declared.devices.stimulator->traits().drive, Drive::Voltage);
    EXPECT_EQ(declared.circuit().load(), Load::resistor(Ohms(500)));
    SimBench told("500 ohm");
    told.open("sim:?load=2kohm&mode=current", kAll);
    EXPECT_EQ(told.circuit().load(), Load::resistor(Ohms(2000)));
    EXPECT_EQ(told.devices.stimulator->traits().drive, Drive::Current);
    EXPECT_TRUE(told.devices.load->fitLoad("200 ohm + 10 kohm || 50 nF").has_value());
    EXPECT_EQ(told.circuit().load(), benchRcLoad());
    EXPECT_FALSE(told.devices.load->fitLoad("a potato").has_value());
}

TEST(SimulatedDriver, DevicesOpenedOneByOneShareOneWorld) {
    SimBench bench;
    bench.open("sim:oscilloscope");
    bench.open("sim:stimulator");
    bench.open("sim:massager");
    bench.open("sim:finger");
    const auto world = [](auto& device) { return dynamic_cast<sim::WorldMember&>(*device).world(); };
    EXPECT_EQ(world(bench.devices.oscilloscope), world(bench.devices.stimulator));
    EXPECT_EQ(world(bench.devices.massager), world(bench.devices.sensor));
}

TEST(SimulatedDriver, RefusesASecondDeviceOfARole) {
    SimBench bench;
    bench.open("sim:stimulator");
    EXPECT_FALSE(bench.tryOpen("sim:stimulator").has_value());
}

TEST(SimulatedDriver, ReadsUnitsAndPrefixes) {
    SimBench bench;
    bench.open("sim:stimulator?rise=2us&max=60V&step=10mV&deadman=2000ms&load=1.5kohm&gap=highz");
    const auto& traits = bench.devices.stimulator->traits();
    EXPECT_DOUBLE_EQ(traits.amplitudeMax, 60);
    EXPECT_DOUBLE_EQ(traits.amplitudeStep, 0.01);
    EXPECT_DOUBLE_EQ(traits.deadMan.count(), 2);
    EXPECT_EQ(traits.gap, GapState::HighImpedance);
    EXPECT_EQ(bench.circuit().load(), Load::resistor(Ohms(1500)));
}

TEST(FaultSchedule, IsAFunctionOfTimeAlone) {
    sim::FaultSchedule schedule;
    ASSERT_TRUE(schedule.add("open@2s..3s", {Fault::Open, Fault::Short}).has_value());
    ASSERT_TRUE(schedule.add("short@2500ms", {Fault::Open, Fault::Short}).has_value());
    using namespace std::chrono_literals;
    EXPECT_FALSE(schedule.active(Fault::Open, 1999ms));
    EXPECT_TRUE(schedule.active(Fault::Open, 2s));
    EXPECT_FALSE(schedule.active(Fault::Open, 3s));
    EXPECT_EQ(schedule.since(Fault::Short, 9s), Instant(2500ms));
    EXPECT_FALSE(schedule.active(Fault::Late, 2s));
}

}  // namespace
}  // namespace tacto::test
