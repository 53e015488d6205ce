// Tables of further makers' oscilloscopes and programs. The headers are as the named sources show or describe them; the
// rows are invented.
#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/Random.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

CaptureReading madeOf(std::string_view text) {
    auto read = parseCapture(text, "t.csv");
    EXPECT_TRUE(read) << (read ? "" : read.error().message) << "\n" << text;
    return read ? std::move(*read) : CaptureReading{};
}

std::string saidOf(std::string_view text) {
    const auto read = parseCapture(text, "t.csv");
    return read ? "accepted" : read.error().message;
}

/// The expected content of a table: format, rate and start, and each channel's name, unit and samples.
struct Expected {
    std::string format;
    double rate_hz;
    double start_s;
    struct Channel {
        std::string name;
        std::string unit;
        std::vector<float> samples;
    };
    std::vector<Channel> channels;
};

void expectRead(const Expected& expected, std::string_view text) {
    const auto read = madeOf(text);
    EXPECT_EQ(read.formatId, expected.format) << text;
    EXPECT_NEAR(read.capture.rate_hz / expected.rate_hz, 1, 1e-6) << text;
    EXPECT_NEAR(read.capture.start_s, expected.start_s, 1e-3 / expected.rate_hz) << text;
    ASSERT_THAT(read.capture.channels, SizeIs(expected.channels.size())) << text;
    for (std::size_t c = 0; c < expected.channels.size(); ++c) {
        const auto& channel = read.capture.channels[c];
        EXPECT_EQ(channel.name, expected.channels[c].name) << text;
        EXPECT_EQ(channel.unit, expected.channels[c].unit) << text;
        EXPECT_THAT(channel.samples, ::testing::Pointwise(::testing::FloatEq(), expected.channels[c].samples)) << text;
        EXPECT_EQ(channel.low, channel.high) << "a table states no input range";
    }
}

// github.com/scottprahl/RigolWFM, tests/files/wfm/DS1204B-F.csv and DS1204B-A-original.csv: the times have no name, and
// only the rows end in a comma and a blank.
TEST(CsvMakers, RigolDs1000b) {
    expectRead({"csv-rigol", 250e3, -16.384e-3, {{"CH2", "V", {14.8F, 14.8F, 20.8F}}, {"CH4", "V", {14.4F, 0, 13.6F}}}},
               ",CH2,CH4\r\nSecond,Volt,Volt\r\n-1.63840e-02,1.48e+01,1.44e+01, \r\n-1.63800e-02,1.48e+01,0.00e+00, "
               "\r\n-1.63760e-02,2.08e+01,1.36e+01, \r\n");
    expectRead({"csv-rigol", 1e3, 0, {{"CH1", "V", {1, 2}}, {"CH2", "V", {3, 4}}}},
               ",CH1,CH2,\nSecond,Volt,Volt,\n0,1,3,\n1e-3,2,4,\n");
}

// DS1102D-A.csv of the same project: X in seconds, units in the names of the columns.
TEST(CsvMakers, RigolDs1000d) {
    expectRead(
        {"csv-rigol", 1 / 10.01e-6, -4.688e-3, {{"CH 1", "V", {8.08F, 4.88F, 0.28F}}, {"CH 2", "V", {8.4F, 8.4F, 8}}}},
        "X,CH 1 (V),CH 2 (V)\n-0.00468800,8.08,8.40\n-0.00467799,4.88,8.40\n-0.00466798,0.28,8\n");
}

// Header of a DS1102E as public readers of laboratory files recognise it; files NewFile1.csv.
TEST(CsvMakers, RigolDs1000eWithItsChannelsInBrackets) {
    expectRead({"csv-rigol", 1e6, -1e-6, {{"CH1", "V", {1, 2}}, {"CH2", "V", {3, 4}}}},
               "Time,X(CH1),X(CH2),\nSecond,Volt,Volt,\n-1.0e-06,1,3,\n0.0e+00,2,4,\n");
}

