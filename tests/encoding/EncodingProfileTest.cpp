#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Statistics.h"
#include "core/encoding/EncodingProfile.h"

namespace tacto {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const char* text) {
    const auto profile = encodingProfileFrom(json::parse(text));
    return profile ? "" : profile.error().message;
}

TEST(EncodingProfile, IsThePapersWhenNothingIsSaid) {
    const auto profile = encodingProfileFrom(json::object());
    ASSERT_TRUE(profile);
    EXPECT_EQ(*profile, EncodingProfile{});
    EXPECT_EQ(profile->amplitudeMin, Volts(10));
    EXPECT_EQ(profile->amplitudeMax, Volts(40));
    EXPECT_EQ(profile->intervalMin, Seconds(0.5));
    EXPECT_EQ(profile->intervalMax, Seconds(2));
    EXPECT_EQ(profile->assignment, Assignment::TextureToAmplitude);
    EXPECT_EQ(profile->train.pulses, 1);
    ASSERT_EQ(profile->conditions.size(), 4U);
    EXPECT_EQ(profile->conditions[1], (Condition{"smooth-high", 0, 1}));
    EXPECT_EQ(*profile->condition("rough-low"), (Condition{"rough-low", 1, 0}));
    EXPECT_EQ(profile->condition("velvet"), nullptr);
}

TEST(EncodingProfile, ReadsEveryKey) {
    const auto profile = encodingProfileFrom(json::parse(R"({
        "amplitude_min_v": 5, "amplitude_max_v": 30, "interval_min_s": 0.25, "interval_max_s": 1,
        "amplitude_curve": "power", "amplitude_beta": 2, "interval_curve": "logarithmic", "interval_beta": 3,
        "assignment": "swapped", "shape": "asymmetric", "polarity": "negative", "phase_width_us": 150,
        "inter_phase_gap_us": 50, "recharge_ratio": 8, "pulses": 4, "rate_hz": 80, "amplitude_slew_v_per_s": 20,
        "amplitude_ratio_per_train": 1.25,
        "interval_ratio_per_train": 1.5, "hold": "energy", "conditions": [{"name": "a", "R": 0.1, "P": 0.9}]})"));
    ASSERT_TRUE(profile) << profile.error().message;
    EXPECT_EQ(profile->amplitudeMin, Volts(5));
    EXPECT_EQ(profile->amplitudeMax, Volts(30));
    EXPECT_EQ(profile->intervalMin, Seconds(0.25));
    EXPECT_EQ(profile->intervalMax, Seconds(1));
    EXPECT_EQ(profile->amplitudeCurve, (Curve{CurveKind::Power, 2}));
    EXPECT_EQ(profile->intervalCurve, (Curve{CurveKind::Logarithmic, 3}));
    EXPECT_EQ(profile->assignment, Assignment::Swapped);
    EXPECT_EQ(profile->train.shape, PulseShape::AsymmetricBiphasic);
    EXPECT_EQ(profile->train.polarity, Polarity::Negative);
    EXPECT_EQ(profile->train.phaseWidth, Micros(150));
    EXPECT_EQ(profile->train.interPhaseGap, Micros(50));
    EXPECT_EQ(profile->train.rechargeRatio, 8);
    EXPECT_EQ(profile->train.pulses, 4);
    EXPECT_EQ(profile->train.rate, Hertz(80));
    EXPECT_EQ(profile->amplitudeSlew_V_per_s, 20);
    EXPECT_EQ(profile->intervalRatioPerTrain, 1.5);
    EXPECT_EQ(profile->amplitudeRatioPerTrain, 1.25);
    EXPECT_EQ(profile->hold, Hold::Energy);
    EXPECT_EQ(profile->conditions, (std::vector<Condition>{{"a", 0.1, 0.9}}));
    const auto again = encodingProfileFrom(toJson(*profile));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, *profile);
}

TEST(EncodingProfile, RefusesAnUnknownKeyByName) {
    EXPECT_THAT(refusal(R"({"amplitude_max": 40})"), AllOf(HasSubstr("amplitude_max"), HasSubstr("amplitude_max_v")));
    EXPECT_THAT(refusal(R"([1])"), HasSubstr("[1] stands where an object is expected"));
}

TEST(EncodingProfile, RefusesWrongTypesNamingKeyValueAndWhatIsAccepted) {
    EXPECT_THAT(refusal(R"({"amplitude_max_v": "40"})"), AllOf(HasSubstr("amplitude_max_v"), HasSubstr("a number")));
    EXPECT_THAT(refusal(R"({"amplitude_max_v": null})"), HasSubstr("null"));
    EXPECT_THAT(refusal(R"({"pulses": 1.5})"), AllOf(HasSubstr("pulses"), HasSubstr("1.5"), HasSubstr("whole number")));
    EXPECT_THAT(refusal(R"({"pulses": 1e99})"), HasSubstr("whole number"));
    EXPECT_THAT(refusal(R"({"hold": "power"})"), AllOf(HasSubstr("power"), HasSubstr("charge")));
    EXPECT_THAT(refusal(R"({"shape": "square"})"), AllOf(HasSubstr("square"), HasSubstr("symmetric")));
    EXPECT_THAT(refusal(R"({"assignment": 3})"), HasSubstr("texture_to_amplitude or swapped"));
    EXPECT_THAT(refusal(R"({"conditions": 3})"), HasSubstr("conditions"));
    EXPECT_THAT(refusal(R"({"conditions": [{"name": "a", "R": 0}]})"), HasSubstr("\"P\""));
    EXPECT_THAT(refusal(R"({"conditions": [{"name": "a", "R": 0, "P": 0, "Q": 1}]})"),
                HasSubstr("\"Q\" is not a known key"));
}

