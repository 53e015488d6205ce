// Tests the oscilloscope's scales (steps, values as people write them, numbers on an axis) and its mask counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/scope/model/Viewport.h"
#include "app/gui/scope/panels/MaskPanel.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/scope/screen/Graticule.h"
#include "core/base/Random.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

TEST(Steps, ClimbTheLadderInBothDirections) {
    EXPECT_EQ(gui::stepNotBelow(1e-3), 1e-3);
    EXPECT_EQ(gui::stepNotBelow(1.01e-3), 2e-3);
    EXPECT_EQ(gui::stepNotBelow(7), 10);
    EXPECT_EQ(gui::stepAlong(1, -1), 0.5);
    EXPECT_EQ(gui::stepAlong(0.5, 1), 1);
    double up = 1e-9;
    for (int i = 0; i < 36; ++i) up = gui::stepAlong(up, 1);
    EXPECT_EQ(up, 1000) << "a step is the same number however it is reached";
    EXPECT_THAT(gui::stepsBetween(1, 10), ElementsAre(1, 2, 5, 10));
    EXPECT_DOUBLE_EQ(gui::stepAlong(150e-6, 1), 200e-6) << "a value between two is one away from either";
    EXPECT_DOUBLE_EQ(gui::stepAlong(150e-6, -1), 100e-6);
}

TEST(ScopeQuantity, IsReadAsPeopleWriteIt) {
    EXPECT_NEAR(gui::parseQuantity("1.5 ms", "s").value(), 1.5e-3, 1e-12);
    EXPECT_NEAR(gui::parseQuantity("20u", "s").value(), 20e-6, 1e-15);
    EXPECT_NEAR(gui::parseQuantity("−2,5 V", "V").value(), -2.5, 1e-12);
    EXPECT_NEAR(gui::parseQuantity("3", "A").value(), 3, 1e-12);
    EXPECT_FALSE(gui::parseQuantity("two volts", "V"));
    EXPECT_FALSE(gui::parseQuantity("", "V"));
    gui::QuantitySpin spin("V", 0, 50);
    QSignalSpy changed(&spin, &QDoubleSpinBox::valueChanged);
    spin.show();
    spin.selectAll();
    QTest::keyClicks(&spin, "150 mV");
    QTest::keyClick(&spin, Qt::Key_Return);
    EXPECT_NEAR(spin.value(), 0.15, 1e-12);
    EXPECT_EQ(changed.count(), 1);
    EXPECT_EQ(spin.text(), "150\u202fmV");
}

/// Tries spans over nine decades with any start and any least distance.
TEST(RoundTicker, NumbersAreRoundAndStandWhereTheyBelongAtEveryZoom) {
    Random random(7, "spans");
    for (int i = 0; i < 3000; ++i) {
        const double span = std::pow(10, 9 * random.uniform() - 7);
        const double lower = (random.uniform() - 0.5) * span * (i % 3 == 0 ? 100 : 4);
        const QCPRange range(lower, lower + span);
        const double factor = std::pow(10, 3 * std::floor(-std::log10(span / 2) / 3 + 1));
        gui::RoundTicker ticker(10);
        const double position = i % 2 == 0 ? 0 : span * (random.uniform() - 0.5);
        ticker.setQuantity(position, 1, factor);
        QVector<double> ticks;
        QVector<QString> labels;
        ticker.generate(range, {}, 'f', 6, ticks, nullptr, &labels);
        ASSERT_EQ(ticks.size(), labels.size());
        ASSERT_GE(ticks.size(), 4) << span;
        ASSERT_LE(ticks.size(), 11) << span;
        const double step = (ticks[1] - ticks[0]) * factor;
        const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
        EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6)
            << step;
        for (int t = 0; t < ticks.size(); ++t) {
            const double number = QString(labels[t]).replace(QChar(0x2212), '-').toDouble();
            EXPECT_NEAR(number, (ticks[t] - position) * factor, 1e-6 * step) << labels[t].toStdString();
            EXPECT_NEAR(std::remainder(number, step), 0, 1e-5 * step) << labels[t].toStdString();
            EXPECT_GE(ticks[t], range.lower);
            EXPECT_LE(ticks[t], range.upper);
            EXPECT_FALSE(labels[t].startsWith(QChar(0x2212)) && number == 0) << "no −0";
        }
        ASSERT_EQ(QSet<QString>(labels.begin(), labels.end()).size(), labels.size()) << "no number twice";
    }
}

TEST(RoundTicker, StandAtTheDivisionsOfAStepAndNoNearerThanTheLeast) {
    gui::RoundTicker ticker(10);
    ticker.setQuantity(0, 1, 1e6);
    QVector<double> ticks;
    QVector<QString> labels;
    ticker.generate({-300e-6, 700e-6}, {}, 'f', 6, ticks, nullptr, &labels);
    EXPECT_EQ(ticks.size(), 11);
    EXPECT_EQ(labels.first(), "−300");
    EXPECT_EQ(labels.last(), "700");
    ticker.setLeast(150e-6);
    ticker.generate({-300e-6, 700e-6}, {}, 'f', 6, ticks, nullptr, &labels);
    EXPECT_THAT(labels, ElementsAre("−200", "0", "200", "400", "600"));
}

TEST(MaskPanel, AResetCountsNoCaptureFromBefore) {
    gui::MaskPanel panel;
    panel.make(prepared(twoPulses()));
    const auto judged = [&] {
        auto shown = std::const_pointer_cast<gui::ShownCapture>(prepared(twoPulses(99.999, 30)));
        shown->judgedBy = panel.mask();
        shown->mask = panel.mask()->check(*shown->capture);
        return shown;
    };
    const auto underWay = judged();
    panel.take(judged());
    ASSERT_EQ(panel.counts().outside, 1U);
    panel.resetCounts();
    panel.take(underWay);
    EXPECT_EQ(panel.counts().judged(), 0U);
    EXPECT_EQ(panel.alarm(), "");
    EXPECT_EQ(panel.firstOutside(), nullptr);
    panel.take(judged());
    EXPECT_EQ(panel.counts().outside, 1U) << "the test goes on with the same band";
}

}  // namespace
}  // namespace tacto::test
