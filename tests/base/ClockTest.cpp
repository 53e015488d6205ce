#include <gtest/gtest.h>
#include <regex>

#include "core/base/Clock.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;

TEST(VirtualClock, StartsAtZeroAndMovesOnlyWhenMoved) {
    VirtualClock clock;
    EXPECT_EQ(clock.now(), 0ns);
    clock.advanceTo(5ms);
    EXPECT_EQ(clock.now(), 5ms);
    EXPECT_EQ(clock.now(), 5ms);
}

TEST(VirtualClock, IgnoresAMomentAlreadyPast) {
    VirtualClock clock;
    clock.advanceTo(2s);
    clock.advanceTo(1s);
    EXPECT_EQ(clock.now(), 2s);
}

TEST(VirtualClock, TakesItsTimeAtAPace) {
    VirtualClock clock(4);
    const auto began = std::chrono::steady_clock::now();
    for (int turn = 1; turn <= 40; ++turn) clock.advanceTo(turn * 5ms);
    clock.advanceTo(100ms);  // a moment in the past takes none
    EXPECT_EQ(clock.now(), 200ms);
    EXPECT_GE(std::chrono::steady_clock::now() - began, 50ms);
    EXPECT_TRUE(clock.isVirtual());
}

TEST(VirtualClock, StandsStillWhileTheComputerSleeps) {
    VirtualClock clock;
    clock.advanceTo(2s);
    clock.sleepFor(3s);
    EXPECT_EQ(clock.now(), 2s);
    EXPECT_EQ(clock.asleep(), 3s);
    EXPECT_EQ(clock.elapsed(), 5s);
}

TEST(SteadyClock, HasNotSleptWhileThisTestRuns) {
    SteadyClock clock;
    const Instant begun = clock.now();
    while (clock.now() < begun + 20ms) {
        // A pause between the two clock readings must not look like sleep.
        ASSERT_LT(clock.asleep(), 5ms);
    }
    EXPECT_GE(clock.elapsed(), begun + 20ms);
}

TEST(SteadyClock, NeverGoesBack) {
    SteadyClock clock;
    Instant last = clock.now();
    EXPECT_GE(last, 0ns);
    for (int i = 0; i < 10'000; ++i) {
        const Instant now = clock.now();
        ASSERT_GE(now, last);
        last = now;
    }
}

TEST(Clock, SaysWhichKindItIs) {
    EXPECT_TRUE(VirtualClock().isVirtual());
    EXPECT_FALSE(SteadyClock().isVirtual());
}

TEST(Instant, RoundsSecondsToTheNearestNanosecond) {
    EXPECT_EQ(toInstant(1.0000000006), 1'000'000'001ns);
    EXPECT_EQ(toInstant(-1.0000000006), -1'000'000'001ns);
    EXPECT_EQ(toInstant(Seconds(0.5)), 500ms);
    EXPECT_DOUBLE_EQ(toSeconds(1500ms), 1.5);
}

TEST(WallTime, IsIso8601Utc) {
    EXPECT_TRUE(std::regex_match(wallTimeUtc(), std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)"))) << wallTimeUtc();
}

TEST(WallTime, IsReadAsItWasWrittenAndNothingElseIs) {
    using namespace std::chrono;
    EXPECT_EQ(wallTimeFrom("1970-01-01T00:00:00Z"), sys_seconds(0s));
    EXPECT_EQ(wallTimeFrom("2026-11-20T14:03:05Z"), sys_days(2026y / 11 / 20) + 14h + 3min + 5s);
    EXPECT_LE(abs(*wallTimeFrom(wallTimeUtc()) - system_clock::now()), 2s);
    for (const char* text : {"", "x", "2026-11-20", "2026-13-20T14:03:05Z", "2026-11-20T25:03:05Z",
                             "2026-11-20T14:03:05", "2026-11-20T14:03:05Z ", "2026-11-20T14:03:05+01:00"})
        EXPECT_EQ(wallTimeFrom(text), std::nullopt) << text;
}

}  // namespace
}  // namespace tacto
