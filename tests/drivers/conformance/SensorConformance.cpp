#include "tests/drivers/conformance/SensorConformance.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {

void SensorConformance::SetUp() {
    rig_ = GetParam().make();
    ASSERT_NE(rig_, nullptr);
    blocks_.resize(device().streams().size());
}

void SensorConformance::collect(Seconds duration, Seconds step) {
    for (Seconds passed(0); passed < duration && !device().finished(); passed += step) {
        rig_->wait(step);
        accepted(device().read(blocks_));
    }
}

TEST_P(SensorConformance, DeclaresStreamsThatMakeSense) {
    EXPECT_EQ(device().identity().role, Role::Sensor);
    ASSERT_FALSE(device().streams().empty());
    for (const auto& stream : device().streams()) {
        EXPECT_GT(stream.rate_hz, 0);
        EXPECT_FALSE(stream.name.empty());
        if (stream.kind == StreamKind::Acceleration) {
            EXPECT_GE(stream.channels, 1U);
            EXPECT_LE(stream.channels, 3U);
            EXPECT_TRUE(stream.unit == StreamUnit::MetrePerSecondSquared || stream.unit == StreamUnit::Count);
        } else if (stream.kind == StreamKind::Taxels) {
            EXPECT_GE(stream.channels, 2U);
            EXPECT_TRUE(stream.unit == StreamUnit::Pascal || stream.unit == StreamUnit::Count);
        } else {
            EXPECT_EQ(stream.channels, 1U);
            EXPECT_TRUE(stream.unit == StreamUnit::Newton || stream.unit == StreamUnit::Count);
        }
    }
}

TEST_P(SensorConformance, EverySampleHasAllChannels) {
    collect(Seconds(0.5), Seconds(0.0137));
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        EXPECT_EQ(blocks_[i].values.size(), blocks_[i].samples() * device().streams()[i].channels);
    }
}

TEST_P(SensorConformance, StampsRiseAndAreNeverAheadOfTheClock) {
    RecordProperty("hazard", "H7");
    collect(Seconds(1), Seconds(0.02));
    for (const auto& block : blocks_) {
        ASSERT_IN_TIME(block.samples() > 1U);
        EXPECT_TRUE(std::is_sorted(block.t_s.begin(), block.t_s.end(), std::less_equal<>()));
        EXPECT_LE(block.t_s.back(), toSeconds(rig_->clock().now()) + 1e-6);
    }
}

TEST_P(SensorConformance, RatesAreThoseDeclared) {
    collect(Seconds(1), Seconds(0.05));
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const auto& t = blocks_[i].t_s;
        ASSERT_IN_TIME(t.size() > 2U);
        std::vector<double> steps;
        for (std::size_t k = 1; k < t.size(); ++k) steps.push_back(t[k] - t[k - 1]);
        // By the median step: a board whose line was not read in time drops blocks.
        const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
        std::ranges::nth_element(steps, middle);
        EXPECT_NEAR(1 / *middle, device().streams()[i].rate_hz, 0.02 * device().streams()[i].rate_hz);
    }
}

TEST_P(SensorConformance, GivesEachSampleOnce) {
    collect(Seconds(0.2), Seconds(0.02));
    std::vector<SampleBlock> again(blocks_.size());
    ASSERT_TRUE(device().read(again).has_value());
    for (std::size_t i = 0; i < again.size(); ++i) {
        if (again[i].samples() == 0) continue;
        ASSERT_IN_TIME(blocks_[i].samples() > 0U);
        EXPECT_GT(again[i].t_s.front(), blocks_[i].t_s.back());
    }
}

TEST_P(SensorConformance, AppendsToWhatIsThere) {
    blocks_[0].t_s.assign(1, -1);
    blocks_[0].values.assign(device().streams()[0].channels, 7);
    collect(Seconds(0.1), Seconds(0.02));
    ASSERT_IN_TIME(blocks_[0].samples() > 1U);
    EXPECT_EQ(blocks_[0].t_s.front(), -1);
    EXPECT_EQ(blocks_[0].values.front(), 7);
}

TEST_P(SensorConformance, NeverBlocks) {
    for (int i = 0; i < 20; ++i) {
        rig_->wait(Seconds(0.001));
        const auto begin = std::chrono::steady_clock::now();
        ASSERT_TRUE(device().read(blocks_).has_value());
        EXPECT_IN_TIME(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(50));
    }
}

TEST_P(SensorConformance, RefusesTheWrongNumberOfBlocks) {
    std::vector<SampleBlock> wrong(blocks_.size() + 1);
    EXPECT_FALSE(device().read(wrong).has_value());
}

TEST_P(SensorConformance, UnpluggedIsAnErrorAndNotACrash) {
    RecordProperty("hazard", "H7");
    if (!rig_->unplug()) GTEST_SKIP() << "this rig cannot pull the plug";
    const auto read = device().read(blocks_);
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(read.error().code, ErrorCode::Device);
    EXPECT_FALSE(device().read(blocks_).has_value());
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SensorConformance);

}  // namespace tacto::test
