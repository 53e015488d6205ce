// The chain reports what is missing: why no frame is in contact, which stream has no data for the frames, and which
// values were implausibly large.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/dsp/RoughnessAnalysis.h"

using namespace tacto;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

SampleBlock noise(double from_s, double to_s, double rate_hz, std::size_t channels, double mean, double spread,
                  unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> around(mean - spread, mean + spread);
    SampleBlock block;
    const auto count = static_cast<std::size_t>(std::lround((to_s - from_s) * rate_hz));
    for (std::size_t i = 0; i < count; ++i) {
        block.t_s.push_back(from_s + static_cast<double>(i) / rate_hz);
        for (std::size_t c = 0; c < channels; ++c) block.values.push_back(around(random));
    }
    return block;
}

StreamInfo accelerationAt(double rate_hz) {
    return {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 1, rate_hz, "a"};
}
StreamInfo forceAt(double rate_hz, StreamUnit unit = StreamUnit::Newton) {
    return {StreamKind::Force, unit, 1, rate_hz, "f"};
}

RoughnessSummary analysed(const std::vector<StreamInfo>& infos, const std::vector<SampleBlock>& blocks,
                          const DeclaredIntervals& declared = {}) {
    const auto found = analyseRoughness(infos, blocks, {}, declared);
    EXPECT_TRUE(found) << found.error().message;
    return found ? found->summary : RoughnessSummary{};
}

/// Returns the sentence for the flag that begins with `flag`; empty if there is none.
std::string sentenceOf(const RoughnessSummary& summary, const std::string& flag) {
    for (const auto& text : summary.flags) {
        if (text.starts_with(flag)) return flagSentence(text);
    }
    return {};
}

}  // namespace

TEST(Absence, AForceBelowContactIsNamedWithItsRangeAndAsksForItsSignOrUnit) {
    RecordProperty("hazard", "H7");
    for (unsigned seed = 1; seed <= 50; ++seed) {
        std::mt19937 random(seed);
        const double size = std::pow(10.0, std::uniform_real_distribution<double>(-3, 2)(random));
        const bool negative = seed % 2 == 0;
        const double mean = negative ? -size : std::min(size, 0.08), spread = 0.2 * std::abs(mean);
        const auto force = noise(0, 2, 200, 1, mean, spread, seed);
        const auto summary = analysed({accelerationAt(1000), forceAt(200)}, {noise(0, 2, 1000, 1, 0, 1, seed), force});
        ASSERT_EQ(summary.contactFrames, 0U);
        const auto [low, high] = std::ranges::minmax(force.values);
        const auto sentence = sentenceOf(summary, "force below contact");
        EXPECT_THAT(sentence, HasSubstr(fmt::format("between {:.3g} and {:.3g} N", low, high))) << "seed " << seed;
        EXPECT_THAT(sentence,
                    HasSubstr(negative ? "is the sign of the normal force reversed?" : "its unit is another"));
    }
    const auto counts = analysed({forceAt(200, StreamUnit::Count)}, {noise(0, 2, 200, 1, -500, 10, 1)});
    EXPECT_THAT(sentenceOf(counts, "force below contact"), HasSubstr("-490 count; is the sign"));
    const auto touched = analysed({forceAt(200)}, {noise(0, 2, 200, 1, 1, 0.1, 1)});
    EXPECT_EQ(sentenceOf(touched, "force below contact"), "");
}

TEST(Absence, StreamsAtOtherTimesAreNamedWithTheFramesThatHaveNothingOfThem) {
    const StreamInfo taxels{StreamKind::Taxels, StreamUnit::Pascal, 2, 200, "t"};
    for (const double shift_s : {-100.0, -4.0, 4.0, 1000.0}) {
        const auto summary = analysed({accelerationAt(1000), forceAt(200), taxels},
                                      {noise(0, 2, 1000, 1, 0, 1, 1), noise(shift_s, shift_s + 2, 200, 1, 1, 0.1, 2),
                                       noise(shift_s, shift_s + 2, 200, 2, 5000, 100, 3)});
        EXPECT_EQ(summary.contactFrames, 0U) << shift_s;
        EXPECT_THAT(summary.flags, Contains(fmt::format("force at other times: {}", summary.frames))) << shift_s;
        EXPECT_THAT(summary.flags, Contains(fmt::format("taxels at other times: {}", summary.frames))) << shift_s;
        EXPECT_THAT(summary.flags, testing::Not(Contains("no frame in contact")));
    }
    const auto together = analysed(
        {accelerationAt(1000), forceAt(200), taxels},
        {noise(0, 2, 1000, 1, 0, 1, 1), noise(0.5, 2.5, 200, 1, 1, 0.1, 2), noise(-1, 0.5, 200, 2, 5000, 100, 3)});
    EXPECT_THAT(together.flags, testing::Not(Contains(HasSubstr("other times")))) << "a part of them is enough";
}

