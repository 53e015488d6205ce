// Options of a user who knows more than the table shows, and oddities of tables.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::string_view kTable = "time_s,CH1,CH2,note\n0,1,10,a\n1,2,20,b\n2,3,30,c\n";

std::string refusal(std::string_view text, const ReadOptions& options) {
    const auto read = parseCapture(text, "t.csv", options);
    return read ? "accepted" : read.error().message;
}

TEST(CsvOptions, ColumnsAreChosenByNameOrNumberInTheirOrder) {
    for (const auto& columns : {std::vector<std::string>{"ch2", "CH1"}, {"3", "2"}}) {
        const auto read = accepted(parseCapture(kTable, "t.csv", {.columns = columns}));
        ASSERT_THAT(read.capture.channels, SizeIs(2));
        EXPECT_EQ(read.capture.channels[0].name, "CH2");
        EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(10, 20, 30));
    }
    EXPECT_THAT(refusal(kTable, {.columns = {"CH9"}}), HasSubstr("there is no channel 'CH9'"));
    EXPECT_THAT(refusal(kTable, {.columns = {"CH9"}}), HasSubstr("CH1 (2), CH2 (3), note (4)"));
    EXPECT_THAT(refusal(kTable, {.columns = {"CH1", "2"}}), HasSubstr("is given twice"));
    EXPECT_THAT(refusal(kTable, {.columns = {"note"}}), HasSubstr("t.csv:2: 'a' in column 'note'"));
}

TEST(CsvOptions, UnitsAndProbesReplaceAndMultiply) {
    const auto read = accepted(parseCapture("time_s,CH1_v,CH2\n0,1000,1\n1,2000,2\n", "t.csv",
                                            {.units = {{"CH1", "mV"}, {"CH2", "A"}}, .probeFactors = {{"CH1", 10.0}}}));
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(10, 20)) << "1000 mV through a 10:1 probe";
    EXPECT_EQ(read.capture.channels[1].unit, "A");
    EXPECT_THAT(refusal(kTable, {.units = {{"CH1", "lbf"}}}), HasSubstr("the unit 'lbf' of channel 'CH1' is unknown"));
    EXPECT_THAT(refusal(kTable, {.units = {{"X", "V"}}}), HasSubstr("no channel 'X'"));
    for (const double factor : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THAT(refusal(kTable, {.probeFactors = {{"CH1", factor}}}), HasSubstr("the probe factor of channel"));
    }
    EXPECT_EQ(refusal("time_s,force (lbf)\n0,1\n1,2\n", {.units = {{"force", "V"}}}), "accepted");
}

TEST(CsvOptions, ARangeIsTheChannelsInVoltsAndAmperes) {
    const auto read = accepted(parseCapture("time_s,CH1_mv,CH2_a\n0,1000,1\n1,2000,2\n", "t.csv",
                                            {.ranges = {{"CH1", {-5, 5}}, {"3", {0, 2}}}}));
    EXPECT_EQ(read.capture.channels[0].low, -5);
    EXPECT_EQ(read.capture.channels[0].high, 5);
    EXPECT_EQ(read.capture.channels[1].low, 0);
    EXPECT_EQ(read.capture.channels[1].high, 2);
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(1, 2));
    for (const auto& [low, high] :
         {std::pair(5.0, -5.0), {1.0, 1.0}, {std::nan(""), 1.0}, {-1.0, std::numeric_limits<double>::infinity()}}) {
        EXPECT_THAT(refusal("time_s,a\n0,1\n1,2\n", {.ranges = {{"a", {low, high}}}}),
                    HasSubstr("two finite numbers, the lower first, were expected"));
    }
    EXPECT_THAT(refusal(kTable, {.ranges = {{"X", {0, 1}}}}), HasSubstr("no channel 'X', which the range names"));
}

