// Tables as instruments and people write them, drawn at random (WrittenTables.h): every number, unit and name is read
// back, or reported as missing.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/CaptureFormats.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/formats/WrittenTables.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

int drawn() { return trials<int>({.local = 100, .ci = 300, .campaign = 5000}); }

using Drawing = WrittenTable (*)(Random&);
class CsvKinds : public ::testing::TestWithParam<std::pair<const char*, Drawing>> {};

TEST_P(CsvKinds, AreReadAsWritten) {
    RecordProperty("hazard", "H10");
    Random random(20261129, GetParam().first);
    for (int i = 0; i < drawn(); ++i) {
        const auto table = GetParam().second(random);
        expectAsWritten(parseCapture(table.text, "t.csv"), table);
        if (HasFatalFailure() || HasNonfatalFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Drawn, CsvKinds,
    ::testing::Values(std::pair("Plain", &plainTable), std::pair("TektronixBesideKeys", &tektronixBesideKeys),
                      std::pair("GwInstekWithoutMode", &gwInstekWithoutMode),
                      std::pair("RigolWithoutIndex", &rigolWithoutIndex),
                      std::pair("DsViewOscilloscope", &dsViewOscilloscope),
                      std::pair("PicoScope", &picoScopeOfSomeLanguage), std::pair("RohdeSchwarz", &rohdeSchwarz),
                      std::pair("TimesForEachChannel", &timesForEachChannel), std::pair("Stamped", &stampedTable)),
    [](const auto& one) { return std::string(one.param.first); });

/// A table with SCPI's marks for no value in random rows, and the numbers of these rows.
struct Marked {
    std::string text;
    std::vector<std::size_t> rows;
};
Marked marked(std::string_view head, std::string_view beside, std::size_t rows, Random& random) {
    constexpr std::string_view kMarks[] = {"9.9E+37",  "+9.9E+37", "-9.9E+37",      "9.90000E+037", "9.91E37",
                                           "9.91e+37", "-9.91E37", "9.9999999e+37", "9.8999997e37"};
    Marked table{std::string(head), {}};
    for (std::size_t i = 0; i < rows; ++i) {
        const bool isMark = i + 1 < rows && random.uniform() < 0.2;
        if (isMark) table.rows.push_back(i);
        table.text += fmt::format("{}{}{}\n", fmt::format(fmt::runtime(beside), 1e-5 * static_cast<double>(i)),
                                  isMark ? kMarks[random.below(std::size(kMarks))] : "1.5", "");
    }
    return table;
}

TEST(CsvKinds, ScpisNoValueIsMissingAndCounted) {
    RecordProperty("hazard", "H10");
    Random random(46, "no value");
    const std::pair<const char*, const char*> layouts[] = {{"x-axis,1\nsecond,Volt\n", "{:.6f},"},
                                                           {"time_s,CH1_mv\n", "{:.6f},"},
                                                           {"t/s;I/µA\n", "{:.6f};"},
                                                           {"CH1,Start,Increment,\nVolt,0,1e-05\n", "{0:.0}"},
                                                           {"Time,Channel A\n(s),(mV)\n\n", "{:.6f},"}};
    for (int i = 0; i < drawn(); ++i) {
        const auto& [head, beside] = layouts[random.below(std::size(layouts))];
        const bool isCounted = std::string_view(beside).find(".0}") != std::string_view::npos;
        const auto table = marked(head, isCounted ? "" : beside, 5 + random.below(50), random);
        const auto read = parseCapture(table.text, "t.csv");
        ASSERT_TRUE(read) << read.error().message << table.text;
        const auto& samples = read->capture.channels[0].samples;
        std::vector<std::size_t> missing;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            if (std::isnan(samples[k])) missing.push_back(k);
        }
        ASSERT_EQ(missing, table.rows) << table.text;
        const auto count = table.rows.size() == 1 ? "a sample" : fmt::format("{} samples", table.rows.size());
        if (table.rows.empty()) {
            EXPECT_THAT(read->warnings, Each(Not(HasSubstr("SCPI")))) << table.text;
        } else {
            EXPECT_THAT(read->warnings, Contains(HasSubstr(count + " of '"))) << table.text;
        }
    }
}

TEST(CsvKinds, ScpisNoValueIsMissingInBinaryFormatsToo) {
    const ScratchDir scratch;
    Capture capture;
    capture.rate_hz = 1000;
    capture.channels.push_back({"CH1", "V", {1, 9.9e37F, 2, -9.9e37F, 9.91e37F, 3}});
    const auto path = scratch.path() / "t.wav";
    ASSERT_TRUE(ownCaptureFormats()->write(path, capture));
    const auto isf = scratch.write(
        "t.isf",
        ":WFMPRE:BYT_NR 2;BIT_NR 16;ENCDG ASCII;BN_FMT RI;BYT_OR MSB;WFID \"Ch1, DC\";NR_PT 6;PT_FMT Y;XUNIT \"s\";"
        "XINCR 1.0E-3;XZERO 0;PT_OFF 0;YUNIT \"V\";YMULT 0.5;YOFF 0;YZERO 0;:CURVE 2,9.9E+37,4,-9.9E37,9.91E+37,6");
    for (const auto& file : {path, isf}) {
        const auto read = accepted(ownCaptureFormats()->read(file));
        const auto& samples = read.capture.channels.at(0).samples;
        ASSERT_EQ(samples.size(), 6U);
        for (const std::size_t k : {0U, 2U, 5U}) EXPECT_FLOAT_EQ(samples[k], k == 0 ? 1.0F : k == 2 ? 2.0F : 3.0F);
        for (const std::size_t k : {1U, 3U, 4U}) EXPECT_TRUE(std::isnan(samples[k])) << file << k;
        EXPECT_THAT(read.warnings, Contains(HasSubstr("3 samples of 'CH1'"))) << file;
    }
}

TEST(CsvKinds, AUnitOfTimeIsNeverDroppedWhenItsColumnIsChosen) {
    RecordProperty("hazard", "H10");
    const std::pair<const char*, double> names[] = {
        {"t/ms", 1e3},       {"t / ms", 1e3},   {"t[ms]", 1e3},      {"Time ms", 1e3},
        {"when (ms)", 1e3},  {"when_ms", 1e3},  {"when in us", 1e6}, {"temps en µs", 1e6},
        {"ms", 1e3},         {"ns", 1e9},       {"x/s", 1},          {"t/min", 1.0 / 60},
        {"t/h", 1.0 / 3600}, {"Zeit, ms", 1e3}, {"t/(ms)", 1e3},     {"when", 1}};
    for (const auto& [name, rate] : names) {
        const auto text = fmt::format("{};CH1\n0;1\n1;2\n2;3\n", name);
        for (const auto& column : {std::string("1"), std::string(name)}) {
            const auto read = parseCapture(text, "t.csv", {.timeColumn = column});
            ASSERT_TRUE(read) << read.error().message << text;
            EXPECT_NEAR(read->capture.rate_hz / rate, 1, 1e-9) << text;
        }
        const auto said = accepted(parseCapture(text, "t.csv", {.timeColumn = "1", .units = {{"1", "us"}}}));
        EXPECT_NEAR(said.capture.rate_hz, 1e6, 1e-3) << "the user knows better: " << text;
    }
    for (const auto* name : {"t/T", "x (mm)", "t (samples)", "U/V", "time [div]", "T / °C"}) {
        const auto text = fmt::format("{};CH1\n0;1\n1;2\n2;3\n", name);
        const auto read = parseCapture(text, "t.csv", {.timeColumn = "1"});
        if (std::string_view(name) == "t/T") continue;  // a name without a unit
        ASSERT_FALSE(read) << text;
        EXPECT_THAT(read.error().message, HasSubstr("a column of times, in s, ms, us or ns, was expected")) << text;
    }
}

TEST(CsvKinds, NamesThatLookLikeUnitsAreNames) {
    const auto read =
        parseCapture("time_s,Channel A,channel_a,U_min,CH1/CH2,I/O,Phase 1\n0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n", "t.csv");
    ASSERT_TRUE(read) << read.error().message;
    std::vector<std::string> names;
    for (const auto& channel : read->capture.channels) {
        EXPECT_EQ(channel.unit, "") << channel.name;
        names.push_back(channel.name);
    }
    EXPECT_THAT(names, ::testing::ElementsAre("Channel A", "channel_a", "U_min", "CH1/CH2", "I/O", "Phase 1"));
}

TEST(CsvKinds, ASpectrumIsNoRecordOverTime) {
    for (const auto* text :
         {"Record Length,3,,0,1\nSource,MATH,,1,2\nVertical Units,dB,,2,3\nHorizontal Units,Hz,,3,4\n,,,4,5\n,,,5,6\n",
          "Record Length,3\nSample Interval,1\nHorizontal Units,Hz\nVertical Units,V\nTIME,CH1\n0,1\n1,2\n2,3\n"}) {
        EXPECT_THAT(parseCapture(text, "t.csv"), test::refusedSaying("the horizontal unit is 'Hz'")) << text;
    }
}

TEST(CsvKinds, TimesOfChannelsThatDifferAreRefusedByName) {
    RecordProperty("hazard", "H10");
    Random random(46, "times differ");
    for (int i = 0; i < drawn(); ++i) {
        const auto rows = 5 + random.below(30);
        const auto from = random.below(rows - 1);
        const double off = (random.below(2) == 0 ? -1 : 1) * (0.1 + random.uniform());
        std::string text = "Time (ms),CH1 (V),Time (ms),CH2 (V)\n";
        for (std::size_t k = 0; k < rows; ++k) {
            text += fmt::format("{},{},{:.4f},{}\n", k, k % 7, static_cast<double>(k) + (k >= from ? off : 0), k % 5);
        }
        const auto read = parseCapture(text, "t.csv");
        ASSERT_FALSE(read) << text;
        EXPECT_THAT(read.error().message,
                    ::testing::StartsWith(fmt::format("t.csv:{}: the times of column 3", from + 2)));
        EXPECT_THAT(read.error().message, ::testing::EndsWith("; --columns 2 reads it"));
        const auto first = parseCapture(text, "t.csv", {.columns = {"2"}});
        ASSERT_TRUE(first) << first.error().message;
        EXPECT_NEAR(first->capture.rate_hz, 1000, 1e-6);
        const auto other = parseCapture(text, "t.csv", {.columns = {"4"}});
        if (from == 0) {  // these steps are as even as those of the first column
            ASSERT_TRUE(other) << other.error().message;
            EXPECT_NEAR(other->capture.start_s, off * 1e-3, 1e-7) << "the times of its own";
        }
    }
}

TEST(CsvKinds, NamesGivenTwiceAreReadByNumber) {
    const std::string text = "time_s,CH1,CH1,,b\n0,1,2,3,4\n1,5,6,7,8\n";
    EXPECT_THAT(parseCapture(text, "t.csv"),
                test::refusedSaying(testing::StrEq(
                    "t.csv:1: column 'CH1' is given twice; once is expected; --columns 2,3,4,5 reads it")));
    const auto read = accepted(parseCapture(text, "t.csv", {.columns = {"3", "2", "4"}}));
    ASSERT_EQ(read.capture.channels.size(), 3U);
    EXPECT_EQ(read.capture.channels[0].name, "CH1");
    EXPECT_EQ(read.capture.channels[1].name, "CH1 (2)");
    EXPECT_EQ(read.capture.channels[2].name, "column 4");
    EXPECT_THAT(read.capture.channels[0].samples, ::testing::ElementsAre(2, 6));
    EXPECT_THAT(parseCapture(text, "t.csv", {.columns = {"CH1"}}), test::refusedSaying("'CH1' names columns 2 and 3"))
        << "which of the two?";
}

TEST(CsvKinds, PairsOfMinimumAndMaximumAreRefusedByName) {
    RecordProperty("hazard", "H10");
    std::string text = "in s,C1 in V\n";
    for (int i = 0; i < 40; ++i) text += fmt::format("{:.6E},{}\n", 1e-6 * (i / 2), i % 2 == 0 ? -1 : 1);
    EXPECT_THAT(parseCapture(text, "t.csv"), test::refusedSaying("every time stands twice"));
}

TEST(CsvKinds, UnitsOfKeysAndLabelsAreNotLost) {
    const std::string sigrok = "; CSV generated by libsigrok 0.5.2\n; Channels (2/2): P1, P2\n; Samplerate: 1 kHz\n";
    const auto both = accepted(parseCapture(sigrok + "V,°C\n1,20\n2,21\n", "t.csv"));
    EXPECT_EQ(both.capture.channels.size(), 1U);
    EXPECT_THAT(both.warnings, Contains(HasSubstr("'P2' is in '°C'")));
    const auto atten = accepted(
        parseCapture("Record Length,2\nSample Interval,CH1:1 CH2:1\nVertical Units,CH1:V CH2:A,,\nSource,CH1,CH2\n"
                     "Second,Value,Value\n0,1,2\n1,3,4\n",
                     "t.csv"));
    EXPECT_EQ(atten.capture.channels.at(0).unit, "V");
    EXPECT_EQ(atten.capture.channels.at(1).unit, "A");
    const auto origin = accepted(parseCapture("Time,CH1\nms,mV\n,trial 1\n0,1000\n1,2000\n", "t.csv"));
    EXPECT_NEAR(origin.capture.rate_hz, 1000, 1e-9);
    EXPECT_THAT(origin.capture.channels.at(0).samples, ::testing::ElementsAre(1, 2));
    EXPECT_THAT(origin.warnings, Contains(HasSubstr("a line without numbers below the names")));
    const auto alone = accepted(parseCapture("Sample Interval (s),1e-3\nU1 / V,U2 / mV\n1,1000\n2,2000\n", "t.csv"));
    EXPECT_NEAR(alone.capture.rate_hz, 1000, 1e-9);
    EXPECT_THAT(alone.capture.channels.at(1).samples, ::testing::ElementsAre(1, 2));
}

TEST(CsvKinds, AnUnnamedColumnThatCountsTheRowsIsNoSignal) {
    const auto read = parseCapture(",time_s,a_v\n0,0.0,5\n1,0.1,6\n2,0.2,7\n", "t.csv");  // written by pandas
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->capture.channels.size(), 1U);
    EXPECT_THAT(read->warnings, Contains(HasSubstr("counts the rows")));
}

TEST(CsvKinds, AStampThatIsNoneIsRefused) {
    for (const auto* stamp :
         {"2026-13-01T00:00:00Z", "2026-02-30T00:00:00Z", "2026-11-29T24:00:00Z", "2026-11-29T10:61:00Z",
          "2026-11-29T10:00:00+25:00", "2026-11-29X10:00:00", "29.11.2026"}) {
        const auto read =
            parseCapture(fmt::format("when,a\n2026-11-29T10:00:00Z,1\n{},2\n2026-11-29T10:00:02Z,3\n", stamp), "t.csv");
        ASSERT_FALSE(read) << stamp;
        EXPECT_THAT(read.error().message, HasSubstr("t.csv:3: '")) << stamp;
        EXPECT_THAT(read.error().message, HasSubstr("a date and time, as in the first row, was expected")) << stamp;
    }
}

}  // namespace
}  // namespace tacto::test
