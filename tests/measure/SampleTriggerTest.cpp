// Tests the triggers that are searched for in samples, against their definitions in SampleTrigger.h written out sample
// by sample, and against pulses whose places are known because the test put them there.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "core/base/Random.h"
#include "core/measure/SampleTrigger.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr double kRate_hz = 1e6;

CaptureChannel channelWith(std::vector<float> samples, double range = 0) {
    CaptureChannel channel;
    channel.name = "voltage";
    channel.unit = "V";
    channel.samples = std::move(samples);
    channel.low = -range;
    channel.high = range;
    return channel;
}

/// A record of noise, bursts, runts, missing and clipped samples, from one sample on.
std::vector<float> drawnRecord(Random& random, double range) {
    const std::size_t size = random.below(5) == 0 ? 1 + random.below(3) : 1 + random.below(120);
    std::vector<float> samples(size);
    const double noise = random.below(3) == 0 ? 0 : 0.3 * random.uniform();
    for (auto& x : samples) x = static_cast<float>(noise * random.normal());
    for (std::uint64_t pulses = random.below(8); pulses > 0; --pulses) {
        const auto from = random.below(size), width = 1 + random.below(12);
        // Whole numbers: levels are then met exactly, too.
        const double height = random.below(2) == 0 ? double(random.below(13)) - 6 : 12 * random.uniform() - 6;
        for (auto i = from; i < std::min<std::uint64_t>(size, from + width); ++i)
            samples[i] = static_cast<float>(height + noise * random.normal());
    }
    for (auto& x : samples) {
        if (range > 0) x = std::clamp(x, static_cast<float>(-range), static_cast<float>(range));
    }
    if (random.below(2) == 0) {
        for (std::uint64_t gaps = random.below(4); gaps > 0; --gaps)
            samples[random.below(size)] = random.below(4) == 0 ? std::numeric_limits<float>::infinity() : std::nanf("");
    }
    return samples;
}

SampleTrigger drawnTrigger(Random& random) {
    SampleTrigger its;
    its.kind = std::array{TriggerKind::Slope, TriggerKind::Width, TriggerKind::Runt}[random.below(3)];
    its.edge = std::array{TriggerEdge::Rising, TriggerEdge::Falling, TriggerEdge::Either}[random.below(3)];
    const auto level = [&] { return random.below(2) == 0 ? double(random.below(11)) - 5 : 10 * random.uniform() - 5; };
    its.widths =
        std::array{WidthRule::Inside, WidthRule::Outside, WidthRule::Less, WidthRule::Greater}[random.below(4)];
    its.level = level();
    its.upper = its.level + 0.1 + 5 * random.uniform();
    its.hysteresis = random.below(2) == 0 ? 0 : 3 * random.uniform();
    its.shortest_s = 8 * random.uniform() / kRate_hz;
    its.longest_s = random.below(4) == 0 ? INFINITY : its.shortest_s + 10 * random.uniform() / kRate_hz;
    return its;
}

bool accepted(double width_s, const SampleTrigger& trigger) {
    const bool inside = trigger.shortest_s <= width_s && width_s <= trigger.longest_s;
    return trigger.widths == WidthRule::Inside    ? inside
           : trigger.widths == WidthRule::Outside ? !inside
           : trigger.widths == WidthRule::Less    ? width_s <= trigger.longest_s
                                                  : width_s >= trigger.shortest_s;
}

