// hid show-bytes: the bytes that would be sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

TEST(HidShowBytes, PrintsTheReportOfAShippedTemplate) {
    RecordProperty("hazard", "H4");
    const Desk desk;
    const auto ran = desk.run({"hid", "show-bytes", "dualshock4", "--intensity", "0.5"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, testing::HasSubstr("05 01 00 00 80 80 00 00"));
    EXPECT_THAT(ran.out, testing::HasSubstr("05 01 00 00 00 00 00 00"));
}

TEST(HidShowBytes, ItsJsonHasTheBytesTheStopAndTheFields) {
    const Desk desk;
    const auto ran = desk.run({"hid", "show-bytes", "dualsense", "--intensity", "1", "--length", "63", "--json"});
    EXPECT_EQ(ran.code, 0);
    const auto value = jsonOf(ran);
    expectKeys(value,
               {"template", "title", "report", "length", "intensity", "bytes", "stop", "fields", "keep_alive_s",
                "shortest_write_s"},
               "hid");
    EXPECT_EQ(value["length"], 63);
    ASSERT_EQ(value["bytes"].size(), 63u);
    EXPECT_EQ(value["bytes"][0], 2);
    EXPECT_EQ(value["bytes"][3], 255);
    EXPECT_EQ(value["bytes"][4], 255);
    EXPECT_EQ(value["stop"][3], 0);
    EXPECT_EQ(value["fields"][0]["role"], "weak");
}

TEST(HidShowBytes, WhatIsWrongIsNamed) {
    const Desk desk;
    expectRefused(desk.run({"hid"}), 2, {"show-bytes"});
    expectRefused(desk.run({"hid", "buzz"}), 2, {"buzz", "show-bytes"});
    expectRefused(desk.run({"hid", "show-bytes"}), 2, {"TEMPLATE"});
    expectRefused(desk.run({"hid", "show-bytes", "dualsense"}), 2, {"intensity"});
    expectRefused(desk.run({"hid", "show-bytes", "dualsense", "--intensity", "1.5"}), 2, {"1.5", "0 to 1"});
    expectRefused(desk.run({"hid", "show-bytes", "dualsense", "--intensity", "nan"}), 2, {"nan"});
    expectRefused(desk.run({"hid", "show-bytes", "dualsense", "--intensity", "1", "--length", "50"}), 2,
                  {"50", "48 or 63"});
    expectRefused(desk.run({"hid", "show-bytes", "wheel", "--intensity", "1"}), 3, {"wheel", "dualsense"});
    expectRefused(desk.run({"hid", "show-bytes", desk.write("pad.json", "{}"), "--intensity", "1"}), 3,
                  {"pad.json", "title"});
}

}  // namespace
}  // namespace tacto::test
