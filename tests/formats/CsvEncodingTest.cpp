// Different ways to write the same table: line ends, byte-order marks, encodings, separators, points and commas.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/CaptureFormats.h"
#include "core/formats/TextBlocks.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::ElementsAre;

/// Returns ASCII text as UTF-16; `big`: the high byte comes first.
std::string wide(std::string_view text, bool big, bool mark = true) {
    std::string bytes;
    if (mark) bytes = big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) {
        if (big) bytes.push_back('\0');
        bytes.push_back(c);
        if (!big) bytes.push_back('\0');
    }
    return bytes;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
        text.replace(at, what.size(), by);
    }
    return text;
}

TEST(CsvEncoding, TheSameTableHoweverItIsWritten) {
    const std::string plain = "time (ms),CH1 (mV)\n-0.5,1.25\n0.0,2.5\n0.5,-3.75\n";
    const auto semicolons = replaced(replaced(plain, ",", ";"), ".", ",");
    const auto tabs = replaced(replaced(plain, ",", "\t"), ".", ",");
    for (const auto& text :
         {plain, replaced(plain, "\n", "\r\n"), "\xEF\xBB\xBF" + plain, semicolons, replaced(semicolons, "\n", "\r\n"),
          tabs, replaced(plain, ",", "\t"), replaced(plain, "\n", ",\n"), replaced(plain, "\n", " , ,\r\n"),
          replaced(semicolons, "\n", ";\n"), wide(plain, false), wide(plain, true),
          wide(replaced(semicolons, "\n", "\r\n"), false), "# made by hand\n\n# twice\n" + plain,
          "; a comment\n;another, with a comma\n" + plain, "made by hand\n" + plain, plain + "\n\n",
          plain.substr(0, plain.size() - 1)}) {
        const auto read = parseCapture(text, "t.csv");
        ASSERT_TRUE(read) << read.error().message << "\n" << text;
        EXPECT_NEAR(read->capture.rate_hz, 2000, 1e-6) << text;
        EXPECT_NEAR(read->capture.start_s, -0.5e-3, 1e-12) << text;
        ASSERT_EQ(read->capture.channels.size(), 1U) << text;
        EXPECT_EQ(read->capture.channels[0].name, "CH1") << text;
        EXPECT_THAT(read->capture.channels[0].samples, ElementsAre(1.25e-3F, 2.5e-3F, -3.75e-3F)) << text;
    }
}

TEST(CsvEncoding, Utf16IsRecognisedInAFileAndReadAcrossBlocks) {
    constexpr int kRows = 60'000;
    std::string text = "X,CH1,\r\nSecond,Volt,\r\n";
    for (int i = 0; i < kRows; ++i) text += fmt::format("{:.6f},{},\r\n", 1e-5 * i, i % 97);
    ASSERT_GT(text.size(), 2 * TextBlocks::kBlockBytes);
    for (const bool big : {false, true}) {
        const ScratchDir scratch;
        const auto path = scratch.write("t.csv", wide(text, big));
        const auto read = accepted(ownCaptureFormats()->read(path));
        EXPECT_EQ(read.formatId, "csv-rigol");
        EXPECT_NEAR(read.capture.rate_hz, 1e5, 1e-3);
        ASSERT_EQ(read.capture.samples(), static_cast<std::size_t>(kRows));
        for (int i = 0; i < kRows; ++i) {
            ASSERT_EQ(read.capture.channels[0].samples[static_cast<std::size_t>(i)], static_cast<float>(i % 97)) << i;
        }
        const auto skipped =
            ownCaptureFormats()->read(scratch.write("s.csv", wide("oh\ntime_s,a\n0,1\n1,2\n", big)), {.skipRows = 1});
        ASSERT_TRUE(skipped) << skipped.error().message;
    }
}

TEST(CsvEncoding, Utf16ThatIsCutOrWithoutItsMarkIsRefusedOrReadToItsEnd) {
    const auto bytes = wide("time_s,a\n0,1\n1,2\n2,3\n", false);
    EXPECT_TRUE(parseCapture(bytes.substr(0, bytes.size() - 1), "t.csv")) << "half a line end";
    EXPECT_THAT(parseCapture(wide("time_s,a\n0,1\n1,2\n", false, false), "t.csv"),
                test::refusedSaying("in UTF-16 with its mark"));
    EXPECT_FALSE(parseCapture("\xFF\xFE", "t.csv"));
    EXPECT_FALSE(parseCapture(std::string_view("\xFF\xFE\x00", 3), "t.csv"));
    // A surrogate pair, and a single surrogate, are accepted in names.
    const auto pair = accepted(parseCapture(
        wide("time_s,", false) + std::string("\x34\xD8\x1E\xDD\x1E\xDD", 6) + wide("\n0,1\n1,2\n", false, false),
        "t.csv"));
    EXPECT_EQ(pair.capture.channels[0].name, "\xF0\x9D\x84\x9E\xEF\xBF\xBD");
}

TEST(CsvEncoding, LatinNamesAndUnitsBecomeUtf8) {
    const auto read =
        accepted(parseCapture("Zeit,Gr\xF6\xDF"
                              "e [mV]\n(\xB5s),(mV)\n0,1000\n1,2000\n",
                              "t.csv", {.timeColumn = "Zeit"}));
    EXPECT_EQ(read.capture.channels[0].name, "Größe");
    EXPECT_THAT(read.capture.channels[0].samples, ElementsAre(1, 2));
}

TEST(CsvEncoding, ADecimalCommaBetweenCommasIsNotGuessedAt) {
    EXPECT_THAT(
        parseCapture("time_s,a\n0,0,1,5\n0,1,2,5\n", "t.csv"),
        test::refusedSaying(testing::StrEq(
            "t.csv:2: 4 fields, where the header has 2: decimal commas cannot be told from commas between columns; "
            "decimal points, or semicolons between columns, were expected")));
}

TEST(CsvEncoding, ScaledUnitsAreConverted) {
    for (const auto& [unit, factor] : {std::pair("s", 1.0),
                                       {"ms", 1e-3},
                                       {"us", 1e-6},
                                       {"µs", 1e-6},
                                       {"ns", 1e-9},
                                       {"ps", 1e-12},
                                       {"msec", 1e-3},
                                       {"Seconds", 1.0}}) {
        const auto read = accepted(parseCapture(fmt::format("time [{}],a [V]\n0,1\n1,2\n", unit), "t.csv"));
        EXPECT_NEAR(read.capture.rate_hz * factor, 1, 1e-9) << unit;
    }
    for (const auto& [unit, factor] : {std::pair("V", 1.0),
                                       {"mV", 1e-3},
                                       {"uV", 1e-6},
                                       {"µV", 1e-6},
                                       {"kV", 1e3},
                                       {"Volts", 1.0},
                                       {"mA", 1e-3},
                                       {"uA", 1e-6},
                                       {"nA", 1e-9},
                                       {"Amps", 1.0}}) {
        const auto read = accepted(parseCapture(fmt::format("time [s],a [{}]\n0,1\n1,2\n", unit), "t.csv"));
        EXPECT_FLOAT_EQ(read.capture.channels[0].samples[0], static_cast<float>(factor)) << unit;
    }
}

}  // namespace
}  // namespace tacto::test
