// Tests the oscilloscope as a person uses it: with the simulated bench, with files, by keys and mouse.
#include <QClipboard>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSplitter>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/theme/Theme.h"
#include "core/formats/csv/CsvFormat.h"
#include "core/measure/CaptureFile.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::Activity;
using gui::BenchController;
using gui::ScopeMode;
using gui::ScopeWorkspace;
using testing::HasSubstr;

TEST_F(Scope, AnEmptyOneSaysWhatItIsForAndOffersTheNextStep) {
    auto* next = find<QPushButton>(scope, "Open the simulated bench");
    ASSERT_NE(next, nullptr);
    QSignalSpy wanted(&scope, &ScopeWorkspace::openBenchWanted);
    click(*next);
    EXPECT_EQ(wanted.count(), 1);
    EXPECT_NE(find<QPushButton>(scope, "Open a capture…"), nullptr);
    shot(scope, "workspace-empty");
}

TEST_F(Scope, WaitsForATriggerAndSaysSoThenShowsWhatIsDelivered) {
    openBench();
    ASSERT_IN_TIME(comes([&] { return scope.running(); }));
    ASSERT_IN_TIME(comes([&] { return QString::fromStdString(status()).startsWith("Waiting for a trigger at"); }));
    EXPECT_THAT(status(), HasSubstr("Output is disarmed."));
    shot(scope, "workspace-waiting");
    deliver();
    ASSERT_IN_TIME(comes([&] { return triggered(); }));
    EXPECT_TRUE(scope.model().shown()->capture->simulated);
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() >= 3; }));
    // In Auto the level is a fifth of the commanded amplitude.
    const double commanded = controller.telemetry().amplitude_v;
    EXPECT_IN_TIME(comes([&] {
        const double level = scope.settings().triggerLevel;
        return level > 0.2 * commanded / 1.4 && level < 0.2 * commanded * 1.4;
    })) << scope.settings().triggerLevel
        << " of " << commanded;
    shot(scope, "workspace-live");
    EXPECT_TRUE(complaints.isEmpty()) << complaints.first().toStdString();
}

TEST_F(Scope, SingleTakesOneAndHoldKeepsThePicture) {
    showATrain();
    QTest::keyClick(&scope.screen(), Qt::Key_S);
    EXPECT_EQ(scope.mode(), ScopeMode::Single);
    ASSERT_IN_TIME(comes([&] { return !scope.running(); }));
    const auto kept = scope.model().shown();
    EXPECT_THAT(status(), HasSubstr("One capture taken"));
    const auto at = controller.telemetry().at;
    ASSERT_IN_TIME(comes([&] { return controller.telemetry().at > at + std::chrono::milliseconds(700); }));
    EXPECT_EQ(scope.model().shown(), kept) << "nothing came after it";
    QTest::keyClick(&scope.screen(), Qt::Key_N);
    EXPECT_EQ(scope.mode(), ScopeMode::Normal);
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != kept; }));
    click(*find<QPushButton>(scope, "Hold"));
    EXPECT_FALSE(scope.running());
    EXPECT_NE(controller.telemetry().state, InterlockState::Disarmed) << "the output is not touched";
    QTest::keyClick(&scope.screen(), Qt::Key_A);
    EXPECT_EQ(scope.mode(), ScopeMode::Auto);
    EXPECT_TRUE(scope.running());
}

TEST_F(Scope, DraggingTheTriggerChangesItsLevelInNormal) {
    openBench();
    deliver();
    // After the amplitude has settled, the level is on the screen.
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() >= 5; }));
    auto& screen = scope.screen();
    QTest::keyClick(&screen, Qt::Key_N);
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() >= 6; }));
    scope.model().fit();
    scope.refresh(controller.telemetry());
    draw();
    ASSERT_TRUE(screen.overlay().trigger && screen.overlay().trigger->height);
    const double before = scope.settings().triggerLevel;
    const double height = *screen.overlay().trigger->height;
    const double perDivision = scope.model().viewport().lanes.at("channel/voltage").perDivision;
    drag(screen, at(screen, 9.95, height), at(screen, 9.95, height + 0.3));
    EXPECT_NEAR(scope.settings().triggerLevel - before, 0.3 * perDivision, 0.05 * perDivision);
    // In Auto the level follows the command and cannot be dragged.
    QTest::keyClick(&screen, Qt::Key_A);
    scope.refresh(controller.telemetry());
    EXPECT_TRUE(screen.overlay().trigger->held);
}

