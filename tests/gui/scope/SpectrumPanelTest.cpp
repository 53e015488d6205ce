// Tests the spectrum of a trace: frequencies, levels and peaks of known sines.
#include <QCheckBox>
#include <QComboBox>
#include <QHeaderView>
#include <QTableWidget>
#include <gmock/gmock.h>

#include "app/gui/scope/measurements/SpectrumPanel.h"
#include "app/report/NumberText.h"
#include "core/base/Random.h"
#include "tests/gui/Person.h"
#include "tests/gui/PlotLooks.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// A trace of `n` samples with the values of(i).
gui::TracePtr traceOf(int n, double rate_hz, const std::function<double(int)>& of) {
    auto samples = std::make_shared<std::vector<float>>();
    for (int i = 0; i < n; ++i) samples->push_back(static_cast<float>(of(i)));
    return gui::makeTrace("channel/voltage", "Voltage", "V", samples, rate_hz, 0, 0);
}

TEST(SpectrumPanel, EachWindowReadsASineRightAndNamesItsPeaks) {
    // 1 kHz and 2.5 kHz, exactly on lines for 8192 samples, with some noise.
    constexpr double kRate = 81'920;
    Random random(3, "spectrum");
    const auto trace = traceOf(8192, kRate, [&](int i) {
        const double t = i / kRate;
        return 2 * std::sqrt(2.0) * std::sin(2 * M_PI * 1000 * t) +
               0.1 * std::sqrt(2.0) * std::sin(2 * M_PI * 2500 * t) + 1e-4 * random.normal();
    });
    gui::SpectrumPanel panel;
    panel.resize(900, 260);
    panel.QWidget::show();
    auto* window = find<QComboBox>(panel, "Window of the spectrum");
    ASSERT_EQ(window->count(), 4);
    const double bandwidths[] = {1.5, 3.77, 2.0, 1.0};
    for (int i = 0; i < 4; ++i) {
        window->setCurrentIndex(i);
        panel.show(trace, 0, 1, Qt::blue);
        const auto& s = panel.spectrum();
        ASSERT_GE(s.peaks.size(), 2U) << i;
        EXPECT_NEAR(s.peaks[0].hz, 1000, 1) << i;
        EXPECT_NEAR(s.peaks[0].rms, 2, 2e-3) << i;
        EXPECT_NEAR(s.peaks[1].hz, 2500, 1) << i;
        EXPECT_NEAR(s.peaks[1].rms, 0.1, 1e-3) << i;
        EXPECT_NEAR(s.bandwidth_hz, 10 * bandwidths[i], 0.1) << i;
    }
    window->setCurrentIndex(0);
    for (const bool log : {false, true}) {
        find<QCheckBox>(panel, "Log frequency")->setChecked(log);
        panel.show(trace, 0, 1, Qt::blue);
        QCoreApplication::processEvents();
        panel.findChild<QCustomPlot*>()->replot(QCustomPlot::rpImmediateRefresh);
        const auto named = panel.namedPeaks();
        ASSERT_GE(named.size(), 1);
        EXPECT_EQ(named.first(), "1.000\u202fkHz · 2.00\u202fV");
        shot(panel, log ? "spectrum-log" : "spectrum-linear");
    }
    QSettings settings(QDir::temp().filePath("tacto-spectrum.ini"), QSettings::IniFormat);
    window->setCurrentIndex(1);
    panel.save(settings);
    gui::SpectrumPanel next;
    next.restore(settings);
    EXPECT_EQ(next.window(), SpectralWindow::FlatTop);
    EXPECT_TRUE(next.logarithmic());
}

TEST(SpectrumPanel, NamesAtAnEdgeLieOnNoneOfTheOthersAndTheLineNamesTheHighestAsItsMarkDoes) {
    constexpr double kRate = 81'920;
    const auto trace = traceOf(8192, kRate, [](int i) {
        double sum = 0;
        for (int k = 1; k <= 12; ++k)
            sum += std::sqrt(2.0) / k * std::sin(2 * M_PI * (155 + 330 * (k - 1)) * i / kRate);
        return sum;
    });
    gui::SpectrumPanel panel;
    panel.QWidget::show();
    auto* log = find<QCheckBox>(panel, "Log frequency");
    for (const int width : {500, 640, 900, 1400}) {
        panel.resize(width, 220);
        for (const bool on : {false, true}) {
            log->setChecked(on);
            letLive(20);
            panel.show(trace, 0, 1, Qt::blue);
            panel.findChild<QCustomPlot*>()->replot(QCustomPlot::rpImmediateRefresh);
            letLive(20);
            EXPECT_GE(panel.namedPeaks().size(), 1);
            EXPECT_EQ(plotWordFaults(panel).join('\n').toStdString(), "") << width << (on ? ", log" : ", linear");
        }
    }
    const auto& s = panel.spectrum();
    ASSERT_FALSE(s.peaks.empty());
    const auto mark = panel.namedPeaks().first().split(QStringLiteral(" · "));
    EXPECT_THAT(s.note.toStdString(), HasSubstr("Highest " + mark[1].toStdString() + " at " + mark[0].toStdString()));
}