/// The definition, with a search of its own for each sample.
std::vector<double> byDefinition(const CaptureChannel& channel, const SampleTrigger& trigger) {
    std::vector<double> found;
    const auto n = static_cast<int>(channel.samples.size());
    for (const bool up : {true, false}) {
        if (up && trigger.edge == TriggerEdge::Falling) continue;
        if (!up && trigger.edge == TriggerEdge::Rising) continue;
        const auto value = [&](int i) {
            const double x = static_cast<double>(channel.samples[static_cast<std::size_t>(i)]);
            return up ? x : -x;
        };
        double level = trigger.level, other = trigger.upper;
        if (!up) {
            level = -trigger.level;
            if (trigger.kind == TriggerKind::Runt) {
                level = -trigger.upper;
                other = -trigger.level;
            }
        }
        const auto finite = [&](int from, int to) {
            for (int i = from; i <= to; ++i)
                if (!std::isfinite(value(i))) return false;
            return true;
        };
        const auto between = [&](int i) {  // where the line from sample i to the next one meets the level
            return i + (level - value(i)) / (value(i + 1) - value(i));
        };
        for (int i = 1; i < n; ++i) {
            if (!(value(i) >= level)) continue;
            int low = i - 1;  // back over samples below the level, to one that is far enough below
            while (low >= 0 && value(low) < level && !(value(low) < level - trigger.hysteresis)) --low;
            if (low < 0 || !finite(low, i) || !(value(low) < level - trigger.hysteresis)) continue;
            const double begin = between(i - 1);
            if (trigger.kind == TriggerKind::Slope) {
                found.push_back(begin);
                continue;
            }
            int end = i + 1;
            while (end < n && std::isfinite(value(end)) && value(end) >= level - trigger.hysteresis) ++end;
            if (end >= n || !std::isfinite(value(end))) continue;
            double last = begin, peak = value(i);
            for (int k = i; k < end; ++k) {
                peak = std::max(peak, value(k));
                if (value(k) >= level && value(k + 1) < level) last = between(k);
            }
            const double width_s = (last - begin) / kRate_hz;
            const double limit = channel.high;
            const bool clipped = channel.high > channel.low && peak >= limit;
            const bool hit = trigger.kind == TriggerKind::Width ? accepted(width_s, trigger) : peak < other && !clipped;
            if (hit) found.push_back(last);
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(SampleTrigger, RandomRecordsTriggerWhereTheDefinitionSays) {
    RecordProperty("hazard", "H12");
    Random random(49, "sample triggers");
    int hits = 0, none = 0;
    const int count = trials<int>({.local = 20'000, .ci = 200'000, .campaign = 2'000'000});
    for (int i = 0; i < count; ++i) {
        const double range = random.below(3) == 0 ? 4 : 0;
        const auto channel = channelWith(drawnRecord(random, range), range);
        const auto trigger = drawnTrigger(random);
        const auto found = triggersIn(channel, kRate_hz, trigger);
        const auto expected = byDefinition(channel, trigger);
        ASSERT_EQ(found.size(), expected.size()) << i << ' ' << infoOf(trigger.kind).key;
        for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NEAR(found[k], expected[k], 1e-6) << i;
        (found.empty() ? none : hits) += 1;
    }
    EXPECT_GT(hits, count / 10);
    EXPECT_GT(none, count / 10);
}

/// A burst of trapezoids, of which each edge takes one sample.
struct PutPulse {
    int at, width;
    double height;
};
std::vector<float> burstOf(const std::vector<PutPulse>& pulses, std::size_t size) {
    std::vector<float> samples(size, 0);
    for (const auto& pulse : pulses)
        std::fill_n(samples.begin() + pulse.at, pulse.width, static_cast<float>(pulse.height));
    return samples;
}

TEST(SampleTrigger, EachKindFindsItsOwnPulseOfABurst) {
    const auto channel = channelWith(burstOf({{100, 20, 10}, {200, 50, 10}, {300, 20, 4}, {400, 20, -10}}, 600));
    SampleTrigger its;
    its.level = 2;
    its.kind = TriggerKind::Slope;
    EXPECT_THAT(triggersIn(channel, kRate_hz, its),
                testing::ElementsAre(testing::DoubleNear(99.2, 1e-9), testing::DoubleNear(199.2, 1e-9),
                                     testing::DoubleNear(299.5, 1e-9)));
    its.level = -2;
    its.edge = TriggerEdge::Falling;
    EXPECT_THAT(triggersIn(channel, kRate_hz, its), testing::ElementsAre(testing::DoubleNear(399.2, 1e-9)));
    its.kind = TriggerKind::Width;
    its.level = 5;
    its.edge = TriggerEdge::Rising;
    its.shortest_s = 40e-6;
    its.longest_s = 60e-6;
    EXPECT_THAT(triggersIn(channel, kRate_hz, its), testing::ElementsAre(testing::DoubleNear(249.5, 1e-9)));
    its.shortest_s = its.longest_s = 50e-6;
    EXPECT_EQ(triggersIn(channel, kRate_hz, its).size(), 1U) << "both limits belong to the window";
    const auto placesOf = [&](WidthRule rule) {
        its.widths = rule;
        std::vector<int> places;
        for (const double at : triggersIn(channel, kRate_hz, its)) places.push_back(int(at));
        return places;
    };
    EXPECT_EQ(placesOf(WidthRule::Outside), (std::vector{119}));
    its.shortest_s = its.longest_s = 30e-6;
    EXPECT_EQ(placesOf(WidthRule::Less), (std::vector{119}));
    EXPECT_EQ(placesOf(WidthRule::Greater), (std::vector{249}));
    its.kind = TriggerKind::Magnitude;
    EXPECT_EQ(placesOf(WidthRule::Inside), (std::vector{99, 199, 399})) << "both signs";
    its.kind = TriggerKind::Runt;
    its.level = 2;
    its.upper = 8;
    EXPECT_THAT(triggersIn(channel, kRate_hz, its), testing::ElementsAre(testing::DoubleNear(319.5, 1e-9)));
}

TEST(SampleTrigger, AClippedPulseIsNoRuntBecauseItMayHaveBeenHigher) {
    SampleTrigger its;
    its.kind = TriggerKind::Runt;
    its.level = 1;
    its.upper = 8;
    const auto pulse = burstOf({{10, 5, 5}}, 30);
    EXPECT_EQ(triggersIn(channelWith(pulse, 6), kRate_hz, its).size(), 1U);
    EXPECT_TRUE(triggersIn(channelWith(pulse, 5), kRate_hz, its).empty());
}

std::shared_ptr<const Capture> benchRecord(std::vector<float> samples, double start_s) {
    auto capture = std::make_shared<Capture>();
    capture->rate_hz = kRate_hz;
    capture->start_s = start_s;
    capture->trigger_s = start_s;
    capture->channels = {channelWith(std::move(samples))};
    capture->channels.push_back(capture->channels.front());
    capture->channels.back().unit = "A";
    return capture;
}

TEST(SampleTriggerSearch, TheRecordHasTheAskedLengthAndPreTriggerWhereverItTriggers) {
    Random random(7, "trigger cuts");
    SampleTrigger its;
    its.kind = TriggerKind::Slope;
    its.level = 2;
    for (int i = 0; i < 500; ++i) {
        const std::size_t samples = 1 + random.below(200);
        const double part = random.uniform();
        const int at = 1 + static_cast<int>(random.below(398));
        SampleTriggerSearch search;
        search.set(its, "V", samples, part);
        const auto record = benchRecord(burstOf({{at, 1, 4}}, 400), 7);
        const auto taken = search.take(record);
        const double before = std::round(part * static_cast<double>(samples));
        const bool room = at - 1 >= before && at - 1 - before + static_cast<double>(samples) <= 400;
        ASSERT_EQ(taken->untriggered, !room) << at << ' ' << samples << ' ' << part;
        ASSERT_EQ(taken->samples(), samples);
        ASSERT_EQ(taken->channels.back().samples.size(), samples);
        ASSERT_EQ(std::isnan(taken->trigger_s), !room);
        if (!room) continue;
        ASSERT_NEAR(taken->trigger_s, 7 + (at - 0.5) / kRate_hz, 1e-12);
        ASSERT_NEAR((taken->trigger_s - taken->start_s) * kRate_hz, before + 0.5, 1e-4);
    }
}

TEST(SampleTriggerSearch, NoTriggerComesSoonerThanTheHoldOff) {
    Random random(8, "hold-off");
    for (int i = 0; i < 200; ++i) {
        const bool own = random.below(2) == 0;
        SampleTrigger its;
        its.kind = own ? TriggerKind::Magnitude : TriggerKind::Slope;
        its.level = 2;
        its.holdOff_s = random.below(4) == 0 ? 0 : 5e-3 * random.uniform();
        SampleTriggerSearch search;
        search.set(its, "V", 20, 0.5);
        double last_s = -INFINITY, start_s = 3;
        for (int record = 0; record < 20; ++record) {
            start_s += 1e-3 * random.uniform() + 100e-6;
            const auto taken = search.take(benchRecord(burstOf({{30, 5, 4}, {60, 5, 4}}, 100), start_s));
            std::vector<double> places = own ? std::vector{0.0} : std::vector{29.5, 59.5};
            std::erase_if(places, [&](double at) { return start_s + at / kRate_hz < last_s + its.holdOff_s; });
            ASSERT_EQ(taken->untriggered, places.empty());
            if (places.empty()) continue;
            ASSERT_NEAR(taken->trigger_s, start_s + places.front() / kRate_hz, 1e-9);
            last_s = taken->trigger_s;
        }
        search.forget();
        EXPECT_FALSE(search.take(benchRecord(burstOf({{30, 5, 4}}, 100), 0))->untriggered) << "another time base";
    }
}

TEST(SampleTriggerSearch, ARecordWithoutItsChannelOrOfOneSampleIsUntriggered) {
    SampleTrigger its;
    its.kind = TriggerKind::Runt;
    SampleTriggerSearch search;
    search.set(its, "W", 10, 0.5);
    EXPECT_TRUE(search.take(benchRecord(burstOf({{5, 2, 0.7}}, 20), 0))->untriggered);
    search.set(its, "V", 10, 0.5);
    const auto one = search.take(benchRecord({0.7F}, 0));
    EXPECT_TRUE(one->untriggered);
    EXPECT_EQ(one->samples(), 1U);
    EXPECT_EQ(search.take(nullptr), nullptr);
    EXPECT_FALSE(search.take(benchRecord(burstOf({{10, 2, 0.7}}, 20), 0))->untriggered);
}

TEST(SampleTrigger, ARefusalNamesTheFieldItsValueAndWhatIsAccepted) {
    for (const auto& kind : triggerKinds()) {
        SampleTrigger good;
        good.kind = kind.kind;
        good.level = 1;
        good.upper = 2;
        EXPECT_TRUE(checkTrigger(good, 10, "V"));
        auto bad = good;
        bad.level = 10.5;
        EXPECT_THAT(checkTrigger(bad, 10, "V").error().message,
                    testing::AllOf(HasSubstr("level 10.5 V"), HasSubstr("-10 V to 10 V")));
        for (const auto& field : kind.fields) {
            for (const double wrong : {std::nan(""), field.least * 10 - 0.5, field.most * 10 + 0.5}) {
                bad = good;
                bad.*field.value = wrong;
                const auto refused = checkTrigger(bad, 10, "V");
                ASSERT_FALSE(refused) << kind.key << ' ' << field.key << ' ' << wrong;
                EXPECT_THAT(refused.error().message, HasSubstr(std::string(field.title)));
            }
        }
    }
    SampleTrigger crossed;
    crossed.kind = TriggerKind::Runt;
    crossed.level = 3;
    crossed.upper = 3;
    EXPECT_THAT(checkTrigger(crossed, 10, "V").error().message, HasSubstr("3 V"));
    crossed.kind = TriggerKind::Width;
    crossed.shortest_s = 2e-3;
    crossed.longest_s = 1e-3;
    EXPECT_THAT(checkTrigger(crossed, 10, "V").error().message, testing::AllOf(HasSubstr("1 ms"), HasSubstr("2 ms")));
}

}  // namespace
}  // namespace tacto::test
