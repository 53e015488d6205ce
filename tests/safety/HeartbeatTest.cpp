#include <gtest/gtest.h>

#include "core/safety/Heartbeat.h"

namespace tacto {

using namespace std::chrono_literals;

TEST(Heartbeat, IsAliveForExactlyAHundredMillisecondsOfSilence) {
    RecordProperty("hazard", "H2");
    Heartbeat heart;
    EXPECT_FALSE(heart.alive(0s)) << "nothing has beaten yet";
    heart.beat(1s);
    EXPECT_TRUE(heart.alive(1s));
    EXPECT_TRUE(heart.alive(1100ms));
    EXPECT_FALSE(heart.alive(1100ms + 1ns));
    heart.revive(2s);
    EXPECT_TRUE(heart.alive(2050ms));
    heart.end();
    EXPECT_FALSE(heart.alive(2050ms)) << "a loop that ends is not alive";
    EXPECT_TRUE(heart.beat(5s)) << "and one that begins is not late";
}

TEST(Heartbeat, ALateBeatRevivesNothing) {
    RecordProperty("hazard", "H2");
    Heartbeat heart;
    EXPECT_TRUE(heart.beat(1s));
    EXPECT_TRUE(heart.beat(1100ms)) << "at 100 ms it is in time";
    EXPECT_FALSE(heart.beat(1200ms + 1ns));
    EXPECT_FALSE(heart.alive(1200ms + 1ns)) << "whichever thread wakes first";
    EXPECT_FALSE(heart.beat(1205ms)) << "and it stays dead";
    EXPECT_EQ(heart.silence(1205ms), Instant(105ms));
    heart.revive(1210ms);
    EXPECT_TRUE(heart.alive(1210ms));
    EXPECT_TRUE(heart.beat(1215ms));
}

}  // namespace tacto
