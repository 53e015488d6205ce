// Tests the envelope pixel by pixel on the raster engine: the extremes are drawn, whichever method draws them.
#include <gtest/gtest.h>

#include "app/gui/scope/screen/EnvelopeGraph.h"
#include "core/base/Random.h"

namespace tacto::test {
namespace {

/// A plot that consists only of its axis rect, 400 by 200 pixels, with value 0 in the middle and ±4 divisions.
class Envelopes : public testing::Test {
protected:
    Envelopes() {
        plot.setNotAntialiasedElements(QCP::aeAll);
        plot.resize(400, 200);
        plot.axisRect()->setAutoMargins(QCP::msNone);
        plot.axisRect()->setMargins({});
        for (auto* axis : {plot.xAxis, plot.yAxis}) {
            axis->setVisible(false);
            axis->grid()->setVisible(false);
        }
        plot.yAxis->setRange(-4, 4);
        plot.plotLayout()->setAutoMargins(QCP::msNone);
        graph->setPen(QPen(Qt::blue, 1));
        graph->setScale(1, 0);
    }
    QImage drawn(const std::vector<float>& samples) {
        auto shared = std::make_shared<const std::vector<float>>(samples);
        const double n = static_cast<double>(samples.size());
        graph->setSpans({{gui::makeTrace("channel/a", "A", "V", shared, 1, 0, 0), 0}});
        plot.xAxis->setRange(0, n);
        return plot.toPixmap(400, 200).toImage().convertToFormat(QImage::Format_RGB32);
    }
    /// The first and last blue row of a column; {-1, -1} if there is none.
    static std::pair<int, int> rows(const QImage& image, int x) {
        int first = -1, last = -1;
        for (int y = 0; y < image.height(); ++y) {
            if (image.pixelColor(x, y) != QColor(Qt::blue)) continue;
            if (first < 0) first = y;
            last = y;
        }
        return {first, last};
    }
    /// Compares every column with its own samples and the one before.
    void expectExtremes(const std::vector<float>& samples) {
        const auto image = drawn(samples);
        const auto area = plot.axisRect()->rect();
        ASSERT_EQ(area.width(), 400);
        const std::size_t perColumn = samples.size() / 400;
        for (int x = 1; x < 399; ++x) {
            const auto from = static_cast<std::size_t>(x) * perColumn;
            float low = samples[from - 1], high = low;
            for (std::size_t i = from; i < from + perColumn; ++i) {
                low = std::min(low, samples[i]);
                high = std::max(high, samples[i]);
            }
            // The lowest row belongs to the axis, so QCustomPlot clips it.
            const auto y = [&](float v) {
                return std::min(198.0, 200 - (static_cast<double>(v) + 4) / 8 * area.height());
            };
            const auto [first, last] = rows(image, x);
            ASSERT_NEAR(first, y(high), 1.01) << "column " << x;
            ASSERT_NEAR(last, y(low), 1.01) << "column " << x;
        }
    }
    QCustomPlot plot;
    gui::EnvelopeGraph* graph = new gui::EnvelopeGraph(plot.xAxis, plot.yAxis);
};

TEST_F(Envelopes, LinesShowTheExtremesOfTheirColumn) {
    Random random(5, "envelope lines");
    std::vector<float> samples;
    for (int i = 0; i < 40'000; ++i) {
        samples.push_back(static_cast<float>(std::sin(i * 2e-4) + 0.2 * (random.uniform() - 0.5)));
    }
    expectExtremes(samples);
}

TEST_F(Envelopes, AScreenFullOfNoiseShowsThemToo) {
    Random random(6, "envelope noise");
    std::vector<float> samples;
    for (int i = 0; i < 40'000; ++i) {
        const double size = 3.5 * std::abs(std::sin(i * 3e-4)) + 0.5;
        samples.push_back(static_cast<float>(size * 2 * (random.uniform() - 0.5)));
    }
    expectExtremes(samples);
}

TEST_F(Envelopes, AFlatLineIsOnePixelThickFromEndToEnd) {
    const auto image = drawn(std::vector<float>(8000, 1.0F));
    for (int x = 0; x < 399; ++x) {
        const auto [first, last] = rows(image, x);
        ASSERT_EQ(first, last) << "column " << x;
        ASSERT_NEAR(first, 75, 1) << "column " << x;
    }
}

TEST_F(Envelopes, MissingSamplesLeaveTheColumnsOpenAndHatched) {
    std::vector<float> samples(8000, 0.0F);
    for (std::size_t i = 4000; i < 6000; ++i) samples[i] = NAN;
    const auto image = drawn(samples);
    EXPECT_EQ(rows(image, 250).first, -1) << "nothing is drawn through a gap";
    EXPECT_EQ(graph->gapColumns(), 100);
    int hatched = 0;
    for (int x = 210; x < 290; ++x) hatched += image.pixelColor(x, 20) != QColor(Qt::white) ? 1 : 0;
    EXPECT_GT(hatched, 5);
    EXPECT_EQ(image.pixelColor(100, 20), QColor(Qt::white));
}

TEST_F(Envelopes, FewSamplesAreALineWithDotsAndAGapBreaksIt) {
    const auto image = drawn({0, 2, -2, NAN, 1, 1, 0, 0});
    EXPECT_TRUE(graph->drewSamples());
    EXPECT_EQ(graph->gapColumns(), 1);
    const auto dot = rows(image, 50);  // the second sample: a dot of three pixels on the corner of the line
    EXPECT_NEAR(dot.first, 49, 1.01);
    for (int x = 104; x < 196; ++x) ASSERT_EQ(rows(image, x).first, -1) << "open from " << 100 << " to " << 200;
}

TEST_F(Envelopes, NothingIsDrawnOutsideTheAxes) {
    plot.axisRect()->setMargins(QMargins(50, 40, 50, 40));
    Random random(8, "envelope outside");
    std::vector<float> samples;
    for (int i = 0; i < 40'000; ++i) samples.push_back(static_cast<float>(30 * random.normal()));
    for (const bool few : {false, true}) {
        if (few) samples.resize(60);
        const auto image = drawn(samples);
        for (int x = 0; x < 400; ++x) {
            for (int y = 0; y < 200; ++y) {
                if (image.pixelColor(x, y) != QColor(Qt::blue)) continue;
                ASSERT_TRUE(plot.axisRect()->rect().adjusted(-1, -1, 1, 1).contains(x, y)) << x << ", " << y;
            }
        }
    }
}

}  // namespace
}  // namespace tacto::test
