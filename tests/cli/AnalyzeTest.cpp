// analyze separability: trials from a CSV, compared with the formulas of science.md section 10.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Result.h"
#include "tests/cli/Shape.h"
#include "tests/support/Figures.h"

namespace tacto::test {
namespace {

struct Trial {
    double amplitude, interval;
};
using Trials = std::array<std::vector<Trial>, 4>;  // trials in the order of kConditions

/// Returns trials with a relative spread of `spread`, without random numbers.
Trials trials(int each, double spread, const std::array<double, 4>& volts = {10, 10, 40, 40}) {
    constexpr std::array<double, 4> kSeconds{2, 0.5, 2, 0.5};
    Trials made;
    for (std::size_t c = 0; c < 4; ++c) {
        for (int k = 0; k < each; ++k) {
            const double place = k + 31.0 * static_cast<double>(c);
            made[c].push_back({volts[c] * (1 + spread * std::sin(7.3 * place)),
                               kSeconds[c] * (1 + spread * std::sin(2.9 * place * place))});
        }
    }
    return made;
}

std::string csv(const Trials& trials, const std::string& header = "condition,amplitude,interval") {
    std::string text = header + "\n";
    for (std::size_t c = 0; c < 4; ++c) {
        for (const auto& trial : trials[c])
            text += fmt::format("{},{:.17g},{:.17g}\n", kConditions[c], trial.amplitude, trial.interval);
    }
    return text;
}

Ran analyze(const std::string& text) {
    const Desk desk;
    return desk.run({"analyze", "separability", desk.write("trials.csv", text), "--json"});
}

/// Returns the distance of two conditions' means with the covariance pooled over all four, calculated step by step.
double mahalanobis(const Trials& trials, std::size_t a, std::size_t b) {
    std::array<Trial, 4> mean{};
    double sumAmplitude = 0, sumInterval = 0, n = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        for (const auto& trial : trials[c]) {
            mean[c].amplitude += trial.amplitude / static_cast<double>(trials[c].size());
            mean[c].interval += trial.interval / static_cast<double>(trials[c].size());
            sumAmplitude += trial.amplitude;
            sumInterval += trial.interval;
            ++n;
        }
    }
    double aa = 0, ai = 0, ii = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        for (const auto& trial : trials[c]) {
            const double da = trial.amplitude - mean[c].amplitude, di = trial.interval - mean[c].interval;
            aa += da * da / (n - 4);
            ai += da * di / (n - 4);
            ii += di * di / (n - 4);
        }
    }
    aa = std::max(aa, std::pow(0.001 * sumAmplitude / n, 2));
    ii = std::max(ii, std::pow(0.001 * sumInterval / n, 2));
    const double da = mean[a].amplitude - mean[b].amplitude, di = mean[a].interval - mean[b].interval;
    return std::sqrt((da * da * ii - 2 * da * di * ai + di * di * aa) / (aa * ii - ai * ai));
}

TEST(AnalyzeSeparability, ConditionsThatDifferPassWithTheNumbersOfTheFormulas) {
    const auto given = trials(25, 0.02);
    const auto ran = analyze(csv(given));
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    expectSeparability(value);
    EXPECT_EQ(value["verdict"], "pass");
    EXPECT_EQ(value["accuracy"]["value"], 1.0);
    // Wilson, 100 of 100: n / (n + z^2)
    const auto& scipy = figuresOf("estimates").at("wilson").at(0);  // 100 of 100
    EXPECT_NEAR(value["accuracy"]["low"].get<double>(), scipy.at("low").get<double>(), 1e-6);
    std::size_t pair = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b, ++pair) {
            const double expected = mahalanobis(given, a, b);
            EXPECT_NEAR(value["pairs"][pair]["mahalanobis"].get<double>(), expected, 1e-6 * expected)
                << kConditions[a] << " / " << kConditions[b];
        }
    }
}

TEST(AnalyzeSeparability, ConditionsThatDoNotDifferFailAndExitOne) {
    const auto ran = analyze(csv(trials(25, 0.02, {10, 10, 10.1, 10.1})));
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_EQ(jsonOf(ran)["verdict"], "fail");
    expectSeparability(jsonOf(ran));
}

TEST(AnalyzeSeparability, AConditionThatVariesTooMuchFails) { EXPECT_EQ(analyze(csv(trials(25, 0.09))).code, 1); }

TEST(AnalyzeSeparability, FewerThan73TrialsAreIndeterminateAndExitFive) {
    RecordProperty("hazard", "H9");
    const auto few = analyze(csv(trials(18, 0.01)));
    EXPECT_EQ(few.code, 5) << few.err;
    EXPECT_EQ(jsonOf(few)["verdict"], "indeterminate");
    EXPECT_EQ(analyze(csv(trials(19, 0.01))).code, 0);
}

TEST(AnalyzeSeparability, WhatWasNotMeasuredDoesNotPass) {
    RecordProperty("hazard", "H9");
    auto text = csv(trials(25, 0.01));
    text += "smooth-low,,2\n";
    EXPECT_EQ(analyze(text).code, 5);
}

TEST(AnalyzeSeparability, NamesOfColumnsAreTrimmed) {
    const auto given = trials(25, 0.01);
    EXPECT_EQ(analyze(csv(given, " condition , amplitude , interval ")).out, analyze(csv(given)).out);
}

TEST(AnalyzeSeparability, AFileThatIsNoTrialsExitsThreeWithFileAndLine) {
    const Desk desk;
    const auto refused = [&](const std::string& text, const Words& parts) {
        expectRefused(desk.run({"analyze", "separability", desk.write("bad.csv", text), "--json"}), 3, parts);
    };
    expectRefused(desk.run({"analyze", "separability", desk.at("none.csv"), "--json"}), 3, {"none.csv"});
    refused("", {"bad.csv", "empty", "condition, amplitude"});
    refused("condition,amp,interval\nsmooth-low,1,2\n", {"bad.csv:1", "amplitude"});
    refused("condition,amplitude,interval\nsmooth-low,10,2\nsmooth-low,ten,2\n", {"bad.csv:3", "ten", "number"});
    refused("condition,amplitude,interval\nsmooth-low,-10,2\n", {"bad.csv:2", "-10"});
    refused("condition,amplitude,interval\nsmooth-low,10\n", {"bad.csv:2", "fields"});
}

TEST(AnalyzeSeparability, TextSaysVerdictAndAccuracy) {
    const Desk desk;
    const auto ran = desk.run({"analyze", "separability", desk.write("trials.csv", csv(trials(25, 0.01)))});
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, testing::HasSubstr("pass"));
    EXPECT_THAT(ran.out, testing::HasSubstr("96.3"));
}

}  // namespace
}  // namespace tacto::test
