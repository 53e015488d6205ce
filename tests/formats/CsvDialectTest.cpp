// The tables of instruments: what each writes and the values it stands for. From real files if there are any.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/CaptureFormats.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

CaptureReading readShared(const std::filesystem::path& path) {
    auto read = ownCaptureFormats()->read(path);
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    return read ? std::move(*read) : CaptureReading{};
}

CaptureReading parsed(std::string_view text) {
    auto read = parseCapture(text, "t.csv");
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    return read ? std::move(*read) : CaptureReading{};
}

TEST(CsvDialects, RigolWithASampleIndexHasStartAndIncrementInItsHeader) {
    const auto path = sharedData("scope/rigol_DS2072A-1.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto read = readShared(*path);
    EXPECT_EQ(read.formatId, "csv-rigol");
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_NEAR(read.capture.rate_hz, 200e3, 1e-3);
    EXPECT_NEAR(read.capture.start_s, -3.5e-3, 1e-12);
    ASSERT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_EQ(read.capture.channels[1].name, "CH2");
    EXPECT_EQ(read.capture.channels[1].unit, "V");
    ASSERT_EQ(read.capture.samples(), 1400U);
    EXPECT_FLOAT_EQ(read.capture.channels[0].samples.front(), 0.024F);
    EXPECT_FLOAT_EQ(read.capture.channels[1].samples.back(), 0.3120F);
}

TEST(CsvDialects, RigolWithSecondsIsNotTakenForAnIndex) {
    const auto path = sharedData("scope/rigol_DS1102E-B.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto read = readShared(*path);
    EXPECT_EQ(read.formatId, "csv-rigol");
    EXPECT_NEAR(read.capture.rate_hz, 50e6, 1e3);
    EXPECT_NEAR(read.capture.start_s, -6e-6, 1e-9);
    ASSERT_THAT(read.capture.channels, SizeIs(1));
    EXPECT_EQ(read.capture.samples(), 600U);
    EXPECT_FLOAT_EQ(read.capture.channels[0].samples[17], -0.96F);
}

TEST(CsvDialects, RigolFilesOfEveryModelHere) {
    const auto three = sharedData("scope/rigol_DS1074Z-A.csv");
    const auto four = sharedData("scope/rigol_DS4024-B.csv");
    if (!three || !four) GTEST_SKIP() << kNoSharedData;
    const auto z = readShared(*three);
    EXPECT_THAT(z.capture.channels, SizeIs(3));
    EXPECT_NEAR(z.capture.rate_hz, 50e3, 1e-3);
    EXPECT_NEAR(z.capture.start_s, -2e-3, 1e-12);
    EXPECT_EQ(z.capture.samples(), 1200U);
    const auto ds4 = readShared(*four);
    EXPECT_NEAR(ds4.capture.rate_hz, 100e3, 1e-3);
    EXPECT_FLOAT_EQ(ds4.capture.channels[0].samples[1], -0.3125F);
}

TEST(CsvDialects, TektronixTakesTheIntervalOfItsHeader) {
    const auto path = sharedData("scope/mdo4104c/RTC.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto read = readShared(*path);
    EXPECT_EQ(read.formatId, "csv-tektronix");
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 1 / 2e-8) << "stamps of six digits would only come close";
    EXPECT_NEAR(read.capture.start_s, -4.03e-4, 1e-12);
    ASSERT_EQ(read.capture.samples(), 100'000U);
    EXPECT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_FLOAT_EQ(read.capture.channels[0].samples[1], 5.12F);
    EXPECT_FLOAT_EQ(read.capture.channels[1].samples.back(), 5);
}

TEST(CsvDialects, TektronixTdsHasItsKeysBesideTheFirstRows) {
    const auto read = parsed(
        "Record Length,4.000000e+00,,-00.000250000000,  0.04800,\n"
        "Sample Interval,2.000000e-07,,-00.000249800000,  0.04000,\n"
        "Source,CH2,,-00.000249600000,  0.03200,\n"
        "Vertical Units,V,,-00.000249400000, -0.02400,\n");
    EXPECT_EQ(read.formatId, "csv-tektronix");
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 1 / 2e-7);
    EXPECT_NEAR(read.capture.start_s, -250e-6, 1e-15);
    ASSERT_THAT(read.capture.channels, SizeIs(1));
    EXPECT_EQ(read.capture.channels[0].name, "CH2");
    EXPECT_EQ(read.capture.channels[0].unit, "V");
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(0.048F, 0.04F, 0.032F, -0.024F));
}

TEST(CsvDialects, SiglentNamesItsChannelsInABlockOfKeys) {
    const auto read = parsed(
        "Record Length,Analog:4,\nSample Interval,Analog:5.000000E-05,\nVertical Units,CH3:V,CH4:A,\n"
        "Vertical Scale,CH3:1.00,CH4:2.00,\nModel Number,SDS1104X-E\nSecond,Value,Value\n"
        "+1.240000E+01,+4.0E-02,1\n+1.240005E+01,+4.5E-02,2\n+1.240010E+01,+5.0E-02,3\n+1.240015E+01,+5.5E-02,4\n");
    EXPECT_EQ(read.formatId, "csv-siglent");
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_NEAR(read.capture.rate_hz, 20e3, 1e-6);
    EXPECT_NEAR(read.capture.start_s, 12.4, 1e-12);
    ASSERT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_EQ(read.capture.channels[0].name, "CH3");
    EXPECT_EQ(read.capture.channels[1].unit, "A");
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(0.04F, 0.045F, 0.05F, 0.055F));
}

