// What an XDF file holds is read, and what is damaged in it is left out and named.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/exchange/xdf/ClockLine.h"
#include "core/exchange/xdf/XdfFile.h"
#include "tests/exchange/recordings/Made.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::SizeIs;

SignalFile readMade(const std::string& content) {
    const ScratchDir folder;
    auto file = readXdf(folder.write("a.xdf", content));
    EXPECT_TRUE(file) << file.error().message;
    return file ? std::move(*file) : SignalFile{};
}

std::string samplesAt(double from_s, std::uint32_t id = 7) {
    std::vector<double> stamps;
    for (int i = 0; i < 50; ++i) stamps.push_back(from_s + i * 0.01);
    return xdfSamples(id, stamps, 1, [](std::size_t i, std::size_t) { return i; });
}
const std::string kHeader = xdfHeader(7, "Finger", "Force", "float32", 1, 100, {{"Fz", "mN"}});

TEST(XdfFile, ADamagedChunkIsLeftOutAndReadingGoesOnAtTheNextBoundary) {
    auto spoilt = samplesAt(1);
    spoilt[spoilt.size() - 4 - 1 - 8] = 3;  // the mark of the last sample: neither stamped nor deduced
    const auto begin = kXdfBegin.size() + kHeader.size() + samplesAt(0).size();
    const auto file =
        readMade(kXdfBegin + kHeader + samplesAt(0) + spoilt + samplesAt(2) + xdfBoundary() + samplesAt(3));
    ASSERT_THAT(file.streams, SizeIs(1));
    EXPECT_EQ(file.streams[0].count, 100U) << "the chunk between the damage and the boundary is not trusted";
    EXPECT_DOUBLE_EQ(file.streams[0].samples.t_s[50], 3);
    ASSERT_THAT(file.warnings, SizeIs(1));
    EXPECT_THAT(file.warnings[0], HasSubstr(fmt::format("damaged at byte {}", begin)));
}

TEST(XdfFile, AFileCutShortGivesWhatIsWhole) {
    const auto whole = kXdfBegin + kHeader + samplesAt(0) + samplesAt(1);
    for (std::size_t cut = 1; cut < samplesAt(1).size(); cut += 7) {
        const auto file = readMade(whole.substr(0, whole.size() - cut));
        ASSERT_THAT(file.streams, SizeIs(1)) << cut;
        EXPECT_EQ(file.streams[0].count, 50U) << cut;
        EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("cut short"))) << cut;
    }
}

TEST(XdfFile, ASampleWhoseStampIsDeducedFromALostOneIsLeftOut) {
    const auto deduced = [](int stamped) {  // three samples, of which one has its stamp
        auto content = littleEndianBytes(std::uint32_t{7}) + std::string("\x01\x03");
        for (int i = 0; i < 3; ++i) {
            content += i == stamped ? "\x08" + littleEndianBytes(9.0) : std::string(1, '\0');
            content += littleEndianBytes(1.0F);
        }
        return xdfChunk(3, content);
    };
    const auto file = readMade(kXdfBegin + kHeader + samplesAt(0) + "\x02" + xdfBoundary() + deduced(1) + deduced(5));
    ASSERT_THAT(file.streams, SizeIs(1));
    const auto& t = file.streams[0].samples.t_s;
    ASSERT_THAT(t, SizeIs(50 + 2 + 3));
    EXPECT_DOUBLE_EQ(t[50], 9);
    EXPECT_DOUBLE_EQ(t[51], 9.01);
    EXPECT_DOUBLE_EQ(t[54], 9.04);
}

TEST(XdfFile, ALengthBeyondTheFileIsADamage) {
    for (const std::uint64_t length :
         {std::uint64_t{1} << 63, ~std::uint64_t{0}, std::uint64_t{1000}, std::uint64_t{1}}) {
        const auto file =
            readMade(kXdfBegin + kHeader + "\x08" + littleEndianBytes(length) + xdfBoundary() + samplesAt(0));
        EXPECT_EQ(file.streams.at(0).count, 50U) << length;
        EXPECT_THAT(file.warnings, SizeIs(1)) << length;
    }
}

