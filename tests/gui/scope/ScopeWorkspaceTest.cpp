// The oscilloscope as a person uses it: with the simulated bench, with files, by keys and mouse.
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSplitter>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/look/Look.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/QuantitySpin.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "core/formats/CsvFormat.h"
#include "core/measure/CaptureFile.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"

namespace tacto::test {
namespace {

using gui::Activity;
using gui::BenchDesk;
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
    ASSERT_TRUE(comes([&] { return scope.running(); }));
    ASSERT_TRUE(comes([&] { return QString::fromStdString(status()).startsWith("Waiting for a trigger at"); }));
    EXPECT_THAT(status(), HasSubstr("Output is disarmed."));
    shot(scope, "workspace-waiting");
    deliver();
    ASSERT_TRUE(comes([&] { return triggered(); }));
    EXPECT_TRUE(scope.view().shown()->capture->simulated);
    ASSERT_TRUE(comes([&] { return scope.table().statistics().captures() >= 3; }));
    // Auto: a fifth of what is commanded.
    const double commanded = desk.telemetry().amplitude_v;
    EXPECT_TRUE(comes([&] {
        const double level = scope.settings().triggerLevel;
        return level > 0.2 * commanded / 1.4 && level < 0.2 * commanded * 1.4;
    })) << scope.settings().triggerLevel
        << " of " << commanded;
    shot(scope, "workspace-live");
    EXPECT_TRUE(complaints.isEmpty()) << complaints.first().toStdString();
}

TEST_F(Scope, SingleTakesOneAndHoldKeepsThePicture) {
    openBench();
    deliver();
    ASSERT_TRUE(comes([&] { return triggered(); }));
    QTest::keyClick(&scope.view(), Qt::Key_S);
    EXPECT_EQ(scope.mode(), ScopeMode::Single);
    ASSERT_TRUE(comes([&] { return !scope.running(); }));
    const auto kept = scope.view().shown();
    EXPECT_THAT(status(), HasSubstr("One capture taken"));
    const auto at = desk.telemetry().at;
    ASSERT_TRUE(comes([&] { return desk.telemetry().at > at + std::chrono::milliseconds(700); }));
    EXPECT_EQ(scope.view().shown(), kept) << "nothing came after it";
    QTest::keyClick(&scope.view(), Qt::Key_N);
    EXPECT_EQ(scope.mode(), ScopeMode::Normal);
    ASSERT_TRUE(comes([&] { return scope.view().shown() != kept; }));
    click(*find<QPushButton>(scope, "Hold"));
    EXPECT_FALSE(scope.running());
    EXPECT_NE(desk.telemetry().state, InterlockState::Disarmed) << "the output is not touched";
    QTest::keyClick(&scope.view(), Qt::Key_A);
    EXPECT_EQ(scope.mode(), ScopeMode::Auto);
    EXPECT_TRUE(scope.running());
}

TEST_F(Scope, DraggingTheTriggerChangesItsLevelInNormal) {
    openBench();
    deliver();
    // Once the amplitude has settled, the level lies on the screen.
    ASSERT_TRUE(comes([&] { return scope.table().statistics().captures() >= 5; }));
    auto& view = scope.view();
    QTest::keyClick(&view, Qt::Key_N);
    ASSERT_TRUE(comes([&] { return scope.table().statistics().captures() >= 6; }));
    view.fit();
    scope.refresh(desk.telemetry());
    draw();
    ASSERT_TRUE(view.overlay().trigger && view.overlay().trigger->height);
    const double before = scope.settings().triggerLevel;
    const double height = *view.overlay().trigger->height;
    const double perDivision = view.viewport().lanes.at("channel/voltage").perDivision;
    drag(view, at(view, 9.95, height), at(view, 9.95, height + 0.3));
    EXPECT_NEAR(scope.settings().triggerLevel - before, 0.3 * perDivision, 0.05 * perDivision);
    // In Auto it follows the command: there is nothing to drag.
    QTest::keyClick(&view, Qt::Key_A);
    scope.refresh(desk.telemetry());
    EXPECT_TRUE(view.overlay().trigger->held);
}

TEST_F(Scope, DraggingTheTriggersMomentChangesThePreTrigger) {
    openBench();
    deliver();
    ASSERT_TRUE(comes([&] { return triggered(); }));
    scope.refresh(desk.telemetry());
    draw();
    auto& view = scope.view();
    EXPECT_NEAR(scope.settings().preTrigger, 0.1, 1e-9);
    const auto from = atTime(view, 0, 3.95);
    drag(view, from, from + QPoint(view.axisRect()->width() / 5, 0));
    EXPECT_NEAR(scope.settings().preTrigger, 0.3, 0.011);
    ASSERT_TRUE(comes([&] { return view.shown()->zero_s - view.shown()->capture->start_s > 0.28 * 10e-3; }))
        << "the next captures begin earlier";
    EXPECT_NEAR(view.viewport().left_s, -3e-3, 1e-4) << "and are seen whole, as before";
}

TEST_F(Scope, OpensACaptureFileAndSaysWhatIsWrongWithABadOne) {
    const QTemporaryDir folder;
    const auto good = folder.filePath("good.csv"), bad = folder.filePath("bad.csv");
    ASSERT_TRUE(writeCapture(good.toStdString(), twoPulses(0)));
    EXPECT_FALSE(scope.openCaptureFile(folder.filePath("none.csv")));
    EXPECT_TRUE(scope.openCaptureFile(good));
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    EXPECT_THAT(status(), HasSubstr("good.csv · 20000 samples at 2"));
    EXPECT_EQ(scope.table().statistics().captures(), 1U);
    shot(scope, "workspace-file");
    QFile file(bad);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("time_s,voltage_v\n0,1\n0.001,oops\n0.002,1\n");
    file.close();
    EXPECT_TRUE(scope.openCaptureFile(bad));
    ASSERT_TRUE(comes([&] { return QString::fromStdString(status()).contains("could not be opened"); }));
    EXPECT_THAT(status(), HasSubstr("bad.csv"));
    EXPECT_EQ(scope.view().shown()->source, "good.csv") << "what was shown stays";
}

TEST_F(Scope, CalculationsSpectrumAndReferencesAreSwitchedOnByHand) {
    scope.show(std::make_shared<const Capture>(twoPulses()));
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    click(*find<QCheckBox>(scope, "Power V·I"));
    ASSERT_TRUE(comes([&] { return scope.view().lanes().size() == 3; }));
    click(*find<QCheckBox>(scope, "Charge ∫I dt"));
    ASSERT_TRUE(comes([&] { return scope.view().lanes().size() == 4; }));
    click(*find<QPushButton>(scope, "Store as reference"));
    ASSERT_EQ(scope.view().lanes().size(), 5U);
    auto* difference = find<QComboBox>(scope, "Difference");
    ASSERT_EQ(difference->count(), 2) << "voltage minus its reference; the current has no partner";
    difference->setFocus();
    QTest::keyClick(difference, Qt::Key_Down);
    ASSERT_TRUE(comes([&] { return scope.view().lanes().size() == 6; }));
    const auto nothing = scope.view().trace("math/difference");
    ASSERT_TRUE(nothing);
    EXPECT_EQ(nothing->pyramid.over(0, nothing->size()).high, 0.0F) << "it has not changed since it was stored";
    click(*find<QCheckBox>(scope, "Spectrum"));
    scope.view().fit();
    EXPECT_TRUE(comes([&] { return find<QWidget>(scope, "Spectrum") != nullptr; }));
    QCoreApplication::processEvents();  // layouts settle
    QCoreApplication::processEvents();
    shot(scope, "workspace-everything");
}

TEST_F(Scope, SavesAndCopies) {
    scope.show(std::make_shared<const Capture>(twoPulses()));
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    const QTemporaryDir folder;
    scope.saveAs(folder.filePath("all.csv"));
    ASSERT_TRUE(comes([&] { return QString::fromStdString(status()).startsWith("Saved"); }));
    const auto read = readCapture(folder.filePath("all.csv").toStdString());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->capture.samples(), 20'000U);
    scope.saveAs(folder.filePath("picture.svg"));
    EXPECT_TRUE(QFile::exists(folder.filePath("picture.svg")));
    auto* menu = scope.findChild<QMenu*>();
    for (auto* action : menu->actions()) {
        if (action->text() == "Copy visible data") action->trigger();
    }
    EXPECT_TRUE(QGuiApplication::clipboard()->text().startsWith("time_s,voltage_v,current_a\n"));
    for (auto* action : menu->actions()) {
        if (action->text() == "Copy picture") action->trigger();
    }
    EXPECT_FALSE(QGuiApplication::clipboard()->image().isNull());
}

TEST_F(Scope, CursorsReadBelowTheTools) {
    scope.show(std::make_shared<const Capture>(twoPulses()));
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    auto* readout = scope.findChild<QLabel*>("cursorReadout");
    EXPECT_FALSE(readout->isVisible());
    click(*find<QToolButton>(scope, "Time cursors"));
    click(*find<QToolButton>(scope, "Level cursors"));
    EXPECT_TRUE(readout->isVisible());
    EXPECT_THAT(readout->text().toStdString(), testing::AllOf(HasSubstr("1/Δ"), HasSubstr("Y2")));
    // By keys: X1 to the first onset, X2 to the second pulse's.
    auto& view = scope.view();
    QTest::keyClick(&view, Qt::Key_1);
    for (int i = 0; i < 4; ++i) QTest::keyClick(&view, Qt::Key_Left, Qt::ControlModifier);
    QTest::keyClick(&view, Qt::Key_2);
    for (int i = 0; i < 4; ++i) QTest::keyClick(&view, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_THAT(readout->text().toStdString(),
                testing::AllOf(HasSubstr("X1 0"), HasSubstr("Δ 4.000\u202fms"), HasSubstr("1/Δ 250.0\u202fHz")));
    QCoreApplication::processEvents();  // layouts settle
    QCoreApplication::processEvents();
    shot(scope, "workspace-cursors");
}

TEST_F(Scope, TheTabKeyReachesToolsScreenAndControlsInThatOrder) {
    scope.show(std::make_shared<const Capture>(twoPulses()));
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    find<QToolButton>(scope, "Auto")->setFocus();
    QStringList met;
    for (int i = 0; i < 40; ++i) {
        auto* at = scope.focusWidget();
        const auto* button = qobject_cast<QAbstractButton*>(at);
        met << (at->accessibleName().isEmpty() && button != nullptr ? button->text() : at->accessibleName());
        QTest::keyClick(at, Qt::Key_Tab);
    }
    const auto place = [&](const char* name) { return met.indexOf(name); };
    EXPECT_GE(place("Fit"), 0);
    EXPECT_GT(place("Oscilloscope screen"), place("Fit"));
    EXPECT_GT(place("Scale of Voltage"), place("Oscilloscope screen"));
    EXPECT_GT(place("Store as reference"), place("Scale of Voltage"));
    EXPECT_GT(place("Time base"), place("Store as reference"));
    EXPECT_GT(place("Trigger source"), place("Time base"));
    EXPECT_GT(place("Measurements"), place("Trigger source"));
}

TEST_F(Scope, EverythingThatIsUsedHasANameAndTeaches) {
    scope.show(std::make_shared<const Capture>(twoPulses()));
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
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
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    draw();
    EXPECT_GT(scope.view().graph("channel/voltage")->gapColumns(), 100);
    EXPECT_THAT(scope.findChild<QLabel*>("warnings")->text().toStdString(), HasSubstr("no pulses"));
    shot(scope, "workspace-nan");
}

TEST_F(Scope, RollFromTheBenchShowsSessionTime) {
    openBench();
    deliver();
    ASSERT_TRUE(comes([&] { return triggered(); }));
    click(*find<QToolButton>(scope, "Roll"));
    EXPECT_EQ(scope.mode(), ScopeMode::Roll);
    ASSERT_TRUE(comes([&] { return scope.view().graph("channel/voltage")->spans().size() >= 6; }));
    EXPECT_GE(scope.view().viewport().left_s, 0) << "before the session there is no time";
    EXPECT_GE(scope.view().viewport().right_s(), scope.view().shown()->end_s() - 0.05);
    shot(scope, "workspace-roll");
}

}  // namespace
}  // namespace tacto::test