// RigolWFM's DS1052E.csv: UltraScope, Rigol's program for the PC. The names are in the line of "Channel Data".
TEST(CsvMakers, RigolUltraScope) {
    expectRead({"csv-rigol", 500e6, 0, {{"CH 1", "V", {1.72F, -4.52F, -4.6F}}, {"CH 2", "V", {9.92F, 9.92F, 9.92F}}}},
               "\"Number of Data points =\",3,\n\"Time Scale (s/DIV) =\",1E-7,\n\"Time Delay (s) =\",0,\n"
               "\"Sampling Frequency (Hz)=\",500000000,\n\"Trigger Mode = \",0,\n\"Channel Data\",\"CH 1\",\"CH 2\"\n"
               "\"Attenuation = \",10,1\n\"Pos (V) = \",0.2,-6\n\"Inverted = \",\"NO\",\"NO\"\n"
               "\"Time (s)\",\"Voltage (V)\",\"Voltage (V)\"\n0,1.72,9.92\n2E-9,-4.52,9.92\n4E-9,-4.6,9.92\n");
}

// A public analysis of MSO5074 files: "Save Screen" writes stamps; "Save Memory" writes start and increment in its only
// header line.
TEST(CsvMakers, RigolMso5000) {
    expectRead({"csv", 1e6, -1e-6, {{"CH1", "V", {1, 2, 3}}}}, "Time(s),CH1(V)\n-1e-06,1\n0,2\n1e-06,3\n");
    expectRead({"csv-rigol", 500e3, -25, {{"CH1", "V", {0.5F, 0.25F, 1}}}},
               "CH1(V),t0 = -25s, tInc = 2e-06s,\n0.5,\n0.25,\n1,\n");
    expectRead({"csv-rigol", 2e6, 0.01, {{"CH1", "V", {1, 2}}, {"CH3", "A", {3, 4}}}},
               "CH1(V),CH3(A),t0=10ms,tInc=0.5us,\n1,3,\n2,4,\n");
    EXPECT_EQ(saidOf("CH1(V),t0 = 0s, tInc = -2e-06s,\n0.5,\n0.25,\n"),
              "t.csv: the time between samples is 't0 = 0s, tInc = -2e-06s'; a finite one above 0 was expected; "
              "--sample-rate HZ reads it, where HZ is the instrument's rate");
    EXPECT_THAT(saidOf("CH1(V),t0=0s,tInc=1s,CH2(V),t0=0s,tInc=1s,\n0.5,\n0.25,\n"),
                HasSubstr("all channels before one t0 and one tInc were expected"));
}

// github.com/MartinCowen/SigFyCSV, README: output of Siglent's bin2csv, with a rate instead of the interval.
TEST(CsvMakers, SiglentWithASampleRate) {
    expectRead({"csv-siglent", 100e6, -70e-6, {{"CH1", "V", {-0.194F, -0.192F, -0.196F}}}},
               "Record Length,Analog:3\nSample Rate,100000000.0\nVertical Scale,CH1: 0.05\n"
               "Vertical Offset,CH1:0.00000\nHorizontal Scale, 0.000010000\nSecond,Volt\n"
               "-0.00007000000,-0.19400\n-0.00006999000,-0.19200\n-0.00006998000,-0.19600\n");
}

// From the source of the same project: files saved on the instrument have two header lines.
TEST(CsvMakers, SiglentSavedOnTheInstrument) {
    expectRead({"csv-siglent", 1e6, 0, {{"CH1", "V", {1, 2}}, {"CH3", "V", {3, 4}}}},
               "Source,CH1,CH3\nSecond,Volt,Volt\n0.000000,1,3\n0.000001,2,4\n");
    expectRead({"csv-siglent", 1e6, 0, {{"CH1", "V", {1, 2}}, {"CH2", "V", {3, 4}}}},
               "Second,Volt,Volt\n0.000000,1,3\n0.000001,2,4\n");
}

