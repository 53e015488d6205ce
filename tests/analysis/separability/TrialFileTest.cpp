#include <gtest/gtest.h>

#include "core/analysis/separability/TrialFile.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

std::string refusal(std::string_view text) {
    const auto trials = parseSeparabilityTrials(text, "t.csv");
    return trials ? "accepted" : trials.error().message;
}

TEST(TrialFile, ReadsColumnsByTheirTrimmedNames) {
    const auto trials = parseSeparabilityTrials(
        "trial, interval ,condition , amplitude\r\n1,2.0,smooth-low,10.1\r\n\r\n2, .5 ,\"rough, high\",40\r\n",
        "t.csv");
    ASSERT_TRUE(trials) << trials.error().message;
    ASSERT_EQ(trials->size(), 2U);
    EXPECT_EQ((*trials)[0].condition, "smooth-low");
    EXPECT_DOUBLE_EQ((*trials)[0].amplitude, 10.1);
    EXPECT_DOUBLE_EQ((*trials)[0].interval_s, 2);
    EXPECT_EQ((*trials)[1].condition, "rough, high");
    EXPECT_DOUBLE_EQ((*trials)[1].interval_s, 0.5);
}

TEST(TrialFile, ReadsTheNamesOfOurOwnExport) {
    EXPECT_EQ(refusal("condition,amplitude_v,interval_s\na,1,1\n"), "accepted");
}

TEST(TrialFile, AnEmptyValueIsATrialThatWasNotMeasured) {
    RecordProperty("hazard", "H9");
    const auto trials = parseSeparabilityTrials("condition,amplitude,interval\na,,1\na,1,nan\n", "t.csv");
    ASSERT_TRUE(trials) << trials.error().message;
    EXPECT_TRUE(std::isnan((*trials)[0].amplitude));
    EXPECT_TRUE(std::isnan((*trials)[1].interval_s));
}

TEST(TrialFile, RefusalsNameFileLineAndWhatWasExpected) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(refusal(""), "t.csv: the file is empty; columns condition, amplitude and interval were expected");
    EXPECT_EQ(refusal("# note\ncondition,amplitude\na,1\n"),
              "t.csv:2: no column 'interval'; columns condition, amplitude and interval were expected");
    EXPECT_EQ(refusal("condition,amplitude,interval\n"),
              "t.csv: nothing after the header line; a row per trial was expected");
    EXPECT_EQ(refusal("condition,amplitude,interval\na,1,1\na,1\n"),
              "t.csv:3: 2 fields; at least 3 were expected, as in the header");
    EXPECT_EQ(refusal("condition,amplitude,interval\n,1,1\n"), "t.csv:2: the condition is empty; a name was expected");
    for (const std::string bad : {"ten", "0", "-4", "inf", "1,5x"}) {
        const auto message = refusal("condition,amplitude,interval\na,1,1\na," + bad + ",1\n");
        EXPECT_EQ(message.find("t.csv:3: "), 0U) << message;
        EXPECT_NE(message.find("a finite number above 0 was expected"), std::string::npos) << message;
    }
}

TEST(TrialFile, AMissingFileIsNamed) {
    const ScratchDir scratch;
    EXPECT_EQ(readSeparabilityTrials(scratch.path() / "none.csv").error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace tacto::test