TEST(XdfFile, AClockResetIsNamedWithItsTime) {
    std::string offsets;
    for (int i = 0; i < 40; ++i) offsets += xdfOffset(7, 5.0 * i + 0.001 * (i % 3), 100 + 1e-4 * (i % 2));
    for (int i = 0; i < 40; ++i) offsets += xdfOffset(7, 4000 + 5.0 * i + 0.001 * (i % 3), -3700 + 1e-4 * (i % 2));
    const auto file = readMade(kXdfBegin + kHeader + samplesAt(0) + offsets);
    EXPECT_THAT(file.streams.at(0).obstacle, HasSubstr("reset after 295.0"));  // 195 s and the offset of 100
    const auto back =
        readMade(kXdfBegin + kHeader + samplesAt(0) + xdfOffset(7, 50, 0) + xdfOffset(7, 55, 0) + xdfOffset(7, 20, 35));
    EXPECT_THAT(back.streams.at(0).obstacle, HasSubstr("reset after 55.000 s"));
}

TEST(XdfFile, TheStrayEndOfAnOutletIsLeftOut) {  // labstreaminglayer/pylsl#67
    std::string offsets;
    for (int i = 0; i < 10; ++i) offsets += xdfOffset(7, 5.0 * i, 1);
    offsets += xdfOffset(7, -9e5, 9e5);
    const auto footer = xdfChunk(
        6, littleEndianBytes(std::uint32_t{7}) + "<?xml version=\"1.0\"?><info><sample_count>50</sample_count></info>");
    const auto stray = xdfSamples(7, {1e6}, 1, [](std::size_t, std::size_t) { return 1e30; });
    const auto file = readMade(kXdfBegin + kHeader + samplesAt(0) + stray + offsets + footer);
    EXPECT_EQ(file.streams.at(0).obstacle, "");
    EXPECT_EQ(file.streams.at(0).count, 50U);
    EXPECT_NEAR(file.streams.at(0).samples.t_s.back(), 1.49, 1e-9);
}

TEST(XdfFile, OffsetsThatAreNoTimesHideNoReset) {
    const double strange[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308};
    for (const bool reset : {false, true}) {
        std::string offsets;
        for (int i = 0; i < 40; ++i) {
            offsets += reset && i >= 20 ? xdfOffset(7, 1000 + 5.0 * i, 900) : xdfOffset(7, 5.0 * i, 1);
            offsets += xdfOffset(7, strange[i % 5], i % 2 == 0 ? strange[i % 3] : 1) +
                       xdfOffset(7, 5.0 * i + 1, strange[(i + 2) % 5]);
        }
        const auto file = readMade(kXdfBegin + kHeader + samplesAt(0) + offsets);
        const auto& stream = file.streams.at(0);
        EXPECT_THAT(stream.obstacle, reset ? HasSubstr("reset after 96.000 s") : HasSubstr(""));
        EXPECT_EQ(stream.obstacle.empty(), !reset);
        if (!reset) EXPECT_NEAR(stream.samples.t_s.front(), 1, 1e-9);
    }
}

TEST(XdfFile, TheLineOfVeryManyOffsetsIsFoundInFewRounds) {
    std::vector<xdf::ClockOffset> offsets;
    for (int i = 0; i < 2'000'000; ++i) offsets.push_back({i * 0.1, 3 + 1e-6 * i + (i % 20 == 7 ? 0.05 : 0)});
    const auto line = xdf::fitClock(offsets);
    for (const double t : {0.0, 1e5, 2e5}) EXPECT_NEAR(line.onRecorder(t) - t, 3 + 1e-5 * t, 1e-4);
}

TEST(XdfFile, FewOffsetsOfABusyNetworkDoNotTurnTheLine) {
    std::vector<xdf::ClockOffset> offsets;
    for (int i = 0; i < 100; ++i) {
        const double at = 1e6 + 5.0 * i;
        offsets.push_back({at, 12 + 2e-5 * (at - 1e6) + (i % 20 == 7 ? 0.05 : 1e-5 * (i % 3 - 1))});
    }
    const auto line = xdf::fitClock(offsets);
    for (const double t : {1e6, 1e6 + 250, 1e6 + 500}) EXPECT_NEAR(line.onRecorder(t) - t, 12 + 2e-5 * (t - 1e6), 1e-4);
    EXPECT_DOUBLE_EQ(xdf::fitClock(std::vector<xdf::ClockOffset>{{5, 3}}).onRecorder(1), 4);
    EXPECT_DOUBLE_EQ(xdf::fitClock({}).onRecorder(1), 1);
}

}  // namespace
}  // namespace tacto