TEST_F(Scope, DraggingTheTriggersMomentChangesThePreTrigger) {
    showATrain();
    EXPECT_NEAR(500e-6 / scope.model().viewport().width_s(), 1.0 / 3, 0.1) << "the first train is seen at once";
    scope.model().fit();
    scope.refresh(controller.telemetry());
    draw();
    auto& screen = scope.screen();
    EXPECT_NEAR(scope.settings().preTrigger, 0.1, 1e-9);
    const auto from = atTime(screen, 0, 3.95);
    drag(screen, from, from + QPoint(screen.axisRect()->width() / 5, 0));
    EXPECT_NEAR(scope.settings().preTrigger, 0.3, 0.011);
    ASSERT_IN_TIME(comes([&] {
        return scope.model().shown()->zero_s - scope.model().shown()->capture->start_s > 0.28 * 10e-3;
    })) << "the next captures begin earlier";
    EXPECT_NEAR(scope.model().viewport().left_s, -3e-3, 1e-4) << "and are seen whole, as before";
}

TEST_F(Scope, OpensACaptureFileAndSaysWhatIsWrongWithABadOne) {
    const QTemporaryDir folder;
    const auto good = folder.filePath("good.csv"), bad = folder.filePath("bad.csv");
    ASSERT_TRUE(writeCapture(good.toStdString(), twoPulses(0)));
    const auto* problem = scope.findChild<QLabel*>("scopeProblem");
    EXPECT_FALSE(problem->isVisible());
    EXPECT_FALSE(scope.openCaptureFile(folder.filePath("none.csv")));
    EXPECT_TRUE(problem->isVisible()) << "where nothing is shown yet";
    EXPECT_THAT(problem->text().toStdString(), HasSubstr("none.csv does not exist."));
    ASSERT_EQ(::mkfifo(folder.filePath("pipe.csv").toUtf8(), 0600), 0);
    EXPECT_FALSE(scope.openCaptureFile(folder.filePath("pipe.csv")));
    EXPECT_THAT(problem->text().toStdString(), HasSubstr("pipe.csv is not a file that can be read."));
    EXPECT_TRUE(scope.openCaptureFile(good));
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != nullptr; }));
    EXPECT_THAT(status(), HasSubstr("good.csv · 20\u202f000 samples at 2"));
    EXPECT_EQ(scope.table().statistics().captures(), 1U);
    shot(scope, "workspace-file");
    QFile file(bad);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("time_s,voltage_v\n0,1\n0.001,oops\n0.002,1\n");
    file.close();
    EXPECT_TRUE(scope.openCaptureFile(bad));
    ASSERT_IN_TIME(comes([&] { return QString::fromStdString(status()).contains("could not be opened"); }));
    EXPECT_THAT(status(), HasSubstr("bad.csv"));
    EXPECT_EQ(scope.model().shown()->source, "good.csv") << "what was shown stays";
}

TEST_F(Scope, CalculationsSpectrumAndReferencesAreSwitchedOnByHand) {
    showTwoPulses();
    click(*find<QCheckBox>(scope, "Power V·I"));
    ASSERT_IN_TIME(comes([&] { return scope.model().lanes().size() == 3; }));
    click(*find<QCheckBox>(scope, "Charge ∫I dt"));
    ASSERT_IN_TIME(comes([&] { return scope.model().lanes().size() == 4; }));
    click(*find<QPushButton>(scope, "Store as reference"));
    ASSERT_EQ(scope.model().lanes().size(), 5U);
    auto* difference = find<QComboBox>(scope, "Difference");
    ASSERT_EQ(difference->count(), 2) << "voltage minus its reference; the current has no partner";
    difference->setFocus();
    QTest::keyClick(difference, Qt::Key_Down);
    ASSERT_IN_TIME(comes([&] { return scope.model().lanes().size() == 6; }));
    const auto nothing = scope.model().trace("math/difference");
    ASSERT_TRUE(nothing);
    EXPECT_EQ(nothing->pyramid.over(0, nothing->size()).high, 0.0F) << "it has not changed since it was stored";
    click(*find<QCheckBox>(scope, "Spectrum"));
    scope.model().fit();
    EXPECT_IN_TIME(comes([&] { return find<QWidget>(scope, "Spectrum") != nullptr; }));
    QCoreApplication::processEvents();  // the layouts settle
    QCoreApplication::processEvents();
    shot(scope, "workspace-everything");
}

