// What the oscilloscope is made of, by itself: scales, calculations, statistics, spectrum, quantities, files.
#include <QCheckBox>
#include <QComboBox>
#include <QFile>
#include <QImage>
#include <QSettings>
#include <QTableWidget>
#include <QTemporaryDir>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/scope/Graticule.h"
#include "app/gui/scope/MaskPanel.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/QuantitySpin.h"
#include "app/gui/scope/ScopeExport.h"
#include "app/gui/scope/ScopePicture.h"
#include "app/gui/scope/SpectrumPanel.h"
#include "app/gui/scope/Steps.h"
#include "app/gui/scope/TraceMath.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/report/NumberText.h"
#include "core/base/Random.h"
#include "core/formats/csv/CsvFormat.h"
#include "core/measure/CaptureFile.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

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

TEST(MeasurementTable, ShowsWhatCoreMeasures) {
    const auto shown = prepared(twoPulses());
    gui::ChosenReadings chosen;
    for (const auto reading : gui::allReadings()) chosen.choose(reading, true);
    gui::MeasurementTable table(chosen);
    table.resize(1000, 420);
    table.show();
    table.add(shown);
    const auto& volts = table.statistics().channels()[0];
    const auto& truth = shown->measurement[0];
    const auto same = [&](gui::Reading reading, const Statistics& expected) {
        const auto& its = volts.of(reading);
        EXPECT_EQ(its.n(), expected.n);
        EXPECT_NEAR(its.mean(), expected.mean, 1e-12 + 1e-9 * std::abs(expected.mean));
        EXPECT_NEAR(its.min(), expected.min, 1e-12);
        EXPECT_NEAR(its.max(), expected.max, 1e-12);
        if (expected.n > 1) {
            EXPECT_NEAR(its.sd(), expected.sd, 1e-9 + 1e-6 * expected.sd);
        }
    };
    same(gui::Reading::Amplitude, truth.amplitude);
    same(gui::Reading::Width, truth.width_s);
    same(gui::Reading::Interval, truth.interval_s);
    same(gui::Reading::Rise, truth.rise_s);
    same(gui::Reading::Fall, truth.fall_s);
    same(gui::Reading::Overshoot, truth.overshoot);
    same(gui::Reading::Droop, truth.droop);
    same(gui::Reading::Charge, truth.charge);
    same(gui::Reading::Gap, truth.gap_s);
    same(gui::Reading::Imbalance, truth.imbalance);
    EXPECT_EQ(volts.of(gui::Reading::Pulses).last(), 2);
    EXPECT_EQ(volts.of(gui::Reading::Interval).n(), 1U);
    const auto one = [&](gui::Reading reading, double expected) {
        EXPECT_EQ(volts.of(reading).n(), 1U);
        EXPECT_EQ(volts.of(reading).last(), expected);
    };
    one(gui::Reading::PeakToPeak, shown->waveforms[0].peakToPeak);
    one(gui::Reading::Rms, shown->waveforms[0].rms);
    one(gui::Reading::Mean, shown->waveforms[0].mean);
    one(gui::Reading::Frequency, shown->waveforms[0].frequency_hz);
    one(gui::Reading::Duty, shown->waveforms[0].duty);
    EXPECT_NEAR(volts.of(gui::Reading::SecondAmplitude).mean(), 40, 0.1);
    EXPECT_NEAR(volts.of(gui::Reading::SecondWidth).mean(), 200e-6, 1e-6);

    // A row for each reading; for each channel the last value, mean, deviation, extremes and n.
    const auto* cells = table.findChild<QTableWidget*>("measurements");
    ASSERT_EQ(cells->rowCount(), int(gui::kReadings));
    ASSERT_EQ(cells->columnCount(), 1 + 2 * 6);
    EXPECT_EQ(cells->horizontalHeaderItem(1)->text(), "Voltage");
    EXPECT_EQ(cells->horizontalHeaderItem(7)->text(), "Current");
    EXPECT_EQ(cells->item(0, 0)->text(), "Amplitude");
    EXPECT_EQ(cells->item(0, 1)->text(), quantityText(truth.amplitude.mean, "V"));
    EXPECT_EQ(cells->item(0, 7)->text(), quantityText(shown->measurement[1].amplitude.mean, "A"));
    const int interval = static_cast<int>(gui::Reading::Interval), charge = static_cast<int>(gui::Reading::Charge);
    EXPECT_EQ(cells->item(interval, 3)->text(), "–") << "one interval has no deviation";
    EXPECT_EQ(cells->item(charge, 1)->text(), "–") << "a voltage has no charge";
    EXPECT_THAT(cells->item(charge, 1)->toolTip().toStdString(), HasSubstr("current"));
    EXPECT_TRUE(cells->item(charge, 7)->text().endsWith("µC"));
    shot(table, "table");

    auto tired = std::make_shared<gui::ShownCapture>(*prepared(twoPulses(100, 20)));
    tired->warnings = {"channel 'voltage' is tired"};
    tired->follows = false;
    table.add(tired);
    EXPECT_EQ(table.statistics().captures(), 2U);
    EXPECT_EQ(volts.of(gui::Reading::Interval).n(), 2U) << "each capture's own";
    EXPECT_EQ(volts.of(gui::Reading::Amplitude).n(), 4U);
    EXPECT_NEAR(volts.of(gui::Reading::Amplitude).last(), 20, 0.1);
    EXPECT_NEAR(volts.of(gui::Reading::Amplitude).mean(), 30, 0.1);
    EXPECT_NE(find<QLabel>(table, "Channel 'voltage' is tired."), nullptr);
    click(*find<QPushButton>(table, "Reset statistics"));
    EXPECT_EQ(table.statistics().captures(), 0U);
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

TEST(Reading, NetChargeAndEnergyAreTheCurrentsWhereOneVoltageGoesWithIt) {
    const auto shown = prepared(twoPulses());
    const auto energy = readingsOf(gui::Reading::Energy, *shown, 1);
    ASSERT_EQ(energy.size(), 2U);
    for (const double joules : energy) EXPECT_NEAR(joules, 2 * 40 * 40e-3 * 200e-6, 10e-6);
    const auto net = readingsOf(gui::Reading::NetCharge, *shown, 1);
    ASSERT_EQ(net.size(), 2U);
    for (const double coulombs : net) EXPECT_NEAR(coulombs, 0, 0.01 * 8e-6);
    EXPECT_EQ(readingText(gui::Reading::Energy, 640e-6, "A"), "640.0\u202fµJ");
    EXPECT_TRUE(readingsOf(gui::Reading::Energy, *shown, 0).empty());
    EXPECT_EQ(whyMissing(gui::Reading::Energy, *shown, 0), "Energy is shown on the current channel.");
    auto three = twoPulses();
    three.channels.push_back(three.channels.front());
    three.channels.back().name = "voltage 2";
    const auto unclear = prepared(std::move(three));
    EXPECT_TRUE(readingsOf(gui::Reading::Energy, *unclear, 1).empty());
    EXPECT_TRUE(whyMissing(gui::Reading::Energy, *unclear, 1).contains("one channel in V and one in A"));
}

TEST(CaptureStatistics, IntervalsRunFromCaptureToCaptureWhereNoneWasLeftOut) {
    gui::CaptureStatistics statistics;
    const auto onePulse = [](double at_s, bool follows = true) {
        std::vector<SyntheticPhase> phases;
        append(phases, biphasic(at_s));
        SyntheticRecord record;
        record.start_s = at_s - 1e-3;
        auto capture = recordOf(phases, record);
        capture.trigger_s = at_s;
        auto shown = std::make_shared<gui::ShownCapture>(*prepared(std::move(capture)));
        shown->follows = follows;
        return shown;
    };
    const auto interval = [&] { return statistics.channels()[0].of(gui::Reading::Interval); };
    statistics.add(*onePulse(10));
    EXPECT_EQ(interval().n(), 0U);
    statistics.add(*onePulse(10.5));
    EXPECT_EQ(interval().n(), 1U);
    EXPECT_NEAR(interval().last(), 0.5, 1e-7);
    statistics.add(*onePulse(11.1));
    EXPECT_NEAR(interval().mean(), 0.55, 1e-7);
    EXPECT_NEAR(interval().max(), 0.6, 1e-7);
    statistics.add(*onePulse(13, false));
    EXPECT_EQ(interval().n(), 2U) << "one was left out: nothing is known of what lay between";
    EXPECT_TRUE(std::isnan(interval().last()));
    statistics.breakOff();
    statistics.add(*onePulse(14));
    EXPECT_EQ(interval().n(), 2U);
    auto clipped = std::make_shared<gui::ShownCapture>(*onePulse(15));
    clipped->measurement[0].pulses[0].flags.clipped = true;
    clipped->measurement[0].trains.clear();
    statistics.add(*clipped);
    statistics.add(*onePulse(16));
    EXPECT_EQ(interval().n(), 2U) << "a train that was seen and not measured lay between";
}

TEST(ChosenReadings, AreAddedRemovedAndRemembered) {
    gui::ChosenReadings chosen;
    QSignalSpy changed(&chosen, &gui::ChosenReadings::changed);
    EXPECT_TRUE(chosen.has(gui::Reading::Amplitude));
    EXPECT_FALSE(chosen.has(gui::Reading::Rms));
    chosen.choose(gui::Reading::Rms, true);
    chosen.choose(gui::Reading::Amplitude, false);
    chosen.choose(gui::Reading::Amplitude, false);
    EXPECT_EQ(changed.count(), 2);
    QSettings settings(QDir::temp().filePath("tacto-readings.ini"), QSettings::IniFormat);
    settings.clear();
    chosen.save(settings);
    gui::ChosenReadings next;
    next.restore(settings);
    EXPECT_EQ(next.all(), chosen.all());
    settings.setValue("readings", QStringList{"nonsense", "", "duty", "duty"});
    next.restore(settings);
    EXPECT_THAT(next.all(), ElementsAre(gui::Reading::Duty));
    settings.setValue("readings", "nonsense");
    next.restore(settings);
    EXPECT_THAT(next.all(), ElementsAre(gui::Reading::Duty)) << "nothing was chosen there";
    std::set<QString> keys;
    for (const auto reading : gui::allReadings()) {
        keys.insert(gui::nameOf(reading).key);
        EXPECT_EQ(gui::readingOfKey(gui::nameOf(reading).key), reading);
    }
    EXPECT_EQ(keys.size(), gui::kReadings);
}

/// Over nine decades of spans, wherever they begin and whatever is least.
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

TEST(Steps, AScaleBetweenTwoStepsGoesToTheNextEitherWay) {
    EXPECT_DOUBLE_EQ(gui::stepAlong(150e-6, 1), 200e-6);
    EXPECT_DOUBLE_EQ(gui::stepAlong(150e-6, -1), 100e-6);
    EXPECT_DOUBLE_EQ(gui::stepAlong(200e-6, 1), 500e-6);
}

TEST(SpectrumPanel, EachWindowReadsASineRightAndNamesItsPeaks) {
    auto samples = std::make_shared<std::vector<float>>();
    // 1 kHz and 2.5 kHz on lines of 8192 samples, some noise.
    constexpr double kRate = 81'920;
    Random random(3, "spectrum");
    for (int i = 0; i < 8192; ++i) {
        const double t = i / kRate;
        samples->push_back(static_cast<float>(2 * std::sqrt(2.0) * std::sin(2 * M_PI * 1000 * t) +
                                              0.1 * std::sqrt(2.0) * std::sin(2 * M_PI * 2500 * t) +
                                              1e-4 * random.normal()));
    }
    const auto trace = gui::makeTrace("channel/voltage", "Voltage", "V", samples, kRate, 0, 0);
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

TEST(SpectrumPanel, ASineStandsAtItsFrequencyWithItsRms) {
    auto samples = std::make_shared<std::vector<float>>();
    for (int i = 0; i < 10'000; ++i) {
        samples->push_back(static_cast<float>(3 + 2 * std::sqrt(2.0) * std::sin(2 * M_PI * 1000 * i / 100e3)));
    }
    const auto trace = gui::makeTrace("channel/voltage", "Voltage", "V", samples, 100e3, 5, 5);
    gui::SpectrumPanel panel;
    panel.resize(800, 250);
    panel.QWidget::show();
    panel.show(trace, 5, 5.1, Qt::blue);
    const auto& s = panel.spectrum();
    EXPECT_EQ(s.samples, 8192U);
    const auto top = static_cast<std::size_t>(std::max_element(s.rms.begin(), s.rms.end()) - s.rms.begin());
    EXPECT_NEAR(s.hz[top], 1000, 100e3 / 8192);
    EXPECT_NEAR(s.rms[top], 2, 0.3) << "scalloping of a Hann window is at most 15 %";
    QCoreApplication::processEvents();
    shot(panel, "spectrum");
    auto holed = std::make_shared<std::vector<float>>(*samples);
    (*holed)[5000] = NAN;
    panel.show(gui::makeTrace("channel/voltage", "Voltage", "V", holed, 100e3, 5, 5), 5, 5.1, Qt::blue);
    EXPECT_TRUE(panel.spectrum().rms.empty());
    EXPECT_THAT(panel.spectrum().note.toStdString(), HasSubstr("missing"));
}

class Exports : public testing::Test {
protected:
    Exports() {
        screen.resize(900, 500);
        screen.QWidget::show();
        gui::MathOptions math;
        math.power = true;
        model.show(prepared(twoPulses(), math));
    }
    QByteArray bytes(const QString& path) {
        QFile file(path);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
    QTemporaryDir folder;
    gui::ScopeModel model;
    gui::ScopeScreen screen{model};
};

TEST_F(Exports, PicturesOfEveryKind) {
    const auto png = folder.filePath("a.png"), svg = folder.filePath("a.svg"), pdf = folder.filePath("a.pdf");
    for (const auto& path : {png, svg, pdf}) ASSERT_EQ(gui::savePicture(screen, path), std::nullopt);
    EXPECT_EQ(QImage(png).size(), screen.size() * 2);
    const auto drawing = QString::fromUtf8(bytes(svg));
    EXPECT_TRUE(drawing.startsWith("<?xml"));
    EXPECT_TRUE(drawing.contains("Voltage (V)"));
    EXPECT_FALSE(drawing.contains("<image")) << "a drawing, not a picture";
    EXPECT_TRUE(bytes(pdf).startsWith("%PDF"));
    if (const auto shots = qEnvironmentVariable("TACTO_SHOTS"); !shots.isEmpty()) {
        for (const auto& path : {png, svg, pdf}) {
            QFile::remove(shots + "/export." + QFileInfo(path).suffix());
            QFile::copy(path, shots + "/export." + QFileInfo(path).suffix());
        }
    }
}

TEST_F(Exports, APictureSaysWhatItShows) {
    auto averaged = std::make_shared<gui::ShownCapture>(*model.shown());
    averaged->averaged = 16;
    model.show(averaged);
    gui::ScopeCaption caption{"Oscilloscope · simulated", "2026-11-23 19:00:00", {}};
    caption.lines << "simulated oscilloscope SIM-1" << gui::scalesText(model) << QString() << "V:  Amplitude 40.0 V";
    const auto path = folder.filePath("said.svg");
    ASSERT_EQ(gui::saveScopePicture(model, screen, caption, path), std::nullopt);
    const auto drawing = QString::fromUtf8(bytes(path));
    for (const auto* text :
         {"Oscilloscope · simulated", "2026-11-23 19:00:00", "simulated oscilloscope SIM-1", "V/div", "1\u202fms/div",
          "20000 samples at 2\u202fMHz", "averaged 16", "Amplitude 40.0 V", "SIMULATED", "Voltage (V)"}) {
        EXPECT_TRUE(drawing.contains(text)) << text;
    }
    const auto picture = gui::scopePicture(model, screen, caption);
    EXPECT_EQ(picture.width(), 2 * screen.width());
    EXPECT_GT(picture.height(), 2 * screen.height() + 100) << "the caption takes nothing from the plot";
    if (const auto shots = qEnvironmentVariable("TACTO_SHOTS"); !shots.isEmpty())
        picture.save(shots + "/captioned.png");
}

TEST_F(Exports, AFileThatCannotBeWrittenIsToldAndAnOldOneStays) {
    const auto wrong = gui::savePicture(screen, folder.filePath("missing/a.png"));
    ASSERT_TRUE(wrong);
    EXPECT_THAT(wrong->toStdString(), HasSubstr("was not saved"));
    EXPECT_THAT(gui::savePicture(screen, folder.filePath("a.bmp"))->toStdString(), HasSubstr(".png, .svg or .pdf"));
    const auto csv = gui::saveData(*model.shown(), 0, 1e9, folder.filePath("missing/a.csv"));
    ASSERT_TRUE(csv);
    EXPECT_THAT(csv->toStdString(), HasSubstr("as it was"));
}

TEST_F(Exports, TheVisibleDataReadBackAsACapture) {
    const auto path = folder.filePath("part.csv");
    QFile other(path + ".part");
    ASSERT_TRUE(other.open(QIODevice::WriteOnly) && other.write("somebody's work") > 0);
    other.close();
    const double zero = model.shown()->zero_s;
    ASSERT_EQ(gui::saveData(*model.shown(), zero - 0.5e-3, zero + 1.5e-3, path), std::nullopt);
    const auto read = readCapture(path.toStdString());
    ASSERT_TRUE(read) << read.error().message;
    const auto& capture = read->capture;
    EXPECT_EQ(capture.samples(), 4000U);
    EXPECT_NEAR(capture.rate_hz, 2e6, 1);
    EXPECT_NEAR(capture.start_s, zero - 0.5e-3, 1e-6);
    ASSERT_EQ(capture.channels.size(), 3U);
    EXPECT_EQ(capture.channels[0].name, "voltage");
    EXPECT_EQ(capture.channels[1].unit, "A");
    EXPECT_EQ(capture.channels[2].name, "power_w");
    for (std::size_t i = 0; i < 4000; i += 13) {
        EXPECT_EQ(capture.channels[0].samples[i], model.shown()->capture->channels[0].samples[1000 + i]);
    }
    EXPECT_EQ(QFileInfo(path + ".part").size(), 15) << "of another name, and not ours";
    EXPECT_EQ(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 2);
    EXPECT_TRUE(gui::saveData(*model.shown(), 0, 1, path)) << "nothing on the screen is not saved";
}

}  // namespace
}  // namespace tacto::test
