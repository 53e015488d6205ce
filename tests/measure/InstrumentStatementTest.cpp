// The stated accuracy of an oscilloscope, its sources, and what is not stated: unknown is never zero (hazard H9).
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/measure/CaptureDescription.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {
namespace {

Capture blank() {
    Capture capture;
    capture.rate_hz = 1e6;
    capture.channels = {{.name = "voltage", .unit = "V", .samples = {0, 1}, .low = -50, .high = 50, .lsb = 0.4},
                        {.name = "current", .unit = "A", .samples = {0, 1}, .low = -0.1, .high = 0.1, .lsb = 1e-3}};
    return capture;
}

TEST(InstrumentStatement, ACaptureOfAnInstrumentThatStatesNothingSaysWhatIsMissing) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(notStated(blank()),
              (std::vector<std::string>{"the gain of voltage", "the probe of voltage", "the gain of current",
                                        "the shunt of current", "the time base"}));
    auto coarse = blank();
    coarse.channels[0].lsb = 0;
    EXPECT_NE(notStatedText(coarse).find("the resolution of voltage"), std::string::npos);
}

TEST(InstrumentStatement, LaterSourcesWinFigureByFigureAndEachKeepsItsName) {
    InstrumentStatement sheet, address;
    sheet.voltage.gain = sheet.current.gain = {0.03, "data sheet"};
    sheet.timeBase = {25e-6, "data sheet"};
    address.voltage.gain = {0.01, "address"};
    address.voltage.probe = {0, "address"};
    address.current.probe = {0.001, "address"};
    auto capture = blank();
    applyStatement(capture, merged(sheet, address));
    EXPECT_DOUBLE_EQ(capture.channels[0].gainTolerance, 0.01);
    EXPECT_DOUBLE_EQ(capture.channels[1].gainTolerance, 0.03);
    EXPECT_DOUBLE_EQ(capture.channels[0].probeTolerance, 0);
    EXPECT_DOUBLE_EQ(capture.timeBaseTolerance, 25e-6);
    EXPECT_TRUE(notStated(capture).empty());
    EXPECT_TRUE(std::isnan(capture.stampTolerance_s)) << "it was not stated";
    EXPECT_EQ(capture.channels[1].statedBy, "gain: data sheet; shunt: address");
}

TEST(InstrumentStatement, AGainOfFullScaleCountsByTheRangeAndIsUnknownWithoutOne) {
    RecordProperty("hazard", "H9");
    InstrumentStatement sheet;
    sheet.voltage.gain = {0, "data sheet"};
    sheet.voltage.linearity = {0.02, "data sheet"};
    auto capture = blank();
    applyStatement(capture, sheet);
    EXPECT_DOUBLE_EQ(capture.channels[0].linearityTolerance, 2) << "2 % of 100 V";
    auto open = blank();
    open.channels[0].low = open.channels[0].high = 0;
    applyStatement(open, sheet);
    EXPECT_TRUE(std::isnan(open.channels[0].gainTolerance));
    // A certificate of the gain replaces both.
    InstrumentStatement certificate;
    certificate.voltage.gain = {0.002, "certificate"};
    auto certified = blank();
    applyStatement(certified, merged(sheet, certificate));
    EXPECT_DOUBLE_EQ(certified.channels[0].gainTolerance, 0.002);
    EXPECT_DOUBLE_EQ(certified.channels[0].linearityTolerance, 0);
}

TEST(CaptureDescription, TheHeaderOfAFileCarriesWhatWasStatedAndLeavesTheRestUnknown) {
    RecordProperty("hazard", "H9");
    auto capture = blank();
    capture.simulated = true;
    capture.trigger_s = 1.25;
    capture.timeBaseTolerance = 1e-5;
    capture.channels[0].gainTolerance = 0.005;
    capture.channels[0].statedBy = "the twin";
    const auto text = "time_s,voltage_v,current_a\n" + captureHeader(capture) + "0,0,0\n";
    const auto header = headerIn(text);
    ASSERT_TRUE(header);
    auto read = blank();
    read.simulated = false;
    takeHeader(read, *header);
    EXPECT_TRUE(read.simulated);
    EXPECT_EQ(read.trigger_s, 1.25);
    EXPECT_EQ(read.channels[0].gainTolerance, 0.005);
    EXPECT_EQ(read.channels[0].statedBy, "the twin");
    EXPECT_EQ(read.channels[0].samples.size(), 2U) << "the samples are the file's own";
    EXPECT_TRUE(std::isnan(read.channels[1].gainTolerance));
    EXPECT_TRUE(std::isnan(read.stampTolerance_s));
}

TEST(CaptureDescription, AHeaderThatIsNoneOrLiesInShapeIsNotBelieved) {
    RecordProperty("hazard", "H10");
    EXPECT_FALSE(headerIn("time_s,voltage_v\n0,1\n"));
    EXPECT_FALSE(headerIn("time_s,voltage_v\n# tactoscope {\"channels\": 1}\n"));
    EXPECT_FALSE(headerIn("time_s,voltage_v\n# tactoscope {broken\n"));
    EXPECT_FALSE(headerIn("x # tactoscope {\"channels\": []}\n")) << "not at the beginning of a line";
    const auto negative = headerIn("# tactoscope {\"channels\": [{\"gain_tolerance\": -1, \"stated_by\": \"x\"}]}\n");
    ASSERT_TRUE(negative);
    EXPECT_TRUE(std::isnan(negative->channels[0].gainTolerance));
    auto other = blank();
    takeHeader(other, *negative);
    EXPECT_EQ(other.channels[0].lsb, 0.4) << "of another number of channels: not this file's";
}

TEST(CaptureDescription, OfASessionOfBeforeZeroIsNotStated) {
    RecordProperty("hazard", "H9");
    const auto old = captureDescribed({{"channels", {{{"name", "voltage"}, {"unit", "V"}, {"gain_tolerance", 0}}}}});
    ASSERT_TRUE(old);
    EXPECT_TRUE(std::isnan(old->channels[0].gainTolerance));
    EXPECT_TRUE(std::isnan(old->timeBaseTolerance));
}

}  // namespace
}  // namespace tacto

