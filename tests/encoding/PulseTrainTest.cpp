#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "core/base/NaN.h"
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

}  // namespace
}  // namespace tacto