// A collection of ADS1202CL+ files (Atten, made by Siglent). The stated sample interval does not fit the rows.
TEST(CsvMakers, AttenAds1000) {
    const auto read = madeOf(
        "Record Length,3\nSample Interval,CH1:0.0000000000013 CH2:0.0000000000013\nVertical Units,CH1:V CH2:V,,\n"
        "Vertical Scale,CH1:0.05 CH2:0.10,,\nHorizontal Units,s,,\nModel Number,ADS1202CL+,,\n\nSource,CH1,CH2\n"
        "Second,Volt,Volt\n-0.00000001680,0.19200,0.01200\n-0.00000000880,0.24200,0.01200\n"
        "-0.00000000080,0.24200,0.01300\n");
    EXPECT_EQ(read.formatId, "csv-siglent");
    EXPECT_NEAR(read.capture.rate_hz, 125e6, 1);
    ASSERT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_EQ(read.capture.channels[1].name, "CH2");
    EXPECT_EQ(read.capture.channels[1].unit, "V");
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("the stamps were taken")));
}

// A description of an MDO3014 file: the digital channels have their own table on the right.
TEST(CsvMakers, TektronixMdoWithDigitalChannels) {
    const auto read = madeOf(
        "Model,MDO3014\nFirmware Version,1.20\n\nWaveform Type,ANALOG,,Waveform Type,DIGITAL,\n"
        "Point Format,Y,,Point Format,Y,\nHorizontal Units,s,,Horizontal Units,s,\nSample Interval,4e-09,,Sample "
        "Interval,4e-09,\nRecord Length,2,,Record Length,2,\nProbe Attenuation,10,,,,\nVertical Units,V,,Vertical "
        "Units,V,V\nVertical Scale,2,,,,\n,,,,,\nLabel,PCLK,,Label,FV,LV\nTIME,CH1,,TIME,D11,D10\n"
        "-4.0e-09,1.5,,-4.0e-09,0,1\n0.0e+00,2.5,,0.0e+00,1,1\n");
    EXPECT_EQ(read.formatId, "csv-tektronix");
    EXPECT_NEAR(read.capture.rate_hz, 250e6, 1);
    ASSERT_THAT(read.capture.channels, SizeIs(1));
    EXPECT_EQ(read.capture.channels[0].name, "CH1");
    EXPECT_EQ(read.capture.channels[0].unit, "V");
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(1.5F, 2.5F));
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("the columns from 4 on have times of their own")));
}

// A decoder of MSO/DPO2000 files quotes this header. "Peak Detect" is a second value of the same samples.
TEST(CsvMakers, TektronixDpo2000) {
    expectRead({"csv-tektronix", 312500, -0.2, {{"CH1", "V", {0.2F, 0.4F}}, {"CH1 Peak Detect", "V", {0, 0.6F}}}},
               "Model,DPO2012B\nFirmware Version,1.35\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,0.04,\n"
               "Sample Interval,3.2e-06,\nFilter Frequency,4.2e+07,\nRecord Length,2,\nGating,0.0% to 100.0%,\n"
               "Probe Attenuation,1,\nVertical Units,V,\nVertical Offset,0,\nVertical Scale,5,\nLabel,,\n"
               "TIME,CH1,CH1 Peak Detect\n-2.0000000e-01,0.2,0\n-1.9999680e-01,0.4,0.6\n");
}

// The five columns of Micsig's files, as in two public readers and a writer of such files; keys: Micsig ATO1000 manual,
// manualshive.com/en/manual/micsig/ato1000-series/1789851?page=136.
TEST(CsvMakers, Micsig) {
    expectRead({"csv-micsig", 1e6, 0, {{"CH1", "V", {0.1F, 0.2F, 0.3F}}}},
               "ProID,Info,,time,Vol.,\nRecord Length,3,,0.0,0.1,\nSample Interval,1.0us,,0.000001,0.2,\n"
               "Vertical Units,V,,0.000002,0.3,\n");
    expectRead({"csv-micsig", 1e6, 0, {{"CH2", "V", {0.1F, 0.2F, 0.3F}}}},
               "ProID,Info,,time,Value,\nModel,T,,,,\nSource,CH2,,,,\nVertical Units,V,,,,\n,,,0.0,0.1,\n"
               ",,,0.000001,0.2,\n,,,0.000002,0.3,\n");
    EXPECT_THAT(saidOf("ProID,Info,,time,Vol.,,ProID,Info,,time,Vol.,\nModel,T,,0,1,,Model,T,,0,1,\n"
                       ",,,1,1,,,,,1,1,\n"),
                HasSubstr("export each channel by itself"));
}

