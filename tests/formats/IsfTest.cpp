// Tektronix ISF, compared with the oscilloscope's own CSV, and statements in a file that are refused.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/CaptureFormats.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string isf(std::string_view keys, std::string_view curve) {
    return ":WFMPRE:" + std::string(keys) + ";:CURVE " + std::string(curve);
}
constexpr std::string_view kKeys =
    "BYT_NR 2;BIT_NR 16;ENCDG BINARY;BN_FMT RI;BYT_OR MSB;WFID \"Ch2, DC coupling; odd\";NR_PT 3;PT_FMT Y;XUNIT \"s\";"
    "XINCR 1.0E-3;XZERO 5.0E-3;PT_OFF 1;YUNIT \"V\";YMULT 0.5;YOFF 2;YZERO 1";

Result<CaptureReading> readIsf(const std::string& bytes, const ReadOptions& options = {}) {
    const ScratchDir scratch;
    return ownCaptureFormats()->read(scratch.write("t.isf", bytes), options);
}
std::string refusal(const std::string& bytes) {
    const auto read = readIsf(bytes);
    return read ? "accepted" : read.error().message;
}

TEST(Isf, HoldsWhatTheOscilloscopeWroteAsCsv) {
    const auto csv = sharedData("scope/mdo4104c/RTC.csv");
    const auto one = sharedData("scope/mdo4104c/tek0000CH1.isf");
    const auto two = sharedData("scope/mdo4104c/tek0000CH2.isf");
    if (!csv || !one || !two) GTEST_SKIP() << kNoSharedData;
    const auto truth = accepted(ownCaptureFormats()->read(*csv));
    for (std::size_t c = 0; c < 2; ++c) {
        const auto read = accepted(ownCaptureFormats()->read(c == 0 ? *one : *two));
        EXPECT_EQ(read.formatId, "isf");
        EXPECT_THAT(read.warnings, IsEmpty());
        const auto& channel = read.capture.channels.at(0);
        EXPECT_EQ(channel.name, c == 0 ? "CH1" : "CH2");
        EXPECT_EQ(channel.unit, "V");
        EXPECT_NEAR(read.capture.rate_hz, truth.capture.rate_hz, 1e-3);
        EXPECT_NEAR(read.capture.start_s, truth.capture.start_s, 1e-12);
        ASSERT_EQ(channel.samples.size(), truth.capture.samples());
        for (std::size_t i = 0; i < channel.samples.size(); ++i) {
            ASSERT_NEAR(channel.samples[i], truth.capture.channels[c].samples[i], 1e-6) << i;
        }
        EXPECT_NEAR(channel.lsb, 0.08, 1e-9) << "an 8-bit converter over 10.24 divisions of 2 V";
        EXPECT_NEAR(channel.high - channel.low, 255 * 0.08, 1e-6);
    }
}

TEST(Isf, CodesBecomeValuesByItsOwnFormula) {
    const auto read = accepted(readIsf(isf(kKeys, std::string("#16\x00\x02\x00\x04\xFF\xFE", 9))));
    const auto& channel = read.capture.channels.at(0);
    EXPECT_EQ(channel.name, "CH2");
    EXPECT_THAT(channel.samples, ElementsAre(1, 2, -1)) << "(code - YOFF) * YMULT + YZERO";
    EXPECT_DOUBLE_EQ(read.capture.start_s, 4e-3) << "sample PT_OFF is at XZERO";
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 1000);
}

TEST(Isf, ShortKeysOtherBytesAndText) {
    const std::string shortKeys =
        "BYT_N 1;BIT_N 8;ENC BIN;BN_F RP;BYT_O LSB;NR_P 2;PT_F Y;XUN \"s\";XIN 1;XZE 0;PT_O 0;YUN \"Volts\";YMU 2;YOF "
        "128;YZE 0";
    const auto bytes = accepted(readIsf(isf(shortKeys, std::string("#12\x80\xFF", 5))));
    EXPECT_THAT(bytes.capture.channels[0].samples, ElementsAre(0, 254));
    EXPECT_EQ(bytes.capture.channels[0].unit, "V");
    EXPECT_DOUBLE_EQ(bytes.capture.channels[0].high, 254);
    const auto text =
        accepted(readIsf(isf("ENCDG ASCII;NR_PT 4;XINCR 0.5;YMULT 2;YOFF 0;YZERO 0;YUNIT \"mV\"", "1,-2,3,4\n")));
    EXPECT_THAT(text.capture.channels[0].samples, ElementsAre(0.002F, -0.004F, 0.006F, 0.008F));
}

