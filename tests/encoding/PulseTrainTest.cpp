#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <rapidcheck/gtest.h>
#include <vector>

#include "core/base/Statistics.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PulseTrain train(const auto& change) {
    PulseTrain t;
    t.amplitude = Volts(40);
    change(t);
    return t;
}

std::string refusal(const auto& change) {
    const auto result = validate(train(change));
    return result ? "" : result.error().message;
}

TEST(SiValue, IsVoltsOrAmperes) {
    EXPECT_DOUBLE_EQ(siValue(Volts(40)), 40);
    EXPECT_DOUBLE_EQ(siValue(Milliamps(4)), 4e-3);
    EXPECT_FALSE(isCurrent(Amplitude(Volts(1))));
    EXPECT_TRUE(isCurrent(Amplitude(Milliamps(1))));
}

TEST(PulseTrain, KnowsItsDurations) {
    const PulseTrain symmetric;
    EXPECT_DOUBLE_EQ(symmetric.pulseDuration().count(), 500e-6);
    EXPECT_DOUBLE_EQ(symmetric.duration().count(), 0.01);
    const auto asymmetric = train([](auto& t) { t.shape = PulseShape::AsymmetricBiphasic; });
    EXPECT_DOUBLE_EQ(asymmetric.pulseDuration().count(), 2300e-6);
    const auto monophasic = train([](auto& t) { t.shape = PulseShape::Monophasic; });
    EXPECT_DOUBLE_EQ(monophasic.pulseDuration().count(), 200e-6);
    const auto three = train([](auto& t) { t.pulses = 3; });
    EXPECT_DOUBLE_EQ(three.duration().count(), 0.03);
    EXPECT_DOUBLE_EQ(restBetweenPulses(three).count(), 0.01 - 500e-6);
}

