#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/IdentificationFile.h"

namespace tacto {
namespace {

TEST(IdentificationFile, ReadsAPlainTableAndTheExportsTable) {
    const auto plain = parseIdentificationTrials("condition,response\nrough,rough\nsmooth,none\n", "t.csv");
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_EQ(plain->size(), 2U);
    EXPECT_EQ((*plain)[1].number, 2U);
    EXPECT_EQ((*plain)[1].phase, TrialPhase::Test);
    EXPECT_TRUE(std::isnan((*plain)[1].rt_s));

    const auto bids = parseIdentificationTrials(
        "trial\tblock\tphase\ttrial_type\tresponse\tresponse_time\tattempt\n"
        "3\tn/a\ttraining\trough\tsmooth\t0.8\t1\n7\t2\ttest\trough\tnot_sure\t1.25\t2\n8\t2\ttest\tcatch\tn/a\tn/"
        "a\t1\n",
        "beh.tsv");
    ASSERT_TRUE(bids) << bids.error().message;
    ASSERT_EQ(bids->size(), 3U);
    EXPECT_EQ((*bids)[0].phase, TrialPhase::Training);
    EXPECT_EQ((*bids)[1].number, 7U);
    EXPECT_EQ((*bids)[1].block, 2U);
    EXPECT_EQ((*bids)[1].response, "not-sure");
    EXPECT_EQ((*bids)[1].attempt, 2U);
    EXPECT_EQ((*bids)[1].rt_s, 1.25);
    EXPECT_EQ((*bids)[2].response, "");
}

TEST(IdentificationFile, RefusesByLine) {
    const auto refusal = [](std::string_view text) {
        const auto read = parseIdentificationTrials(text, "t.csv");
        return read ? std::string("accepted") : read.error().message;
    };
    EXPECT_EQ(refusal("condition,response,block\nrough,rough,0\n"),
              "t.csv:2: block '0'; a whole number from 1 was expected");
    EXPECT_EQ(refusal("condition,response,phase\nrough,rough,tset\n"),
              "t.csv:2: the phase is \"tset\"; familiarisation, training or test is accepted");
    EXPECT_EQ(refusal("condition,response,rt_s\nrough,rough,soon\n"),
              "t.csv:2: response time 'soon'; a number of seconds from 0 was expected");
    EXPECT_EQ(refusal("condition,response\n,rough\n"), "t.csv:2: the condition is empty; a name was expected");
    EXPECT_NE(refusal("condition\nrough\n").find("columns condition and response were expected"), std::string::npos);
}

}  // namespace
}  // namespace tacto
