// devices and protocols.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

TEST(Devices, AreListedWithUriKindNameSerialAndWhetherTheyAreSimulated) {
    const Desk desk;
    const auto ran = desk.run({"devices", "--json"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    const auto devices = jsonOf(ran);
    ASSERT_TRUE(devices.is_array());
    std::vector<std::string> simulated;
    for (const auto& device : devices) {
        expectKeys(device, {"uri", "kind", "name", "serial", "simulated"}, "a device");
        const auto uri = device["uri"].get<std::string>();
        EXPECT_EQ(device["simulated"].get<bool>(), uri.starts_with("sim:") || uri == "sigrok:demo") << uri;
        if (device["simulated"]) simulated.push_back(device["kind"]);
    }
    EXPECT_THAT(simulated, testing::IsSupersetOf({"sensor", "stimulator", "oscilloscope"}));
}

TEST(Devices, AreListedAsTextToo) {
    const Desk desk;
    const auto ran = desk.run({"devices"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, HasSubstr("sim:stimulator"));
    EXPECT_THAT(ran.out, HasSubstr("recording:"));
    EXPECT_THAT(ran.out, HasSubstr("capture:"));
    std::istringstream lines(ran.out);
    std::set<std::ptrdiff_t> columns;
    const std::regex device(R"(^  \S+ +(sensor|stimulator|oscilloscope|massager) )");
    for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        if (std::regex_search(line, found, device)) columns.insert(found.position(1));
    }
    EXPECT_EQ(columns.size(), 1U) << ran.out;
}

Json protocolNamed(const Json& all, const std::string& name) {
    for (const auto& protocol : all) {
        if (protocol["name"] == name) return protocol;
    }
    ADD_FAILURE() << "no protocol " << name << " in " << all.dump();
    return {};
}

TEST(Protocols, ShippedOnesAreListedWithWhatTheyNeedAndTheirParameters) {
    const Desk desk;
    const auto ran = desk.run({"protocols", "--json"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    const auto all = jsonOf(ran);
    ASSERT_TRUE(all.is_array());
    for (const auto& protocol : all) {
        expectKeys(protocol, {"name", "title", "needs", "parameters"}, "a protocol");
        EXPECT_EQ(protocol["kind"], protocol["name"]) << "what its results are";
    }
    const auto separability = protocolNamed(all, "separability");
    EXPECT_THAT(separability["needs"], testing::IsSupersetOf({Json("stimulator"), Json("oscilloscope")}));
    EXPECT_EQ(protocolNamed(all, "live")["needs"], Json({"sensor", "stimulator"}));
    bool hasRepeats = false;
    for (const auto& parameter : separability["parameters"]) {
        expectKeys(parameter, {"name", "label", "type", "unit", "min", "max", "value"}, "a parameter");
        if (parameter["name"] != "repeats") continue;
        hasRepeats = true;
        EXPECT_EQ(parameter["type"], "integer");
        EXPECT_EQ(parameter["value"], 25);
        EXPECT_TRUE(parameter["unit"].is_null());
    }
    EXPECT_TRUE(hasRepeats);
}

TEST(Protocols, AreListedAsTextTooWithAndWithoutUnits) {
    const Desk desk;
    const auto ran = desk.run({"protocols"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("separability: Signal separability"));
    EXPECT_THAT(ran.out, HasSubstr("repeats=25"));
    EXPECT_THAT(ran.out, testing::ContainsRegex("load=1000 +ohm +Load"));
    EXPECT_THAT(ran.out, HasSubstr("finger | direct"));
}

TEST(Protocols, OfTheUserAreFoundInTheirFolder) {
    const Desk desk;
    desk.protocol("hold.js", R"js(protocol({
  title: "Hold still",
  purpose: "Waits.",
  needs: ["stimulator"],
  parameters: { hold: { label: "Hold for", unit: "s", min: 0.5, max: 60, value: 2 } },
});
function run(p) { bench.wait(p.hold); }
)js");
    const auto all = jsonOf(desk.run({"protocols", "--json"}));
    const auto hold = protocolNamed(all, "hold");
    EXPECT_EQ(hold["title"], "Hold still");
    EXPECT_EQ(hold["parameters"][0]["unit"], "s");
    EXPECT_EQ(hold["parameters"][0]["max"], 60.0);
    protocolNamed(all, "separability");
    expectRefused(desk.run({"run", "hold", "--device", "sim:", "--set", "hold=0.1", "--out", desk.at("out")}), 2,
                  {"hold", "0.1", "0.5", "60", "s"});
    EXPECT_EQ(desk.run({"run", "hold", "--device", "sim:", "--out", desk.at("out")}).code, 0);
}

TEST(Protocols, ABrokenOneIsNamedWithItsLineAndHidesNoOther) {
    const Desk desk;
    const auto path = desk.protocol("broken.js", "protocol({ title: \"B\", purpose: \"\", needs: [] });\n\nlet = ;\n");
    const auto ran = desk.run({"protocols", "--json"});
    protocolNamed(jsonOf(ran), "live");
    EXPECT_THAT(ran.err, HasSubstr(path + ":3"));
    expectRefused(desk.run({"run", "broken", "--device", "sim:"}), 3, {path + ":3", "SyntaxError"});
}

}  // namespace
}  // namespace tacto::test