TEST(Absence, ZeroInContactHasItsReasonAlways) {
    const auto acceleration = noise(0, 2, 1000, 1, 0, 1, 1);
    // Contact is declared where there is no frame, or not at all.
    for (const auto& contact : {std::vector<TimeInterval>{}, std::vector<TimeInterval>{{1.9985, 1.9995}}}) {
        const auto summary = analysed({accelerationAt(1000)}, {acceleration}, {std::nullopt, contact});
        EXPECT_EQ(summary.contactFrames, 0U);
        EXPECT_THAT(summary.flags, Contains("no frame in contact"));
    }
    // The force samples are so far apart that the force is stale at every frame.
    SampleBlock seldom{{0.0, 3.0}, {1.0, 1.0}};
    const auto stale = analysed({accelerationAt(1000), forceAt(1)}, {noise(0.2, 2, 1000, 1, 0, 1, 1), seldom});
    EXPECT_EQ(stale.contactFrames, 0U);
    EXPECT_THAT(stale.flags, Contains(testing::AnyOf("no frame in contact", StartsWith("force at other times"))));
    // All values are NaN.
    auto none = noise(0, 2, 200, 1, 1, 0.1, 1);
    std::ranges::fill(none.values, std::nan(""));
    EXPECT_THAT(analysed({accelerationAt(1000), forceAt(200)}, {acceleration, none}).flags,
                Contains("not a number in force: 400"));
    // Values in millinewtons that are declared as newtons.
    EXPECT_THAT(analysed({accelerationAt(1000), forceAt(200)}, {acceleration, noise(0, 2, 200, 1, 1000, 100, 1)}).flags,
                Contains("out of all proportion in force: 400"));
}

TEST(Absence, ValuesOutOfAllProportionAreCountedAndLeftOutAndImpactsAreNot) {
    RecordProperty("hazard", "H7");
    for (unsigned seed = 1; seed <= 50; ++seed) {
        std::mt19937 random(seed);
        const auto clean = noise(0, 2, 200, 1, 1, 0.2, seed);
        auto spiked = clean;
        SampleBlock without;
        std::size_t spikes = 0;
        for (std::size_t i = 0; i < clean.samples(); ++i) {
            const bool spike = i > 0 && i + 1 < clean.samples() && random() % 50 == 0;
            if (spike)
                spiked.values[i] = (random() % 2 == 0 ? 1 : -1) *
                                   std::pow(10.0, std::uniform_real_distribution<double>(2.5, 9)(random));
            if (spike) {
                ++spikes;
                continue;
            }
            without.t_s.push_back(clean.t_s[i]);
            without.values.push_back(clean.values[i]);
        }
        const auto acceleration = noise(0, 2, 1000, 1, 0, 1, seed);
        const auto found = analysed({accelerationAt(1000), forceAt(200)}, {acceleration, spiked});
        const auto expected = analysed({accelerationAt(1000), forceAt(200)}, {acceleration, without});
        EXPECT_EQ(found.pressure_pa.mean, expected.pressure_pa.mean);
        EXPECT_EQ(found.pressure_pa.max, expected.pressure_pa.max);
        EXPECT_EQ(found.h.mean, expected.h.mean);
        if (spikes > 0) {
            EXPECT_THAT(found.flags, Contains(fmt::format("out of all proportion in force: {}", spikes)));
        }
        EXPECT_THAT(expected.flags, testing::Not(Contains(StartsWith("out of all proportion"))));
    }
    auto impact = noise(0, 2, 200, 1, 1, 0.2, 1);
    for (std::size_t i = 200; i < 206; ++i) impact.values[i] = 150;
    auto knock = noise(0, 2, 1000, 1, 0, 1, 1);
    knock.values[1000] = -4000;
    const auto kept = analysed({accelerationAt(1000), forceAt(200)}, {knock, impact});
    EXPECT_THAT(kept.flags, testing::Not(Contains(StartsWith("out of all proportion"))));
    EXPECT_GT(kept.pressure_pa.max, 1e5);
    knock.values[1000] = -9999;
    EXPECT_THAT(analysed({accelerationAt(1000)}, {knock}).flags, Contains("out of all proportion in acceleration: 1"));
    const StreamInfo taxels{StreamKind::Taxels, StreamUnit::Pascal, 2, 200, "t"};
    auto pressed = noise(0, 2, 200, 2, 5000, 100, 1);
    pressed.values[301] = 3e9;
    const auto summary = analysed({taxels}, {pressed});
    EXPECT_THAT(summary.flags, Contains("out of all proportion in taxels: 1"));
    EXPECT_LT(summary.pressure_pa.max, 6000);
}