// A public reader of segmented InfiniiVision files expects this first line.
TEST(CsvMakers, KeysightSegmentsAreReadWhenThereIsOne) {
    const std::string rows = "-1e-03,1,2\n0,3,4\n1e-03,5,6\n";
    expectRead({"csv-keysight", 1e3, -1e-3, {{"CH1", "V", {1, 3, 5}}, {"CH2", "V", {2, 4, 6}}}},
               "points/segment = 3\nx-axis,1,2\nsecond,Volt,Volt\n" + rows);
    EXPECT_EQ(saidOf("points/segment = 3\nx-axis,1,2\nsecond,Volt,Volt\n" + rows + rows),
              "t.csv: 6 rows, where the header announces 3: one segment per file was expected; export each by itself");
}

// Infiniium 90000 Programmer's Reference, "CSV and TSV Header Format":
// manualslib.com/manual/529287/Agilent-Technologies-Infiniium-90000-Series.html?page=1153.
TEST(CsvMakers, KeysightInfiniium) {
    const std::string head =
        "Revision:,0\nType:,raw\nStart:,0\nPoints:,3\nCount:,1\nXDispRange:,1.0E-06\nXDispOrg:,-5.0E-07\n"
        "XInc:,5.0E-11\nXOrg:,-1.0E-10\nYDispRange:,8\nYDispOrg:,-4\nYInc:,1\nYOrg:,0\nXUnits:,Second\nYUnits:,Volt\n"
        "Frame:,DSO9404A:MY0\nData:,\n";
    expectRead({"csv-keysight", 20e9, -1e-10, {{"CH1", "V", {0.1F, 0.2F, 0.3F}}}}, head + "0.1\n0.2\n0.3\n");
    expectRead({"csv-keysight", 20e9, -1e-10, {{"CH1", "V", {0.1F, 0.2F, 0.3F}}}},
               head + "-1.0E-10,0.1\n-5.0E-11,0.2\n0.0,0.3\n");
    EXPECT_THAT(saidOf(head + "1,2,3\n4,5,6\n"), HasSubstr("3 columns for 1 sources"));
}

// LeCroy 9300C manual, "ASCII Waveform Export": easymanua.ls/lecroy/9300c-series/manual?p=257; first lines of
// WaveRunner files, as quoted in many public readers.
TEST(CsvMakers, LeCroy) {
    for (const auto* text :
         {"LECROYWR64Xi,57936,Waveform\nSegments,1,SegmentSize,3\nSegment,TrigTime,TimeSinceSegment1\n"
          "#1,03-May-2017 11:41:40,0                 \nTime,Ampl\n-1e-06,0.5\n0,1.5\n1e-06,2.5\n",
          "LECROYWR625Zi;61392;Waveform\nSegments;1;SegmentSize;3\nSegment;TrigTime;TimeSinceSegment1\n"
          "#1;03-May-2017 11:41:40;0\nTime;Ampl\n-0,000001;0,5\n0;1,5\n0,000001;2,5\n"}) {
        expectRead({"csv-lecroy", 1e6, -1e-6, {{"Ampl", "", {0.5F, 1.5F, 2.5F}}}}, text);
        EXPECT_THAT(madeOf(text).warnings, ElementsAre(HasSubstr("does not state the unit of column 'Ampl'")));
        const auto volts = accepted(parseCapture(text, "t.csv", {.units = {{"Ampl", "V"}}}));
        EXPECT_EQ(volts.capture.channels[0].unit, "V");
    }
    EXPECT_EQ(saidOf("LECROYWP715Zi-A,57936,Waveform\nSegments,1000,SegmentSize,1002\n"
                     "Segment,TrigTime,TimeSinceSegment1\n#1,03-May-2017 11:41:40,0\nTime,Ampl\n0,1\n1,1\n"),
              "t.csv:2: 1000 segments; one per file was expected: export each by itself");
}

