// The limits on a step, train by train, as used by the live loop, the sweep and the design.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "core/encoding/StepResponse.h"
#include "core/encoding/TrainSeries.h"
#include "core/encoding/Transitions.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

EncodingProfile limited() {
    EncodingProfile profile;
    profile.amplitudeRatioPerTrain = 1.2;
    profile.intervalRatioPerTrain = 1.34;
    return profile;
}

Command command(double volts, double seconds) { return {Volts(volts), Seconds(seconds)}; }
Instant seconds(double s) { return toInstant(Seconds(s)); }

struct Seen {
    Instant onset;
    Volts amplitude;
};

TEST(TrainSeries, AnotherEncodersTrainIsNoLargerStepThanTheProfilePermits) {
    testing::Test::RecordProperty("hazard", "H6");
    TrainSeries series(limited());
    ASSERT_TRUE(series.follow(command(20, 1), seconds(10))) << "nothing came before";
    series.delivered();
    EXPECT_FALSE(series.follow(command(24.1, 1), seconds(11))) << "stronger by more than 1.2";
    EXPECT_FALSE(series.command().has_value());
    EXPECT_FALSE(series.follow(command(20, 0.73), seconds(11))) << "sooner by more than 1.34";
    EXPECT_FALSE(series.follow(command(20, 1), seconds(10.49))) << "whatever it states, before the shortest interval";
    EXPECT_FALSE(series.follow(command(20, 1), seconds(10))) << "again";
    ASSERT_TRUE(series.follow(command(23.9, 0.76), seconds(11)));
    EXPECT_EQ(series.command(), command(23.9, 0.76));
    EXPECT_FALSE(series.due().has_value()) << "the other encoder says when";
    EXPECT_TRUE(series.follow(command(10, 2), seconds(11.01))) << "a fall is not held back, and 23.9 was not delivered";
    EXPECT_FALSE(series.follow(command(24.1, 1), seconds(11.02)));
    EXPECT_TRUE(series.follow(command(40, 0.5), seconds(14.01))) << "twice the longest interval later";
}

TEST(TrainSeries, AnotherEncodersSlewIsHeldToo) {
    testing::Test::RecordProperty("hazard", "H6");
    EncodingProfile profile;
    profile.amplitudeSlew_V_per_s = 10;
    TrainSeries series(profile);
    ASSERT_TRUE(series.follow(command(20, 1), seconds(10)));
    series.delivered();
    EXPECT_TRUE(series.follow(command(25, 1), seconds(10.5)));
    EXPECT_FALSE(series.follow(command(25.1, 1), seconds(10.5)));
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(series.follow(command(kNan, 1), seconds(10.5)));
    EXPECT_FALSE(series.follow(command(20, kNan), seconds(10.5)));
}

/// Returns the trains of a loop with a 5 ms period: the first at `before`, and `after` wanted from `step_s` on.
std::vector<Seen> trainsOf(TrainSeries& series, const Command& before, const Command& after, double step_s,
                           double until_s) {
    std::vector<Seen> trains;
    for (Instant now{0}; now < seconds(until_s); now += std::chrono::milliseconds(5)) {
        series.want(now < seconds(step_s) ? before : after, now);
        if (*series.due() > now) continue;
        trains.push_back({now, series.begin(now).amplitude});
        series.delivered();
    }
    return trains;
}

TEST(TrainSeries, ReachesTheOtherEndInEqualStepsOfPerception) {
    RecordProperty("hazard", "H6");
    TrainSeries series(limited());
    const auto trains = trainsOf(series, command(10, 0.5), command(40, 0.5), 0.1, 6);
    ASSERT_GT(trains.size(), 9U);
    for (std::size_t k = 1; k <= 7; ++k) {
        EXPECT_NEAR(trains[k].amplitude.value(), 10 * std::pow(1.2, k), 1e-9) << k;
    }
    EXPECT_EQ(trains[8].amplitude, Volts(40)) << "the eighth train after the change";
    EXPECT_EQ(toSeconds(trains[8].onset), 4);
}

