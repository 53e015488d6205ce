// The list of formats: the order of recognition, the writing formats, and the message if no format recognises a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/CaptureFormats.h"
#include "tests/measure/SyntheticPulses.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::ElementsAre;

TEST(CaptureFormats, TheContentDecidesNotTheName) {
    const ScratchDir scratch;
    const auto formats = ownCaptureFormats();
    const auto path = scratch.write("called.wav", "x-axis,1\nsecond,Volt\n0,1\n1,2\n");
    const auto read = accepted(formats->read(path));
    EXPECT_EQ(read.formatId, "csv-keysight");
    EXPECT_EQ(read.formatName, "Keysight CSV");
}

TEST(CaptureFormats, AnotherFormatCanBeNamedAndAnUnknownOneIsRefused) {
    const ScratchDir scratch;
    const auto formats = ownCaptureFormats();
    const auto path = scratch.write("t.csv", "time_s,a\n0,1\n1,2\n");
    EXPECT_EQ(formats->read(path).value().formatId, "csv");
    EXPECT_THAT(formats->read(path, {.format = "csv-rigol"}), test::refused(ErrorCode::ParseError));
    EXPECT_THAT(
        formats->read(path, {.format = "dat"}),
        test::refusedSaying(testing::StrEq(
            "format 'dat' is not known; known are wav, isf, csv-rigol, csv-siglent, csv-tektronix, csv-keysight, "
            "csv-picoscope, "
            "csv-lecroy, csv-hantek, csv-owon, csv-gwinstek, csv-yokogawa, csv-micsig, csv-sigrok, csv-labview, csv")));
}

TEST(CaptureFormats, SkippedRowsAreNotAskedWhoseTheyAre) {
    const ScratchDir scratch;
    const auto path = scratch.write("t.csv", "exported\nby hand\nx-axis,1\nsecond,Volt\n0,1\n1,2\n");
    const auto read = accepted(ownCaptureFormats()->read(path, {.skipRows = 2}));
    EXPECT_EQ(read.formatId, "csv-keysight");
}

TEST(CaptureFormats, WhatNoFormatRecognisesIsRefusedWithWhatIsKnown) {
    const ScratchDir scratch;
    const auto read = ownCaptureFormats()->read(scratch.write("t.bin", std::string_view("\x01\0\x02", 3)));
    ASSERT_THAT(read, test::refused(ErrorCode::ParseError, "Rigol CSV"));
    EXPECT_EQ(ownCaptureFormats()->read(scratch.path() / "none.csv").error().code, ErrorCode::NotFound);
    EXPECT_EQ(ownCaptureFormats()->read(scratch.path()).error().code, ErrorCode::Io);
}

TEST(CaptureFormats, WritesBySuffixAndLeavesNothingBehindThatFailed) {
    const ScratchDir scratch;
    const auto formats = ownCaptureFormats();
    EXPECT_THAT(formats->writableSuffixes(), ElementsAre(".wav", ".csv"));
    EXPECT_TRUE(formats->knowsSuffix("A.ISF"));
    EXPECT_FALSE(formats->knowsSuffix("readme.txt"));
    const auto capture = recordOf(biphasic(1e-3), {.rate_hz = 1e5, .samples = 1000});
    for (const auto* name : {"a.csv", "a.WAV"}) {
        ASSERT_TRUE(formats->write(scratch.path() / name, capture)) << name;
        EXPECT_EQ(formats->read(scratch.path() / name)->capture.samples(), 1000U) << name;
    }
    EXPECT_THAT(formats->write(scratch.path() / "a.isf", capture),
                test::refusedSaying("captures are not written as '.isf'; .wav, .csv are"));
    EXPECT_FALSE(formats->write(scratch.path() / "b.csv", Capture{}));
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(scratch.path())) ++files;
    EXPECT_EQ(files, 2U);
}

}  // namespace
}  // namespace tacto::test