TEST_F(Scope, SavesAndCopies) {
    showTwoPulses();
    const QTemporaryDir folder;
    scope.saveAs(folder.filePath("all.csv"));
    ASSERT_IN_TIME(comes([&] { return QString::fromStdString(status()).startsWith("Saved"); }));
    const auto read = readCapture(folder.filePath("all.csv").toStdString());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->capture.samples(), 20'000U);
    scope.saveAs(folder.filePath("picture.svg"));
    QFile picture(folder.filePath("picture.svg"));
    ASSERT_TRUE(picture.open(QIODevice::ReadOnly));
    const auto drawn = QString::fromUtf8(picture.readAll());
    for (const auto* text : {"Oscilloscope · simulated", "capture", "20\u202f000 samples", "Amplitude", "Interval"}) {
        EXPECT_TRUE(drawn.contains(text)) << text;
    }
    auto* menu = scope.findChild<QMenu*>();
    for (auto* action : menu->actions()) {
        if (action->text() == "Copy visible data") action->trigger();
    }
    EXPECT_TRUE(QGuiApplication::clipboard()->text().startsWith("time_s,voltage_v,current_a\n"));
    for (auto* action : menu->actions()) {
        if (action->text() == "Copy picture") action->trigger();
    }
    const auto copied = QGuiApplication::clipboard()->image();
    EXPECT_FALSE(copied.isNull());
    QGuiApplication::clipboard()->clear();
    click(*find<QToolButton>(scope, "Copy picture"));
    EXPECT_EQ(QGuiApplication::clipboard()->image().size(), copied.size()) << "by a tool of its own";
}

TEST_F(Scope, WhatIsSavedIsWhatWasShownWhenSaveWasChosenAndThatIsSaid) {
    openBench();
    deliver();
    ASSERT_IN_TIME(comes([&] { return triggered() && scope.table().statistics().captures() >= 2; }));
    const auto asked = scope.model().shown();
    for (auto* action : scope.findChild<QMenu*>()->actions()) {
        if (action->text() == "Save visible data as CSV…") action->trigger();
    }
    auto* dialog = scope.findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(dialog, nullptr);
    auto* line = dialog->findChild<QLineEdit*>("fileNameEdit");
    EXPECT_TRUE(line->text().contains(asked->taken.toString("yyyyMMdd-HHmmss"))) << qPrintable(line->text());
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != asked && triggered(); })) << "the screen runs on";
    const QTemporaryDir folder;
    const auto path = folder.filePath("then.csv");
    line->setText(path);
    static_cast<QDialog*>(dialog)->accept();
    ASSERT_IN_TIME(comes([&] { return QString::fromStdString(status()).startsWith("Saved to " + path); }));
    const auto read = readCapture(path.toStdString());
    ASSERT_TRUE(read);
    EXPECT_NEAR(read->capture.start_s, asked->capture->start_s, 1e-3);
    const auto next = scope.model().shown();
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != next; }));
    EXPECT_THAT(status(), HasSubstr("Saved to")) << "long enough to be read";
}

TEST_F(Scope, TheListOfTimeBasesMarksThePresentOneAndEndsWhereSamplesHaveNoShape) {
    showTwoPulses();
    scope.model().setTimePerDivision(500e-6);
    QStringList marked, refused;
    for (const auto* action : find<QToolButton>(scope, "Time base tool")->menu()->actions()) {
        if (action->isChecked()) marked << action->text();
        if (!action->isEnabled()) refused << action->text();
    }
    EXPECT_EQ(marked, QStringList("500\u202fµs/div"));
    EXPECT_EQ(refused, QStringList("100\u202fns/div")) << "samples 500 ns apart";
    scope.model().setTimePerDivision(150e-6);  // between two steps: tool and view show the grid's step
    EXPECT_EQ(find<QToolButton>(scope, "Time base tool")->text(), "200\u202fµs/div");
    EXPECT_EQ(find<QComboBox>(scope, "Time base")->currentText(), "200\u202fµs/div");
}

TEST_F(Scope, CursorsReadInFlagsAndForThoseWhoDoNotSeeThem) {
    showTwoPulses();
    auto& screen = scope.screen();
    const auto read = [&] { return screen.accessibleDescription().toStdString(); };
    EXPECT_TRUE(screen.overlay().flags.empty());
    click(*find<QToolButton>(scope, "Time cursors"));
    click(*find<QToolButton>(scope, "Level cursors"));
    EXPECT_EQ(screen.overlay().flags.size(), 2U);
    EXPECT_EQ(screen.overlay().levelTexts.size(), 2U);
    EXPECT_THAT(read(), testing::AllOf(HasSubstr("1/Δ"), HasSubstr("y₂")));
    // They begin at the first pulse's edges; the keys put t₂ on the second pulse's onset.
    QTest::keyClick(&screen, Qt::Key_2);
    QTest::keyClick(&screen, Qt::Key_Right, Qt::ControlModifier);
    EXPECT_THAT(read(),
                testing::AllOf(HasSubstr("t₁ 0"), HasSubstr("Δ 4.000\u202fms"), HasSubstr("1/Δ 250.0\u202fHz")));
    EXPECT_EQ(screen.overlay().timeSpan, "Δ 4.000\u202fms · 1/Δ 250.0\u202fHz");
    QCoreApplication::processEvents();  // the layouts settle
    QCoreApplication::processEvents();
    shot(scope, "workspace-cursors");
}

