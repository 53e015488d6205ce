#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/analysis/statistics/ConfidenceBound.h"
#include "tests/analysis/psychophysics/Procedures.h"

namespace tacto {
namespace {

const std::vector<DeliveredCondition> kFour = {
    {4, Seconds(2)}, {4, Seconds(0.5)}, {6.5, Seconds(2)}, {6.5, Seconds(0.5)}};

/// Returns a participant with noise enough for every error, who feels from two JND below the lower level ("none").
VirtualParticipant uncertainParticipant() {
    auto who = test::medianParticipant();
    who.detection = Milliamps(3.6);
    who.noise_jnd = 3;
    who.lapse = 0.05;
    return who;
}

/// Compares counts with probabilities and expects their χ² to be below its 0.999 quantile.
void expectFollows(const std::vector<std::size_t>& counts, const std::vector<double>& probabilities) {
    std::size_t n = 0;
    for (const auto count : counts) n += count;
    double chi = 0, cells = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double expected = static_cast<double>(n) * probabilities[i];
        if (expected < 5) continue;
        chi += std::pow(static_cast<double>(counts[i]) - expected, 2) / expected;
        cells += 1;
    }
    ASSERT_GE(cells, 2);
    EXPECT_LT(chi, chiSquaredQuantile(0.999, cells));
}

TEST(VirtualObserver, AnswersAsPredicted) {
    for (const double adaptation : {0.0, 0.3}) {
        const auto observer = test::observerFor(uncertainParticipant(), 3, adaptation);
        const Seconds stimulated(240);
        const auto predicted = observer.predicted(kFour, stimulated);
        for (std::size_t presented = 0; presented < kFour.size(); ++presented) {
            std::vector<std::size_t> counts(5, 0);
            for (int i = 0; i < 20'000; ++i) {
                ++counts[observer.identify(std::to_string(i), kFour, presented, stimulated)];
            }
            expectFollows(counts, predicted[presented]);
        }
        std::vector<std::size_t> counts(5, 0);
        for (int i = 0; i < 20'000; ++i) {
            ++counts[observer.identify(std::to_string(i), kFour, std::nullopt, stimulated)];
        }
        const double lapse = uncertainParticipant().lapse;
        expectFollows(counts, {lapse / 4, lapse / 4, lapse / 4, lapse / 4, 1 - lapse});
    }
}

TEST(VirtualObserver, DetectsByTheFunctionThatQuestPlusAssumes) {
    const auto who = test::medianParticipant();
    const auto observer = test::observerFor(who, 3);
    const double threshold = who.detection.value();
    EXPECT_NEAR(observer.probabilityRight(threshold, Seconds(0)), 0.5 + 0.49 * (1 - std::exp(-1)), 1e-12);
    EXPECT_NEAR(observer.probabilityRight(100, Seconds(0)), 0.99, 1e-12) << "half of the lapses are right";
    EXPECT_EQ(observer.probabilityRight(0, Seconds(0)), 0.5);
    // The slope at this point is the slope of the noise: d(felt)/d(ln level) = 1/(√(2π) · ln 1.1).
    const double rise = (observer.probabilityRight(threshold * 1.0001, Seconds(0)) -
                         observer.probabilityRight(threshold / 1.0001, Seconds(0))) /
                        (2 * std::log(1.0001) * 0.49);
    EXPECT_NEAR(rise * std::sqrt(2 * std::numbers::pi) * std::log(1.1), 1, 1e-4);
    for (const double level : {2.5, threshold, 3.5}) {
        int right = 0;
        for (int i = 0; i < 20'000; ++i) {
            const auto interval = i % 2 == 0 ? TrialInterval::First : TrialInterval::Second;
            if (observer.detect(std::to_string(i), level, interval, Seconds(0)) == interval) ++right;
        }
        EXPECT_NEAR(right / 20'000.0, observer.probabilityRight(level, Seconds(0)), 0.013) << level;
    }
}

TEST(VirtualObserver, GivesAnAnswerThatDependsOnItsKeyAlone) {
    const auto observer = test::observerFor(uncertainParticipant(), 3),
               again = test::observerFor(uncertainParticipant(), 3);
    const auto different = test::observerFor(uncertainParticipant(), 4);
    std::vector<std::size_t> forwards, backwards(50), others;
    for (int i = 0; i < 50; ++i) {
        const auto key = "session 2 trial " + std::to_string(i);
        forwards.push_back(observer.identify(key, kFour, 0, Seconds(0)));
        others.push_back(different.identify(key, kFour, 0, Seconds(0)));
    }
    for (int i = 49; i >= 0; --i) {
        const auto key = "session 2 trial " + std::to_string(i);
        (void)again.strength(key, 4, Seconds(0));
        backwards[static_cast<std::size_t>(i)] = again.identify(key, kFour, 0, Seconds(0));
    }
    EXPECT_EQ(forwards, backwards);
    EXPECT_NE(forwards, others);
    EXPECT_NE(forwards, std::vector<std::size_t>(50, forwards[0]));
}

TEST(VirtualObserver, SaysHowStrongALevelIs) {
    auto who = test::medianParticipant();
    who.noise_jnd = 1e-6;
    const auto observer = test::observerFor(who, 1);
    const auto said = [&](double level) { return observer.strength("a", level, Seconds(0)); };
    EXPECT_EQ(said(0), StrengthWord::Nothing);
    EXPECT_EQ(said(0.99 * who.detection.value()), StrengthWord::Nothing);
    EXPECT_EQ(said(1.01 * who.detection.value()), StrengthWord::Weak);
    EXPECT_EQ(said(1.01 * who.attention.value()), StrengthWord::Strong);
    EXPECT_EQ(said(0.99 * who.discomfort.value()), StrengthWord::Strong);
    EXPECT_EQ(said(1.01 * who.discomfort.value()), StrengthWord::TooStrong);
    EXPECT_TRUE(observer.acceptable("a", 0.99 * who.discomfort.value(), Seconds(0)));
    EXPECT_FALSE(observer.acceptable("a", 1.01 * who.discomfort.value(), Seconds(0)));
}

TEST(VirtualObserver, AdaptsWithStimulation) {
    auto who = test::medianParticipant();
    const auto observer = test::observerFor(who, 1, 0.4);
    EXPECT_EQ(observer.risen(Seconds(0)), 1);
    EXPECT_NEAR(observer.risen(Seconds(300)), 1 + 0.4 * (1 - std::exp(-1)), 1e-12);
    EXPECT_NEAR(observer.risen(Seconds(1e6)), 1.4, 1e-12);
    EXPECT_NEAR(observer.probabilityRight(1.4 * who.detection.value(), Seconds(1e6)),
                observer.probabilityRight(who.detection.value(), Seconds(0)), 1e-12);
    EXPECT_GT(observer.predicted(kFour, Seconds(1e6))[0][4], observer.predicted(kFour, Seconds(0))[0][4] + 0.1);
}

TEST(VirtualObserver, RatesWithinItsScales) {
    const auto observer = test::observerFor(test::medianParticipant(), 1);
    double last = -1;
    for (const double level : {0.0, 1.0, 4.0, 6.0, 8.0, 12.0, 100.0}) {
        double sum = 0;
        for (int i = 0; i < 200; ++i) {
            const auto rating = observer.rate(std::to_string(i), level, Seconds(0));
            for (const int value : {rating.intensity, rating.unpleasantness, rating.pain}) {
                EXPECT_GE(value, 0);
                EXPECT_LE(value, 10);
            }
            EXPECT_EQ(rating.qualities.empty(), rating.intensity == 0);
            sum += rating.intensity;
        }
        EXPECT_GE(sum, last);
        last = sum;
    }
}

TEST(VirtualObserver, FeelsAMassagersIntensityAsAShareOfItsFullOne) {
    const auto who = test::medianParticipant();
    const auto current = test::observerFor(who, 2);
    const auto intensity = VirtualObserver::create({.who = who, .seed = 2, .unit = LevelUnit::Intensity}).value();
    EXPECT_NEAR(intensity.detection() * kVirtualFullIntensity.value(), current.detection(), 1e-12);
    EXPECT_NEAR(intensity.tooStrong() * kVirtualFullIntensity.value(), current.tooStrong(), 1e-12);
    EXPECT_NEAR(intensity.probabilityRight(3 / kVirtualFullIntensity.value(), Seconds(0)),
                current.probabilityRight(3, Seconds(0)), 1e-12);
}

TEST(VirtualObserver, RefusesWhatIsNoParticipant) {
    const auto refused = [](auto change) {
        VirtualObserverSettings settings{.who = test::medianParticipant()};
        change(settings);
        return !VirtualObserver::create(settings);
    };
    EXPECT_FALSE(refused([](auto&) {}));
    const double nan = std::nan("");
    EXPECT_TRUE(refused([&](auto& s) { s.adaptation = nan; }));
    EXPECT_TRUE(refused([&](auto& s) { s.adaptation = -0.1; }));
    EXPECT_TRUE(refused([&](auto& s) { s.adaptationTime = Seconds(0); }));
    EXPECT_TRUE(refused([&](auto& s) { s.who.detection = Milliamps(nan); }));
    EXPECT_TRUE(refused([&](auto& s) { s.who.discomfort = s.who.detection; }));
    EXPECT_TRUE(refused([&](auto& s) { s.who.lapse = 1.1; }));
    EXPECT_TRUE(refused([&](auto& s) { s.who.noise_jnd = 0; }));
    EXPECT_TRUE(refused([&](auto& s) { s.who.amplitudeWeber = nan; }));
}

}  // namespace
}  // namespace tacto
