#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <random>

#include "core/formats/CaptureFormats.h"
#include "tests/measure/SyntheticPulses.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string little(std::uint64_t value, std::size_t bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
    return text;
}

struct Shape {
    std::uint32_t kind = 1;
    std::uint32_t bits = 16;
    std::uint32_t channels = 1;
    std::uint32_t rate_hz = 48000;
    bool extensible = false;
};
std::string wav(const Shape& s, const std::string& data, std::uint32_t announced) {
    std::string format = little(s.extensible ? 0xFFFE : s.kind, 2) + little(s.channels, 2) + little(s.rate_hz, 4) +
                         little(s.rate_hz * s.channels * s.bits / 8, 4) + little(s.channels * s.bits / 8, 2) +
                         little(s.bits, 2);
    constexpr std::string_view kRestOfGuid("\0\0\0\0\x10\0\x80\0\0\xAA\0\x38\x9B\x71", 14);
    if (s.extensible) {
        format += little(22, 2) + little(s.bits, 2) + little(0, 4) + little(s.kind, 2);
        format += kRestOfGuid;
    }
    const auto rest = "WAVEfmt " + little(format.size(), 4) + format + "junk" + little(3, 4) + "abc" + '\0' + "data" +
                      little(announced, 4) + data;
    return "RIFF" + little(rest.size(), 4) + rest;
}
std::string wav(const Shape& s, const std::string& data) {
    return wav(s, data, static_cast<std::uint32_t>(data.size()));
}

Result<CaptureReading> readWav(const std::string& bytes, const ReadOptions& options = {}) {
    const ScratchDir scratch;
    return ownCaptureFormats()->read(scratch.write("t.wav", bytes), options);
}

TEST(Wav, PcmOfEveryWidthIsAFractionOfFullScale) {
    const struct {
        std::uint32_t bits;
        std::string data;
    } cases[] = {{8, std::string("\x00\x80\xC0", 3)},
                 {16, little(0x8000, 2) + little(0, 2) + little(0x4000, 2)},
                 {24, little(0x800000, 3) + little(0, 3) + little(0x400000, 3)},
                 {32, little(0x80000000, 4) + little(0, 4) + little(0x40000000, 4)}};
    for (const auto& [bits, data] : cases) {
        for (const bool extensible : {false, true}) {
            const auto read = accepted(readWav(wav({.bits = bits, .extensible = extensible}, data)));
            EXPECT_EQ(read.formatId, "wav");
            EXPECT_DOUBLE_EQ(read.capture.rate_hz, 48000);
            EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(-1, 0, 0.5F)) << bits;
            EXPECT_DOUBLE_EQ(read.capture.channels[0].low, -1);
            EXPECT_DOUBLE_EQ(read.capture.channels[0].lsb, std::exp2(1.0 - bits));
            EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("does not say what its full scale is")));
        }
    }
}

TEST(Wav, UnitAndProbeSayWhatFullScaleIs) {
    const auto read =
        accepted(readWav(wav({.channels = 2}, little(0x4000, 2) + little(0xC000, 2) + little(0, 2) + little(0, 2)),
                         {.units = {{"CH1", "V"}, {"CH2", "mA"}}, .probeFactors = {{"CH1", 20.0}}}));
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(10, 0));
    EXPECT_DOUBLE_EQ(read.capture.channels[0].low, -20);
    EXPECT_EQ(read.capture.channels[1].unit, "A");
    EXPECT_THAT(read.capture.channels[1].samples, ElementsAre(-0.0005F, 0));
}

TEST(Wav, FloatsAreTakenAsTheyAre) {
    const auto one =
        accepted(readWav(wav({.kind = 3, .bits = 32}, little(std::bit_cast<std::uint32_t>(12.5F), 4) +
                                                          little(std::bit_cast<std::uint32_t>(-3.0F), 4))));
    EXPECT_THAT(one.capture.channels[0].samples, ElementsAre(12.5F, -3));
    const auto two = accepted(readWav(wav({.kind = 3, .bits = 64}, little(std::bit_cast<std::uint64_t>(0.1), 8) +
                                                                       little(std::bit_cast<std::uint64_t>(1.0), 8))));
    EXPECT_THAT(two.capture.channels[0].samples, ElementsAre(0.1F, 1));
}