TEST(ValidateTrain, AcceptsTheDefaultsAndAFullPeriod) {
    EXPECT_TRUE(validate(PulseTrain{}));
    EXPECT_TRUE(validate(train([](auto& t) {
        t.interPhaseGap = Micros(0);
        t.phaseWidth = Micros(50);
        t.rate = Hertz(10'000);
    })));
}

TEST(ValidateTrain, RefusesWhatNoStimulatorCouldMeanInOneSentence) {
    RecordProperty("hazard", "H1");
    for (const double bad : {kNaN, kInfinity, -kInfinity, -1.0}) {
        EXPECT_THAT(refusal([&](auto& t) { t.amplitude = Volts(bad); }), HasSubstr("amplitude"));
        EXPECT_THAT(refusal([&](auto& t) { t.amplitude = Milliamps(bad); }), HasSubstr("mA"));
        EXPECT_THAT(refusal([&](auto& t) { t.phaseWidth = Micros(bad); }), HasSubstr("phase width"));
        EXPECT_THAT(refusal([&](auto& t) { t.interPhaseGap = Micros(bad); }), HasSubstr("inter-phase gap"));
        EXPECT_THAT(refusal([&](auto& t) { t.rate = Hertz(bad); }), HasSubstr("intra-train rate"));
        EXPECT_THAT(refusal([&](auto& t) {
                        t.shape = PulseShape::AsymmetricBiphasic;
                        t.rechargeRatio = bad;
                    }),
                    HasSubstr("recharge ratio"));
    }
    EXPECT_THAT(refusal([](auto& t) { t.phaseWidth = Micros(0); }), HasSubstr("phase width 0"));
    EXPECT_THAT(refusal([](auto& t) { t.rate = Hertz(0); }), HasSubstr("rate 0"));
    EXPECT_THAT(refusal([](auto& t) { t.pulses = 0; }), HasSubstr("0 pulses"));
    EXPECT_THAT(refusal([](auto& t) { t.pulses = -3; }), HasSubstr("-3 pulses"));
    EXPECT_THAT(refusal([](auto& t) { t.rate = Hertz(2001); }), HasSubstr("does not fit into its period"));
    EXPECT_THAT(refusal([](auto& t) {
                    t.shape = PulseShape::AsymmetricBiphasic;
                    t.rechargeRatio = 1;
                }),
                HasSubstr("above 1"));
    EXPECT_THAT(refusal([](auto& t) { t.shape = static_cast<PulseShape>(7); }), HasSubstr("pulse shape"));
    EXPECT_THAT(refusal([](auto& t) { t.polarity = static_cast<Polarity>(7); }), HasSubstr("polarity"));
    EXPECT_EQ(refusal([](auto& t) { t.rechargeRatio = kNaN; }), "") << "a symmetric pulse has no recharge ratio";
}

TEST(SegmentsOf, IsLeadingPhaseGapAndMirroredPhase) {
    const auto pulse = segmentsOf(train([](auto& t) { t.polarity = Polarity::Negative; }), GapState::HighImpedance);
    ASSERT_EQ(pulse.count, 3U);
    EXPECT_EQ(pulse.items[0].drive, Drive::Voltage);
    EXPECT_DOUBLE_EQ(pulse.items[0].start, -40);
    EXPECT_DOUBLE_EQ(pulse.items[0].end, -40);
    EXPECT_DOUBLE_EQ(pulse.items[0].duration_s, 200e-6);
    EXPECT_EQ(pulse.items[1].drive, Drive::HighImpedance);
    EXPECT_DOUBLE_EQ(pulse.items[1].duration_s, 100e-6);
    EXPECT_DOUBLE_EQ(pulse.items[2].start, 40);
    EXPECT_DOUBLE_EQ(pulse.items[2].duration_s, 200e-6);
}

TEST(SegmentsOf, HoldsZeroVoltsInTheGapWhereTheSourceDoes) {
    const auto pulse = segmentsOf(train([](auto& t) { t.amplitude = Milliamps(4); }), GapState::HoldsZero);
    EXPECT_EQ(pulse.items[0].drive, Drive::Current);
    EXPECT_DOUBLE_EQ(pulse.items[0].start, 4e-3);
    EXPECT_EQ(pulse.items[1].drive, Drive::Voltage);
    EXPECT_EQ(pulse.items[1].start, 0);
    EXPECT_EQ(restOf(GapState::HoldsZero, Seconds(1)).drive, Drive::Voltage);
    EXPECT_EQ(restOf(GapState::HighImpedance, Seconds(1)).drive, Drive::HighImpedance);
    EXPECT_DOUBLE_EQ(restOf(GapState::HighImpedance, Seconds(0.25)).duration_s, 0.25);
}

TEST(SegmentsOf, LeavesOutAGapOfZeroAndAMonophasicPulsesSecondPhase) {
    EXPECT_EQ(segmentsOf(train([](auto& t) { t.interPhaseGap = Micros(0); }), GapState::HoldsZero).count, 2U);
    EXPECT_EQ(segmentsOf(train([](auto& t) { t.shape = PulseShape::Monophasic; }), GapState::HoldsZero).count, 1U);
}

RC_GTEST_PROP(SegmentsOf, BalanceTheChargeOfEveryBiphasicPulse, ()) {
    const auto t = train([](PulseTrain& made) {
        const double amplitude = *rc::gen::inRange(1, 40'000) / 1000.0;
        if (*rc::gen::arbitrary<bool>()) {
            made.amplitude = Volts(amplitude);
        } else {
            made.amplitude = Milliamps(amplitude);
        }
        made.shape = *rc::gen::element(PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic);
        made.polarity = *rc::gen::element(Polarity::Positive, Polarity::Negative);
        made.phaseWidth = Micros(*rc::gen::inRange(1, 1000));
        made.interPhaseGap = Micros(*rc::gen::inRange(0, 1000));
        made.rechargeRatio = *rc::gen::inRange(11, 200) / 10.0;
    });
    double sum = 0;
    double leading = 0;
    double duration = 0;
    const auto pulse = segmentsOf(t, GapState::HoldsZero);
    for (const auto& segment : pulse.span()) {
        sum += segment.start * segment.duration_s;
        duration += segment.duration_s;
        RC_ASSERT(segment.duration_s > 0);
        RC_ASSERT(segment.start == segment.end);
    }
    leading = pulse.items[0].start * pulse.items[0].duration_s;
    RC_ASSERT(std::abs(sum) <= 1e-12 * std::abs(leading));
    RC_ASSERT(std::abs(duration - t.pulseDuration().count()) <= 1e-12);
}

/// Returns the ideal level at `t` directly from the definition.
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
    const auto samples = synthesized(train(PulseShape::SymmetricBiphasic), 10'000);  // 100 µs per sample
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