TEST(CsvDialects, KeysightNumbersItsChannels) {
    const auto read = parsed("x-axis,1,2\nsecond,Volt,Ampere\n-5.0E-03,+1.20E-01,0\n-4.0E-03,+1.30E-01,1E-3\n");
    EXPECT_EQ(read.formatId, "csv-keysight");
    EXPECT_NEAR(read.capture.rate_hz, 1000, 1e-9);
    ASSERT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_EQ(read.capture.channels[0].name, "CH1");
    EXPECT_EQ(read.capture.channels[1].unit, "A");
    EXPECT_FLOAT_EQ(read.capture.channels[0].samples[1], 0.13F);
}

TEST(CsvDialects, PicoScopeSaysItsUnitsInASecondLine) {
    const auto read = parsed("Time,Channel A,Channel B\n(ms),(V),(mV)\n\n-0.5,0.1,250\n0.0,∞,-∞\n0.5,0.3,125\n");
    EXPECT_EQ(read.formatId, "csv-picoscope");
    EXPECT_NEAR(read.capture.rate_hz, 2000, 1e-9);
    EXPECT_NEAR(read.capture.start_s, -0.5e-3, 1e-15);
    ASSERT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_EQ(read.capture.channels[1].unit, "V");
    EXPECT_FLOAT_EQ(read.capture.channels[1].samples[0], 0.25F);
    EXPECT_TRUE(std::isnan(read.capture.channels[0].samples[1])) << "beyond the range is not a value";
    EXPECT_THAT(read.warnings, ::testing::Contains(HasSubstr("beyond the range")));
}

TEST(CsvDialects, PicoScopeOfAGermanComputer) {
    const auto read = parsed("Time;Channel A\n(ms);(mV)\n\n0,5;1,25\n1,0;2,5\n1,5;3,75\n");
    EXPECT_EQ(read.formatId, "csv-picoscope");
    EXPECT_NEAR(read.capture.rate_hz, 2000, 1e-9);
    EXPECT_FLOAT_EQ(read.capture.channels[0].samples[0], 1.25e-3F);
}

TEST(CsvDialects, PlainTablesWithUnitsInTheNameInBracketsOrInALineBelow) {
    for (const auto* text : {"time_ms,CH1_mv\n0,1000\n1,2000\n", "time (ms),CH1 (mV)\n0,1000\n1,2000\n",
                             "t [ms];CH1 [mV]\n0;1000\n1;2000\n", "time\tCH1\nms\tmV\n0\t1000\n1\t2000\n",
                             "made by hand\ntime,CH1\n(ms),(mV)\n0,1000\n1,2000\n"}) {
        const auto read = parsed(text);
        EXPECT_EQ(read.formatName.find("CSV") == std::string::npos, false) << text;
        EXPECT_NEAR(read.capture.rate_hz, 1000, 1e-9) << text;
        ASSERT_THAT(read.capture.channels, SizeIs(1)) << text;
        EXPECT_EQ(read.capture.channels[0].name, "CH1") << text;
        EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(1, 2)) << text;
    }
}

TEST(CsvDialects, ABadRowIsNamedInEveryDialect) {
    RecordProperty("hazard", "H10");
    const auto refusal = [](std::string_view text) {
        const auto read = parseCapture(text, "t.csv");
        return read ? "accepted" : read.error().message;
    };
    EXPECT_EQ(refusal("X,CH1,\nSecond,Volt,\n0,x,\n1,2,\n"), "t.csv:3: 'x' in column 'CH1'; a number was expected");
    EXPECT_EQ(refusal("X,CH1,Start,Increment,\nSequence,Volt,0,-1,\n0,1,\n1,2,\n"),
              "t.csv:2: start and increment are '0,-1,'; two numbers, the increment above 0, were expected; "
              "--sample-rate HZ reads it, where HZ is the instrument's rate");
    EXPECT_EQ(refusal("x-axis,1\nsecond,Volt\n0,1\n1\n"), "t.csv:4: 1 fields; 2 were expected, as in the header");
    EXPECT_EQ(
        refusal("Time,Channel A\n(ms),(bar)\n\n0,1\n1,2\n"),
        "t.csv:1: the unit of column 'Channel A' is unknown; s, V or A with m, u, n or k were expected; --unit 2=V "
        "reads it, its numbers as volts");
}

}  // namespace
}  // namespace tacto::test
