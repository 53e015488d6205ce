#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/sigrok/protocol/ScopeUri.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using sigrok_driver::ScopeUri;
using testing::HasSubstr;

Result<ScopeUri> parse(const std::string& text) { return ScopeUri::parse(DeviceUri::parse(text).value()); }

void expectRefused(const std::string& text, const std::vector<std::string>& named) {
    const auto parsed = parse(text);
    ASSERT_FALSE(parsed.has_value()) << text;
    EXPECT_EQ(parsed.error().code, ErrorCode::InvalidArgument);
    for (const auto& one : named) EXPECT_THAT(parsed.error().message, HasSubstr(one));
}

TEST(ScopeUri, ReadsDriverOptionsAndWiring) {
    const auto uri = accepted(parse(
        "sigrok:rigol-ds:conn=tcp-raw/192.0.2.1/5555?voltage=CH1&current=CH2&shunt=100ohm&probe=10&currentprobe=1&"
        "slope=fall&record=live&trigger=instrument"));
    EXPECT_EQ(uri.driver, "rigol-ds");
    ASSERT_EQ(uri.options.size(), 1U);
    EXPECT_EQ(uri.options[0], (std::pair<std::string, std::string>("conn", "tcp-raw/192.0.2.1/5555")));
    EXPECT_EQ(uri.voltage, "CH1");
    EXPECT_EQ(uri.current, "CH2");
    EXPECT_DOUBLE_EQ(uri.shunt.value(), 100);
    EXPECT_EQ(uri.voltageProbe, 10U);
    EXPECT_EQ(uri.currentProbe, 1U);
    EXPECT_TRUE(uri.falling && uri.live && uri.ownTrigger);
    EXPECT_EQ(uri.tcp(), std::pair(std::string("192.0.2.1"), std::string("5555")));
    EXPECT_EQ(uri.optionsVia("127.0.0.1", 99)[0].second, "tcp-raw/127.0.0.1/99");
}

TEST(ScopeUri, ADriverAloneIsEnough) {
    const auto uri = accepted(parse("sigrok:demo"));
    EXPECT_EQ(uri.driver, "demo");
    EXPECT_TRUE(uri.options.empty());
    EXPECT_FALSE(uri.tcp());
    EXPECT_EQ(parse("sigrok:hantek-dso:conn=1.5:serialcomm=9600/8n1")->options.size(), 2U);
    EXPECT_FALSE(parse("sigrok:rigol-ds:conn=usbtmc/1.5")->tcp());
}

TEST(ScopeUri, RefusesWhatItDoesNotKnowByName) {
    expectRefused("sigrok:", {"no driver"});
    expectRefused("sigrok:rigol-ds:conn", {"\"conn\"", "key=value"});
    expectRefused("sigrok:rigol-ds:=x", {"key=value"});
    expectRefused("sigrok:demo?volts=A0", {"volts", "voltage, current"});
    expectRefused("sigrok:demo?voltage=A0&voltage=A1", {"voltage", "twice"});
    expectRefused("sigrok:demo?current=A1", {"without shunt"});
    expectRefused("sigrok:demo?shunt=100", {"without current"});
    expectRefused("sigrok:demo?voltage=A1&current=A1&shunt=1", {"A1", "both"});
    expectRefused("sigrok:demo?currentprobe=10", {"currentprobe", "without current"});
    expectRefused("sigrok:demo?slope=up", {"slope=up", "rise or fall"});
    for (const char* shunt : {"0", "-5", "nan", "1e9", "x", ""}) {
        expectRefused(fmt::format("sigrok:demo?current=A1&shunt={}", shunt), {"shunt=", "1 mΩ to 1 MΩ"});
    }
    for (const char* probe : {"0", "1.5", "nan", "1e9", "ten"}) {
        expectRefused(fmt::format("sigrok:demo?probe={}", probe), {"probe=", "1 to 10000"});
    }
}

}  // namespace
}  // namespace tacto::test
