#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <rapidcheck/gtest.h>
#include <vector>

#include "core/base/NaN.h"
#include "core/encoding/Waveform.h"

namespace tacto {
namespace {

/// The ideal level at `t`, by walking through the definition.
double levelAt(const PulseTrain& train, double t) {
    const double period = 1 / train.rate.value();
    const auto pulse = segmentsOf(train, GapState::HoldsZero);
    for (int p = 0; p < train.pulses; ++p) {
        double from = p * period;
        for (const auto& segment : pulse.span()) {
            if (t >= from && t < from + segment.duration_s) return segment.start;
            from += segment.duration_s;
        }
    }
    return 0;
}

std::vector<double> synthesized(const PulseTrain& train, double rate) {
    std::vector<double> samples(static_cast<std::size_t>(std::ceil(train.duration().count() * rate * (1 - 1e-12))));
    const auto result = synthesize(train, Hertz(rate), samples);
    EXPECT_TRUE(result);
    return samples;
}

PulseTrain train(PulseShape shape) {
    PulseTrain t;
    t.amplitude = Volts(40);
    t.shape = shape;
    t.pulses = 3;
    return t;
}

TEST(Waveform, IsThePlateauWhereAPhaseFillsTheSample) {
    const auto samples = synthesized(train(PulseShape::SymmetricBiphasic), 10'000);  // 100 µs a sample
    const std::vector<double> expected{40, 40, 0, -40, -40, 0};
    for (std::size_t p = 0; p < 3; ++p) {
        for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(samples[100 * p + k], expected[k], 1e-9);
    }
}

TEST(Waveform, StartsWithTheSignOfItsPolarity) {
    auto t = train(PulseShape::Monophasic);
    t.polarity = Polarity::Negative;
    EXPECT_DOUBLE_EQ(synthesized(t, 10'000)[0], -40);
}

TEST(Waveform, SharesASampleThatAnEdgeFallsInto) {
    auto t = train(PulseShape::Monophasic);
    t.phaseWidth = Micros(150);
    const auto samples = synthesized(t, 10'000);
    EXPECT_DOUBLE_EQ(samples[0], 40);
    EXPECT_NEAR(samples[1], 20, 1e-9);
}

TEST(Waveform, KeepsAPhaseNarrowerThanASample) {
    auto t = train(PulseShape::Monophasic);
    t.phaseWidth = Micros(5);
    EXPECT_NEAR(synthesized(t, 1000)[0], 40 * 5e-6 * 1000, 1e-12);
}

TEST(Waveform, IsZeroBeforeTheLeadingEdgeAndAfterTheTrain) {
    const auto t = train(PulseShape::SymmetricBiphasic);
    std::vector<double> samples(1000, 7.0);
    ASSERT_TRUE(synthesize(t, Hertz(10'000), samples, Seconds(-0.02)));
    for (std::size_t k = 0; k < 200; ++k) EXPECT_EQ(samples[k], 0) << k;
    EXPECT_NEAR(samples[200], 40, 1e-9);
    for (std::size_t k = 406; k < 1000; ++k) EXPECT_EQ(samples[k], 0) << k;
}

TEST(Waveform, GivesTheSameSamplesInAWindowAsInTheWhole) {
    const auto t = train(PulseShape::AsymmetricBiphasic);
    const auto whole = synthesized(t, 44'100);
    std::vector<double> window(100);
    ASSERT_TRUE(synthesize(t, Hertz(44'100), window, Seconds(400 / 44'100.0)));
    for (std::size_t k = 0; k < window.size(); ++k) EXPECT_NEAR(window[k], whole[400 + k], 1e-7) << k;
}

TEST(Waveform, RefusesARateOrStartThatIsNone) {
    std::vector<double> samples(10);
    for (const double bad : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(synthesize(PulseTrain{}, Hertz(bad), samples)) << bad;
    }
    EXPECT_FALSE(synthesize(PulseTrain{}, Hertz(1000), samples, Seconds(kNaN)));
    PulseTrain broken;
    broken.amplitude = Volts(kNaN);
    EXPECT_FALSE(synthesize(broken, Hertz(1000), samples));
}

RC_GTEST_PROP(Waveform, KeepsTheExactChargeAtAnyRateForEveryShape, ()) {
    auto t =
        train(*rc::gen::element(PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic, PulseShape::Monophasic));
    t.phaseWidth = Micros(*rc::gen::inRange(5, 4000) / 10.0);
    t.interPhaseGap = Micros(*rc::gen::inRange(0, 2000) / 10.0);
    t.rechargeRatio = *rc::gen::inRange(11, 150) / 10.0;
    t.pulses = *rc::gen::inRange(1, 6);
    t.rate = Hertz(*rc::gen::inRange(200, 1500) / 10.0);
    if (!validate(t)) return;
    const double fs = *rc::gen::inRange(1'000, 10'000'000) / 3.0;
    const auto samples = synthesized(t, fs);
    const double sum = std::accumulate(samples.begin(), samples.end(), 0.0) / fs;
    double magnitude = 0;
    for (const double x : samples) magnitude += std::abs(x) / fs;
    const double phase = siValue(t.amplitude) * Seconds(t.phaseWidth).count() * t.pulses;
    const double expected = t.shape == PulseShape::Monophasic ? phase : 0.0;
    RC_ASSERT(std::abs(sum - expected) <= 1e-9 * phase);
    RC_ASSERT(magnitude <= phase * 2 * (1 + 1e-9));
}

RC_GTEST_PROP(Waveform, IsEachSamplesMeanOfTheIdealLevel, ()) {
    auto t = train(*rc::gen::element(PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic));
    t.phaseWidth = Micros(*rc::gen::inRange(50, 300));
    t.interPhaseGap = Micros(*rc::gen::inRange(0, 300));
    t.rechargeRatio = *rc::gen::inRange(2, 10);
    const double fs = *rc::gen::inRange(2'000, 50'000);
    const auto samples = synthesized(t, fs);
    const auto k = *rc::gen::inRange<std::size_t>(0, samples.size());
    constexpr int kFine = 20'000;
    double mean = 0;
    for (int n = 0; n < kFine; ++n) mean += levelAt(t, (static_cast<double>(k) + (n + 0.5) / kFine) / fs) / kFine;
    RC_ASSERT(std::abs(samples[k] - mean) <= 40 * 4.0 / kFine);
}

}  // namespace
}  // namespace tacto