TEST_F(Scope, EverythingThatIsUsedHasANameAndTeaches) {
    showTwoPulses();
    for (const auto* widget : scope.findChildren<QWidget*>()) {
        if (!widget->isVisible() || widget->focusPolicy() == Qt::NoFocus) continue;
        const auto* button = qobject_cast<const QAbstractButton*>(widget);
        const bool control = button != nullptr || qobject_cast<const QComboBox*>(widget) != nullptr ||
                             qobject_cast<const QAbstractSpinBox*>(widget) != nullptr;
        if (!control) continue;
        EXPECT_FALSE(widget->accessibleName().isEmpty() && (button == nullptr || button->text().isEmpty()))
            << widget->metaObject()->className();
        EXPECT_FALSE(widget->toolTip().isEmpty())
            << widget->metaObject()->className() << " " << (button ? button->text().toStdString() : "");
    }
}

TEST_F(Scope, ACaptureWithoutPulsesSaysWhyInWords) {
    Capture flat = twoPulses();
    for (auto& channel : flat.channels) std::fill(channel.samples.begin(), channel.samples.end(), NAN);
    scope.show(std::make_shared<const Capture>(flat));
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != nullptr; }));
    draw();
    EXPECT_GT(scope.screen().graph("channel/voltage")->gapColumns(), 100);
    EXPECT_THAT(scope.findChild<QLabel*>("warnings")->text().toStdString(), HasSubstr("no pulses"));
    shot(scope, "workspace-nan");
}

TEST_F(Scope, AnAverageIsMarkedAndBeginsAnewWithTheCommand) {
    showATrain();
    click(*find<QToolButton>(scope, "Average"));
    EXPECT_EQ(find<QComboBox>(scope, "Average")->currentText(), "16 captures");
    const auto averaged = [&] { return scope.model().shown()->averaged; };
    ASSERT_IN_TIME(comes([&] { return averaged() >= 3; }));
    ASSERT_FALSE(scope.screen().overlay().notes.isEmpty());
    EXPECT_EQ(scope.screen().overlay().notes.first(), QString("averaged %1").arg(averaged()));
    shot(scope, "workspace-averaged");
    const auto before = averaged();
    controller.drive(DriveSource::Manual, 1, 0.2);
    ASSERT_IN_TIME(comes([&] { return averaged() < before; })) << "another command is not a repetition";
    click(*find<QToolButton>(scope, "Average"));
    ASSERT_IN_TIME(comes([&] { return averaged() == 0; }));
    EXPECT_TRUE(scope.screen().overlay().notes.isEmpty());
}

TEST_F(Scope, AnAverageBeginsAnewWithAnotherLoad) {
    RecordProperty("hazard", "H9");
    showATrain();
    click(*find<QToolButton>(scope, "Average"));
    ASSERT_IN_TIME(comes([&] { return scope.model().shown()->averaged >= 4; }));
    controller.fitLoad("1 kohm");
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() == 0; }));
    deliver();
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() >= 1; }));
    EXPECT_EQ(scope.model().shown()->averaged, scope.table().statistics().captures());
}

