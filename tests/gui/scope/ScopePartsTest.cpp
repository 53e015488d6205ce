// What the oscilloscope is made of, by itself: scales, calculations, statistics, spectrum, quantities, files.
#include <QFile>
#include <QImage>
#include <QTableWidget>
#include <QTemporaryDir>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/look/PlotPicture.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/QuantitySpin.h"
#include "app/gui/scope/ScopeExport.h"
#include "app/gui/scope/SpectrumPanel.h"
#include "app/gui/scope/Steps.h"
#include "app/gui/scope/TraceMath.h"
#include "app/report/NumberText.h"
#include "core/formats/CsvFormat.h"
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
    const auto capture = twoPulses();
    const auto measured = measureCapture(capture);
    gui::MeasurementTable table;
    table.resize(1000, 320);
    table.show();
    table.add(measured.channels, measured.warnings);
    const auto& volts = table.statistics().channels()[0];
    const auto& truth = measured.channels[0];
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

    const auto* cells = table.findChild<QTableWidget*>("measurements");
    EXPECT_EQ(cells->item(0, 2)->text(), quantityText(truth.amplitude.mean, "V"));
    EXPECT_EQ(cells->item(2, 4)->text(), "–") << "one interval has no deviation";
    shot(table, "table");

    table.add(measureCapture(twoPulses(100, 20)).channels, {"channel 'voltage' is tired"});
    EXPECT_EQ(table.statistics().captures(), 2U);
    EXPECT_EQ(volts.of(gui::Reading::Amplitude).n(), 4U);
    EXPECT_NEAR(volts.of(gui::Reading::Amplitude).last(), 20, 0.1);
    EXPECT_NEAR(volts.of(gui::Reading::Amplitude).mean(), 30, 0.1);
    EXPECT_NE(find<QLabel>(table, "Channel 'voltage' is tired."), nullptr);
    click(*find<QPushButton>(table, "Reset statistics"));
    EXPECT_EQ(table.statistics().captures(), 0U);
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
        view.resize(900, 500);
        view.QWidget::show();
        gui::MathOptions wish;
        wish.power = true;
        view.show(prepared(twoPulses(), wish));
    }
    QByteArray bytes(const QString& path) {
        QFile file(path);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
    QTemporaryDir folder;
    gui::ScopeView view;
};

TEST_F(Exports, PicturesOfEveryKind) {
    const auto png = folder.filePath("a.png"), svg = folder.filePath("a.svg"), pdf = folder.filePath("a.pdf");
    for (const auto& path : {png, svg, pdf}) ASSERT_EQ(gui::savePicture(view, path), std::nullopt);
    EXPECT_EQ(QImage(png).size(), view.size() * 2);
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

TEST_F(Exports, AFileThatCannotBeWrittenIsToldAndAnOldOneStays) {
    const auto wrong = gui::savePicture(view, folder.filePath("missing/a.png"));
    ASSERT_TRUE(wrong);
    EXPECT_THAT(wrong->toStdString(), HasSubstr("was not saved"));
    EXPECT_THAT(gui::savePicture(view, folder.filePath("a.bmp"))->toStdString(), HasSubstr(".png, .svg or .pdf"));
    const auto csv = gui::saveData(*view.shown(), 0, 1e9, folder.filePath("missing/a.csv"));
    ASSERT_TRUE(csv);
    EXPECT_THAT(csv->toStdString(), HasSubstr("as it was"));
}

TEST_F(Exports, TheVisibleDataReadBackAsACapture) {
    const auto path = folder.filePath("part.csv");
    QFile other(path + ".part");
    ASSERT_TRUE(other.open(QIODevice::WriteOnly) && other.write("somebody's work") > 0);
    other.close();
    const double zero = view.shown()->zero_s;
    ASSERT_EQ(gui::saveData(*view.shown(), zero - 0.5e-3, zero + 1.5e-3, path), std::nullopt);
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
        EXPECT_EQ(capture.channels[0].samples[i], view.shown()->capture->channels[0].samples[1000 + i]);
    }
    EXPECT_EQ(QFileInfo(path + ".part").size(), 15) << "of another name, and not ours";
    EXPECT_EQ(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 2);
    EXPECT_TRUE(gui::saveData(*view.shown(), 0, 1, path)) << "nothing on the screen is not saved";
}

}  // namespace
}  // namespace tacto::test
