// The encoding comparison on the simulated bench, against distances calculated by hand from science.md section 4.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/session/SessionReader.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;
using testing::HasSubstr;
using Json = nlohmann::json;
using Settings = std::map<std::string, std::string>;

const std::set<Role> kCompared{Role::Stimulator, Role::Oscilloscope};
const Settings kShort{{"repeats", "2"}, {"level_repeats", "2"}};

ScriptOutcome compare(const Settings& settings) {
    RunBench rig(true, "sim:", 1, false, kCompared);
    auto outcome = runProtocol(rig.shipped("encoding-comparison", settings)).value();
    EXPECT_TRUE(rig.outputOff());
    return outcome;
}

/// Returns the value at `x` on a curve between `from` and `to`, calculated independently.
double along(const std::string& curve, double x, double from, double to) {
    if (curve == "logarithmic") return from * std::pow(to / from, x);
    return from + (to - from) * (curve == "power" ? std::pow(x, 1 / 1.5) : x);
}

double jnd(double a, double b, double w) { return std::abs(std::log(a / b)) / std::log(1 + w); }

/// Returns the smallest distance between the neighbouring levels 0.25, 0.5 and 0.75 of one output.
double smallestStep(const std::string& curve, double from, double to, double w) {
    const auto at = [&](double x) { return along(curve, x, from, to); };
    return std::min(jnd(at(0.25), at(0.5), w), jnd(at(0.5), at(0.75), w));
}

const Json& only(const Json& encodings, const std::string& assignment, const std::string& curve) {
    for (const auto& each : encodings) {
        if (each["assignment"] == assignment && each["curve"] == curve) return each;
    }
    throw std::out_of_range(assignment + " " + curve);
}

TEST(EncodingComparison, FindsTheDistancesThatTheFormulasGive) {
    const auto outcome = compare(kShort);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::None);
    const auto& encodings = outcome.results["encodings"];
    ASSERT_EQ(encodings.size(), 6U);
    for (const std::string curve : {"linear", "logarithmic", "power"}) {
        const double amplitude = smallestStep(curve, 10, 40, 0.10), interval = smallestStep(curve, 2, 0.5, 0.16);
        const auto& usual = only(encodings, "texture_to_amplitude", curve)["neighbours"];
        EXPECT_NEAR(usual["texture_min_jnd"].get<double>(), amplitude, 0.05) << curve;
        EXPECT_NEAR(usual["pressure_min_jnd"].get<double>(), interval, 0.05) << curve;
        EXPECT_NEAR(usual["min_jnd"].get<double>(), std::min(amplitude, interval), 0.05) << curve;
        const auto& swapped = only(encodings, "swapped", curve)["neighbours"];
        EXPECT_NEAR(swapped["texture_min_jnd"].get<double>(), interval, 0.05) << curve;
        EXPECT_NEAR(swapped["pressure_min_jnd"].get<double>(), amplitude, 0.05) << curve;
        EXPECT_NEAR(only(encodings, "swapped", curve)["smallest_amplitude_jnd"].get<double>(),
                    jnd(along(curve, 0.1, 10, 40), along(curve, 0.9, 10, 40), 0.10), 0.05)
            << curve;
        // With conditions at 0.1 and 0.9, the worst pair differs only in the interval.
        const double pair = jnd(along(curve, 0.1, 2, 0.5), along(curve, 0.9, 2, 0.5), 0.16);
        EXPECT_NEAR(only(encodings, "swapped", curve)["smallest_pair_jnd"].get<double>(), pair, 0.05) << curve;
    }
}

TEST(EncodingComparison, SwappedExchangesSmoothHighAndRoughLow) {
    const auto outcome = compare(kShort);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    for (const std::string curve : {"linear", "logarithmic", "power"}) {
        const auto& swapped = only(outcome.results["encodings"], "swapped", curve);
        const auto& high = swapped["conditions"][1];
        EXPECT_EQ(high["name"], "smooth-high");
        EXPECT_NEAR(high["amplitude_v"]["mean"].get<double>(), along(curve, 0.9, 10, 40), 0.3) << curve;
        EXPECT_NEAR(high["interval_s"]["mean"].get<double>(), along(curve, 0.1, 2, 0.5), 0.01) << curve;
    }
    const auto& differences = outcome.results["differences"];
    ASSERT_EQ(differences.size(), 5U);
    EXPECT_EQ(outcome.results["default"], "R to A, linear");
    EXPECT_EQ(differences[2]["encoding"], "swapped, linear");
    EXPECT_NEAR(differences[2]["smooth-low amplitude_jnd"].get<double>(), 0, 0.05);
    EXPECT_NEAR(differences[2]["smooth-high amplitude_jnd"].get<double>(), jnd(37, 13, 0.10), 0.05);
    EXPECT_NEAR(differences[2]["rough-low amplitude_jnd"].get<double>(), -jnd(37, 13, 0.10), 0.05);
    EXPECT_NEAR(differences[0]["smooth-low amplitude_jnd"].get<double>(),
                -jnd(along("logarithmic", 0.1, 10, 40), 13, 0.10), 0.05);
}