TEST(Wav, WhatIsWrittenReturnsBitByBit) {
    const ScratchDir scratch;
    auto capture = recordOf(biphasic(1e-3), {.rate_hz = 1e6, .start_s = -0.25, .samples = 400'000, .noise = 0.1});
    capture.channels.push_back(capture.channels[0]);
    capture.channels[1].name = "current; odd";
    capture.channels[1].unit = "A";
    capture.channels[1].samples[5] = std::nanf("");
    const auto formats = ownCaptureFormats();
    ASSERT_TRUE(formats->write(scratch.path() / "c.wav", capture));
    const auto read = accepted(formats->read(scratch.path() / "c.wav"));
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 1e6);
    EXPECT_DOUBLE_EQ(read.capture.start_s, -0.25);
    ASSERT_THAT(read.capture.channels, SizeIs(2));
    EXPECT_EQ(read.capture.channels[1].name, "current; odd");
    EXPECT_EQ(read.capture.channels[1].unit, "A");
    EXPECT_EQ(read.capture.channels[0].samples, capture.channels[0].samples);
    EXPECT_TRUE(std::isnan(read.capture.channels[1].samples[5]));
}

TEST(Wav, NamesOfManyChannelsReturn) {
    const ScratchDir scratch;
    auto capture = recordOf({}, {.rate_hz = 1000, .samples = 50});
    for (int c = 1; c < 200; ++c) {
        capture.channels.push_back(capture.channels[0]);
        capture.channels.back().name = fmt::format("electrode {}", c);
    }
    const auto formats = ownCaptureFormats();
    ASSERT_TRUE(formats->write(scratch.path() / "c.wav", capture));
    const auto read = accepted(formats->read(scratch.path() / "c.wav"));
    ASSERT_THAT(read.capture.channels, SizeIs(200));
    EXPECT_EQ(read.capture.channels[199].name, "electrode 199");
}

TEST(Wav, HoldsOnlyWholeRates) {
    const ScratchDir scratch;
    auto capture = recordOf({}, {.rate_hz = 1000, .samples = 50});
    for (const double rate : {35.7, 5e9, 0.4}) {
        capture.rate_hz = rate;
        EXPECT_THAT(ownCaptureFormats()->write(scratch.path() / "c.wav", capture),
                    test::refused(ErrorCode::InvalidArgument));
        EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
    }
    capture.rate_hz = 9'999'999.9;  // a rate of 10 MHz as found from its rounded time stamps
    EXPECT_TRUE(ownCaptureFormats()->write(scratch.path() / "c.wav", capture));
}

TEST(Wav, CutShortOpenEndedAndSenseless) {
    RecordProperty("hazard", "H10");
    const auto data = little(1, 2) + little(2, 2) + little(3, 2);
    const auto cut = readWav(wav({}, data, 100));
    ASSERT_TRUE(cut) << cut.error().message;
    EXPECT_THAT(cut->capture.channels[0].samples, SizeIs(3));
    EXPECT_THAT(cut->warnings, ::testing::Contains(HasSubstr("cut short")));
    const auto open = accepted(readWav(wav({}, data, 0xFFFFFFFFU)));
    EXPECT_THAT(open.capture.channels[0].samples, SizeIs(3));
    EXPECT_THAT(open.warnings, SizeIs(1)) << "only the full scale";
    const auto refusal = [](const std::string& bytes) {
        const auto read = readWav(bytes);
        return read ? "accepted" : read.error().message;
    };
    EXPECT_THAT(refusal(wav({.kind = 6, .bits = 8}, data)), HasSubstr("samples of kind 6 with 8 bits"));
    EXPECT_THAT(refusal(wav({.bits = 12}, data)), HasSubstr("with 12 bits"));
    EXPECT_THAT(refusal(wav({.channels = 0}, data)), HasSubstr("0 channels at 48000 Hz; 1 to 1024"));
    EXPECT_THAT(refusal(wav({}, little(1, 2))), HasSubstr("1 sample(s)"));
    EXPECT_THAT(refusal("RIFF....WAVE"), HasSubstr("no data chunk"));
    EXPECT_THAT(refusal("RIFF....WAVE" + std::string(80000, '\0')), HasSubstr("no data chunk"));
    EXPECT_THAT(refusal("RIFF....WAVEdata" + little(6, 4) + data), HasSubstr("samples of kind 0 with 0 bits"));
}

TEST(Wav, ARecordingThatWasNeverFinishedIsReadToItsEnd) {
    RecordProperty("hazard", "H10");
    const auto data = little(1, 2) + little(2, 2) + little(3, 2);
    auto bytes = wav({}, data, 0);
    for (const auto* whole : {"\x24\0\0\0", "\0\0\0\0", "\x08\0\0\0"}) {
        bytes.replace(4, 4, whole, 4);
        const auto read = accepted(readWav(bytes));
        EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(1 / 32768.0F, 2 / 32768.0F, 3 / 32768.0F));
        EXPECT_THAT(read.warnings, ::testing::Contains(HasSubstr("never finished")));
    }
}