TEST(SpectrumPanel, ASmallSignalsAxisHasAPrefixAndItsPeakStandsThere) {
    const auto trace =
        traceOf(10'000, 100e3, [](int i) { return 0.02 * std::sqrt(2.0) * std::sin(2 * M_PI * 1000 * i / 100e3); });
    gui::SpectrumPanel panel;
    panel.resize(800, 250);
    panel.QWidget::show();
    panel.show(trace, 0, 0.1, Qt::blue);
    const auto* plot = panel.findChild<QCustomPlot*>();
    EXPECT_EQ(plot->yAxis->label(), "RMS (mV)");
    EXPECT_EQ(plot->xAxis->label(), "Frequency (kHz)");
    EXPECT_TRUE(plot->yAxis->range().contains(20)) << "20 mV";
    bool found = false;
    EXPECT_NEAR(plot->graph(0)->getValueRange(found).upper, 20, 0.1);
    EXPECT_TRUE(found);
}

TEST(SpectrumPanel, LevelsInDecibelsAndLinearStandOnTheirAxisAndInThePeakList) {
    Random random(5, "spectrum scales");
    gui::SpectrumPanel panel;
    panel.resize(1000, 260);
    panel.QWidget::show();
    auto* scales = find<QComboBox>(panel, "Levels of the spectrum");
    const auto* list = panel.findChild<QTableWidget*>();
    auto* plot = panel.findChild<QCustomPlot*>();
    for (int i = 0; i < 12; ++i) {
        // Two sines on lines of 4096 samples, with RMS levels over six decades.
        constexpr double kRate = 40'960;
        const double large = std::pow(10, 6 * random.uniform() - 4), small = 0.3 * large;
        const double first = 10 * (50 + double(random.below(500))), second = 10 * (800 + double(random.below(500)));
        const auto trace = traceOf(4096, kRate, [&](int at) {
            const double t = at / kRate;
            return std::sqrt(2.0) * (large * std::sin(2 * M_PI * first * t) + small * std::sin(2 * M_PI * second * t));
        });
        for (int scale = 0; scale < 3; ++scale) {
            scales->setCurrentIndex(scale);
            panel.show(trace, 0, 1, Qt::blue);
            plot->replot(QCustomPlot::rpImmediateRefresh);
            bool found = false;
            const double top = plot->graph(0)->getValueRange(found).upper;
            const auto label = plot->yAxis->label();
            const double expected = label == "RMS (dB re 1 V)" ? 20 * std::log10(large)
                                    : label == "RMS (mV)"      ? 1e3 * large
                                    : label == "RMS (µV)"      ? 1e6 * large
                                                               : large;
            EXPECT_NEAR(top, expected, 2e-3 * std::abs(expected) + 0.01) << label.toStdString();
            EXPECT_TRUE(plot->yAxis->range().contains(top));
            EXPECT_EQ(label.contains("dB"), scale == 1);
            EXPECT_EQ(plot->yAxis->scaleType(), scale == 0 ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
        }
        ASSERT_GE(list->rowCount(), 2);
        EXPECT_EQ(list->item(0, 0)->text(), quantityText(first, "Hz"));
        EXPECT_EQ(list->item(0, 1)->text(), quantityText(large, "V", 3));
        EXPECT_NEAR(list->item(0, 2)->text().replace("−", "-").toDouble(), 20 * std::log10(large), 0.06);
        EXPECT_EQ(list->item(1, 0)->text(), quantityText(second, "Hz"));
    }
    EXPECT_EQ(list->horizontalHeaderItem(2)->text(), "dB re 1 V");
    for (int column = 0; column < 3; ++column)
        EXPECT_GE(list->columnWidth(column), list->horizontalHeader()->sectionSizeHint(column)) << "nothing is cut";
    scales->setCurrentIndex(1);
    letLive(20);
    shot(panel, "spectrum-dB");
    scales->setCurrentIndex(2);
    find<QCheckBox>(panel, "Peak list")->setChecked(false);
    QSettings settings(QDir::temp().filePath("tacto-spectrum-scales.ini"), QSettings::IniFormat);
    panel.save(settings);
    gui::SpectrumPanel next;
    next.restore(settings);
    EXPECT_EQ(next.levelScale(), gui::LevelScale::Linear);
    EXPECT_TRUE(next.findChild<QTableWidget*>()->isHidden());
}

TEST(SpectrumPanel, ASignalOfNothingHasNoLevelAndNoPeak) {
    gui::SpectrumPanel panel;
    panel.QWidget::show();
    auto* scales = find<QComboBox>(panel, "Levels of the spectrum");
    for (int scale = 0; scale < 3; ++scale) {
        scales->setCurrentIndex(scale);
        panel.show(traceOf(4096, 1e5, [](int) { return 0; }), 0, 1, Qt::blue);
        panel.findChild<QCustomPlot*>()->replot(QCustomPlot::rpImmediateRefresh);
        EXPECT_EQ(panel.findChild<QTableWidget*>()->rowCount(), 0);
    }
}

TEST(SpectrumPanel, SaysThatSamplesAreMissing) {
    gui::SpectrumPanel panel;
    panel.show(traceOf(10'000, 100e3, [](int i) { return i == 5000 ? NAN : 1; }), 0, 0.1, Qt::blue);
    EXPECT_TRUE(panel.spectrum().rms.empty());
    EXPECT_THAT(panel.spectrum().note.toStdString(), HasSubstr("missing"));
}

}  // namespace
}  // namespace tacto::test
