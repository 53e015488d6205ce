#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/Estimate.h"
#include "core/base/JustNoticeable.h"

namespace tacto::test {
namespace {

TEST(Estimate, WilsonIntervalAgreesWithScipy) {
    // scipy.stats.binomtest(k, n).proportion_ci(0.95, method='wilson')
    struct Case {
        std::size_t k, n;
        double low, high;
    };
    for (const auto& c :
         {Case{100, 100, 0.963006501793014, 1}, Case{99, 100, 0.945513803821295, 0.998232567935859},
          Case{73, 73, 0.950007992044269, 1}, Case{72, 72, 0.949348827403542, 1}, Case{0, 10, 0, 0.277532799862889},
          Case{5, 10, 0.236593090512564, 0.763406909487436}, Case{1, 1, 0.206549314377237, 1}}) {
        const auto interval = wilsonInterval(c.k, c.n);
        EXPECT_DOUBLE_EQ(interval.value, static_cast<double>(c.k) / static_cast<double>(c.n));
        EXPECT_NEAR(interval.low, c.low, 1e-13) << c.k << "/" << c.n;
        EXPECT_NEAR(interval.high, c.high, 1e-13) << c.k << "/" << c.n;
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
    EXPECT_NEAR(justNoticeableDifferences(10, 40, kAmplitudeWeberFraction), 14.545081794683425, 1e-12);
    EXPECT_NEAR(justNoticeableDifferences(2, 0.5, kIntervalWeberFraction), 9.340347077977647, 1e-12);
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
