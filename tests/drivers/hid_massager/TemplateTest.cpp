// MassagerTemplate: the shipped files, byte by byte, and templates that are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/hid_massager/MassagerTemplate.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using hid::parseMassagerTemplate;
using testing::AllOf;
using testing::HasSubstr;

hid::MassagerTemplate shipped(std::string_view key) {
    auto loaded = hid::loadMassagerTemplate(sourceDir() / "resources" / "massagers" / (std::string(key) + ".json"));
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded.value_or(hid::MassagerTemplate{});
}

Bytes padded(Bytes head, std::size_t length) {
    head.resize(length);
    return head;
}

TEST(MassagerTemplate, DualSenseGetsReport2WithRightAndLeft) {
    RecordProperty("hazard", "H4");
    const auto pad = shipped("dualsense");
    ASSERT_NE(pad.deviceOf(0x054C, 0x0CE6), nullptr);
    ASSERT_NE(pad.deviceOf(0x054C, 0x0DF2), nullptr);
    for (const std::size_t length : {48u, 63u}) {
        const auto reports = accepted(pad.reportsFor(hid::parseHidDescriptor(outputDescriptor(2, length)).value()));
        EXPECT_EQ(hid::startBytes(reports, 1).value(), padded({0x02, 0x03, 0x00, 0xFF, 0xFF}, length));
        EXPECT_EQ(hid::startBytes(reports, 0.25).value(), padded({0x02, 0x03, 0x00, 0x40, 0x40}, length));
        EXPECT_EQ(reports.stop, padded({0x02, 0x03}, length));
        EXPECT_EQ(reports.fields[0].role, hid::VibrationRole::Weak);
        EXPECT_EQ(reports.fields[1].role, hid::VibrationRole::Strong);
    }
}

TEST(MassagerTemplate, DualShock4GetsReport5) {
    RecordProperty("hazard", "H4");
    const auto pad = shipped("dualshock4");
    ASSERT_NE(pad.deviceOf(0x054C, 0x05C4), nullptr);
    ASSERT_NE(pad.deviceOf(0x054C, 0x09CC), nullptr);
    const auto reports = accepted(pad.reportsFor(hid::parseHidDescriptor(outputDescriptor(5, 32)).value()));
    EXPECT_EQ(hid::startBytes(reports, 1).value(), padded({0x05, 0x01, 0x00, 0x00, 0xFF, 0xFF}, 32));
    EXPECT_EQ(reports.stop, padded({0x05, 0x01}, 32));
}

TEST(MassagerTemplate, EveryShippedFileIsReadAndNoTwoDescribeOneDevice) {
    const auto all = accepted(hid::loadMassagerTemplates(sourceDir() / "resources" / "massagers"));
    EXPECT_GE(all.size(), 2u);
}

TEST(MassagerTemplate, ADeviceWhoseDescriptorSaysOtherwiseIsRefused) {
    RecordProperty("hazard", "H4");
    const auto pad = shipped("dualsense");
    EXPECT_THAT(pad.reportsFor(hid::parseHidDescriptor(outputDescriptor(2, 64)).value()),
                refusedSaying(AllOf(HasSubstr("64 bytes"), HasSubstr("48 or 63"))));
    EXPECT_THAT(pad.reportsFor(hid::parseHidDescriptor(outputDescriptor(0x31, 48)).value()),
                refusedSaying("no output report 2"));
}

/// Returns a valid template with one piece of its text replaced.
std::string with(std::string_view from = "", std::string_view to = "") {
    std::string text = R"({"title": "Pad", "source": "test", "devices": [{"vendor": "1234", "product": "abCD",
        "name": "Pad"}], "usage": {"page": "0001", "id": "0005"}, "report": {"number": 5, "lengths": [8],
        "constants": [{"byte": 1, "hex": "01 0a"}]}, "fields": [{"role": "intensity", "byte": 4, "bits": 16,
        "endian": "big", "min": 0, "max": 1000}], "stop": {"hex": "05 FF"}, "keep_alive_s": 0.5,
        "shortest_write_s": 0.01})";
    if (from.empty()) return text;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return text;
}

TEST(MassagerTemplate, EveryKeyOfTheSchemaHasItsEffect) {
    const auto pad = accepted(parseMassagerTemplate(with(), "some/pad.json"));
    EXPECT_EQ(pad.key, "pad");
    EXPECT_NE(pad.deviceOf(0x1234, 0xABCD), nullptr);
    EXPECT_EQ(pad.usage, 0x00010005u);
    EXPECT_EQ(pad.keepAlive, Seconds(0.5));
    EXPECT_EQ(pad.shortestWrite, Seconds(0.01));
    const auto reports = accepted(pad.reports(8));
    EXPECT_EQ(hid::startBytes(reports, 1).value(), (Bytes{5, 1, 10, 0, 0x03, 0xE8, 0, 0}));
    EXPECT_EQ(reports.stop, (Bytes{5, 0xFF, 0, 0, 0, 0, 0, 0}));
    EXPECT_FALSE(pad.reports(9));
}

