#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "core/encoding/Encoder.h"

namespace tacto {
namespace {

Command encoded(const EncodingProfile& profile, double R, std::optional<double> P) {
    const auto command = Encoder(profile).encode(R, P);
    EXPECT_TRUE(command);
    return command.value_or(Command{});
}

TEST(Encoder, GivesTheFourConditionsOfThePaper) {
    const EncodingProfile profile;
    struct Case {
        const char* name;
        double volts;
        double seconds;
    };
    for (const auto& [name, volts, seconds] : std::initializer_list<Case>{
             {"smooth-low", 10, 2}, {"smooth-high", 10, 0.5}, {"rough-low", 40, 2}, {"rough-high", 40, 0.5}}) {
        const Condition* condition = profile.condition(name);
        ASSERT_NE(condition, nullptr);
        EXPECT_EQ(encoded(profile, condition->R, condition->P), (Command{Volts(volts), Seconds(seconds)})) << name;
    }
}

TEST(Encoder, FollowsItsThreeCurvesExactly) {
    EncodingProfile profile;
    for (const double x : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
        profile.amplitudeCurve = profile.intervalCurve = {CurveKind::Linear};
        EXPECT_DOUBLE_EQ(encoded(profile, x, x).amplitude.value(), 10 + x * 30);
        EXPECT_DOUBLE_EQ(encoded(profile, x, x).interval.count(), 2 - x * 1.5);
        profile.amplitudeCurve = profile.intervalCurve = {CurveKind::Logarithmic};
        EXPECT_NEAR(encoded(profile, x, x).amplitude.value(), 10 * std::pow(4, x), 1e-12);
        EXPECT_NEAR(encoded(profile, x, x).interval.count(), 2 * std::pow(0.25, x), 1e-12);
        profile.amplitudeCurve = profile.intervalCurve = {CurveKind::Power, 1.5};
        EXPECT_NEAR(encoded(profile, x, x).amplitude.value(), 10 + 30 * std::pow(x, 1 / 1.5), 1e-12);
        EXPECT_NEAR(encoded(profile, x, x).interval.count(), 2 - 1.5 * std::pow(x, 1 / 1.5), 1e-12);
    }
}

TEST(Encoder, SwapsWhatDrivesWhat) {
    EncodingProfile profile;
    profile.assignment = Assignment::Swapped;
    const Command command = encoded(profile, 1, 0);
    EXPECT_EQ(command.amplitude, Volts(10));
    EXPECT_EQ(command.interval, Seconds(0.5));
    EXPECT_EQ(encoded(profile, 0, 1), (Command{Volts(40), Seconds(2)}));
}

TEST(Encoder, TakesTheLongestIntervalWithoutPressure) {
    EXPECT_EQ(encoded({}, 0.5, std::nullopt), (Command{Volts(25), Seconds(2)}));
}

TEST(Encoder, RefusesWhatIsNotWithinZeroToOne) {
    RecordProperty("hazard", "H1");
    const Encoder encoder{EncodingProfile{}};
    for (const double bad : {-1e-9, 1.0000001, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
        const auto roughness = encoder.encode(bad, 0.5);
        ASSERT_FALSE(roughness);
        EXPECT_EQ(roughness.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(roughness.error().message, testing::HasSubstr("roughness R"));
        const auto pressure = encoder.encode(0.5, bad);
        ASSERT_FALSE(pressure);
        EXPECT_THAT(pressure.error().message, testing::HasSubstr("pressure P"));
    }
}

RC_GTEST_PROP(Encoder, RisesWithRoughnessAndQuickensWithPressureWithinItsBounds, ()) {
    EncodingProfile profile;
    profile.amplitudeMin = Volts(*rc::gen::inRange(1, 200) / 10.0);
    profile.amplitudeMax = profile.amplitudeMin + Volts(*rc::gen::inRange(1, 400) / 10.0);
    profile.intervalMin = Seconds(*rc::gen::inRange(20, 1000) / 1000.0);
    profile.intervalMax = profile.intervalMin + Seconds(*rc::gen::inRange(1, 4000) / 1000.0);
    const auto curve = [] {
        return Curve{*rc::gen::element(CurveKind::Linear, CurveKind::Logarithmic, CurveKind::Power),
                     *rc::gen::inRange(5, 50) / 10.0};
    };
    profile.amplitudeCurve = curve();
    profile.intervalCurve = curve();
    RC_ASSERT(validate(profile).has_value());
    const Encoder encoder(profile);
    const double low = *rc::gen::inRange(0, 1000) / 1000.0;
    const double high = low + (1 - low) * *rc::gen::inRange(1, 1001) / 1000.0;
    const Command a = *encoder.encode(low, low);
    const Command b = *encoder.encode(high, high);
    RC_ASSERT(a.amplitude < b.amplitude);
    RC_ASSERT(a.interval > b.interval);
    for (const Command& c : {a, b}) {
        RC_ASSERT(c.amplitude >= profile.amplitudeMin && c.amplitude <= profile.amplitudeMax);
        RC_ASSERT(c.interval >= profile.intervalMin && c.interval <= profile.intervalMax);
    }
    RC_ASSERT(encoder.encode(1, 1)->amplitude == profile.amplitudeMax);
    RC_ASSERT(encoder.encode(1, 1)->interval == profile.intervalMin);
}

TEST(SlewLimits, AreOffUnlessAsked) {
    const Encoder encoder{EncodingProfile{}};
    const Command from{Volts(10), Seconds(2)};
    const Command to{Volts(40), Seconds(0.5)};
    EXPECT_EQ(encoder.limited(from, to, Seconds(0.5)), to);
}

TEST(SlewLimits, BoundTheAmplitudePerSecondAndTheIntervalPerTrain) {
    EncodingProfile profile;
    profile.amplitudeSlew_V_per_s = 20;
    profile.intervalRatioPerTrain = 1.5;
    const Encoder encoder(profile);
    const Command low{Volts(10), Seconds(1.8)};
    const Command high{Volts(40), Seconds(0.5)};
    EXPECT_EQ(encoder.limited(low, high, Seconds(0.5)).amplitude, Volts(20));
    EXPECT_DOUBLE_EQ(encoder.limited(low, high, Seconds(0.5)).interval.count(), 1.2);
    EXPECT_EQ(encoder.limited(high, low, Seconds(0.5)).amplitude, Volts(30));
    EXPECT_DOUBLE_EQ(encoder.limited(high, low, Seconds(0.5)).interval.count(), 0.75);
    EXPECT_EQ(encoder.limited(low, high, Seconds(2)).amplitude, Volts(40)) << "no overshoot";
    EXPECT_EQ(encoder.limited(low, low, Seconds(0.5)), low);
}

TEST(SlewLimits, BoundTheAmplitudeByARatioPerTrainHoweverLongItTook) {
    RecordProperty("hazard", "H6");
    EncodingProfile profile;
    profile.amplitudeRatioPerTrain = 1.2;
    const Encoder encoder(profile);
    const Command low{Volts(10), Seconds(1)};
    const Command high{Volts(40), Seconds(1)};
    for (const double since : {0.0, 0.5, 60.0}) {
        EXPECT_DOUBLE_EQ(encoder.limited(low, high, Seconds(since)).amplitude.value(), 12);
        EXPECT_DOUBLE_EQ(encoder.limited(high, low, Seconds(since)).amplitude.value(), 40 / 1.2);
    }
    EXPECT_EQ(encoder.limited({Volts(36), Seconds(1)}, high, Seconds(1)).amplitude, Volts(40)) << "no overshoot";
    profile.amplitudeSlew_V_per_s = 1;
    EXPECT_DOUBLE_EQ(Encoder(profile).limited(low, high, Seconds(0.5)).amplitude.value(), 10.5) << "the tighter one";
}

TEST(HeldAmplitude, FollowsTheImpedanceByWhatIsHeld) {
    const auto held = [](Hold hold, double armed, double now) {
        return heldAmplitude(hold, Volts(20), Ohms(armed), Ohms(now))->value();
    };
    EXPECT_DOUBLE_EQ(held(Hold::Voltage, 1000, 1210), 20);
    EXPECT_DOUBLE_EQ(held(Hold::Charge, 1000, 1210), 24.2);
    EXPECT_DOUBLE_EQ(held(Hold::Energy, 1000, 1210), 22);
    EXPECT_DOUBLE_EQ(held(Hold::Charge, 1000, 800), 16);
    EXPECT_DOUBLE_EQ(held(Hold::Charge, 1000, 2000), 40);
    EXPECT_FALSE(heldAmplitude(Hold::Charge, Volts(1), Ohms(1000), Ohms(2001))) << "no drift";
    EXPECT_FALSE(heldAmplitude(Hold::Energy, Volts(1), Ohms(1000), Ohms(499)));
    EXPECT_EQ(*heldAmplitude(Hold::Voltage, Volts(20), std::nullopt, std::nullopt), Volts(20));
    for (const auto hold : {Hold::Charge, Hold::Energy}) {
        EXPECT_FALSE(heldAmplitude(hold, Volts(20), std::nullopt, Ohms(1000)));
        EXPECT_FALSE(heldAmplitude(hold, Volts(20), Ohms(1000), std::nullopt));
        EXPECT_FALSE(heldAmplitude(hold, Volts(20), Ohms(0), Ohms(1000)));
        EXPECT_FALSE(heldAmplitude(hold, Volts(20), Ohms(1000), Ohms(std::numeric_limits<double>::quiet_NaN())));
    }
}

TEST(TrainFor, GivesAVoltageSourceVolts) {
    EncodingProfile profile;
    profile.train.pulses = 3;
    const auto train = trainFor(Drive::Voltage, profile, Volts(25), std::nullopt);
    ASSERT_TRUE(train);
    EXPECT_EQ(std::get<Volts>(train->amplitude), Volts(25));
    EXPECT_EQ(train->pulses, 3);
}

TEST(TrainFor, GivesACurrentSourceVoltsOverMeasuredImpedance) {
    const auto train = trainFor(Drive::Current, {}, Volts(40), Ohms(3497));
    ASSERT_TRUE(train);
    EXPECT_DOUBLE_EQ(std::get<Milliamps>(train->amplitude).value(), 40 / 3497.0 * 1e3);
}

TEST(TrainFor, NeverGivesACurrentSourceVoltsWithoutAMeasuredImpedance) {
    RecordProperty("hazard", "H4");
    const auto missing = trainFor(Drive::Current, {}, Volts(40), std::nullopt);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotArmed);
    for (const double bad :
         {0.0, -500.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(trainFor(Drive::Current, {}, Volts(40), Ohms(bad))) << bad;
    }
    EXPECT_FALSE(trainFor(Drive::HighImpedance, {}, Volts(40), Ohms(500)));
}

TEST(MassagerIntensity, IsTheAmplitudeOverItsLargest) {
    const Encoder encoder{EncodingProfile{}};
    EXPECT_DOUBLE_EQ(encoder.massagerIntensity(Volts(10)), 0.25);
    EXPECT_DOUBLE_EQ(encoder.massagerIntensity(Volts(40)), 1);
    EXPECT_DOUBLE_EQ(encoder.massagerIntensity(Volts(80)), 1);
    EXPECT_EQ(encoder.massagerIntensity(Volts(-1)), 0);
    EXPECT_EQ(encoder.massagerIntensity(Volts(std::numeric_limits<double>::quiet_NaN())), 0);
}

}  // namespace
}  // namespace tacto
