// XDF files packed by gzip are read as those that are not, whatever their name; what is cut short is read as far as it
// goes; what is damaged or would fill the memory is refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/exchange/recordings/OpenRecording.h"
#include "core/exchange/xdf/Gunzip.h"
#include "core/exchange/xdf/XdfFile.h"
#include "tests/exchange/recordings/Made.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::string madeXdf() {
    std::vector<double> stamps;
    for (int i = 0; i < 500; ++i) stamps.push_back(10 + i * 0.01);
    return kXdfBegin + xdfHeader(7, "force", "force", "float32", 1, 100, {{"force", "N"}}) +
           xdfSamples(7, stamps, 1, [](std::size_t i, std::size_t) { return i; }) + xdfBoundary();
}

TEST(Gunzip, AFileIsTheSameWhateverItsName) {
    const ScratchDir folder;
    const auto plain = readXdf(folder.write("plain.xdf", madeXdf())).value();
    for (const char* name : {"a.xdfz", "a.xdf.gz", "A.XDF.GZ", "a.xdf", "a", "a.bin"}) {
        const auto path = folder.write(name, gzipped(madeXdf()));
        const auto file = readSignals(path);
        ASSERT_TRUE(file) << file.error().message;
        ASSERT_TRUE(*file) << name;
        ASSERT_THAT((*file)->streams, SizeIs(1)) << name;
        EXPECT_EQ((*file)->streams[0].samples.t_s, plain.streams[0].samples.t_s) << name;
        EXPECT_EQ((*file)->streams[0].samples.values, plain.streams[0].samples.values) << name;
        EXPECT_THAT((*file)->warnings, SizeIs(0)) << name;
    }
    EXPECT_TRUE(openRecording(folder.path() / "a.xdfz")) << openRecording(folder.path() / "a.xdfz").error().message;
    EXPECT_FALSE(readSignals(folder.write("b.csv.gz", gzipped("t,f\n1,2\n"))).value()) << "a table";
    EXPECT_THAT(readSignals(folder.write("b.xdfz", gzipped("t,f\n1,2\n"))).error().message,
                HasSubstr("does not begin with \"XDF:\""));
    EXPECT_TRUE(isSignalName("a.xdf.gz") && isSignalName("b.EDF") && !isSignalName("a.csv.gz"));
}

TEST(Gunzip, MembersInARowAndPaddingAreOneContent) {
    const auto text = madeXdf();
    const auto split = text.size() / 3;
    const auto both = gzipped(text.substr(0, split)) + gzipped("") + gzipped(text.substr(split));
    EXPECT_EQ(gunzip(both, kMaxUnpacked).value().content, text);
    EXPECT_EQ(gunzip(both + std::string(512, '\0'), kMaxUnpacked).value().content, text);
    EXPECT_THAT(gunzip(both + "more", kMaxUnpacked).error().message, HasSubstr("something else"));
}

TEST(Gunzip, WhatIsCutShortIsReadAsFarAsItGoes) {
    const ScratchDir folder;
    const auto packed = gzipped(madeXdf());
    for (std::size_t size = packed.size() - 1; size > 300; size -= 97) {
        const auto file = readXdf(folder.write("cut.xdfz", packed.substr(0, size)));
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_THAT(file->warnings.at(0), HasSubstr("cut short")) << size;
    }
    EXPECT_FALSE(readXdf(folder.write("head.xdfz", packed.substr(0, 12))));
}

TEST(Gunzip, WhatIsDamagedIsRefusedByName) {
    RecordProperty("hazard", "H10");
    const ScratchDir folder;
    const auto packed = gzipped(madeXdf());
    auto spoilt = packed;
    spoilt[spoilt.size() - 6] ^= 1;  // its checksum
    const auto path = folder.write("spoilt.xdfz", spoilt);
    const auto file = readXdf(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::ParseError);
    EXPECT_THAT(file.error().message, HasSubstr(path.string() + " is damaged: its gzip data at byte"));
}

TEST(Gunzip, AFileThatUnpacksToMoreThanMemoryIsRefusedByNameAndHeldNowhere) {
    RecordProperty("hazard", "H10");
    const auto most_KiB = [] {
        rusage use{};
        getrusage(RUSAGE_SELF, &use);
        return use.ru_maxrss;
    };
    // 1.1 GiB of zeros in 1.1 MB: members of 16 MiB each.
    const auto member = gzipped(std::string(1 << 24, '\0'));
    std::string bomb = gzipped(madeXdf());
    for (int i = 0; i < 70; ++i) bomb += member;
    const ScratchDir folder;
    const auto path = folder.write("bomb.xdfz", bomb);
    const auto before_KiB = most_KiB();
    const auto file = readXdf(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::LimitExceeded);
    EXPECT_THAT(file.error().message, HasSubstr(path.string() + " holds more than 1073741824 bytes"));
    EXPECT_LT(most_KiB() - before_KiB, 16 * 1024);
    EXPECT_TRUE(gunzip(gzipped("12345678"), 8));
    EXPECT_FALSE(gunzip(gzipped("123456789"), 8));
}

}  // namespace
}  // namespace tacto