// The figures in a profile, the instruments it belongs to, and what is refused (hazard H9: no figure without a source,
// unknown is not zero).
namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr const char* kSource =
    R"("source": "a sheet, page 3", "address": "https://example.org/3", "confidence": "high")";
const std::string kGain = fmt::format(R"({{"pct": 2, "of": "full scale", {}}})", kSource);
const std::string kTimeBase = fmt::format(R"({{"ppm": 25, "ppm_per_year": 5, {}}})", kSource);

std::string profileText(const std::string& gain = kGain, const std::string& timeBase = kTimeBase,
                        const std::string& models = R"(["DS2072", "DS21*"])") {
    return fmt::format(
        R"({{"id": "x", "title": "Rigol DS2000", "makers": ["Rigol"], "models": {}, "gain": {}, "time_base": {}}})",
        models, gain, timeBase);
}
InstrumentProfile profileOf(const std::string& text) {
    auto profile = parseInstrumentProfile(text, "x.json");
    EXPECT_TRUE(profile) << profile.error().message;
    return profile.value_or(InstrumentProfile{});
}
std::string refusalOf(const std::string& text) {
    const auto profile = parseInstrumentProfile(text, "x.json");
    return profile ? "accepted" : profile.error().message;
}
std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(InstrumentProfile, MatchesItsMakersModelsAndNoOthers) {
    const auto profile = profileOf(profileText());
    for (const char* name : {"Rigol DS2072", "RIGOL ds2072", "Rigol DS2102", "Rigol DS21", "Rigol DS2102A"}) {
        EXPECT_TRUE(profile.matches(name)) << name;
    }
    for (const char* name : {"Rigol DS2072A", "Rigol DS2202", "Rigol DS1054Z", "Agilent DS2072", "Rigol", "Rigol ",
                             "DS2072", "RigolDS2072", "", "a Rigol DS2072", "Rigol  DS2072"}) {
        EXPECT_FALSE(profile.matches(name)) << name;
    }
}

TEST(InstrumentProfile, AGainOfFullScaleLeavesNothingOfTheReading) {
    const auto statement = profileOf(profileText()).statement();
    for (const auto* channel : {&statement.voltage, &statement.current}) {
        EXPECT_DOUBLE_EQ(channel->gain.value, 0);
        EXPECT_DOUBLE_EQ(channel->linearity.value, 0.02);
        EXPECT_EQ(channel->linearity.by, "data sheet of the Rigol DS2000");
        EXPECT_FALSE(channel->probe.known()) << "no sheet of an oscilloscope knows the probe";
        EXPECT_FALSE(channel->offset.known());
    }
    EXPECT_FALSE(statement.stamp_s.known());
}

TEST(InstrumentProfile, AGainOfTheReadingIsOne) {
    const auto statement = profileOf(profileText(with(kGain, "full scale", "reading"))).statement();
    EXPECT_DOUBLE_EQ(statement.voltage.gain.value, 0.02);
    EXPECT_FALSE(statement.voltage.linearity.known());
}

TEST(InstrumentProfile, TheTimeBaseHasAgedTenYears) {
    EXPECT_DOUBLE_EQ(profileOf(profileText()).statement().timeBase.value, 75e-6);
    const auto steady = with(kTimeBase, R"("ppm_per_year": 5, )", "");
    EXPECT_DOUBLE_EQ(profileOf(profileText(kGain, steady)).statement().timeBase.value, 25e-6);
}

