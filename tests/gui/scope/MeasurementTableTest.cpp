// Tests the oscilloscope's readings of its captures: the chosen readings, their statistics, and their table.
#include <QMenu>
#include <QScrollBar>
#include <QSettings>
#include <QTableWidget>
#include <gmock/gmock.h>

#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/report/NumberText.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MeasurementTable : public testing::Test {
protected:
    MeasurementTable() {
        table.resize(1000, 420);
        table.show();
    }
    gui::ChosenReadings chosen;
    gui::MeasurementTable table{chosen};
    const QTableWidget* cells = table.findChild<QTableWidget*>("measurements");
};

TEST_F(MeasurementTable, ShowsWhatCoreMeasures) {
    const auto shown = prepared(twoPulses());
    for (const auto reading : gui::allReadings()) chosen.choose(reading, true);
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
    EXPECT_EQ(volts.of(gui::Reading::Charge).n(), 0U) << "a voltage has no charge";
    EXPECT_EQ(table.statistics().channels()[1].of(gui::Reading::Charge).n(), shown->measurement[1].charge.n);
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

    // One row per reading; for each channel the last value, mean, deviation, extremes and n.
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

/// A capture with a voltage only, with edges of 200 ns and samples 500 ns apart.
Capture steepVoltage(double start_s = 99.999, double edge_s = 200e-9) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(start_s + 1e-3, 40, 200e-6, 100e-6, edge_s));
    SyntheticRecord record;
    record.start_s = start_s;
    auto capture = recordOf(phases, record);
    capture.trigger_s = start_s + 1e-3;
    return capture;
}

TEST_F(MeasurementTable, AnEdgeThatTheSamplesDoNotResolveIsAnUpperBoundAndNotCounted) {
    table.add(prepared(steepVoltage()));
    const auto& rise = table.statistics().channels()[0].of(gui::Reading::Rise);
    EXPECT_EQ(rise.n(), 0U);
    int row = 0;
    while (cells->item(row, 0)->text() != "Rise") ++row;
    EXPECT_EQ(cells->item(row, 1)->text(), "≤\u202f1\u202fµs");
    EXPECT_THAT(cells->item(row, 1)->toolTip().toStdString(), HasSubstr("samples are 500\u202fns apart"));
    EXPECT_EQ(cells->item(row, 2)->text(), "–") << "no mean of it";
    EXPECT_EQ(cells->item(row, 6)->text(), "0");
    EXPECT_THAT(table.asLines().first().toStdString(), HasSubstr("Rise ≤\u202f1\u202fµs"));
    table.add(prepared(steepVoltage(100.2, 2e-6)));
    EXPECT_EQ(rise.n(), 1U) << "this one is resolved";
    EXPECT_TRUE(cells->item(row, 1)->text().startsWith("1.59") || cells->item(row, 1)->text().startsWith("1.60"))
        << qPrintable(cells->item(row, 1)->text());
    EXPECT_TRUE(cells->item(row, 1)->toolTip().isEmpty());
}

TEST_F(MeasurementTable, NeverScrollsSidewaysAndSaysInATipWhatHasNoRoom) {
    table.add(prepared(twoPulses()));
    const auto tip = [&] { return cells->item(0, 1)->toolTip().toStdString(); };
    for (const int width : {1400, 800, 560, 400}) {
        table.resize(width, 320);
        const bool all = width == 1400;
        EXPECT_IN_TIME(comesTrue([&] { return cells->isColumnHidden(6) != all; })) << "n goes first, at " << width;
        EXPECT_IN_TIME(comesTrue([&] { return cells->horizontalScrollBar()->maximum() == 0; })) << width;
        EXPECT_FALSE(cells->isColumnHidden(1) || cells->isColumnHidden(7)) << "the values themselves";
        EXPECT_EQ(tip().find("n 2") == std::string::npos, all) << width << ": " << tip();
        EXPECT_EQ(cells->isColumnHidden(5), cells->isColumnHidden(4)) << "no least without a largest";
    }
    EXPECT_THAT(tip(), AllOf(HasSubstr("mean 40."), HasSubstr("s.d. "), HasSubstr("min "), HasSubstr("max ")));
    shot(table, "table-narrow");
}

