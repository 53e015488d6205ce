// An oscilloscope that states nothing: no procedure passes on it, and each says why. And an absolute reference: what a
// known load cannot show (science.md section 12, hazard H9).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

const std::set<Role> kElectric{Role::Stimulator, Role::Oscilloscope};

ScriptOutcome ran(const std::string& protocol, const std::string& device, std::map<std::string, std::string> settings,
                  const std::set<Role>& needed = kElectric) {
    RunBench rig(true, device, 1, false, needed);
    auto outcome = runProtocol(rig.shipped(protocol, settings)).value();
    EXPECT_TRUE(rig.outputOff());
    return outcome;
}

TEST(UnknownAccuracy, NoProcedurePasses) {
    RecordProperty("hazard", "H9");
    const std::set<Role> all{Role::Sensor, Role::Stimulator, Role::Oscilloscope};
    struct Case {
        const char* protocol;
        std::map<std::string, std::string> settings;
        std::set<Role> needed;
    };
    for (const auto& each : {Case{"load-safety", {{"area", "3"}, {"steps", "2"}}, kElectric},
                             Case{"stimulator-calibration", {{"quantities", "amplitude"}, {"repeats", "2"}}, kElectric},
                             Case{"separability", {{"source", "direct"}, {"repeats", "5"}}, all},
                             Case{"transitions", {}, kElectric}, Case{"encoding-comparison", {}, kElectric}}) {
        const auto outcome = ran(each.protocol, "sim:oscilloscope?accuracy=unknown", each.settings, each.needed);
        ASSERT_FALSE(outcome.error) << each.protocol << ": " << outcome.error->message;
        EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate) << each.protocol;
        ASSERT_FALSE(outcome.reasons.empty()) << each.protocol;
        EXPECT_THAT(outcome.results.dump(), HasSubstr("does not state")) << each.protocol;
        ASSERT_TRUE(outcome.results["instruments"].is_array()) << each.protocol;
        EXPECT_TRUE(outcome.results["instruments"][0]["gain_pct"].is_null()) << each.protocol;
    }
}

TEST(UnknownAccuracy, TheKeysOfTheAddressStateIt) {
    const auto outcome =
        ran("load-safety",
            "sim:oscilloscope?accuracy=unknown&gain_pct=0.5&probe_pct=0&shunt_pct=0.1&timebase_ppm=50&stamp_s=1e-6",
            {{"area", "3"}, {"steps", "2"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump(1);
    EXPECT_EQ(outcome.results["instruments"][0]["stated_by"], "gain, shunt: the device's address");
    EXPECT_THAT(outcome.results["rests_on"].dump(), HasSubstr("No absolute reference was read"));
}

TEST(UnknownAccuracy, WithoutTimeStampsTheIntervalIsMeasuredInOneRecord) {
    RecordProperty("hazard", "H9");
    const auto outcome =
        ran("load-safety", "sim:oscilloscope?accuracy=unknown&gain_pct=0.5&probe_pct=0&shunt_pct=0.1&timebase_ppm=50",
            {{"area", "3"}, {"steps", "2"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump(1);
}

TEST(AbsoluteReference, FindsAGainThatAKnownLoadCannotShow) {
    RecordProperty("hazard", "H9");
    // The example that once passed: 1.05 delivered, read as 1.01, and V/I right all the same.
    const std::string lying = "sim:oscilloscope?gain=0.96&currentgain=0.96";
    const std::map<std::string, std::string> read{
        {"area", "3"}, {"steps", "2"}, {"reference_v", "40"}, {"reference_u_pct", "0.02"}};
    const auto outcome = ran("load-safety", lying, read);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail);
    ASSERT_FALSE(outcome.reasons.empty());
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("absolute reference: 40 V of a reference source read as 38.4"));
    const auto honest = ran("load-safety", "sim:oscilloscope", read);
    ASSERT_FALSE(honest.error) << honest.error->message;
    EXPECT_EQ(honest.verdict, ScriptVerdict::Pass) << honest.results["reasons"].dump(1);
    EXPECT_THAT(honest.results["rests_on"].dump(), HasSubstr("The absolute scale of the voltage was read"));
}

TEST(AbsoluteReference, IsNotEvaluatedByAnOscilloscopeThatStatesNothing) {
    RecordProperty("hazard", "H9");
    const auto outcome = ran("stimulator-calibration", "sim:oscilloscope?accuracy=unknown",
                             {{"quantities", "amplitude"}, {"reference_v", "20"}, {"reference_u_pct", "0.05"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("not evaluated"));
    const auto unsaid = ran("stimulator-calibration", "sim:", {{"quantities", "amplitude"}, {"reference_v", "20"}});
    ASSERT_TRUE(unsaid.error);
    EXPECT_THAT(unsaid.error->message, HasSubstr("reference_u_pct is 0"));
}

}  // namespace
}  // namespace tacto::test