TEST(EncodingProfile, RefusesImpossibleValuesNamingThem) {
    struct Case {
        const char* text;
        const char* named;
    };
    for (const auto& [text, named] : std::initializer_list<Case>{
             {R"({"amplitude_min_v": 0})", "amplitude_min_v"},
             {R"({"amplitude_min_v": -10})", "amplitude_min_v"},
             {R"({"amplitude_max_v": 501})", "amplitude_max_v"},
             {R"({"amplitude_min_v": 40})", "amplitude_min_v 40 V is not below amplitude_max_v 40 V"},
             {R"({"interval_min_s": 2})", "interval_min_s 2 s is not below"},
             {R"({"interval_min_s": 0.001})", "interval_min_s"},
             {R"({"interval_max_s": 61})", "interval_max_s"},
             {R"({"amplitude_beta": 0})", "amplitude_beta"},
             {R"({"interval_beta": -1})", "interval_beta"},
             {R"({"phase_width_us": 0})", "phase_width_us"},
             {R"({"inter_phase_gap_us": -1})", "inter_phase_gap_us"},
             {R"({"shape": "asymmetric", "recharge_ratio": 1})", "recharge ratio"},
             {R"({"pulses": 0})", "pulses"},
             {R"({"rate_hz": 0})", "rate"},
             {R"({"rate_hz": 5000})", "does not fit into its period"},
             {R"({"pulses": 50})", "a train of 50 pulses at 100 Hz lasts 0.5 s"},
             {R"({"amplitude_slew_v_per_s": -1})", "amplitude_slew_v_per_s"},
             {R"({"interval_ratio_per_train": 1})", "interval_ratio_per_train"},
             {R"({"conditions": []})", "\"conditions\" is []; a list of 1 to 64 entries"},
             {R"({"conditions": [{"name": "a", "R": 1.1, "P": 0}]})", "conditions[0]: \"R\" is 1.1"},
             {R"({"conditions": [{"name": "", "R": 1, "P": 0}]})", "conditions[0]: \"name\" is \"\""},
             {R"({"conditions": [{"name": "a", "R": 1, "P": 0}, {"name": "a", "R": 0, "P": 0}]})", "twice"},
         }) {
        EXPECT_THAT(refusal(text), HasSubstr(named)) << text;
    }
    EXPECT_EQ(refusal(R"({"pulses": 49})"), "") << "n/rate must be below T_min, and 0.49 s is";
}

TEST(EncodingProfile, RefusesNanInEveryNumber) {
    RecordProperty("hazard", "H1");
    const auto refused = [](const auto& change) {
        EncodingProfile profile;
        change(profile);
        return !validate(profile);
    };
    EXPECT_FALSE(refused([](auto&) {}));
    EXPECT_TRUE(refused([&](auto& p) { p.amplitudeMin = Volts(kNaN); }));
    EXPECT_TRUE(refused([&](auto& p) { p.amplitudeMax = Volts(kNaN); }));
    EXPECT_TRUE(refused([&](auto& p) { p.intervalMin = Seconds(kNaN); }));
    EXPECT_TRUE(refused([&](auto& p) { p.intervalMax = Seconds(kNaN); }));
    EXPECT_TRUE(refused([&](auto& p) { p.amplitudeCurve.beta = kNaN; }));
    EXPECT_TRUE(refused([&](auto& p) { p.intervalCurve.beta = kNaN; }));
    EXPECT_TRUE(refused([&](auto& p) { p.train.phaseWidth = Micros(kNaN); }));
    EXPECT_TRUE(refused([&](auto& p) { p.train.rate = Hertz(kNaN); }));
    EXPECT_TRUE(refused([&](auto& p) { p.train.rechargeRatio = kNaN; }));
    EXPECT_TRUE(refused([&](auto& p) { p.amplitudeSlew_V_per_s = kNaN; }));
    EXPECT_TRUE(refused([&](auto& p) { p.intervalRatioPerTrain = kNaN; }));
    EXPECT_TRUE(refused([&](auto& p) { p.amplitudeRatioPerTrain = kNaN; }));
    EXPECT_TRUE(refused([&](auto& p) { p.amplitudeRatioPerTrain = 1; }));
    EXPECT_TRUE(refused([&](auto& p) { p.conditions[0].R = kNaN; }));
}

}  // namespace
}  // namespace tacto