TEST(Wav, WhatStandsBehindTheSamplesIsNotReadAndSaid) {
    RecordProperty("hazard", "H10");
    const auto data = little(1, 2) + little(2, 2);
    for (const auto& behind : {wav({.rate_hz = 8000}, data), "data" + little(4, 4) + data}) {
        const auto read = accepted(readWav(wav({}, data) + behind));
        EXPECT_EQ(read.capture.rate_hz, 48000);
        EXPECT_THAT(read.capture.channels[0].samples, SizeIs(2));
        EXPECT_THAT(read.warnings, ::testing::Contains(HasSubstr("a second recording")));
    }
    const auto read = accepted(readWav(wav({}, data) + "LIST" + little(4, 4) + "adtl"));
    EXPECT_THAT(read.warnings, SizeIs(1)) << "only the full scale";
}

/// Returns the file as RF64 or BW64 (EBU Tech 3306): with 64-bit sizes first, and all ones as 32-bit sizes.
std::string withLongSizes(const std::string& riff, const char* kind, const std::string& data,
                          const std::string& table) {
    auto rest = riff.substr(12);
    const auto at = rest.find("data") + 4;
    rest.replace(at, 4, little(0xFFFFFFFF, 4));
    const auto sizes =
        little(riff.size() + 28, 8) + little(data.size(), 8) + little(0, 8) + little(table.size() / 12, 4) + table;
    return kind + little(0xFFFFFFFF, 4) + "WAVEds64" + little(sizes.size(), 4) + sizes + rest;
}

TEST(Wav, Rf64AndBw64HoldWhatTheSameRiffHolds) {
    std::mt19937 random(20261129);
    for (int k = 0; k < 200; ++k) {
        constexpr std::uint32_t kBits[] = {8, 16, 24, 32, 64};
        const auto bits = kBits[random() % 5];
        const Shape shape{.kind = bits == 64 ? 3U : 1U,
                          .bits = bits,
                          .channels = 1 + std::uint32_t(random() % 4),
                          .rate_hz = 1 + std::uint32_t(random() % 4'000'000),
                          .extensible = random() % 2 == 0};
        std::string data;
        const auto frames = 2 + random() % 50;
        for (std::size_t i = 0; i < frames * shape.channels; ++i)
            data += bits == 64 ? little(std::bit_cast<std::uint64_t>(double(random()) / 1e9), 8)
                               : little(random(), bits / 8);
        const auto riff = wav(shape, data);
        const auto expected = accepted(readWav(riff));
        for (const auto* kind : {"RF64", "BW64"}) {
            for (const std::string& table : {std::string(), "abcd" + little(77, 8) + "junk" + little(99, 8)}) {
                // Other data follow the samples.
                const auto read =
                    accepted(readWav(withLongSizes(riff, kind, data, table) + "LIST" + little(4, 4) + "adtl"));
                EXPECT_EQ(read.capture.rate_hz, expected.capture.rate_hz);
                ASSERT_EQ(read.capture.channels.size(), shape.channels);
                for (std::size_t c = 0; c < shape.channels; ++c)
                    EXPECT_EQ(read.capture.channels[c].samples, expected.capture.channels[c].samples) << bits;
                EXPECT_EQ(read.warnings.size(), expected.warnings.size());
            }
        }
    }
}

TEST(Wav, ChunksBeyondFourGigabytesArePassedOver) {
    const auto data = little(0x4000, 2) + little(0xC000, 2);
    const auto riff = wav({}, data);
    constexpr std::uint64_t kLong = 5'000'000'000;
    auto bytes = withLongSizes(riff, "RF64", data, "junk" + little(kLong, 8));
    const auto junk = bytes.rfind("junk");
    const auto behind = bytes.substr(bytes.rfind("data"));
    bytes.resize(junk + 4);
    bytes += little(0xFFFFFFFF, 4);
    const ScratchDir scratch;
    const auto path = scratch.write("long.wav", bytes);
    std::filesystem::resize_file(path, bytes.size() + kLong);  // takes no disk space: the file is a single hole
    std::ofstream(path, std::ios::binary | std::ios::app) << behind;
    const auto read = accepted(ownCaptureFormats()->read(path));
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(0.5F, -0.5F));
}

TEST(Wav, MarkersDoNotHideTheNames) {
    const ScratchDir scratch;
    auto capture = recordOf({}, {.rate_hz = 1000, .samples = 50});
    capture.channels[0].name = "electrode";
    const auto path = scratch.path() / "c.wav";
    ASSERT_TRUE(ownCaptureFormats()->write(path, capture));
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    bytes.insert(12, "LIST" + little(4, 4) + "adtl");
    const auto read = accepted(readWav(bytes));
    EXPECT_EQ(read.capture.channels[0].name, capture.channels[0].name);
    EXPECT_EQ(read.capture.channels[0].unit, capture.channels[0].unit);
}

}  // namespace
}  // namespace tacto::test
