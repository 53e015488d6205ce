#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "core/encoding/TrainScheduler.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;

TEST(TrainScheduler, HasNothingDueBeforeItStarts) {
    TrainScheduler scheduler;
    EXPECT_FALSE(scheduler.due());
    scheduler.setInterval(Seconds(1), 0s);
    EXPECT_FALSE(scheduler.due());
    EXPECT_FALSE(scheduler.isDue(100s));
}

TEST(TrainScheduler, SendsTheFirstTrainAtOnceAndTheNextAnIntervalLater) {
    TrainScheduler scheduler;
    scheduler.start(3s, Seconds(2));
    EXPECT_EQ(scheduler.due(), 3s);
    EXPECT_TRUE(scheduler.isDue(3s));
    scheduler.trainAt(3s);
    EXPECT_EQ(scheduler.due(), 5s);
    EXPECT_FALSE(scheduler.isDue(5s - 1ns));
    EXPECT_TRUE(scheduler.isDue(5s));
}

TEST(TrainScheduler, PullsThePendingTrainForwardWhenTheIntervalShrinks) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(2));
    scheduler.trainAt(0s);
    scheduler.setInterval(Seconds(0.5), 200ms);
    EXPECT_EQ(scheduler.due(), 500ms) << "last onset + T";
    scheduler.setInterval(Seconds(2), 210ms);
    scheduler.setInterval(Seconds(0.5), 800ms);
    EXPECT_EQ(scheduler.due(), 800ms) << "now: a press is felt at once";
}

TEST(TrainScheduler, PushesThePendingTrainBackWhenTheIntervalGrows) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(0.5));
    scheduler.trainAt(0s);
    scheduler.setInterval(Seconds(2), 400ms);
    EXPECT_EQ(scheduler.due(), 2s);
}

TEST(TrainScheduler, KeepsTheIntervalThroughPauseAndResume) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(1));
    scheduler.trainAt(0s);
    scheduler.pause();
    EXPECT_FALSE(scheduler.due());
    scheduler.resume(300ms);
    EXPECT_EQ(scheduler.due(), 1s) << "not earlier than last onset + T";
    scheduler.pause();
    scheduler.setInterval(Seconds(0.5), 4s);
    EXPECT_FALSE(scheduler.due());
    scheduler.resume(5s);
    EXPECT_EQ(scheduler.due(), 5s);
    scheduler.resume(9s);
    EXPECT_EQ(scheduler.due(), 5s) << "resuming what runs changes nothing";
}

TEST(TrainScheduler, RemembersTheLastOnsetAcrossOff) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(1));
    scheduler.trainAt(0s);
    scheduler.off();
    EXPECT_FALSE(scheduler.due());
    scheduler.resume(100ms);
    EXPECT_FALSE(scheduler.due()) << "only start() ends off";
    scheduler.pause();
    EXPECT_FALSE(scheduler.due());
    scheduler.start(200ms, Seconds(1));
    EXPECT_EQ(scheduler.due(), 1s);
}

TEST(TrainScheduler, DoesNotDriftWhenTheMomentDueIsPassed) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(0.1));
    for (int n = 0; n < 1000; ++n) scheduler.trainAt(*scheduler.due());
    EXPECT_EQ(scheduler.due(), 100s);
}

TEST(TrainScheduler, IgnoresAnIntervalThatIsNone) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(1));
    scheduler.trainAt(0s);
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        scheduler.setInterval(Seconds(bad), 100ms);
        EXPECT_EQ(scheduler.due(), 1s) << bad;
        TrainScheduler other;
        other.start(0s, Seconds(bad));
        EXPECT_FALSE(other.due()) << bad;
    }
}

RC_GTEST_PROP(TrainScheduler, NeverSendsATrainEarlierThanTheLastOnsetPlusTheInterval, ()) {
    TrainScheduler scheduler;
    Instant now{0};
    Seconds interval(0.5);
    std::optional<Instant> last;
    scheduler.start(now, interval);
    const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(0, 6), rc::gen::inRange(1, 400)));
    for (const auto& [what, amount] : steps) {
        now += std::chrono::milliseconds(amount);
        switch (what) {
            case 0:
            case 1:
                interval = Seconds(amount * 0.0077);
                scheduler.setInterval(interval, now);
                if (scheduler.due() && last) {
                    RC_ASSERT(Seconds(*scheduler.due() - *last) >= interval);
                    RC_ASSERT(*scheduler.due() <= std::max(now, *last + toInstant(interval) + 1ns));
                }
                break;
            case 2:
                scheduler.pause();
                break;
            case 3:
                scheduler.resume(now);
                break;
            case 4:
                scheduler.off();
                break;
            default:
                scheduler.start(now, interval);
                break;
        }
        if (scheduler.isDue(now)) {
            if (last) RC_ASSERT(Seconds(now - *last) >= scheduler.interval());
            scheduler.trainAt(now);
            last = now;
            RC_ASSERT(scheduler.due().has_value());
            RC_ASSERT(Seconds(*scheduler.due() - now) >= scheduler.interval());
        }
    }
}

}  // namespace
}  // namespace tacto
