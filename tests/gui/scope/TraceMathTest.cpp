// Traces that are computed of others: power, charge, difference.
#include <gmock/gmock.h>

#include "app/gui/scope/model/TraceMath.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

TEST(TraceMath, PowerIsVoltageTimesCurrent) {
    const auto shown = prepared(twoPulses());
    const auto power = gui::powerTrace(*shown->traces[0], *shown->traces[1]);
    ASSERT_EQ(power->size(), 20'000U);
    for (std::size_t i = 0; i < power->size(); i += 97) {
        const float expected = (*shown->traces[0]->samples)[i] * (*shown->traces[1]->samples)[i];
        EXPECT_FLOAT_EQ((*power->samples)[i], expected);
    }
    EXPECT_EQ(power->unit, "W");
}

TEST(TraceMath, ChargeReturnsToZeroAfterABalancedPulseAndBeginsAgainAfterAGap) {
    auto capture = twoPulses();
    auto& amps = capture.channels[1].samples;
    amps[8000] = NAN;
    const auto shown = prepared(std::move(capture));
    const auto charge = gui::chargeTrace(*shown->traces[1]);
    const auto most = *std::max_element(charge->samples->begin(), charge->samples->begin() + 8000);
    EXPECT_NEAR(static_cast<double>(most), 40e-3 * 200e-6, 1e-7);
    EXPECT_NEAR(static_cast<double>((*charge->samples)[7999]), 0, 2e-8);
    EXPECT_TRUE(std::isnan((*charge->samples)[8000]));
    EXPECT_EQ((*charge->samples)[8001], 0.0F);
}

TEST(TraceMath, ADifferenceIsTakenAtTheSameTimeFromTheTrigger) {
    const auto a = prepared(twoPulses(10, 40));
    auto later = twoPulses(20, 30);
    const auto b = prepared(std::move(later));
    const auto difference = gui::differenceTrace(*a->traces[0], *b->traces[0]);
    EXPECT_NEAR(difference->valueAt(a->zero_s + 0.1e-3), 10, 0.2);
    EXPECT_NEAR(difference->valueAt(a->zero_s + 2e-3), 0, 0.2);
    // Half the rate: between its samples by straight line.
    auto ramp = std::make_shared<std::vector<float>>();
    auto coarse = std::make_shared<std::vector<float>>();
    for (int i = 0; i < 100; ++i) ramp->push_back(static_cast<float>(i));
    for (int i = 0; i < 40; ++i) coarse->push_back(static_cast<float>(2 * i));
    const auto fine = gui::makeTrace("channel/a", "A", "V", ramp, 1000, 0, 0);
    const auto half = gui::makeTrace("channel/b", "B", "V", coarse, 500, 0, 0);
    const auto zero = gui::differenceTrace(*fine, *half);
    for (std::size_t i = 0; i <= 78; ++i) ASSERT_NEAR(static_cast<double>((*zero->samples)[i]), 0, 1e-4) << i;
    EXPECT_TRUE(std::isnan((*zero->samples)[90])) << "where one has ended there is no difference";
}

}  // namespace
}  // namespace tacto::test
