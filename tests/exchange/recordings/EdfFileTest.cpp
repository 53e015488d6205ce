// What stands in an EDF or BDF header against the format, or against the file, is refused by name.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/exchange/edf/EdfFile.h"
#include "tests/exchange/recordings/Made.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using namespace test;
using testing::HasSubstr;

int counted(std::size_t, std::size_t k) { return static_cast<int>(k) - 5; }

Result<SignalFile> readMadeEdf(const EdfMade& made) {
    const ScratchDir folder;
    return readEdf(folder.write("a.edf", made.file(counted)));
}

TEST(EdfFile, SamplesHaveTheScaleOfTheHeader) {
    for (const bool bdf : {false, true}) {
        EdfMade made{.bdf = bdf, .reserved = bdf ? "BDF+C" : "EDF+C", .duration = "0.5"};
        made.signals = {{.physicalMin = "0", .physicalMax = "10", .digitalMin = "0", .digitalMax = "1000"},
                        {.label = "slow", .perRecord = "7"}};
        const auto file = readMadeEdf(made);
        ASSERT_TRUE(file) << file.error().message;
        ASSERT_EQ(file->streams.size(), 2U);
        const auto& slow = file->streams[1];
        const auto& fast = file->streams[0];
        EXPECT_DOUBLE_EQ(slow.rate_hz, 14);
        EXPECT_EQ(slow.channels[0].number, 2U);
        EXPECT_DOUBLE_EQ(fast.rate_hz, 200);
        EXPECT_EQ(fast.count, 300U);
        EXPECT_DOUBLE_EQ(fast.samples.t_s[299], 299 / 200.0);
        EXPECT_DOUBLE_EQ(fast.samples.values[299], 2.94);
    }
}

TEST(EdfFile, TheLowestDigitalValueIsAbsentInOurFilesAlone) {
    for (const bool ours : {false, true}) {
        EdfMade made{.recording = ours ? "Startdate 30-NOV-2026 X X Tactoscope_0.2.0_SIMULATED 00ff" : "by others"};
        made.reserved = ours ? "EDF+C" : "";
        made.signals = {{.digitalMin = "-5", .digitalMax = "400"}};
        const auto file = readMadeEdf(made);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(std::isnan(file->streams[0].samples.values[0]), ours);
        EXPECT_FALSE(std::isnan(file->streams[0].samples.values[1]));
        EXPECT_EQ(file->ours, ours);
        EXPECT_EQ(file->simulated.value_or(false), ours);
    }
}

struct Fault {
    const char* name;
    void (*spoil)(EdfMade& made);
    const char* named;
};
class EdfFaults : public testing::TestWithParam<Fault> {};

TEST_P(EdfFaults, AreRefusedByName) {
    EdfMade made;
    GetParam().spoil(made);
    const auto file = readMadeEdf(made);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::ParseError);
    EXPECT_THAT(file.error().message, HasSubstr(GetParam().named));
    EXPECT_THAT(file.error().message, HasSubstr("a.edf"));
}

INSTANTIATE_TEST_SUITE_P(
    All, EdfFaults,
    testing::Values(
        Fault{"discontinuous", [](EdfMade& m) { m.reserved = "EDF+D"; }, "EDF+D"},
        Fault{"calibrationZero", [](EdfMade& m) { m.signals[0].physicalMin = m.signals[0].physicalMax = "5.0"; },
              "calibration is 0"},
        Fault{"digitalRangeOfNothing", [](EdfMade& m) { m.signals[0].digitalMax = "-32768"; }, "digital maximum"},
        Fault{"digitalBeyond16Bits", [](EdfMade& m) { m.signals[0].digitalMax = "40000"; }, "40000"},
        Fault{"physicalOverflow",
              [](EdfMade& m) {
                  m.signals[0].physicalMin = "-1.7e308";
                  m.signals[0].physicalMax = "1.7e308";
              },
              "1.7e308"},
        Fault{"physicalNotANumber", [](EdfMade& m) { m.signals[0].physicalMin = "nan"; }, "physical minimum"},
        Fault{"manyRecords", [](EdfMade& m) { m.records = "99999999"; }, "cut short"},
        Fault{"unfinished", [](EdfMade& m) { m.records = "-1"; }, "number of records"},
        Fault{"longRecords", [](EdfMade& m) { m.signals[0].perRecord = "99999999"; }, "samples in a record"},
        Fault{"longerThanTheFile", [](EdfMade& m) { m.signals[0].perRecord = "4000000"; }, "cut short"},
        Fault{"noDuration", [](EdfMade& m) { m.duration = "0"; }, "duration"},
        Fault{"durationOfWords", [](EdfMade& m) { m.duration = "1,5"; }, "1,5"},
        Fault{"noSignals", [](EdfMade& m) { m.signalCount = "0"; }, "number of signals"},
        Fault{"moreSignalsThanThere",
              [](EdfMade& m) {
                  m.signalCount = "600";
                  m.headerBytes = "153856";
              },
              "ends in its header"},
        Fault{"anotherHeaderSize", [](EdfMade& m) { m.headerBytes = "512"; }, "size of the header"}),
    [](const auto& info) { return info.param.name; });

TEST(EdfFile, CutShortOrLongerIsRefused) {
    const auto whole = EdfMade().file(counted);
    const ScratchDir folder;
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, std::size_t{500}, whole.size() - 1}) {
        const auto cut = readEdf(folder.write("cut.edf", whole.substr(0, length)));
        ASSERT_FALSE(cut) << length;
        EXPECT_THAT(cut.error().message, HasSubstr(fmt::format("{} bytes", length)));
    }
    EXPECT_FALSE(readEdf(folder.write("long.edf", whole + "x")));
}

}  // namespace
}  // namespace tacto
