#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "drivers/sigrok/protocol/RecordPlan.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sigrok_driver;
using testing::HasSubstr;

/// Returns a DS2072A's abilities as libsigrok 0.5.2 reports them (sigrok-cli --show).
Abilities ds2072a() {
    Abilities a;
    a.driver = "rigol-ds";
    a.model = "DS2072A";
    for (const char* name : {"CH1", "CH2"}) {
        auto& channel = a.channels.emplace_back();
        channel.name = name;
        channel.voltsPerDivision = {{500, 1000000}};
        for (const std::uint64_t milli : {1U, 2U, 5U, 10U, 20U, 50U, 100U, 200U, 500U}) {
            channel.voltsPerDivision.push_back({milli, 1000});
        }
        for (const std::uint64_t volts : {1U, 2U, 5U, 10U, 20U, 50U, 100U})
            channel.voltsPerDivision.push_back({volts, 1});
        channel.probes = {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};
    }
    for (const std::uint64_t q : {1'000'000'000ULL, 1'000'000ULL, 1000ULL, 1ULL}) {
        for (const std::uint64_t p : {1U, 2U, 5U, 10U, 20U, 50U, 100U, 200U, 500U}) a.timebases.push_back({p, q});
    }
    a.timebases.erase(a.timebases.begin(), a.timebases.begin() + 2);
    a.divisions = 14;
    a.triggerSources = {"CH1", "CH2", "EXT", "AC Line"};
    a.triggerSlope = a.triggerLevel = a.triggerPosition = a.frameLimit = true;
    a.dataSources = {"Live", "Memory", "Segmented"};
    a.memory = memoryOf(a.driver, a.model);
    return a;
}

Wiring wiring(const Abilities& abilities, const std::string& parameters = "voltage=CH1&current=CH2&shunt=100") {
    return wire(ScopeUri::parse(DeviceUri::parse("sigrok:rigol-ds?" + parameters).value()).value(), abilities).value();
}

ScopeSettings planSettings(double rate, std::size_t samples) {
    ScopeSettings s;
    s.sampleRate = Hertz(rate);
    s.samples = samples;
    s.triggerLevel = 5;
    s.voltageRange = Volts(13);
    s.currentRange = Milliamps(18);
    return s;
}

TEST(RecordPlan, KnowsTheMemoryOfTheSeriesLibsigrokDrives) {
    EXPECT_EQ(memoryOf("rigol-ds", "DS2072A"), 14'000U);
    EXPECT_EQ(memoryOf("rigol-ds", "MSO2302A"), 14'000U);
    EXPECT_EQ(memoryOf("rigol-ds", "DS1054Z"), 12'000'000U);
    EXPECT_EQ(memoryOf("rigol-ds", "MSO1104Z-S"), 12'000'000U);
    EXPECT_EQ(memoryOf("rigol-ds", "DS1102E"), 1'048'576U);
    EXPECT_EQ(memoryOf("rigol-ds", "DSO1014A"), 20'480U);
    EXPECT_EQ(memoryOf("rigol-ds", "VS5022"), 0U);
    EXPECT_EQ(memoryOf("siglent-sds", "DS2072A"), 0U);
}

TEST(RecordPlan, TakesTheShortestScreenWhoseRateIsAMultiple) {
    const auto abilities = ds2072a();
    // 2 ms at 1 MHz: 200 us/div would sample at 2.5 MHz, which is no multiple of 1 MHz.
    const auto plan = accepted(planRecord(planSettings(1e6, 2000), abilities, wiring(abilities)));
    EXPECT_DOUBLE_EQ(plan.timebase.value(), 500e-6);
    EXPECT_EQ(plan.record, 7000U);
    // 250 us at 2.5 MHz: 20 us/div gives 280 us at 25 MHz.
    EXPECT_DOUBLE_EQ(planRecord(planSettings(2.5e6, 625), abilities, wiring(abilities))->timebase.value(), 20e-6);
}

TEST(RecordPlan, TheRangeIsTheNextOneUpAndTheShuntTurnsMilliampsIntoVolts) {
    const auto abilities = ds2072a();
    const auto plan = accepted(planRecord(planSettings(1e6, 2000), abilities, wiring(abilities)));
    EXPECT_EQ(plan.voltageScale, (Fraction{5, 1}));       // 13 V needs 4 divisions of 5 V
    EXPECT_EQ(plan.currentScale, (Fraction{500, 1000}));  // 18 mA * 100 ohm = 1.8 V
    EXPECT_EQ(plan.triggerSource, "CH1");
    EXPECT_DOUBLE_EQ(plan.triggerLevel_V, 5);
    auto byCurrent = planSettings(1e6, 2000);
    byCurrent.triggerOnCurrent = true;
    byCurrent.triggerLevel = 0.005;
    const auto second =
        accepted(planRecord(byCurrent, abilities, wiring(abilities, "voltage=CH1&current=CH2&shunt=100&slope=fall")));
    EXPECT_EQ(second.triggerSource, "CH2");
    EXPECT_DOUBLE_EQ(second.triggerLevel_V, -0.5);
}

TEST(RecordPlan, TheTriggerPositionMakesUpForLibsigroksScale) {
    const auto abilities = ds2072a();
    const auto plan = accepted(planRecord(planSettings(1e6, 2000), abilities, wiring(abilities)));
    // libsigrok will send -(position - 0.5) * timebase * number of time bases. A tenth before the trigger is wanted.
    const double sent = -(plan.triggerPosition - 0.5) * 500e-6 * static_cast<double>(abilities.timebases.size());
    EXPECT_NEAR(sent, 0.4 * 14 * 500e-6, 1e-9);
    EXPECT_NEAR(plan.triggerAt_s, 0.1 * 7e-3, 1e-9);
}

TEST(RecordPlan, RefusesByNameWhatTheInstrumentCannotDo) {
    const auto abilities = ds2072a();
    const auto refused = [&](ScopeSettings s, const std::vector<std::string>& named, const std::string& wired = "") {
        const auto plan = planRecord(s, abilities, wired.empty() ? wiring(abilities) : wiring(abilities, wired));
        ASSERT_FALSE(plan.has_value());
        EXPECT_EQ(plan.error().code, ErrorCode::InvalidArgument);
        for (const auto& one : named) EXPECT_THAT(plan.error().message, HasSubstr(one));
    };
    refused(planSettings(1e6, 7001), {"7001", "2 to 7000"});
    refused(planSettings(3e6, 2000), {"3000000", "1, 2, 5"});
    auto s = planSettings(1e6, 2000);
    s.voltageRange = Volts(500);
    refused(s, {"voltage range", "500 V", "400 V"});
    s = planSettings(1e6, 2000);
    s.triggerLevel = std::numeric_limits<double>::quiet_NaN();
    refused(s, {"trigger level nan"});
    s = planSettings(1e6, 2000);
    s.triggerOnCurrent = true;
    s.triggerLevel = 0.001;
    refused(s, {"no current channel"}, "voltage=CH1");
}

TEST(RecordPlan, WiringNamesTheChannelsThereAre) {
    const auto abilities = ds2072a();
    const auto refused = [&](const std::string& parameters, const std::vector<std::string>& named) {
        const auto wired =
            wire(ScopeUri::parse(DeviceUri::parse("sigrok:rigol-ds?" + parameters).value()).value(), abilities);
        ASSERT_FALSE(wired.has_value());
        for (const auto& one : named) EXPECT_THAT(wired.error().message, HasSubstr(one));
    };
    refused("voltage=CH3", {"CH3", "CH1, CH2"});
    refused("current=CH1&shunt=1", {"CH1", "voltage channel too"});
    refused("probe=3", {"probe=3", "1, 2, 5"});
    auto dumb = abilities;
    dumb.channels[0].probes.clear();
    EXPECT_THAT(wire(ScopeUri::parse(DeviceUri::parse("sigrok:x?probe=10").value()).value(), dumb).error().message,
                HasSubstr("cannot be set through this driver"));
    dumb = abilities;
    dumb.triggerLevel = false;
    EXPECT_THAT(wire(ScopeUri::parse(DeviceUri::parse("sigrok:x").value()).value(), dumb),
                test::refused(ErrorCode::Unsupported, "trigger=instrument"));
    EXPECT_TRUE(
        wire(ScopeUri::parse(DeviceUri::parse("sigrok:x?trigger=instrument").value()).value(), dumb).has_value());
}

}  // namespace
}  // namespace tacto::test
