#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/JustNoticeable.h"
#include "tests/support/Figures.h"

namespace tacto::test {
namespace {

TEST(Estimate, WilsonIntervalAgreesWithScipy) {
    for (const auto& scipy : figuresOf("estimates").at("wilson")) {
        const auto k = scipy.at("k").get<std::size_t>(), n = scipy.at("n").get<std::size_t>();
        const auto interval = wilsonInterval(k, n);
        EXPECT_DOUBLE_EQ(interval.value, static_cast<double>(k) / static_cast<double>(n));
        EXPECT_NEAR(interval.low, scipy.at("low").get<double>(), 1e-13) << k << "/" << n;
        EXPECT_NEAR(interval.high, scipy.at("high").get<double>(), 1e-13) << k << "/" << n;
    }
}

TEST(Estimate, NoTrialsKnowNothing) {
    RecordProperty("hazard", "H9");
    const auto interval = wilsonInterval(0, 0);
    EXPECT_TRUE(std::isnan(interval.value));
    EXPECT_EQ(interval.low, 0);
    EXPECT_EQ(interval.high, 1);
}

TEST(Estimate, JustNoticeableDifferencesCountWeberSteps) {
    EXPECT_NEAR(justNoticeableDifferences(10, 40, kAmplitudeWeberFraction), std::log(4) / std::log(1.1), 1e-12);
    EXPECT_NEAR(justNoticeableDifferences(2, 0.5, kIntervalWeberFraction), std::log(4) / std::log(1.16), 1e-12);
    EXPECT_NEAR(justNoticeableDifferences(10, 11, 0.10), 1, 1e-12);
    EXPECT_EQ(justNoticeableDifferences(7, 7, 0.10), 0);
}

TEST(Estimate, JustNoticeableDifferencesOfWhatIsNotMeasuredAreUnknown) {
    RecordProperty("hazard", "H9");
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_TRUE(std::isnan(justNoticeableDifferences(bad, 1, 0.1))) << bad;
        EXPECT_TRUE(std::isnan(justNoticeableDifferences(1, bad, 0.1))) << bad;
        EXPECT_TRUE(std::isnan(justNoticeableDifferences(1, 2, bad))) << bad;
    }
}

}  // namespace
}  // namespace tacto::test