TEST(TrainSeries, NoTrainStepsBeyondTheLimitsWhateverIsWantedAndWhenever) {
    RecordProperty("hazard", "H6");
    rc::check("ratio of neighbours, as delivered",
              [](const std::vector<std::tuple<std::uint8_t, std::uint8_t, std::uint8_t>>& moves) {
                  const EncodingProfile profile = limited();
                  TrainSeries series(profile);
                  const Encoder encoder(profile);
                  std::vector<Seen> trains;
                  Instant now{0};
                  for (const auto& [r, p, wait] : moves) {
                      const Command wanted = *encoder.encode(r / 255.0, p / 255.0);
                      for (int step = 0; step <= wait; ++step, now += std::chrono::milliseconds(5)) {
                          series.want(wanted, now);
                          if (*series.due() > now) continue;
                          trains.push_back({now, series.begin(now).amplitude});
                          series.delivered();
                      }
                  }
                  for (std::size_t k = 1; k < trains.size(); ++k) {
                      RC_ASSERT(amplitudeDistance(trains[k].amplitude, trains[k - 1].amplitude) <= 2);
                      if (k < 2) continue;
                      const auto interval = [&](std::size_t i) {
                          return Seconds(trains[i].onset - trains[i - 1].onset);
                      };
                      // The loop runs every 5 ms: an interval can be longer than commanded by that much.
                      const double slack = std::log1p(0.006 / interval(k).count()) / std::log(1.16);
                      RC_ASSERT(intervalDistance(interval(k), interval(k - 1)) <= 2 + slack);
                  }
              });
}

TEST(TrainSeries, ATrainPulledForwardLateIsFeltAtTheIntervalThatPassed) {
    RecordProperty("hazard", "H6");
    TrainSeries series(limited());
    const auto trains = trainsOf(series, command(20, 2), command(20, 0.5), 1.9, 12);
    EXPECT_EQ(toSeconds(trains[1].onset), 1.9) << "at once";
    // Computed from the 1.9 s that have passed, not from 1.49 s, when the train could have come at the earliest.
    EXPECT_NEAR(toSeconds(trains[2].onset - trains[1].onset), 1.9 / 1.34, 0.005);
}

TEST(TrainSeries, AfterASilenceATrainBeginsAnew) {
    TrainSeries series(limited());
    ASSERT_EQ(trainsOf(series, command(10, 0.5), command(10, 0.5), 1, 0.2).size(), 1U);
    series.wantNothing();
    EXPECT_FALSE(series.due());
    series.want(command(40, 0.5), seconds(3.9));
    EXPECT_EQ(series.command()->amplitude, Volts(12)) << "an interval of the series, however long";
    series.wantNothing();
    series.want(command(40, 0.5), seconds(4.1));
    EXPECT_EQ(series.command()->amplitude, Volts(40)) << "no train within 4 s to compare it with";
}

TEST(TrainSeries, SwitchedOnAgainNothingBeginsStrongerOrMoreOftenThanItIsWanted) {
    RecordProperty("hazard", "H6");
    TrainSeries series(limited());
    const auto after = [&](const Command& wanted) {
        series.want(command(40, 0.5), seconds(0));
        static_cast<void>(series.begin(seconds(0)));
        series.delivered();
        series.wantNothing();
        series.want(wanted, seconds(1));
        return series.begin(seconds(1));
    };
    EXPECT_EQ(after(command(10, 2)).amplitude, Volts(10)) << "not a step down from 40 V";
    EXPECT_EQ(after(command(10, 2)).interval, Seconds(2));
    // However often it is switched, the amplitude rises in steps.
    TrainSeries again(limited());
    again.want(command(10, 2), seconds(0));
    static_cast<void>(again.begin(seconds(0)));
    again.delivered();
    again.wantNothing();
    again.want(command(40, 0.5), seconds(1));
    EXPECT_NEAR(again.begin(seconds(1)).amplitude.value(), 12, 1e-9);
    again.delivered();
    again.want(command(10, 2), seconds(1));
    EXPECT_NEAR(again.command()->amplitude.value(), 10, 1e-9);
    // While driven, it steps down as before.
    again.want(command(40, 0.5), seconds(1));
    for (double now = 2; now < 12; now += 1) {
        static_cast<void>(again.begin(seconds(now)));
        again.delivered();
    }
    again.want(command(10, 0.5), seconds(12));
    EXPECT_NEAR(again.begin(seconds(12)).amplitude.value(), 40 / 1.2, 1e-9);
}

TEST(TrainSeries, ARefusedTrainIsNoneToStepFrom) {
    RecordProperty("hazard", "H6");
    TrainSeries series(limited());
    series.want(command(10, 0.5), seconds(0));
    static_cast<void>(series.begin(seconds(0)));
    series.delivered();
    for (const double refused_s : {0.5, 1.0}) {
        series.want(command(40, 0.5), seconds(refused_s));
        EXPECT_EQ(series.begin(seconds(refused_s)).amplitude, Volts(12)) << refused_s;
    }
}

TEST(TrainSeries, ACalibratedScheduleKeepsTheIntervalsThatAreTold) {
    StimulatorCalibration calibration;
    calibration.amplitude = {1, 0, 1, 50};
    calibration.interval = CalibrationLine{1.01, 0, 0.4, 3};
    TrainSeries series(EncodingProfile{}, calibration);
    series.want(command(20, 2), seconds(0));
    static_cast<void>(series.begin(seconds(0)));
    series.delivered();
    series.want(command(20, 1), seconds(0.1));
    EXPECT_NEAR(toSeconds(*series.due()), programmedFor(Seconds(1), calibration).count(), 1e-8);
    EXPECT_EQ(series.command()->interval, Seconds(1));
}