// README of a DSO5202P analyser and parsers of DSO2000 files quote these keys.
TEST(CsvMakers, HantekWithTimes) {
    expectRead({"csv-hantek", 5e3, 2e-4, {{"CH1", "V", {4.68F, 4.6F, 0.04F}}}},
               "#timebase=4000000000(ps)\n,#voltbase=1000000(uV)\n#size=3\n2.00E-04,4.680\n4.00E-04,4.600\n"
               "6.00E-04,0.040\n");
    EXPECT_THAT(saidOf("#timebase=4(ns)\n,#threshold=1500(mv)\n#size=2\n0,5\n1,6\n"),
                HasSubstr("this channel is a logic analyzer's; an analog channel was expected"));
}

// Electronicayciencia, 2 February 2020: the channels follow each other, separated only by comments.
TEST(CsvMakers, HantekWithoutTimes) {
    const std::string first = "# CHANNEL:CH1\n# CLOCK=20.0uS\n# SIZE=3\n# UNITS:V\n\n-1.5686\n0\n0.9412\n";
    expectRead({"csv-hantek", 50e3, 0, {{"CH1", "V", {-1.5686F, 0, 0.9412F}}}}, first);
    expectRead({"csv-hantek", 50e3, 0, {{"CH1", "V", {-1.5686F, 0, 0.9412F}}}},
               "#CHANNEL:CH1\n#CLOCK=20.0uS\n#SIZE=3\n#UNITS:V\n\n-1.5686\n0\n0.9412\n");
    EXPECT_EQ(saidOf(first + "\n\n# CHANNEL:CH2\n# CLOCK=20.0uS\n# SIZE=3\n# UNITS:V\n\n2.6\n2.5\n2.4\n"),
              "t.csv: 6 rows, where the header announces 3: one channel per file was expected; export each by itself")
        << "two channels are never one record";
    EXPECT_THAT(saidOf("# CHANNEL:CH1\n# CLOCK=20.0uS\n1\n2\n# CHANNEL:CH2\n# CLOCK=20.0uS\n3\n4\n"),
                HasSubstr("no number of samples"));
}

// github.com/h-elsner/OwonOszi, for an HDS242; files of a DOS1102S have the same keys.
TEST(CsvMakers, Owon) {
    expectRead({"csv-owon", 5e6, 0, {{"CH1", "V", {-0.6F, -0.62F, 0.04F}}}},
               "Channel\t\t\t  :,CH1\nFrequency\t\t\t  :,F=1.498kHz\nPeriod \t\t\t  :,T=667.4us\n"
               "PK-PK\t\t\t\t  :,Vpp=1.280V\nVertical pos\t\t  :,0.00mV\nProbe attenuation\t  :,1X\n"
               "Voltage per ADC value:,20.00mV\nTime interval\t\t  :,0.20uS\n\nindex,CH1_Voltage(mV)\n0,-600.00\n"
               "1,-620.00\n2,40.00\n");
    expectRead({"csv-owon", 5e6, 0, {{"CH1", "V", {1, 2}}, {"CH2", "V", {3, 4}}}},
               "Channel :,CH1,CH2\nTime interval :,0.20000us\nindex,CH1_Voltage(mV),CH2_Voltage(mV)\n0,1000,3000\n"
               "1,2000,4000\n");
    EXPECT_EQ(
        saidOf("Time interval :,none\nindex,CH1_Voltage(mV)\n0,1\n1,2\n"),
        "t.csv: the time between samples is 'none'; a finite one above 0 was expected; --sample-rate HZ reads it, "
        "where HZ is the instrument's rate");
}

