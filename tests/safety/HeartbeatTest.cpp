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
    heart.beat(2s);
    EXPECT_TRUE(heart.alive(2050ms));
    heart.end();
    EXPECT_FALSE(heart.alive(2050ms)) << "a loop that ends is not alive";
}

}  // namespace tacto
