// What is stated of an oscilloscope, by whom, and what is not: unknown is never zero (hazard H9).
#include <cmath>
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
    // A certificate of the gain takes the place of both.
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