// Keys and columns as in four versions of a public reader (OpenQlab); meaning of Detail and Fast:
// manualshive.com/en/manual/texio/dcs-9700-series/1097547?page=138.
TEST(CsvMakers, GwInstek) {
    const auto head = [](std::string_view mode) {
        return "Format,1.0B,\nMemory Length,3,Memory Length,3,\nSource,CH1,Source,CH2,\nVertical Units,V,Vertical "
               "Units,A,\nVertical Scale,5.0E-01,Vertical Scale,1.0E+01,\nHorizontal Units,S,Horizontal Units,S,\n"
               "Horizontal Scale,1.0E-05,Horizontal Scale,1.0E-05,\nHorizontal Position,2.0E-06,Horizontal "
               "Position,2.0E-06,\nSampling Period,1.0E-06,Sampling Period,1.0E-06,\nMode," +
               std::string(mode) + ",Mode," + std::string(mode) + ",\nWaveform Data,\n";
    };
    expectRead({"csv-gwinstek", 1e6, -1e-6, {{"CH1", "V", {0.5F, 0.6F, 0.7F}}, {"CH2", "A", {1, 2, 3}}}},
               head("Detail") + "-1.0E-06,0.5,-1.0E-06,1,\n0.0E+00,0.6,0.0E+00,2,\n1.0E-06,0.7,1.0E-06,3,\n");
    expectRead({"csv-gwinstek", 1e6, -48e-6, {{"CH1", "V", {0.5F, -0.5F, 0.02F}}, {"CH2", "A", {10, 20, 0.4F}}}},
               head("Fast") + "25,,25,\n-25,,50,\n1,,1,\n");
    EXPECT_THAT(saidOf(head("Other") + "25,,25,\n-25,,50,\n"), HasSubstr("Detail or Fast was expected"));
}

// DL1540L: manualshive.com/ru/manual/yokogawa/dl-1520/911604?page=198; DLM3000 ("HResolution", "HOffset"):
// easymanua.ls/yokogawa/dlm3024/manual?p=273.
TEST(CsvMakers, Yokogawa) {
    expectRead({"csv-yokogawa", 100e6, 0, {{"Ch1", "V", {-42, 38}}, {"Ch2", "V", {-2, -2}}}},
               "\"Model\", \"DL1540L\"\n\"BlockSize\", 2\n\"BlockNumber\", 1\n\"DisplayPointNo.\", 6\n\"Date\", "
               "\"95/12/01\"\n\"Time\", \"18:17:11\"\n\"SampleRate\", 100,\"MHz\"\n\"TraceName\", \"Ch1\",\"Ch2\"\n"
               "\"Unit\", \"V\",\"V\"\n\"MediaNo.\", 1\n-4.200e+01, -2.000e+00\n3.800e+01, -2.000e+00\n");
    const std::string head =
        "\"Header Size\",16\n\"Model Name\",\"DLM3024\"\n\"Comment\",\"\"\n\"BlockNumber\",2\n\"TraceName\",\"CH1\","
        "\"CH3\"\n\"BlockSize\",2,2\n\"VUnit\",\"V\",\"A\"\n\"SampleRate\",1.25E+06,1.25E+06\n\"HResolution\",8.0E-07,"
        "8.0E-07\n\"HOffset\",-1.6E-06,-1.6E-06\n\"HUnit\",\"s\",\"s\"\n\"Date\",\"2020/01/01\"\n\"Time\",\"1:2:3\"\n";
    expectRead({"csv-yokogawa", 1.25e6, -1.6e-6, {{"CH1", "V", {1, 2}}, {"CH3", "A", {3, 4}}}}, head + ",1,3\n,2,4\n");
    EXPECT_THAT(saidOf(head + ",1,3\n,2,4\n,1,3\n,2,4\n"), HasSubstr("one block per file was expected"));
}