TEST(Isf, ATimeIsNoUnitOfItsChannel) {
    RecordProperty("hazard", "H10");
    for (const std::string unit : {"s", "ms", "second"}) {
        const auto read =
            readIsf(isf("ENCDG ASCII;NR_PT 2;XINCR 0.5;YMULT 2;YOFF 0;YZERO 0;YUNIT \"" + unit + "\"", "1,2\n"));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->capture.channels[0].unit, "");
        EXPECT_THAT(read->capture.channels[0].samples, ElementsAre(2, 4));
        EXPECT_THAT(read->warnings, ElementsAre(HasSubstr("the unit '" + unit + "'")));
    }
}

TEST(Isf, OptionsApplyToItsChannel) {
    const auto bytes = isf(kKeys, std::string("#16\x00\x02\x00\x04\xFF\xFE", 9));
    const auto read =
        accepted(readIsf(bytes, {.units = {{"1", "mA"}}, .probeFactors = {{"CH2", 10.0}}, .rate = Hertz(5)}));
    EXPECT_EQ(read.capture.channels[0].unit, "A");
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(0.01F, 0.02F, -0.01F));
    EXPECT_DOUBLE_EQ(read.capture.channels[0].lsb, 0.5 * 0.01);
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 5);
    EXPECT_FALSE(readIsf(bytes, {.skipRows = 1}));
    EXPECT_FALSE(readIsf(bytes, {.timeColumn = "1"}));
}

TEST(Isf, AFileCutShortIsReadAsFarAsItGoes) {
    const auto read = accepted(readIsf(isf(kKeys, std::string("#16\x00\x02\x00\x04", 7))));
    EXPECT_THAT(read.capture.channels[0].samples, SizeIs(2));
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("3 points are announced, 2 are there")));
}

TEST(Isf, WhatMakesNoSenseIsRefusedByKey) {
    RecordProperty("hazard", "H10");
    const auto with = [](std::string_view from, std::string_view to) {
        std::string keys(kKeys);
        keys.replace(keys.find(from), from.size(), to);
        return refusal(isf(keys, std::string("#16\x00\x02\x00\x04\xFF\xFE", 9)));
    };
    EXPECT_THAT(with("BYT_NR 2", "BYT_NR 4"), HasSubstr("byt_nr is '4'; 1 or 2 was expected"));
    EXPECT_THAT(with("PT_FMT Y", "PT_FMT ENV"), HasSubstr("pt_fmt is 'ENV'"));
    EXPECT_THAT(with("XUNIT \"s\"", "XUNIT \"Hz\""), HasSubstr("xunit is 'Hz'; s was expected"));
    EXPECT_THAT(with("XINCR 1.0E-3", "XINCR 0"), HasSubstr("xincr"));
    EXPECT_THAT(with("XINCR 1.0E-3", "XINCR nan"), HasSubstr("xincr"));
    EXPECT_THAT(with("YMULT 0.5;", ""), HasSubstr("ymult is missing"));
    EXPECT_THAT(with("YOFF 2;", ""), HasSubstr("yoff is missing")) << "unknown, not 0";
    EXPECT_THAT(with(";YZERO 1", ""), HasSubstr("yzero is missing"));
    EXPECT_THAT(with("NR_PT 3", "NR_PT 1e30"), HasSubstr("nr_pt"));
    EXPECT_THAT(refusal(isf(kKeys, "16")), HasSubstr("'#', a digit"));
    EXPECT_THAT(refusal(":WFMPRE:" + std::string(kKeys)), HasSubstr("no :CURVE"));
    EXPECT_THAT(refusal(isf("ENCDG ASCII;NR_PT 2;XINCR 0.5;YMULT 2;YOFF 0;YZERO 0", "1,x")),
                HasSubstr("point 2 is 'x'"));
}

}  // namespace
}  // namespace tacto::test
