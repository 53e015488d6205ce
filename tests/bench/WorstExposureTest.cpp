#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/bench/delivery/ExposureWatch.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

ExposureRow rowOf(double value, double limit, LimitAction action = LimitAction::Refuse) {
    ExposureRow row;
    row.quantity = Quantity::PeakCurrent;
    row.value = value;
    row.limit = limit;
    row.unit = unitOf(row.quantity);
    row.set = "a set";
    row.action = action;
    row.evaluated = true;
    row.within = value <= limit;
    return row;
}

std::vector<double> valuesOf(const WorstExposure& worst) {
    std::vector<double> values;
    for (const auto& row : worst.rows()) values.push_back(row.evaluated ? row.value : -1);
    return values;
}

TEST(WorstExposure, KeepsALimitThatWarnsBesideTheOneThatRefuses) {
    RecordProperty("hazard", "H9");
    WorstExposure worst;
    for (const double value : {3.0, 7.0, 5.0}) {
        const ExposureRow now[] = {rowOf(value, 10), rowOf(value, 5, LimitAction::Warn)};
        worst.take(now);
    }
    ASSERT_THAT(valuesOf(worst), ElementsAre(7, 7));
    EXPECT_EQ(worst.rows()[1].limit, 5);
    EXPECT_FALSE(worst.rows()[1].within);
}

TEST(WorstExposure, OnceUnknownIsWorseThanAnyNumber) {
    RecordProperty("hazard", "H9");
    WorstExposure worst;
    auto unknown = rowOf(4, 10);
    unknown.evaluated = false;
    for (const auto& row : {rowOf(3, 10), unknown, rowOf(9, 10)}) worst.take(std::span(&row, 1));
    EXPECT_THAT(valuesOf(worst), ElementsAre(-1));
}

TEST(WorstExposure, OfLimitsThatDifferByFrequencyIsTheOneInForce) {
    WorstExposure worst;
    const ExposureRow atRest[] = {rowOf(0, 50), rowOf(0, 80)}, inForce[] = {rowOf(7, 80)};
    worst.take(atRest);
    worst.take(inForce);
    ASSERT_THAT(valuesOf(worst), ElementsAre(7));
    EXPECT_EQ(worst.rows()[0].limit, 80);
}

TEST(WorstExposure, WhatIsShownWithoutALimitIsOneRow) {
    WorstExposure worst;
    for (const double value : {1.0, 2.0}) {
        const auto row = rowOf(value, std::numeric_limits<double>::quiet_NaN(), LimitAction::Disclose);
        worst.take(std::span(&row, 1));
    }
    EXPECT_THAT(valuesOf(worst), ElementsAre(2));
}

}  // namespace
}  // namespace tacto::test