TEST_F(MeasurementTable, SaysWhatTheScreenHoldsWhenNoTriggerComes) {
    table.add(prepared(twoPulses()));
    table.passOverUntriggered(true);
    EXPECT_NE(find<QLabel>(table, "Over 1 capture · no trigger since: the last train is held on the screen"), nullptr);
    table.passOverUntriggered(false);
    EXPECT_NE(find<QLabel>(table, "Over 1 capture · the record shown now is untriggered and not counted"), nullptr);
}

TEST(CaptureStatistics, BeginAnewWithAnotherDriveAndSaySinceWhen) {
    gui::CaptureStatistics statistics;
    const auto add = [&](std::optional<gui::AskedDrive> asked, double programmed, int minute) {
        auto capture = twoPulses();
        capture.programmed = programmed;
        auto shown = std::make_shared<gui::ShownCapture>(*prepared(std::move(capture)));
        shown->asked = asked;
        shown->taken = QDateTime(QDate(2026, 11, 26), QTime(16, minute));
        statistics.add(*shown);
        return statistics.captures();
    };
    const gui::AskedDrive loud{true, 40, 1.25}, soft{true, 25, 1.25}, slow{true, 25, 2.5}, touch{false, 25, 2.5};
    EXPECT_EQ(add(std::nullopt, kNaN, 1), 1U) << "a check pulse, perhaps";
    EXPECT_EQ(add(loud, 40, 2), 1U);
    EXPECT_EQ(add(loud, 40.1, 3), 2U) << "a current follows the impedance a little";
    EXPECT_EQ(add(std::nullopt, 40, 4), 3U) << "the last train of a drive that is off";
    EXPECT_EQ(statistics.sinceText(), "since 16:02:00");
    EXPECT_EQ(add(soft, 40, 5), 1U) << "another amplitude";
    EXPECT_EQ(add(soft, 25, 6), 1U) << "the train before was programmed for the old one";
    EXPECT_EQ(add(slow, 25, 7), 1U) << "another interval";
    EXPECT_EQ(add(slow, 25, 8), 2U);
    EXPECT_EQ(add(touch, 25, 9), 1U) << "the fingertip took over";
    EXPECT_EQ(statistics.sinceText(), "since 16:09:00");
    EXPECT_EQ(add({{false, 33, 1}}, 33, 10), 2U) << "what follows the touch is one drive";
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

TEST(ChosenReadings, TheListStaysOpenUntilItsLastRowClosesIt) {
    RecordProperty("hazard", "H2");  // if Esc were needed to leave the list, it would stop the output
    gui::ChosenReadings chosen;
    QWidget window;
    window.show();
    QTest::mouseMove(&window, {0, 0});  // Qt 6.8 ignores the first move of the mouse
    auto* menu = makeReadingsMenu(chosen, &window);
    menu->popup(window.mapToGlobal(QPoint(0, 0)));
    const auto place = [&](QAction* action) { return menu->actionGeometry(action).center(); };
    QTest::mouseClick(menu, Qt::LeftButton, {}, place(menu->actions().first()));
    EXPECT_TRUE(menu->isVisible());
    EXPECT_FALSE(chosen.has(gui::Reading::Amplitude));
    auto* close = menu->actions().last();
    EXPECT_EQ(close->text(), "Close");
    QTest::mouseClick(menu, Qt::LeftButton, {}, place(close));
    EXPECT_FALSE(menu->isVisible());
    menu->popup(window.mapToGlobal(QPoint(0, 0)));
    menu->setActiveAction(close);
    QTest::keyClick(menu, Qt::Key_Return);
    EXPECT_FALSE(menu->isVisible());
}

}  // namespace
}  // namespace tacto::test
