#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/dsp/ForceTrack.h"

using namespace tacto;

namespace {

double normalised(ForceTrack& track, double t, double start = 0) {
    double one = 1;
    double* axes[] = {&one};
    track.normalise(std::span(&t, 1), axes, start);
    return 1 / one;
}

}  // namespace

TEST(Contact, StartsAtATenthOfANewtonAndEndsBelowHalfOfThat) {
    ForceTrack track(100);
    const std::vector<std::pair<double, bool>> story{{0.099, false},  {0.1, true},   {0.06, true}, {0.05, true},
                                                     {0.0499, false}, {0.09, false}, {0.5, true}};
    for (std::size_t i = 0; i < story.size(); ++i) track.push(static_cast<double>(i) * 0.01, story[i].first);
    for (std::size_t i = 0; i < story.size(); ++i) {
        EXPECT_EQ(track.at(static_cast<double>(i) * 0.01 + 0.004).contact, story[i].second) << story[i].first << " N";
    }
    EXPECT_DOUBLE_EQ(track.firstContact_s(), 0.01);
}

TEST(Contact, EndsWhenForceIsOlderThanATenthOfASecond) {
    RecordProperty("hazard", "H7");
    ForceTrack track(100);
    track.push(0.3, 1);
    track.push(0.9, 1);
    EXPECT_FALSE(track.at(0.29).contact) << "nothing was measured yet";
    EXPECT_TRUE(track.at(0.4).contact) << "0.4 - 0.3 is not older than 0.1";
    EXPECT_FALSE(track.at(0.401).contact);
    EXPECT_FALSE(track.at(0.401).fresh);
    EXPECT_TRUE(track.at(0.95).contact);
    EXPECT_EQ(track.staleStretches(0.95), 1U);
    EXPECT_EQ(track.staleStretches(1.05), 2U);
}

TEST(Contact, MustStartAgainAfterASilence) {
    RecordProperty("hazard", "H7");
    ForceTrack track(100);
    track.push(0, 1);
    track.push(0.5, 0.07);
    EXPECT_FALSE(track.at(0.5).contact) << "0.07 N holds a contact, it does not start one";
}

TEST(Contact, DoesNotUseForceThatIsNoNumberOrOutOfOrder) {
    RecordProperty("hazard", "H7");
    ForceTrack track(100);
    track.push(0, 0.5);
    track.push(0.01, std::numeric_limits<double>::quiet_NaN());
    track.push(0.02, std::numeric_limits<double>::infinity());
    track.push(std::numeric_limits<double>::quiet_NaN(), 1);
    track.push(0.02, 0.7);
    track.push(0.02, 9);
    track.push(0.01, 9);
    EXPECT_EQ(track.invalidSamples(), 2U);
    EXPECT_EQ(track.samplesBeyond(), 1U) << "infinity is beyond whatever is plausible";
    EXPECT_EQ(track.outOfOrder(), 2U);
    EXPECT_NEAR(track.at(0.01).force_n, 0.6, 1e-12);
    EXPECT_NEAR(track.at(0.03).force_n, 0.7, 1e-12);
}

TEST(Force, IsInterpolatedAndHeldAtTheEnds) {
    ForceTrack track(100);
    track.push(0.1, 0.5);
    track.push(0.2, 1.5);
    EXPECT_NEAR(normalised(track, 0.0), 0.5, 1e-12);
    EXPECT_NEAR(normalised(track, 0.1), 0.5, 1e-12);
    EXPECT_NEAR(normalised(track, 0.125), 0.75, 1e-12);
    EXPECT_NEAR(normalised(track, 0.2), 1.5, 1e-12);
    EXPECT_NEAR(normalised(track, 0.9), 1.5, 1e-12);
}

TEST(Force, NeverDividesByLessThanATenthOfANewton) {
    ForceTrack track(100);
    track.push(0, -3);
    track.push(0.1, 0.02);
    track.push(0.2, 2);
    EXPECT_NEAR(normalised(track, 0.05), 0.1, 1e-12);
    EXPECT_NEAR(normalised(track, 0.1), 0.1, 1e-12);
    EXPECT_NEAR(normalised(track, 0.15), 1.01, 1e-12);
}

TEST(Force, SilenceOfMoreThanASecondIsNotBridged) {
    ForceTrack track(100);
    track.push(0, 1);
    track.push(1.0, 2);
    track.push(2.1, 4);
    EXPECT_NEAR(normalised(track, 0.5), 1.5, 1e-12);
    EXPECT_NEAR(normalised(track, 2.0), 2.0, 1e-12) << "held";
    EXPECT_NEAR(normalised(track, 2.2), 4.0, 1e-12);
    ForceTrack late(100);
    late.push(3, 2);
    EXPECT_NEAR(normalised(late, 0.5, 0), 0.1, 1e-12) << "a force that comes 3 s late says nothing about the start";
}
