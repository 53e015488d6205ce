#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/IdentificationFile.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/statistics/Estimate.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

Identification with68Of80() {
    Identification found;
    found.labels = {"rough-high", "rough-low", "smooth-high", "smooth-low"};
    found.all.n = 80;
    found.all.hits = 68;
    found.all.chance = 0.25;
    found.all.accuracy = wilsonInterval(68, 80);
    return found;
}

TEST(IdentificationText, HeadlineIsThatOfTheDesign) {
    PresentedRange range;
    range.low = Milliamps(4);
    range.high = Milliamps(6.5);
    range.lowVoltage = Volts(13.6);
    range.highVoltage = Volts(22.1);
    range.impedance = Ohms(3400);
    EXPECT_EQ(headline("P-7K3M", with68Of80(), range),
              "P-7K3M told the four apart in 68 of 80 trials (85 %, 95 % interval 76 to 91 %, chance 25 %) between 4.0 "
              "and 6.5 mA, 14 to 22 V at 3.4 kΩ.");
}

TEST(IdentificationText, SmallVoltagesKeepTwoDigits) {
    EXPECT_EQ(voltageRangeText(Volts(2.47), Volts(4.45)), "2.5 to 4.5 V");
    EXPECT_EQ(voltageRangeText(Volts(9.96), Volts(22.14)), "10 to 22 V");
    EXPECT_EQ(voltageRangeText(Volts(9.9), Volts(22.14)), "9.9 to 22.1 V");
    EXPECT_EQ(voltageRangeText(Volts(0.62), Volts(0.949)), "0.62 to 0.95 V");
    EXPECT_EQ(voltageRangeText(Volts(120), Volts(204.6)), "120 to 205 V");
    EXPECT_EQ(voltageRangeText(Volts(0), Volts(3)), "0.0 to 3.0 V");
}

TEST(IdentificationText, ConditionsAndAnswersAreReadAsTheParticipantReadsThem) {
    EXPECT_EQ(answerWords("rough-high"), "rough, firm");
    EXPECT_EQ(answerWords("smooth-low"), "smooth, light");
    EXPECT_EQ(answerWords("none"), "nothing");
    EXPECT_EQ(answerWords("not-sure"), "not sure");
    for (const char* other : {"", "-", "rough", "rough-", "rough-medium", "silk-high", "catch"})
        EXPECT_EQ(answerWords(other), other) << "named otherwise: nothing is claimed of it";
}

TEST(IdentificationText, AChanceBelowOneInAThousandIsGivenAsSuch) {
    EXPECT_EQ(chanceText(2e-44), "< 0.001");
    EXPECT_EQ(chanceText(0.0123), "0.012");
    EXPECT_EQ(chanceText(1), "1.000");
    EXPECT_EQ(chanceText(kNaN), "–");
}

TEST(IdentificationText, WhatIsNotKnownIsLeftOut) {
    RecordProperty("hazard", "H9");
    PresentedRange range;
    EXPECT_EQ(headline("P-7K3M", with68Of80(), range),
              "P-7K3M told the four apart in 68 of 80 trials (85 %, 95 % interval 76 to 91 %, chance 25 %).");
    range.lowIntensity = 0.2;
    range.highIntensity = 0.8;
    EXPECT_EQ(headline("P-7K3M", with68Of80(), range),
              "P-7K3M told the four apart in 68 of 80 trials (85 %, 95 % interval 76 to 91 %, chance 25 %) between "
              "strengths of 0.20 and 0.80.");
    EXPECT_EQ(headline("P-7K3M", Identification(), range), "P-7K3M answered no test trial.");
}

TEST(IdentificationText, PrecisionIsThatOfTheDesign) {
    EXPECT_EQ(precisionSentence(80, 0.25), "80 trials: ± 8 % at 85 %, ± 11 % at 50 %; 27 right of 80 is above chance.");
    EXPECT_EQ(precisionSentence(40, 0.25),
              "40 trials: ± 11 % at 85 %, ± 15 % at 50 %; 16 right of 40 is above chance.");
}

TEST(IdentificationFile, ReadsAPlainTableAndTheExportsTable) {
    const auto plain =
        test::accepted(parseIdentificationTrials("stimulus,response\nrough,rough\nsmooth,none\n", "t.csv"));
    ASSERT_EQ(plain.size(), 1U);
    const auto& trials = plain.front().sessions.front().trials;
    ASSERT_EQ(trials.size(), 2U);
    EXPECT_EQ(trials[1].number, 2U);
    EXPECT_EQ(trials[1].phase, TrialPhase::Test);
    EXPECT_TRUE(std::isnan(trials[1].rt_s));

    const auto bids = test::accepted(parseIdentificationTrials(
        "trial\tblock\tphase\ttrial_type\tresponse\tresponse_time\tattempt\n"
        "3\tn/a\ttraining\trough\tsmooth\t0.8\t1\n7\t2\ttest\trough\tnot_sure\t1.25\t2\n8\t2\ttest\tcatch\tn/a\tn/"
        "a\t1\n",
        "beh.tsv"));
    ASSERT_EQ(bids.size(), 1U);
    const auto& exported = bids.front().sessions.front().trials;
    ASSERT_EQ(exported.size(), 3U);
    EXPECT_EQ(exported[0].phase, TrialPhase::Training);
    EXPECT_EQ(exported[1].number, 7U);
    EXPECT_EQ(exported[1].block, 2U);
    EXPECT_EQ(exported[1].response, "not-sure");
    EXPECT_EQ(exported[1].attempt, 2U);
    EXPECT_EQ(exported[1].rt_s, 1.25);
    EXPECT_EQ(exported[2].response, "");
}

TEST(IdentificationFile, KeepsParticipantsApart) {
    const auto people =
        parseIdentificationTrials("participant,stimulus,response\nA,rough,rough\nB,rough,smooth\nA,smooth,none\n", "t");
    ASSERT_TRUE(people) << people.error().message;
    ASSERT_EQ(people->size(), 2U);
    EXPECT_EQ((*people)[0].participant, "A");
    EXPECT_EQ((*people)[0].trials().size(), 2U);
    EXPECT_EQ((*people)[0].trials()[1].number, 2U);
    EXPECT_EQ((*people)[1].trials().size(), 1U);
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
    EXPECT_EQ(refusal("condition,response\n,rough\n"), "t.csv:2: the stimulus is empty; a name was expected");
    EXPECT_NE(refusal("condition\nrough\n").find("columns stimulus and response were expected"), std::string::npos);
}

}  // namespace
}  // namespace tacto