// libsigrok, src/output/csv.c; `time` counts in whole nanoseconds at 50 MHz.
TEST(CsvMakers, Sigrok) {
    const std::string head =
        "; CSV generated by libsigrok 0.5.2\n; from Demo device on Mon Nov 23 03:25:18 2026\n"
        "; Channels (2/2): SDA, SCL\n; Samplerate: 50 MHz\n";
    expectRead({"csv-sigrok", 50e6, 0, {{"SDA", "V", {4.96F, 5.12F}}, {"SCL", "A", {4.92F, 5.08F}}}},
               head + "V,A\n4.96,4.92\n5.12,5.08\n");
    expectRead({"csv-sigrok", 50e6, 0, {{"SDA", "", {1, 0, 1}}, {"SCL", "", {0, 0, 1}}}},
               head + "nanoseconds,logic,logic\n0,1,0\n20,0,0\n40,1,1\n");
    expectRead({"csv-sigrok", 50e6, 0, {{"SDA", "", {1, 2, 3}}, {"SCL", "", {4, 5, 6}}}},
               head + "Time,SDA,SCL,Trigger\n0,1,4,0\n20,2,5,1\n40,3,6,0\n");
    expectRead({"csv-sigrok", 50e6, 0, {{"SDA", "", {1, 2}}, {"SCL", "", {4, 5}}}}, head + "1,4\n2,5\n");
    EXPECT_THAT(saidOf(head + "nanoseconds,logic,logic\n0,1,0\n20,0,0\n40,1,0\n200,1,1\n220,1,1\n240,1,1\n"),
                HasSubstr("it must rise in even steps"))
        << "rows that were left out because nothing changed are not there";
    EXPECT_THAT(saidOf(head + "0,1,4\n20,2,5\n"), HasSubstr("3 columns for 2 channels"));
    EXPECT_THAT(saidOf("; CSV generated by libsigrok 0.5.2\n; Channels (1/1): A\nV\n1\n2\n"),
                HasSubstr("its sampling rate is ''; a frequency above 0 was expected"));
}

// DSView, a program derived from sigrok; quoted in a generator of its files.
TEST(CsvMakers, DsView) {
    expectRead({"csv", 100e6, 0, {{"0", "", {1, 0}}, {"1", "", {0, 0}}}},
               "; CSV generated by DSView\n; Channels (2/16)\n; Sample rate: 100 MHz\n; Sample count: 2 Samples\n"
               "Time(s),0,1\n0.00000000E+00,1,0\n1.00000000E-08,0,0\n");
}

// Readers of RTB2000 files quote the first line; R&S RTM manual:
// manualshive.com/en/manual/rohde-and-schwarz/rtm20-series/1478072?page=243.
TEST(CsvMakers, RohdeSchwarz) {
    expectRead({"csv", 1e6, -1e-6, {{"C1", "V", {0.1F, 0.2F}}, {"C2", "A", {3e-3F, 4e-3F}}}},
               "in s,C1 in V,C2 in mA\n-1.0000000E-06,1.0E-01,3.0\n0.0E+00,2.0E-01,4.0\n");
    // Batronix Magnova, as in a public reader.
    expectRead({"csv", 1e6, 0, {{"CH1", "V", {1, 2}}}}, "time in s,CH1 in V\n0,1\n1e-06,2\n");
    // Samples of an RTO ("x.Wfm.csv"; the keys are in a second file): no names, no times.
    EXPECT_THAT(saidOf("-0.031620555\n0\n0.015810277\n"), HasSubstr("; --sample-rate HZ reads it"));
    const auto read = accepted(parseCapture("-0.031620555\n0\n0.015810277\n", "t.csv", {.rate = Hertz(1e9)}));
    EXPECT_EQ(read.capture.samples(), 3U);
}

// github.com/ngscopeclient/scopehal, issue 429, and the conditions in its importer.
TEST(CsvMakers, DigilentWaveForms) {
    expectRead({"csv", 1e6, -1e-6, {{"Channel 1", "V", {0, 1, 2}}, {"Channel 2", "V", {0.01F, 0.02F, 0.03F}}}},
               "#Digilent WaveForms Oscilloscope Acquisition\n#Device Name: Discovery2\n#Serial Number: "
               "SN:210321A0000\n#Date Time: 2026-09-28 10:00:00.000\n#Sample rate: 1e+06Hz\n#Samples: 3\n\n"
               "Time (s),Channel 1 (V),Channel 2 (V)\n-1e-06,0,0.01\n0,1,0.02\n1e-06,2,0.03\n");
}