TEST(CsvOptions, ATimeColumnOrARateMakesAnyTableACapture) {
    const auto named = accepted(parseCapture("when,a\n5,1\n6,2\n", "t.csv", {.timeColumn = "when"}));
    EXPECT_NEAR(named.capture.start_s, 5, 1e-12);
    EXPECT_THAT(named.capture.channels, SizeIs(1));
    const auto counted = accepted(parseCapture("a,b\n5,1\n6,2\n", "t.csv", {.rate = Hertz(100)}));
    EXPECT_THAT(counted.capture.channels, SizeIs(2));
    EXPECT_DOUBLE_EQ(counted.capture.rate_hz, 100);
    EXPECT_DOUBLE_EQ(counted.capture.start_s, 0);
    const auto bare = accepted(parseCapture("0,1\n1,2\n", "t.csv", {.timeColumn = "1"}));
    EXPECT_THAT(bare.capture.channels, SizeIs(1));
    EXPECT_THAT(bare.capture.channels[0].samples, ElementsAre(1, 2));
    EXPECT_THAT(refusal("a,b\n5,1\n6,2\n", {.timeColumn = "when"}), HasSubstr("no time column 'when'"));
}

TEST(CsvOptions, ARateReplacesWrongStamps) {
    const auto read = accepted(parseCapture("time_s,a\n7,1\n7,2\n9,3\n", "t.csv", {.rate = Hertz(1000)}));
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 1000);
    EXPECT_DOUBLE_EQ(read.capture.start_s, 7);
    for (const double rate : {0.0, -1.0, std::nan("")}) {
        EXPECT_THAT(refusal(kTable, {.columns = {"CH1"}, .rate = Hertz(rate)}), HasSubstr("the sampling rate is"));
    }
}

TEST(CsvOptions, RowsAreSkippedAndLinesStillCounted) {
    EXPECT_EQ(refusal("time_s,x\nrubbish\ntime_s,a\n0,1\n1,y\n", {.skipRows = 2}),
              "t.csv:5: 'y' in column 'a'; a number was expected");
}

TEST(CsvOddities, StampsTooCoarseForTheirRateAreTakenFromFirstAndLast) {
    // Rows 1.5 us apart with times in steps of 10 us, as a Rigol writes them for a million points.
    std::string text = "Time(s),CH1(V)\n";
    for (int i = 0; i < 10'000; ++i) text += fmt::format("{:.5f},{}\n", 1.5e-6 * i, i % 7);
    const auto read = accepted(parseCapture(text, "t.csv"));
    EXPECT_NEAR(read.capture.rate_hz, 1 / 1.5e-6, 1e-3 / 1.5e-6);
    ASSERT_THAT(read.warnings, SizeIs(1));
    EXPECT_THAT(read.warnings[0], HasSubstr("time stamps move by at least 1e-05 s"));
}

TEST(CsvOddities, StrayingStampsAndAContradictingHeaderAreSaid) {
    const auto stray = parseCapture("time_s,a\n0,1\n1.4,1\n1.7,1\n3,1\n", "t.csv");
    ASSERT_TRUE(stray);
    ASSERT_THAT(stray->warnings, SizeIs(1));
    EXPECT_THAT(stray->warnings[0], HasSubstr("stray"));
    const auto header =
        accepted(parseCapture("Record Length,3\nSample Interval,5\nTIME,CH1\n0,1\n1,1\n2,1\n3,1\n", "t.csv"));
    EXPECT_DOUBLE_EQ(header.capture.rate_hz, 1) << "the stamps are there for every row";
    EXPECT_THAT(header.warnings,
                ElementsAre(HasSubstr("announces 3 rows; there are 4"), HasSubstr("states 5 s between samples")));
}

TEST(CsvOddities, MissingTimesAtThePaddedEndAreNoFault) {
    const auto read = accepted(parseCapture("time_s,a\n0,1\n1,2\n2,3\n,\n9,\n", "t.csv"));
    EXPECT_EQ(read.capture.samples(), 3U);
    EXPECT_NEAR(read.capture.rate_hz, 1, 1e-12);
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("t.csv:5: 2 rows without values at the end left out")));
}

TEST(CsvOddities, BytesThatAreNoTextAreRefused) {
    EXPECT_THAT(refusal(std::string_view("time_s,a\n\0\0\0", 12), {}), HasSubstr("not a text in UTF-8"));
}

}  // namespace
}  // namespace tacto::test