TEST(StepPace, CountsTheTrainsAndTheTimeThatTwoDifferencesTake) {
    // The expected values come from an exhaustive search (tests/reference/trains.py).
    for (const auto& least : test::figuresOf("trains").at("pace")) {
        const auto at = [&](const char* end) { return command(least.at(end).at(0), least.at(end).at(1)); };
        const auto pace = fastestPace({Seconds(least.at("since")), at("before"), at("after")}, 2);
        EXPECT_EQ(pace.trains, least.at("trains").get<int>()) << least;
        EXPECT_NEAR(pace.complete.count(), least.at("complete_s").get<double>(), 1e-9) << least;
    }
    // However late the step comes, the elapsed time counts as the first interval.
    for (const double since : {0.0, 0.5, 1.0, 1.4863, 1.7, 2.0}) {
        EXPECT_GT(fastestPace({Seconds(since), command(25, 2), command(25, 0.5)}, 2).complete, Seconds(3)) << since;
    }
}

TEST(StepPace, IsNeverSlowerThanASeriesUnderTheSameLimits) {
    EncodingProfile profile;
    profile.amplitudeRatioPerTrain = 1.21;
    profile.intervalRatioPerTrain = 1.3456;
    for (const double since : {0.01, 0.3, 0.49}) {
        for (const Command& from :
             {command(10, 0.5), command(40, 0.5), command(10, 2), command(40, 2), command(20, 1)}) {
            for (const Command& to :
                 {command(10, 0.5), command(40, 0.5), command(10, 2), command(40, 2), command(20, 1)}) {
                if (from == to) continue;
                const StepEnds ends{Seconds(since), from, to};
                const auto found = respond(ends, designedTrains(profile, ends).value(), 0.001);
                const auto bound = fastestPace(ends, 2);
                ASSERT_TRUE(found.trains && found.complete);
                EXPECT_LE(bound.trains, *found.trains);
                EXPECT_LE(bound.complete.count(), found.complete->count() + 1e-6);
            }
        }
    }
}

TEST(StepPace, TheShippedLimitsTakeNoMoreTrainsThanTwoDifferencesDo) {
    const EncodingProfile profile = limited();
    for (double since = 0; since <= 2; since += 0.01) {
        for (const auto& [from, to] :
             {std::pair{command(25, 2), command(25, 0.5)}, std::pair{command(25, 0.5), command(25, 2)},
              std::pair{command(10, 2), command(40, 0.5)}, std::pair{command(40, 2), command(10, 2)}}) {
            if (since > from.interval.count()) continue;
            const StepEnds ends{Seconds(since), from, to};
            const auto found = respond(ends, designedTrains(profile, ends).value());
            EXPECT_LE(found.trains.value(), fastestPace(ends, 2).trains)
                << since << " " << from.amplitude.value() << " V, " << from.interval.count() << " s";
        }
    }
}

using namespace std::chrono_literals;

TEST(TrainScheduler, HasNothingDueBeforeItStarts) {
    TrainScheduler scheduler;
    EXPECT_FALSE(scheduler.due());
    scheduler.setInterval(Seconds(1), 0s);
    EXPECT_FALSE(scheduler.due());
}

TEST(TrainScheduler, SendsTheFirstTrainAtOnceAndTheNextAnIntervalLater) {
    TrainScheduler scheduler;
    scheduler.start(3s, Seconds(2));
    EXPECT_EQ(scheduler.due(), 3s);
    scheduler.trainAt(3s);
    EXPECT_EQ(scheduler.due(), 5s);
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

TEST(TrainScheduler, RemembersTheLastOnsetAcrossOff) {
    TrainScheduler scheduler;
    scheduler.start(0s, Seconds(1));
    scheduler.trainAt(0s);
    scheduler.off();
    EXPECT_FALSE(scheduler.due());
    scheduler.setInterval(Seconds(0.5), 100ms);
    EXPECT_FALSE(scheduler.due()) << "only start() ends off";
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
        rc::gen::pair(rc::gen::inRange(0, 4), rc::gen::inRange(1, 400)));
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
                scheduler.off();
                break;
            default:
                scheduler.start(now, interval);
                break;
        }
        if (scheduler.due() && *scheduler.due() <= now) {
            if (last) RC_ASSERT(Seconds(now - *last) >= interval);
            scheduler.trainAt(now);
            last = now;
            RC_ASSERT(scheduler.due().has_value());
            RC_ASSERT(Seconds(*scheduler.due() - now) >= interval);
        }
    }
}

}  // namespace
}  // namespace tacto
