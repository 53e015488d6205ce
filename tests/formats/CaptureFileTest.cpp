#include <fstream>
#include <gtest/gtest.h>

#include "core/formats/csv/CsvFormat.h"
#include "core/measure/CaptureFile.h"
#include "tests/measure/SyntheticPulses.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

std::string refusal(std::string_view text) {
    const auto reading = parseCapture(text, "c.csv");
    return reading ? "accepted" : reading.error().message;
}

TEST(CaptureFile, WhatIsWrittenReadsBackTheSame) {
    const ScratchDir scratch;
    auto capture =
        recordOf(biphasic(7203.001), {.rate_hz = 10e6, .start_s = 7203.0000001, .samples = 20'000, .noise = 0.1});
    capture.channels.push_back(capture.channels[0]);
    capture.channels[1].name = "current";
    capture.channels[1].unit = "A";
    const auto path = scratch.path() / "capture.csv";
    ASSERT_TRUE(writeCapture(path, capture));
    std::string header;
    std::ifstream lines(path);
    std::getline(lines, header);
    EXPECT_EQ(header, "time_s,voltage_v,current_a");
    std::getline(lines, header);
    EXPECT_TRUE(header.starts_with("# tactoscope {")) << header;

    const auto read = accepted(readCapture(path));
    EXPECT_TRUE(read.warnings.empty());
    EXPECT_NEAR(read.capture.rate_hz, 10e6, 1e-2);
    EXPECT_NEAR(read.capture.start_s, capture.start_s, 1e-10);
    EXPECT_EQ(read.capture.trigger_s, capture.trigger_s);
    ASSERT_EQ(read.capture.channels.size(), 2U);
    EXPECT_EQ(read.capture.channels[1].name, "current");
    EXPECT_EQ(read.capture.channels[1].unit, "A");
    EXPECT_EQ(read.capture.channels[0].samples, capture.channels[0].samples) << "bit by bit";
}

TEST(CaptureFile, TimesBeforeAndFarAfterZeroAreWrittenInFull) {
    const ScratchDir scratch;
    for (const double start : {-0.0025, -1.0, 0.0, 0.999999, 12345.678, 4e6}) {
        for (const double rate : {1.0, 1e3, 44.1e3, 10e6}) {
            const auto capture = recordOf({}, {.rate_hz = rate, .start_s = start, .samples = 50, .noise = 1});
            ASSERT_TRUE(writeCapture(scratch.path() / "t.csv", capture));
            const auto read = accepted(readCapture(scratch.path() / "t.csv"));
            EXPECT_NEAR(read.capture.start_s, start, 1e-3 / rate + 1e-9);
            EXPECT_NEAR(read.capture.rate_hz / rate, 1, start > 1e6 ? 1e-2 : 1e-4) << start << " " << rate;
        }
    }
}

TEST(CaptureFile, AcceptsWhatOscilloscopesReallyWrite) {
    const auto read = accepted(parseCapture(
        "\xEF\xBB\xBF# made by hand\r\n Time (ms) , CH1 (mV) ,D0,\r\n0,1000,0,\r\n\r\n1,-nan,1,\r\n2, 3000 "
        ",1,\r\n3,,,\r\n",
        "c.csv"));
    EXPECT_NEAR(read.capture.rate_hz, 1000, 1e-9);
    ASSERT_EQ(read.capture.channels.size(), 2U);
    EXPECT_EQ(read.capture.channels[0].name, "CH1");
    EXPECT_EQ(read.capture.channels[0].unit, "V");
    EXPECT_EQ(read.capture.channels[1].unit, "");
    const auto& samples = read.capture.channels[0].samples;
    ASSERT_EQ(samples.size(), 3U) << "the last row has no values";
    EXPECT_FLOAT_EQ(samples[0], 1);
    EXPECT_TRUE(std::isnan(samples[1]));
    EXPECT_FLOAT_EQ(samples[2], 3);
    ASSERT_EQ(read.warnings.size(), 2U);
    EXPECT_NE(read.warnings[0].find("c.csv:7:"), std::string::npos) << read.warnings[0];
    EXPECT_NE(read.warnings[1].find("c.csv:5:"), std::string::npos) << read.warnings[1];
}

TEST(CaptureFile, RefusalsNameFileLineAndWhatWasExpected) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(refusal(""), "c.csv: the file is empty; a header line and rows of numbers were expected");
    EXPECT_EQ(refusal("time_s,voltage_v\n"), "c.csv: nothing after the header line; rows of numbers were expected");
    EXPECT_EQ(refusal("time_s,voltage_v\n0,1\n1,abc\n"), "c.csv:3: 'abc' in column 'voltage_v'; a number was expected");
    EXPECT_EQ(refusal("time_s,voltage_v\n0,1\n1\n2,1\n"), "c.csv:3: 1 fields; 2 were expected, as in the header");
    EXPECT_EQ(refusal("time_s,voltage_v\n0,1\n1,1,1\n"), "c.csv:3: 3 fields; 2 were expected, as in the header");
    EXPECT_EQ(refusal("time_s,voltage_v\n0,1\n1,1\n2\n"), "c.csv:4: 1 fields; 2 were expected, as in the header");
    EXPECT_EQ(refusal("0,1\n1,2\n"),
              "c.csv:1: a header line naming the columns, time among them, was expected before the numbers; "
              "--time-column 1 reads it, its numbers as seconds");
    EXPECT_EQ(refusal("a,b\n0,1\n"),
              "c.csv:1: columns 'a,b'; a time column and channels were expected, as in time_s,voltage_v,current_a");
    EXPECT_EQ(refusal("a,b\n0,1\n0.5,1\n"),
              "c.csv:1: columns 'a,b'; a time column and channels were expected, as in time_s,voltage_v,current_a; "
              "--time-column 1 reads it, its numbers as seconds");
    EXPECT_EQ(refusal("time_s,force (lbf)\n0,1\n"),
              "c.csv:1: the unit of column 'force (lbf)' is unknown; s, V or A with m, u, n or k were expected");
    EXPECT_EQ(refusal("time_s,v,v\n0,1,1\n"), "c.csv:1: column 'v' is given twice; once is expected");
    EXPECT_EQ(refusal("time_s,voltage_v\n0,1\n"), "c.csv:2: 1 row(s) with values; at least 2 were expected");
    EXPECT_EQ(
        refusal("time_s,voltage_v\n0,1\n,1\n2,1\n"),
        "c.csv:3: the time is missing; every row needs one; where the samples are even all the same, --sample-rate HZ "
        "reads them, where HZ is the instrument's rate");
    EXPECT_EQ(
        refusal("time_s,voltage_v\n0,1\n1,1\n2,1\n7,1\n8,1\n9,1\n"),
        "c.csv:5: time moves by 5 s here; it must rise in even steps (most are 1 s); where the samples are even all "
        "the same, --sample-rate 1 reads them");
    EXPECT_EQ(
        refusal("time_s,voltage_v\n0,1\n1,1\n2,1\n1,1\n2,1\n3,1\n"),
        "c.csv:5: time moves by -1 s here; it must rise in even steps (most are 1 s); where the samples are even all "
        "the same, --sample-rate 1 reads them");
    EXPECT_EQ(
        refusal("time_s,voltage_v\n0,1\n0,1\n0,1\n"),
        "c.csv:3: time moves by 0 s here; it must rise in even steps (most are 0 s); where the samples are even all "
        "the same, --sample-rate HZ reads them, where HZ is the instrument's rate");
}

TEST(CaptureFile, StampsThatJitterByLessThanHalfAStepAreRegular) {
    EXPECT_EQ(refusal("time_s,voltage_v\n0,1\n1.4,1\n1.7,1\n3,1\n"), "accepted");
}

TEST(CaptureFile, AFileThatIsNotThereOrAFolderIsNamed) {
    const ScratchDir scratch;
    EXPECT_EQ(readCapture(scratch.path() / "none.csv").error().code, ErrorCode::NotFound);
    EXPECT_EQ(readCapture(scratch.path()).error().code, ErrorCode::Io);
}

TEST(CaptureFile, WillNotWriteWhatCouldNotBeRead) {
    const ScratchDir scratch;
    const auto path = scratch.path() / "c.csv";
    EXPECT_FALSE(writeCapture(path, Capture{}));
    auto capture = recordOf({});
    capture.rate_hz = std::nan("");
    EXPECT_FALSE(writeCapture(path, capture));
    capture.rate_hz = 1e6;
    capture.channels.push_back({"current", "A", {1.0F}});
    EXPECT_FALSE(writeCapture(path, capture));
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(writeCapture(scratch.path() / "no" / "folder.csv", recordOf({})).error().code, ErrorCode::Io);
}

TEST(CaptureFile, FindsAChannelByNameOrColumn) {
    auto capture = recordOf({});
    EXPECT_EQ(findChannel(capture, "voltage").value(), 0U);
    EXPECT_EQ(findChannel(capture, " Voltage_V ").value(), 0U);
    EXPECT_FALSE(findChannel(capture, "current"));
}

TEST(CaptureFile, AShuntTurnsVoltsIntoAmperes) {
    auto capture = recordOf(biphasic(1e-3, 2));
    auto& channel = capture.channels[0];
    channel.high = 5;
    channel.low = -5;
    channel.lsb = 0.1;
    channel.offsetTolerance = 0.2;
    ASSERT_TRUE(convertShunt(capture, std::nullopt, Ohms(10)));
    EXPECT_EQ(channel.unit, "A");
    EXPECT_NEAR(channel.samples[2100], 0.2, 1e-6);
    EXPECT_DOUBLE_EQ(channel.high, 0.5);
    EXPECT_DOUBLE_EQ(channel.low, -0.5);
    EXPECT_DOUBLE_EQ(channel.lsb, 0.01);
    EXPECT_DOUBLE_EQ(channel.offsetTolerance, 0.02);
    EXPECT_FALSE(convertShunt(capture, std::nullopt, Ohms(10))) << "it is in amperes now";
}

TEST(CaptureFile, AShuntThatCannotBeMeantIsRefused) {
    auto capture = recordOf({});
    EXPECT_FALSE(convertShunt(capture, std::nullopt, Ohms(0)));
    EXPECT_FALSE(convertShunt(capture, std::nullopt, Ohms(std::nan(""))));
    EXPECT_FALSE(convertShunt(capture, "nothing", Ohms(1)));
    capture.channels.push_back(capture.channels[0]);
    capture.channels[1].name = "CH2";
    EXPECT_FALSE(convertShunt(capture, std::nullopt, Ohms(1))) << "which of the two?";
    ASSERT_TRUE(convertShunt(capture, "CH2", Ohms(1)));
    EXPECT_EQ(capture.channels[0].unit, "V");
}

}  // namespace
}  // namespace tacto::test