TEST(InstrumentProfile, WhatIsNullStaysUnknown) {
    const auto none = profileOf(profileText("null", "null")).statement();
    EXPECT_FALSE(none.voltage.gain.known());
    EXPECT_FALSE(none.voltage.linearity.known());
    EXPECT_FALSE(none.timeBase.known());
}

TEST(InstrumentProfile, TheAddressOverridesTheSheetFigureByFigure) {
    InstrumentStatement address;
    address.voltage.gain = {0.005, "the device's address"};
    const auto both = merged(profileOf(profileText()).statement(), address);
    EXPECT_DOUBLE_EQ(both.voltage.gain.value, 0.005);
    EXPECT_FALSE(both.voltage.linearity.known()) << "a gain of the reading replaces the sheet's of full scale";
    EXPECT_DOUBLE_EQ(both.current.linearity.value, 0.02);
    EXPECT_DOUBLE_EQ(both.timeBase.value, 75e-6);
}

TEST(InstrumentProfile, ReachesTheChannelsAndSaysWhoStatesIt) {
    Capture capture;
    capture.channels = {{"voltage", "V", {0}, -20, 20, 0.1}, {"current", "A", {0}, 0, 0, 1e-4}};
    applyStatement(capture, profileOf(profileText()).statement());
    EXPECT_DOUBLE_EQ(capture.channels[0].gainTolerance, 0);
    EXPECT_DOUBLE_EQ(capture.channels[0].linearityTolerance, 0.8) << "2 % of 40 V";
    EXPECT_THAT(capture.channels[0].statedBy, HasSubstr("data sheet of the Rigol DS2000"));
    EXPECT_TRUE(std::isnan(capture.channels[1].gainTolerance)) << "of an unknown range nothing can be a share";
    EXPECT_DOUBLE_EQ(capture.timeBaseTolerance, 75e-6);
    EXPECT_TRUE(std::isnan(capture.stampTolerance_s));
}

TEST(InstrumentProfile, AFigureNeedsItsSourceItsAddressAndAConfidence) {
    for (const char* key : {"source", "address", "confidence"}) {
        for (const bool inGain : {true, false}) {
            const auto without = with(inGain ? kGain : kTimeBase, fmt::format("\"{}\": ", key), "\"condition\": ");
            EXPECT_THAT(refusalOf(inGain ? profileText(without) : profileText(kGain, without)),
                        HasSubstr(fmt::format("\"{}\" is missing", key)));
        }
    }
    EXPECT_THAT(refusalOf(profileText(with(kGain, "a sheet, page 3", ""))), HasSubstr("a text that is not empty"));
    EXPECT_THAT(refusalOf(profileText(with(kGain, R"("high")", R"("sure")"))),
                HasSubstr(R"("confidence" is "sure"; high, medium, medium-low or low was expected)"));
}

TEST(InstrumentProfile, RefusesFiguresThatAreNone) {
    for (const char* value : {"-1", "50.1", "\"2\"", "null", "[2]", "true"}) {
        EXPECT_THAT(refusalOf(profileText(with(kGain, "2,", fmt::format("{},", value)))),
                    HasSubstr("a number from 0 to 50"))
            << value;
        EXPECT_THAT(refusalOf(profileText(kGain, with(kTimeBase, "5, \"source", fmt::format("{}, \"source", "-5")))),
                    HasSubstr("a number from 0 to 100000"));
    }
    EXPECT_THAT(refusalOf(profileText(with(kGain, "2,", "NaN,"))), HasSubstr("x.json"));
    EXPECT_THAT(refusalOf(profileText(with(kGain, "full scale", "screen"))),
                HasSubstr("reading or full scale was expected"));
}

TEST(InstrumentProfile, RefusesKeysAndNamesThatItDoesNotKnow) {
    EXPECT_THAT(refusalOf(profileText(with(kGain, "\"pct\"", "\"probe_pct\": 1, \"pct\""))), HasSubstr("probe_pct"));
    EXPECT_THAT(refusalOf(with(profileText(), "\"gain\":", "\"gains\":")), HasSubstr("gains"));
    EXPECT_THAT(refusalOf(with(profileText(), "\"gain\":", "\"note\": \"\", \"gain\":")), HasSubstr("\"note\""));
    for (const char* models : {"[]", "\"DS2072\"", "[\"\"]", "[\"*\"]", "[\"DS*2\"]", "[\"DS**\"]", "[7]"}) {
        EXPECT_THAT(refusalOf(profileText(kGain, kTimeBase, models)), HasSubstr("\"models")) << models;
    }
    EXPECT_THAT(refusalOf(with(profileText(), R"(["Rigol"])", R"(["*"])")), HasSubstr("a maker's name"));
    EXPECT_THAT(refusalOf(profileText("2")), HasSubstr("x.json: gain: 2 stands where an object is expected"));
    EXPECT_THAT(refusalOf("[]"), HasSubstr("x.json"));
}

}  // namespace
}  // namespace tacto::test
