// Tests the small plot of the last capture: the numbers at its axes never overlap.
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

std::shared_ptr<const Capture> captureOf(double seconds, double level) {
    auto capture = std::make_shared<Capture>();
    capture->rate_hz = 1000 / seconds;
    capture->start_s = -0.1 * seconds;
    capture->trigger_s = 0;
    for (const auto* unit : {"V", "A"}) {
        CaptureChannel channel;
        channel.unit = unit;
        for (int i = 0; i < 1000; ++i) channel.samples.push_back(float(i < 500 ? level : -level));
        capture->channels.push_back(std::move(channel));
    }
    return capture;
}

/// Number of labels of the axis that overlap the next one, or are less than a space apart.
int touching(QCustomPlot& plot, QCPAxis& axis) {
    QVector<double> ticks;
    QVector<QString> labels;
    axis.ticker()->generate(axis.range(), plot.locale(), 'g', axis.numberPrecision(), ticks, nullptr, &labels);
    const QFontMetrics metrics(axis.tickLabelFont());
    const bool across = axis.orientation() == Qt::Horizontal;
    double end = -1e9;
    int found = 0;
    QList<QPair<double, QString>> shown;
    for (int i = 0; i < ticks.size(); ++i) {
        if (axis.range().contains(ticks[i])) shown.append({axis.coordToPixel(ticks[i]), labels[i]});
    }
    std::sort(shown.begin(), shown.end());
    for (const auto& [at, text] : shown) {
        const double half = (across ? metrics.horizontalAdvance(text) : metrics.ascent()) / 2.0;
        const double apart = across ? metrics.horizontalAdvance(' ') : 0;
        found += at - half < end + apart;
        end = at + half;
    }
    return found;
}

TEST(CaptureStrip, GrownItHasTheNumbersThatItHasRoomFor) {
    gui::CaptureStrip strip;
    strip.resize(120, 120);
    static_cast<QWidget&>(strip).show();
    strip.show(captureOf(1e-3, 40));
    letLive(20);
    strip.resize(400, 560);
    letLive(20);
    for (auto* axis : {strip.xAxis, strip.yAxis, strip.yAxis2}) {
        const auto labels = axis->tickVectorLabels();
        EXPECT_GE(labels.size(), 3) << axis->label().toStdString();
    }
}

TEST(CaptureStrip, VoltageAndCurrentOfOneShapeDoNotHideEachOther) {
    gui::CaptureStrip strip;
    strip.resize(600, 300);
    static_cast<QWidget&>(strip).show();
    strip.show(captureOf(1e-3, 40));
    strip.replot();
    ASSERT_EQ(strip.graphCount(), 2);
    const auto topOf = [&](int graph) {
        bool found = false;
        return strip.graph(graph)->valueAxis()->coordToPixel(strip.graph(graph)->getValueRange(found).upper);
    };
    EXPECT_GT(topOf(1), topOf(0) + 10) << "the current is drawn smaller";
}

TEST(CaptureStrip, TheNumbersAtItsAxesNeverTouch) {
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        gui::CaptureStrip strip;
        static_cast<QWidget&>(strip).show();
        for (const auto size : {QSize(220, 140), QSize(320, 180), QSize(480, 300), QSize(900, 400), QSize(1600, 700)}) {
            strip.resize(size);
            for (const double seconds : {97e-6, 500e-6, 1.7e-3, 40e-3, 2.3}) {
                for (const double level : {0.013, 7.7, 40.0, 320.0}) {
                    strip.show(captureOf(seconds, level));
                    strip.replot();
                    for (auto* axis : {strip.xAxis, strip.yAxis, strip.yAxis2})
                        EXPECT_EQ(touching(strip, *axis), 0)
                            << axis->label().toStdString() << " at " << percent << " %, " << size.width() << " x "
                            << size.height() << ", " << seconds << " s, " << level;
                }
            }
        }
    }
}

}  // namespace
}  // namespace tacto::test
