#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/Statistics.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(StudentQuantile, AgreesWithPrintedTables) {
    // GUM table G.2, p = 95 % (two-sided).
    struct Row {
        double freedom, t;
    };
    for (const auto& row :
         {Row{1, 12.71}, Row{2, 4.30}, Row{3, 3.18}, Row{4, 2.78}, Row{5, 2.57}, Row{8, 2.31}, Row{10, 2.23},
          Row{16, 2.12}, Row{30, 2.04}, Row{50, 2.01}, Row{100, 1.984}, Row{kInf, 1.960}}) {
        EXPECT_NEAR(studentQuantile(0.975, row.freedom), row.t, 0.0051) << row.freedom;
    }
    EXPECT_NEAR(studentQuantile(0.975, 1), std::tan(std::numbers::pi * 0.475), 1e-9);  // Cauchy, in closed form
    EXPECT_DOUBLE_EQ(studentQuantile(0.025, 7), -studentQuantile(0.975, 7));
}

TEST(StudentQuantile, HasNoValueOutsideItsRange) {
    for (const double p : {0.0, 1.0, -0.1, kNaN}) EXPECT_TRUE(std::isnan(studentQuantile(p, 5))) << p;
    for (const double freedom : {0.0, -1.0, kNaN}) EXPECT_TRUE(std::isnan(studentQuantile(0.975, freedom))) << freedom;
}

TEST(UncertaintyBudget, FollowsTheGumsOwnExample) {
    // GUM H.1 (end gauge, nm): contributions 25, 9.7, 2.9 and 16.6 with 18, 25.6, 50 and 2 degrees of freedom give
    // u_c = 32 nm and, with those digits, 16.7 effective degrees of freedom.
    const auto budget = accepted(combine({{"standard", Distribution::Normal, 25, 1, 1, 18},
                                          {"difference", Distribution::Student, 9.7, 1, 1, 25.6},
                                          {"expansion", Distribution::Normal, 2.9, 1, 1, 50},
                                          {"temperature", Distribution::Normal, 16.6, 1, 1, 2}}));
    EXPECT_NEAR(budget.combined, 31.7, 0.05);
    EXPECT_NEAR(budget.degreesOfFreedom, 16.7, 0.5);
    EXPECT_EQ(budget.method, CoverageMethod::WelchSatterthwaite);
    EXPECT_DOUBLE_EQ(budget.coverageFactor, studentQuantile(0.975, budget.degreesOfFreedom));
    EXPECT_DOUBLE_EQ(budget.expanded, budget.coverageFactor * budget.combined);
}

TEST(UncertaintyBudget, ARowIsValueOverDivisorTimesSensitivity) {
    const auto budget =
        combine({{"a", Distribution::Normal, 6, 2, -4, kInf}, {"b", Distribution::Normal, 5, 1, 1, kInf}});
    ASSERT_TRUE(budget);
    EXPECT_DOUBLE_EQ(budget->rows[0].contribution(), 12);
    EXPECT_DOUBLE_EQ(budget->combined, 13);
    EXPECT_NEAR(budget->coverageFactor, figuresOf("estimates").at("normal_quantile").at("0.975").get<double>(), 1e-6);
    EXPECT_TRUE(std::isinf(budget->degreesOfFreedom));
}

TEST(UncertaintyBudget, OneRectangleIsPropagatedNotTakenForNormal) {
    // By itself: 95 % of a half-width of 2 is 1.9, not 1.96 · 2/√3 = 2.26.
    const auto one = accepted(combine({{"gain", Distribution::Rectangular, 2, std::sqrt(3.0), 1, kInf}}));
    EXPECT_EQ(one.method, CoverageMethod::MonteCarlo);
    EXPECT_NEAR(one.expanded, 1.9, 0.01);
    // Two equal rectangles make a triangle of half-width 4.
    const auto two = accepted(combine({{"gain", Distribution::Rectangular, 2, std::sqrt(3.0), 1, kInf},
                                       {"offset", Distribution::Rectangular, 2, std::sqrt(3.0), -1, kInf}}));
    EXPECT_NEAR(two.expanded, 4 * (1 - std::sqrt(0.05)), 0.02);
}

TEST(UncertaintyBudget, ManySmallRectanglesAreNearNormal) {
    std::vector<Contribution> rows;
    for (int i = 0; i < 9; ++i) rows.push_back({"part", Distribution::Rectangular, 1, std::sqrt(3.0), 1, kInf});
    const auto budget = accepted(combine(rows));
    EXPECT_EQ(budget.method, CoverageMethod::WelchSatterthwaite);
    EXPECT_NEAR(budget.expanded, 1.96 * std::sqrt(3.0), 1e-3);
}