// pastebin.com/et1AHHqB: one row per change, so not an evenly sampled record (CsvChangesTest.cpp).
TEST(CsvMakers, SaleaeLogicChangesAreLevels) {
    const auto read = madeOf(
        "Time [s],Channel 0,Channel 1\n289.692741059,0,0\n289.693153750,1,0\n289.693153875,0,0\n"
        "289.693166125,1,1\n");
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("it lists 3 changes of level and not samples")));
    EXPECT_NEAR(static_cast<double>(read.capture.samples()) / read.capture.rate_hz, 425.066e-6 + 125e-9, 1e-9);
    const auto& first = read.capture.channels[0].samples;
    EXPECT_EQ(std::ranges::count_if(first, [](float level) { return level > 0.5F; }), 200) << "two levels of 125 ns";
    expectRead({"csv", 1e3, 0, {{"Channel 0", "", {0.5F, 0.6F}}}}, "Time [s],Channel 0\n0.000,0.5\n0.001,0.6\n");
}

// ADALM2000 (Scopy): a column counts the samples, next to their times. OpenHantek: units after a slash.
TEST(CsvMakers, OthersThatArePlainTables) {
    const auto scopy = madeOf("Sample,Time(S),CH1(V)\n0,0.0,1\n1,0.001,2\n2,0.002,3\n");
    EXPECT_NEAR(scopy.capture.rate_hz, 1e3, 1e-6);
    ASSERT_THAT(scopy.capture.channels, SizeIs(1));
    EXPECT_THAT(scopy.warnings, ElementsAre(HasSubstr("column 'Sample' counts the rows and was left out")));
    const auto asked =
        accepted(parseCapture("Sample,Time(S),CH1(V)\n0,0.0,1\n1,0.001,2\n", "t.csv", {.columns = {"Sample"}}));
    EXPECT_EQ(asked.capture.channels[0].name, "Sample");
    expectRead({"csv", 1e3, 0, {{"CH1", "V", {0.5F, 1.5F}}, {"CH2", "A", {1, 2}}}},
               "\"t / s\";\"CH1 / V\";\"CH2 / mA\"\n0;0,5;1000\n0,001;1,5;2000\n");
    expectRead({"csv", 1e3, 0, {{"CH1", "V", {1, 2}}}}, "Time(s),CH1V\n0,1\n0.001,2\n");
    expectRead({"csv", 1e3, 0, {{"V1", "V", {1, 2}}}}, "Operator,me\nTime,12:30\ntime_ms,V1_v\n0,1\n1,2\n");
}

// A row that stands before the keys leaves no header line.
TEST(CsvMakers, KeysThatStandBesideRowsAlone) {
    constexpr std::array kKeys{"TraceName", "BlockSize", "HResolution", "SampleRate", "VUnit",   "XInc",
                               "XOrg",      "Points",    "Source",      "YUnits",     "Segments"};
    Random random(51, "tables of keys");
    for (int n = 0; n < 3000; ++n) {
        std::vector<std::string> lines{random.below(2) == 0 ? ",1" : "1,2"};
        for (const auto* key : kKeys) {
            if (random.below(8) != 0) lines.push_back(fmt::format("{},{}", key, random.below(3)));
        }
        for (std::size_t i = lines.size() - 1; i > 1; --i) std::swap(lines[i], lines[1 + random.below(i)]);
        const auto text = fmt::format("{}\na,1\n", fmt::join(lines, "\n"));
        EXPECT_THAT(saidOf(text), AnyOf(Eq("accepted"), StartsWith("t.csv:"))) << text;
    }
}

}  // namespace
}  // namespace tacto::test