TEST(EncodingComparison, AtTheEndsTheCurvesAreTheSame) {
    auto ends = kShort;
    ends["low"] = "0";
    ends["high"] = "1";
    const auto outcome = compare(ends);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    for (const auto& each : outcome.results["encodings"]) {
        EXPECT_NEAR(each["smallest_pair_jnd"].get<double>(), std::log(4) / std::log(1.16), 0.05) << each["name"];
    }
    EXPECT_THAT(outcome.results["conclusion"].get<std::string>(), HasSubstr("people decide"));
    EXPECT_LT(outcome.results["asymmetry_jnd"].get<double>(), 0.1) << "swapping is a symmetry";
}

TEST(EncodingComparison, OnAnotherLoadThanStatedComparesNothing) {
    RecordProperty("hazard", "H9");
    auto other = kShort;
    other["load"] = "900";
    const auto outcome = compare(other);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_TRUE(outcome.results["encodings"].empty());
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("known-reference check failed"));
}

TEST(EncodingComparison, ReportsSideBySideAndAgainstTheDefault) {
    RunBench rig(true, "sim:", 1, true, kCompared);
    const auto outcome = runProtocol(rig.shipped("encoding-comparison", kShort)).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    const auto items = reader.reportItems().value();
    const auto found =
        std::ranges::find_if(items, [](const auto& item) { return item.body.value("kind", "") == "results"; });
    ASSERT_NE(found, items.end());
    const auto& results = found->body["results"];
    EXPECT_EQ(results["encodings"].size(), 6U);
    EXPECT_EQ(results["differences"].size(), 5U);
    ASSERT_EQ(results["conditions"].size(), 24U);
    EXPECT_FALSE(results["conditions"][0].contains("amplitude_jnd")) << "the default moves by nothing";
    EXPECT_EQ(results["conditions"][4]["amplitude_jnd"], results["differences"][0]["smooth-low amplitude_jnd"]);
    const auto first =
        std::ranges::find_if(items, [](const auto& item) { return item.body.value("kind", "") == "text"; });
    ASSERT_NE(first, items.end());
    EXPECT_THAT(first->body["text"].get<std::string>(), HasSubstr("Swapping R and P is a symmetry of this metric"));
    EXPECT_THAT(first->body["text"].get<std::string>(), HasSubstr("people decide"));
    EXPECT_EQ(reader.trials().value().size(), 6U * (4 * 2 + 9 * 2));
}

class ComparisonFault : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(ComparisonFault, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    const auto [device, at_s] = GetParam();
    RunBench rig(true, fmt::format("sim:{}@{}s", device, at_s), 1, false, kCompared);
    const auto outcome = runProtocol(rig.shipped("encoding-comparison", kShort)).value();
    ASSERT_TRUE(outcome.error);
    EXPECT_TRUE(rig.outputOff());
    EXPECT_NE(outcome.verdict, ScriptVerdict::Pass);
    if (at_s < 100) return;  // no encoding was complete by then
    ASSERT_TRUE(outcome.results.is_object()) << outcome.error->message;
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
    EXPECT_TRUE(outcome.results["verdict"].is_null());
    EXPECT_GE(outcome.results["encodings"].size(), 1U);
    EXPECT_LT(outcome.results["encodings"].size(), 6U);
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, ComparisonFault,
                         ::testing::Combine(::testing::Values("stimulator?fault=unplug", "oscilloscope?fault=unplug",
                                                              "oscilloscope?fault=stale"),
                                            ::testing::Values(0.0, 20.0, 130.0, 250.0)));

TEST(EncodingComparison, StoppedKeepsTheEncodingsThatWereWhole) {
    RecordProperty("hazard", "H2");
    RunBench rig(true, "sim:", 1, false, kCompared);
    auto request = rig.shipped("encoding-comparison", kShort);
    Bench& bench = rig.bench();
    int trials = 0;
    request.onTrial = [&](const Json&) {
        if (++trials == 60) bench.stop("the test");
    };
    const auto outcome = runProtocol(std::move(request)).value();
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
    EXPECT_TRUE(rig.outputOff());
    EXPECT_EQ(outcome.results["encodings"].size(), 2U);
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
}

}  // namespace
}  // namespace tacto
