// Tables larger than a block: nothing is lost between blocks, and reading can be watched and stopped.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/formats/TextBlocks.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::HasSubstr;

std::string longTable(int rows) {
    std::string text = "time_s,a_v,b\n";
    for (int i = 0; i < rows; ++i) text += fmt::format("{:.6f},{:.4f},{}\n", 1e-5 * i, 0.0001 * i, i % 2);
    return text;
}

TEST(CsvStream, NothingIsLostBetweenBlocks) {
    constexpr int kRows = 150'000;
    auto text = longTable(kRows);
    ASSERT_GT(text.size(), 2 * TextBlocks::kBlockBytes);
    for (const bool ended : {true, false}) {
        if (!ended) text.pop_back();  // removes the end of the last line
        const ScratchDir scratch;
        const auto read = accepted(readCapture(scratch.write("long.csv", text)));
        ASSERT_EQ(read.capture.samples(), static_cast<std::size_t>(kRows));
        EXPECT_TRUE(read.warnings.empty());
        EXPECT_NEAR(read.capture.rate_hz, 1e5, 1e-3);
        for (int i = 0; i < kRows; ++i) {
            const auto k = static_cast<std::size_t>(i);
            ASSERT_EQ(read.capture.channels[0].samples[k], static_cast<float>(std::round(i) / 10000)) << i;
            ASSERT_EQ(read.capture.channels[1].samples[k], static_cast<float>(i % 2)) << i;
        }
    }
}

TEST(CsvStream, ALineFarBehindIsStillNamedRight) {
    auto text = longTable(100'000);
    text += "1.000000,1,1\n\n# a word\n1.000010,oops,1\n";
    EXPECT_THAT(parseCapture(text, "t.csv"),
                test::refusedSaying(testing::StrEq(
                    "t.csv:100005: 'oops' in column 'a_v'; a number was expected; --columns 3 reads it")));
    auto uneven = longTable(100'000);
    uneven += "1.5,1,1\n";
    const auto jump = parseCapture(uneven, "t.csv");
    ASSERT_FALSE(jump);
    EXPECT_THAT(jump.error().message, HasSubstr("t.csv:100002: time moves by 0.50001 s here"));
    EXPECT_THAT(jump.error().message, HasSubstr("most are 1e-05 s"));
}

TEST(CsvStream, ProgressRisesToOneAndAStopEndsIt) {
    const auto text = longTable(150'000);
    std::vector<double> told;
    ASSERT_TRUE(parseCapture(text, "t.csv", {}, {[&](double part) { told.push_back(part); }, {}}));
    ASSERT_GE(told.size(), 3U);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_DOUBLE_EQ(told.back(), 1);

    std::stop_source stop;
    int chunks = 0;
    EXPECT_THAT(parseCapture(text, "t.csv", {},
                             {[&](double) {
                                  ++chunks;
                                  stop.request_stop();
                              },
                              stop.get_token()}),
                test::refused(ErrorCode::Stopped));
    EXPECT_EQ(chunks, 1) << "looked at in every chunk";
}

TEST(CsvStream, ALineWithoutEndIsRefused) {
    const std::string text = "time_s,a\n0,1\n" + std::string(3 * TextBlocks::kBlockBytes, '1');
    EXPECT_THAT(parseCapture(text, "t.csv"), test::refusedSaying("a line is longer than"));
}

TEST(CsvStream, TheSlowWayMeansTheSameAsTheFastOne) {
    // Quotes, blanks and more digits than a double holds take a slower path through the reader.
    std::string fast = "time_s,a_v\n";
    std::string slow = "time_s,a_v\n";
    for (int i = 0; i < 3000; ++i) {
        fast += fmt::format("{},{:.3f}\n", i, 0.001 * i);
        slow += i % 3 == 0   ? fmt::format("\"{}\", \"{:.3f}\" \r\n", i, 0.001 * i)
                : i % 3 == 1 ? fmt::format(" {} ,\t{:.3f}0000000000000000000000 ,\n", i, 0.001 * i)
                             : fmt::format("{}.,+{:.3f}e0\n", i, 0.001 * i);
    }
    const auto one = parseCapture(fast, "t.csv");
    const auto two = parseCapture(slow, "t.csv");
    ASSERT_TRUE(one && two) << (two ? "" : two.error().message);
    EXPECT_EQ(one->capture.channels[0].samples, two->capture.channels[0].samples);
    EXPECT_DOUBLE_EQ(one->capture.rate_hz, two->capture.rate_hz);
}

}  // namespace
}  // namespace tacto::test