TEST_F(Scope, AMaskThatFailsSaysSoLoudlyKeepsTheFirstAndTouchesNoOutput) {
    RecordProperty("hazard", "H9");
    openBench();
    deliver();
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() >= 6; })) << "the amplitude has settled";
    click(*find<QToolButton>(scope, "Mask"));
    auto* says = scope.findChild<QLabel*>("maskSays");
    ASSERT_IN_TIME(comes([&] { return status().find("captures inside") != std::string::npos; }));
    EXPECT_EQ(scope.screen().alarm(), "");
    EXPECT_TRUE(scope.screen().mask());
    shot(scope, "workspace-mask");
    const auto delivered = controller.telemetry().trainsDelivered;
    controller.drive(DriveSource::Manual, 1, 0.9);
    ASSERT_IN_TIME(comes([&] { return !scope.screen().alarm().isEmpty(); }));
    EXPECT_TRUE(scope.screen().alarm().startsWith("✕ Mask failed: "));
    EXPECT_THAT(says->text().toStdString(), HasSubstr("The first outside: "));
    shot(scope, "workspace-mask-failed");
    ASSERT_IN_TIME(comes([&] { return controller.telemetry().trainsDelivered > delivered + 3; }))
        << "a mask never controls the output";
    EXPECT_IN_TIME(controller.telemetry().state == InterlockState::Delivering);
    const auto first = find<QPushButton>(scope, "Show the first outside");
    ASSERT_NE(first, nullptr);
    click(*first);
    ASSERT_IN_TIME(comes([&] { return scope.model().shown()->source == "first capture outside the mask"; }));
    click(*find<QPushButton>(scope, "Reset counts"));
    EXPECT_EQ(scope.screen().alarm(), "");
    click(*find<QPushButton>(scope, "Remove"));
    EXPECT_FALSE(scope.screen().mask());
    EXPECT_THAT(status(), testing::Not(HasSubstr("Mask")));
}

TEST_F(Scope, OpeningABenchLeavesTheFile) {
    const QTemporaryDir folder;
    ASSERT_TRUE(writeCapture(folder.filePath("old.csv").toStdString(), twoPulses(0)));
    scope.openCaptureFile(folder.filePath("old.csv"));
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != nullptr; }));
    openBench();
    EXPECT_IN_TIME(comes([&] { return scope.running(); })) << "though the file had put it on hold";
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() && scope.model().shown()->source.isEmpty(); }));
    EXPECT_THAT(status(), testing::Not(HasSubstr("old.csv")));
}

TEST_F(Scope, EveryStepOfTheWorkHasAKey) {
    showATrain();
    auto& screen = scope.screen();
    QTest::keyClick(&screen, Qt::Key_R);
    EXPECT_FALSE(scope.running());
    QTest::keyClick(&screen, Qt::Key_R);
    EXPECT_TRUE(scope.running());
    QTest::keyClick(&screen, Qt::Key_T);
    QTest::keyClick(&screen, Qt::Key_L);
    EXPECT_TRUE(scope.model().cursors().time_s() && scope.model().cursors().level());
    QTest::keyClick(&screen, Qt::Key_T);
    QTest::keyClick(&screen, Qt::Key_L);
    EXPECT_FALSE(scope.model().cursors().time_s() || scope.model().cursors().level());
    QSignalSpy drive(&scope, &ScopeWorkspace::driveWanted);
    QTest::keyClick(&screen, Qt::Key_D);
    EXPECT_EQ(drive.count(), 1);
    const auto state = controller.telemetry().state;
    QTest::keyClick(&screen, Qt::Key_B);
    EXPECT_TRUE(find<QToolButton>(scope, "Box")->isChecked());
    const auto asks = [&] {
        return std::ranges::any_of(QApplication::topLevelWidgets(), [](QWidget* each) {
            return qobject_cast<QFileDialog*>(each) != nullptr && each->isVisible();
        });
    };
    EXPECT_FALSE(asks());
    QTest::keyClick(&screen, Qt::Key_S, Qt::ControlModifier);
    EXPECT_IN_TIME(comes(asks)) << "where to save the picture";
    EXPECT_EQ(controller.telemetry().state, state) << "none of them drives or stops";
    for (auto* dialog : QApplication::topLevelWidgets()) {
        if (dialog != &scope && dialog->isVisible()) dialog->close();
    }
    // In an input field these keys type letters.
    auto* level = find<gui::QuantitySpin>(scope, "Mask: Voltage ±");
    level->setFocus();
    const bool running = scope.running();
    QTest::keyClicks(level, "r");
    EXPECT_EQ(scope.running(), running);
}

TEST_F(Scope, RollFromTheBenchShowsSessionTime) {
    showATrain();
    for (auto* action : find<QToolButton>(scope, "Auto")->menu()->actions()) {
        if (action->text() == "Roll") action->trigger();
    }
    EXPECT_EQ(scope.mode(), ScopeMode::Roll);
    ASSERT_IN_TIME(comes([&] { return scope.screen().graph("channel/voltage")->spans().size() >= 6; }));
    EXPECT_GE(scope.model().viewport().left_s, 0) << "before the session there is no time";
    EXPECT_GE(scope.model().viewport().right_s(), scope.model().shown()->end_s() - 0.05);
    shot(scope, "workspace-roll");
}

}  // namespace
}  // namespace tacto::test