TEST(UncertaintyBudget, PropagatedScatterKeepsItsDegreesOfFreedom) {
    // A type A row with a rectangle just large enough to require the Monte Carlo method: with 3 degrees of freedom the
    // interval is far wider than with many.
    const auto with = [](double freedom) {
        const auto budget = combine({{"s", Distribution::Student, 1, 1, 1, freedom},
                                     {"gain", Distribution::Rectangular, 1.1, std::sqrt(3.0), 1, kInf}});
        EXPECT_TRUE(budget);
        EXPECT_EQ(budget->method, CoverageMethod::MonteCarlo);
        return budget->expanded;
    };
    // Normal (1) plus rectangle (± 1.1), integrated numerically.
    EXPECT_NEAR(with(kInf), figuresOf("estimates").at("normal_and_rectangle").at("expanded").get<double>(), 0.02);
    EXPECT_GT(with(3), 1.3 * with(kInf));
}

TEST(UncertaintyBudget, TheSameSeedGivesTheSameInterval) {
    const std::vector<Contribution> rows{{"gain", Distribution::Rectangular, 2, std::sqrt(3.0), 1, kInf},
                                         {"s", Distribution::Student, 0.5, 1, 1, 8}};
    EXPECT_DOUBLE_EQ(combine(rows, {7, 5000})->expanded, combine(rows, {7, 5000})->expanded);
    EXPECT_NE(combine(rows, {7, 5000})->expanded, combine(rows, {8, 5000})->expanded);
}

TEST(UncertaintyBudget, NothingUncertainHasNoFactor) {
    const auto budget = accepted(combine({{"s", Distribution::Student, 0, 1, 1, 4}}));
    EXPECT_EQ(budget.expanded, 0);
    EXPECT_TRUE(std::isnan(budget.coverageFactor));
}

TEST(UncertaintyBudget, WithARowThatIsNotStatedThereIsNoU) {
    RecordProperty("hazard", "H9");
    const auto budget =
        combine({{"s", Distribution::Student, 1, 1, 1, 4}, {"gain", Distribution::Rectangular, kNaN, 1, 1}});
    ASSERT_TRUE(budget);
    EXPECT_TRUE(std::isnan(budget->combined));
    EXPECT_TRUE(std::isnan(budget->expanded));
    EXPECT_EQ(budget->rows.size(), 2U) << "what is known stays to be read";
    EXPECT_EQ(guardBanded(0, budget->expanded, 1), Verdict::Indeterminate);
}

TEST(UncertaintyBudget, RefusesWhatIsNoUncertainty) {
    RecordProperty("hazard", "H9");
    EXPECT_FALSE(combine({}));
    for (const double value : {-1.0, kInf}) EXPECT_FALSE(combine({{"s", Distribution::Normal, value, 1, 1, kInf}}));
    for (const double divisor : {0.0, -1.0, kNaN})
        EXPECT_FALSE(combine({{"s", Distribution::Normal, 1, divisor, 1, kInf}}));
    for (const double freedom : {0.0, kNaN}) EXPECT_FALSE(combine({{"s", Distribution::Normal, 1, 1, 1, freedom}}));
    EXPECT_FALSE(combine({{"s", Distribution::Normal, 1, 1, kNaN, kInf}}));
    EXPECT_FALSE(combine({{"s", Distribution::Normal, 1, 1, 1, kInf}}, {1, 999}));
}

TEST(GuardBand, PassesAndFailsOnlyWhereTheUncertaintyCannotTurnIt) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(guardBanded(0.7, 0.25, 1), Verdict::Pass);
    EXPECT_EQ(guardBanded(-0.75, 0.25, 1), Verdict::Pass);  // |error| + U = tolerance
    EXPECT_EQ(guardBanded(0.8, 0.25, 1), Verdict::Indeterminate);
    EXPECT_EQ(guardBanded(-1.25, 0.25, 1), Verdict::Indeterminate);  // |error| - U = tolerance
    EXPECT_EQ(guardBanded(1.3, 0.25, 1), Verdict::Fail);
    EXPECT_EQ(guardBandedName(1.3, 0.25, 1), "fail");
    EXPECT_EQ(guardBandedName(0.8, 0.25, 1), "indeterminate");
    EXPECT_EQ(guardBandedName(1.3, std::nan(""), 1), "not evaluated");
    EXPECT_EQ(guardBandedName(std::nan(""), 0.25, 1), "not evaluated");
    EXPECT_EQ(guardBanded(-1.3, 0.25, 1), Verdict::Fail);
    EXPECT_EQ(guardBanded(kNaN, 0.25, 1), Verdict::Indeterminate);
    EXPECT_EQ(guardBanded(0, kNaN, 1), Verdict::Indeterminate);
    EXPECT_EQ(guardBanded(0, -1, 1), Verdict::Indeterminate);
    EXPECT_EQ(guardBanded(0, 0, 0), Verdict::Indeterminate);
    EXPECT_EQ(guardBanded(0, 0, kNaN), Verdict::Indeterminate);
}

}  // namespace
}  // namespace tacto::test
