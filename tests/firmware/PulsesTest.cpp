// The edges that a board's timer plays are those of its train (hazards H1 and H5).
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "core/base/Random.h"
#include "resources/firmware/tactile_board/tactile_pulses.h"

namespace tacto::test {
namespace {

struct Edge {
    double level, ticks;
};

std::vector<Edge> edgesOf(const te_train& train, float ticksPerUs) {
    tp_pulses pulses{};
    EXPECT_EQ(tp_begin(&pulses, &train, ticksPerUs), 1);
    std::vector<Edge> edges;
    float level = 0;
    std::uint32_t ticks = 0;
    while (tp_next(&pulses, &level, &ticks) != 0) edges.push_back({level, static_cast<double>(ticks)});
    EXPECT_EQ(level, 0);
    EXPECT_EQ(tp_next(&pulses, &level, &ticks), 0) << "it has ended";
    EXPECT_EQ(level, 0);
    return edges;
}

te_train drawn(Random& random) {
    const auto within = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    te_train train{};
    train.amplitude = static_cast<float>(within(0.1, 40));
    train.shape = static_cast<std::uint32_t>(random.below(3));
    train.negative = static_cast<std::uint32_t>(random.below(2));
    train.width_us = static_cast<float>(within(10, 1000));
    train.gap_us = random.below(3) == 0 ? 0 : static_cast<float>(within(1, 200));
    train.recharge_ratio = static_cast<float>(within(1.01, 20));
    train.pulses = 1 + static_cast<std::uint32_t>(random.below(30));
    const double second = train.shape == TE_MONOPHASIC  ? 0
                          : train.shape == TE_SYMMETRIC ? train.width_us
                                                        : double{train.width_us} * double{train.recharge_ratio};
    train.pulse_hz =
        static_cast<float>(1e6 / (double{train.width_us} + double{train.gap_us} + second + 2) * within(0.1, 1));
    return train;
}

}  // namespace

TEST(Pulses, AreThoseOfTheTrain) {
    RecordProperty("hazard", "H1");
    Random random(5, "pulses");
    for (int k = 0; k < 20'000; ++k) {
        const te_train train = drawn(random);
        const double perUs = k % 2 == 0 ? 25 : 84;
        SCOPED_TRACE(testing::Message() << "train " << k << ", shape " << train.shape);
        double most = 0, leading = 0, charge = 0, ticks = 0, longest = 0;
        for (const auto& edge : edgesOf(train, static_cast<float>(perUs))) {
            most = std::max(most, std::abs(edge.level));
            charge += edge.level * edge.ticks;
            if (edge.level != 0 && (edge.level < 0) == (train.negative != 0)) {
                leading += edge.ticks;
                longest = std::max(longest, edge.ticks);
            }
            ticks += edge.ticks;
        }
        const double width = double{train.width_us} * perUs;
        ASSERT_EQ(most, double{train.amplitude});
        ASSERT_NEAR(longest, width, 0.51);
        ASSERT_NEAR(leading, width * train.pulses, 0.51 * train.pulses);
        const double one = train.shape == TE_MONOPHASIC ? width * double{train.amplitude} : 0;
        ASSERT_NEAR(std::abs(charge), one * train.pulses, 1.02 * double{train.amplitude} * train.pulses);
        ASSERT_LE(ticks, train.pulses / double{train.pulse_hz} * 1e6 * perUs * (1 + 1e-6) + train.pulses);
        ASSERT_GE(ticks, (train.pulses - 1) / double{train.pulse_hz} * 1e6 * perUs * (1 - 1e-6) - train.pulses);
    }
}

TEST(Pulses, AreNoneOfATrainThatNoTimerPlays) {
    RecordProperty("hazard", "H1");
    Random random(6, "pulses");
    const te_train sound = drawn(random);
    for (const auto spoil : std::initializer_list<void (*)(te_train&)>{
             [](auto& t) { t.width_us = 0; }, [](auto& t) { t.width_us = NAN; }, [](auto& t) { t.width_us = 1e9F; },
             [](auto& t) { t.pulse_hz = NAN; }, [](auto& t) { t.pulse_hz = 1e5F; },
             [](auto& t) { t.shape = TE_ASYMMETRIC, t.recharge_ratio = NAN; }}) {
        te_train train = sound;
        spoil(train);
        tp_pulses pulses{};
        EXPECT_EQ(tp_begin(&pulses, &train, 25), 0);
        float level = 1;
        std::uint32_t ticks = 0;
        EXPECT_EQ(tp_next(&pulses, &level, &ticks), 0);
        EXPECT_EQ(level, 0);
    }
}

/// A timer and an output, of which a program has one each.
struct Played {
    std::uint32_t after = 0;
    float level = 0;
    std::vector<Edge> edges;
};
Played played;

TEST(Pulses, ArePlayedTrainAfterTrainAndEndAtOnce) {
    RecordProperty("hazard", "H2");
    constexpr double kPerUs = 25;
    const tp_player zeroed{[](std::uint32_t ticks) { played.after = ticks; },
                           [](float level) { played.level = level; },
                           static_cast<float>(kPerUs),
                           {},
                           {},
                           0,
                           0};
    Random random(6, "player");
    for (int k = 0; k < 2000; ++k) {
        SCOPED_TRACE(testing::Message() << "train " << k);
        tp_player player = zeroed;
        played = {};
        double ticks = 0;
        const auto now_us = [&] { return static_cast<std::uint64_t>(ticks / kPerUs); };
        // Until the timer stops, or for so many of its interrupts.
        const auto run = [&](std::uint64_t most) {
            while (played.after > 0 && most-- > 0) {
                if (played.level != 0) played.edges.push_back({played.level, static_cast<double>(played.after)});
                ticks += std::exchange(played.after, 0);
                tp_go_on(&player, now_us());
            }
        };
        te_train first = drawn(random), second = drawn(random), third = drawn(random);
        first.onset_ns = static_cast<std::int64_t>(random.below(5000)) * 1000;
        second.onset_ns = third.onset_ns = 0;
        te_train impossible = second;
        impossible.width_us = 0;
        EXPECT_EQ(tp_play(&player, &impossible, 0), 0);
        EXPECT_EQ(played.after, 0U);
        EXPECT_EQ(tp_play(&player, &first, 0), 1);
        EXPECT_EQ(played.level, 0) << "before its onset";
        EXPECT_EQ(played.after, std::max<double>(1, static_cast<double>(first.onset_ns) / 1000 * kPerUs));
        EXPECT_EQ(tp_play(&player, &impossible, 0), 0);
        EXPECT_EQ(tp_play(&player, &second, 0), 1) << "it waits";
        EXPECT_EQ(tp_play(&player, &third, 0), 0) << "two are there";
        std::vector<Edge> expected;
        for (const auto& train : {first, second}) {
            for (const auto& edge : edgesOf(train, static_cast<float>(kPerUs)))
                if (edge.level != 0) expected.push_back(edge);
        }
        const bool cut = k % 2 == 0;
        run(cut ? 1 + random.below(2 * expected.size()) : 100'000);
        if (cut) {
            EXPECT_EQ(tp_play(&player, nullptr, now_us()), 1);
            expected.resize(std::min(expected.size(), played.edges.size()));
        }
        EXPECT_EQ(played.level, 0);
        EXPECT_EQ(played.after, 0U);
        tp_go_on(&player, now_us());  // an interrupt that was on its way
        EXPECT_EQ(played.level, 0);
        EXPECT_EQ(played.after, 0U);
        ASSERT_EQ(played.edges.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(played.edges[i].level, expected[i].level);
            EXPECT_EQ(played.edges[i].ticks, expected[i].ticks);
        }
        EXPECT_EQ(tp_play(&player, &third, now_us()), 1) << "and it plays again";
        EXPECT_GT(played.after, 0U);
    }
}

}  // namespace tacto::test