TEST(MassagerTemplate, WhatIsWrongIsRefusedWithItsPlaceAndWhatIsAccepted) {
    RecordProperty("hazard", "H10");
    const auto refusal = [](const std::string& text) {
        const auto read = parseMassagerTemplate(text, "pad.json");
        EXPECT_FALSE(read) << text;
        if (read) return std::string();
        EXPECT_EQ(read.error().code, ErrorCode::ParseError);
        EXPECT_THAT(read.error().message, testing::StartsWith("pad.json: "));
        return read.error().message;
    };
    EXPECT_THAT(refusal("{"), HasSubstr("not JSON"));
    EXPECT_THAT(refusal("[]"), HasSubstr("object is expected"));
    EXPECT_THAT(refusal(std::string(70'000, ' ')), HasSubstr("at most 65536"));
    EXPECT_THAT(refusal(with("\"title\": \"Pad\", ", "")), HasSubstr("\"title\" is missing; a text"));
    EXPECT_THAT(refusal(with("\"source\"", "\"sauce\"")), AllOf(HasSubstr("sauce"), HasSubstr("source")));
    EXPECT_THAT(refusal(with("\"1234\"", "\"12345\"")), AllOf(HasSubstr("devices[0]"), HasSubstr("four hexadecimal")));
    EXPECT_THAT(refusal(with("\"abCD\"", "\"abCg\"")), HasSubstr("abCg"));
    EXPECT_THAT(refusal(with("\"number\": 5", "\"number\": 256")), HasSubstr("0 to 255"));
    EXPECT_THAT(refusal(with("\"number\": 5", "\"number\": 1.5")), HasSubstr("whole number"));
    EXPECT_THAT(refusal(with("[8]", "[]")), HasSubstr("list of 1 to 64"));
    EXPECT_THAT(refusal(with("[8]", "[1]")), HasSubstr("2 to 4096"));
    EXPECT_THAT(refusal(with("[8]", "[8, 3]")), HasSubstr("behind the report"));
    EXPECT_THAT(refusal(with("\"01 0a\"", "\"01 0a \"")), HasSubstr("02 03 FF"));
    EXPECT_THAT(refusal(with("\"01 0a\"", "\"010a\"")), HasSubstr("010a"));
    EXPECT_THAT(refusal(with("\"byte\": 1", "\"byte\": 0")), HasSubstr("constants[0]"));
    EXPECT_THAT(refusal(with("\"byte\": 1", "\"byte\": 7")), HasSubstr("constant at byte 7"));
    EXPECT_THAT(refusal(with("\"intensity\"", "\"loud\"")), AllOf(HasSubstr("fields[0]"), HasSubstr("weak")));
    EXPECT_THAT(refusal(with("\"big\"", "\"middle\"")), HasSubstr("little or big"));
    EXPECT_THAT(refusal(with("\"max\": 1000", "\"max\": 65536")), HasSubstr("65535"));
    EXPECT_THAT(refusal(with(", \"max\": 1000", "")), HasSubstr("\"max\" is missing; a whole number"));
    EXPECT_THAT(refusal(with("\"max\": 1000", "\"max\": 18446744073709551615")), HasSubstr("18446744073709551615"));
    EXPECT_THAT(refusal(with("\"05 FF\"", "\"06 FF\"")), HasSubstr("must have the same number"));
    EXPECT_THAT(refusal(with("{\"hex\": \"05 FF\"}", "{}")), HasSubstr("stop"));
    EXPECT_THAT(refusal(with("{\"hex\": \"05 FF\"}", "{\"fields\": 1}")), HasSubstr("0 to 0"));
    EXPECT_THAT(refusal(with("0.5", "-0.5")), HasSubstr("keep_alive_s"));
    EXPECT_THAT(refusal(with("0.01", "0.2")), HasSubstr("0.04"));
    EXPECT_THAT(refusal(with("0.01", "\"fast\"")), HasSubstr("a number of 0 s or more"));
}

TEST(MassagerTemplate, AFileThatIsNotThereAndTwoForOneDeviceAreNamed) {
    EXPECT_THAT(hid::loadMassagerTemplate("/no/such/pad.json"), refused(ErrorCode::NotFound, "/no/such/pad.json"));
    const ScratchDir folder;
    folder.write("a.json", with());
    folder.write("b.json", with());
    EXPECT_THAT(hid::loadMassagerTemplates(folder.path()),
                refusedSaying(AllOf(HasSubstr("b.json"), HasSubstr("1234:abcd"), HasSubstr("a too"))));
}

}  // namespace
}  // namespace tacto::test
