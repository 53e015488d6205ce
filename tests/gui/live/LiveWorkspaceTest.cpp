// Tests the live workspace and the drive as a person uses them: open, touch, drive, stop, replay, freeze.
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QPushButton>
#include <QSlider>
#include <QSplitter>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <cmath>

#include "app/gui/live/StripPlots.h"
#include "app/gui/live/TactilePlane.h"
#include "app/gui/live/TaxelMap.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "tests/gui/Looks.h"
#include "tests/gui/live/LiveBench.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using gui::LiveHistory;
using testing::HasSubstr;

QString textOf(const QWidget& in, const char* name) {
    const auto* label = in.findChild<QLabel*>(name);
    return label != nullptr ? label->text() : QString("(no %1)").arg(name);
}

void choose(QComboBox& box, const QVariant& data) { box.setCurrentIndex(box.findData(data)); }

TEST_F(LiveBench, TheEmptyWorkspaceOpensTheSimulatedBenchAndTracesFill) {
    auto* open = find<QPushButton>(live, "Open the simulated bench");
    ASSERT_NE(open, nullptr);
    shot(live, "live_empty");
    click(*open);
    ASSERT_IN_TIME(opens());
    ASSERT_IN_TIME(passes(2));
    EXPECT_GT(live.history().samples(StreamKind::Acceleration)->size(), 7000U);
    EXPECT_GT(live.history().samples(StreamKind::Force)->size(), 350U);
    EXPECT_EQ(live.history().samples(StreamKind::Taxels)->channels(), 8U);
    EXPECT_GT(live.history().frames().size(), 50U);
    EXPECT_GT(live.plots().spectrogram().transformed(), 40);
    EXPECT_EQ(live.history().missed(), 0U);
    EXPECT_EQ(find<QPushButton>(live, "Open the simulated bench"), nullptr);
    EXPECT_THAT(textOf(live, "sensorHealth").toStdString(), HasSubstr("Samples are fresh"));
    EXPECT_THAT(textOf(live, "sensorHealth").toStdString(), HasSubstr("uncalibrated R"));
    EXPECT_TRUE(complaints.isEmpty());
    controller.close();
    EXPECT_IN_TIME(comesTrue([this] { return textOf(live, "sensorHealth").isEmpty(); })) << "nothing is fresh any more";
}

TEST_F(LiveBench, TheSlidersDriveAfterArmingAndTheTrainsHaveTheirAmplitude) {
    ASSERT_IN_TIME(openSimulated());
    auto* hand = find<QPushButton>(drive, "By hand");
    auto* roughness = find<QSlider>(drive, "Roughness R");
    auto* pressure = find<QSlider>(drive, "Pressure P");
    ASSERT_TRUE(hand != nullptr && roughness != nullptr && pressure != nullptr);
    click(*hand);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().driving == DriveSource::Manual; }));
    EXPECT_IN_TIME(comesTrue([this] {
        return textOf(drive, "driveSays").simplified() ==
               "By hand asks for 10.0 V every 2.00 s once the output is armed.";
    })) << textOf(drive, "driveSays").toStdString();
    EXPECT_EQ(controller.telemetry().trainsDelivered, 0U);
    EXPECT_IN_TIME(comesTrue([this] { return textOf(live, "whereTitle") == "Set by hand"; }))
        << "the point is the hand's, not the fingertip's";

    ASSERT_IN_TIME(armed());
    pressure->setFocus();
    for (int i = 0; i < 10; ++i) QTest::keyClick(pressure, Qt::Key_PageUp);  // steps of a tenth
    roughness->setFocus();
    for (int i = 0; i < 5; ++i) QTest::keyClick(roughness, Qt::Key_PageUp);
    QTest::keyClick(roughness, Qt::Key_Right);  // steps of a hundredth
    QTest::keyClick(roughness, Qt::Key_Right);
    EXPECT_EQ(roughness->value(), 52);
    ASSERT_IN_TIME(
        comesTrue([this] { return std::abs(controller.telemetry().amplitude_v - (10 + 0.52 * 30)) < 1e-6; }));
    const auto before = live.history().trains().size();
    ASSERT_IN_TIME(comesTrue([&] { return live.history().trains().size() >= before + 4; }));
    const auto& train = live.history().trains().back();
    EXPECT_FALSE(train.isCheck);
    EXPECT_EQ(train.outcome, TrainOutcome::Delivered);
    EXPECT_NEAR(train.amplitude, 25.6, 0.26) << "10 V + 0.52 of 30 V, rounded toward zero to what the device can set";
    EXPECT_NEAR(train.measured, 25.6, 0.8);
    EXPECT_NEAR(toSeconds(train.onset - live.history().trains()[live.history().trains().size() - 2].onset), 0.5, 0.006)
        << "P = 1";
    ASSERT_IN_TIME(comesTrue([&] { return !live.plots().trains().shownTrains().empty(); }));
    EXPECT_NEAR(live.plots().trains().shownTrains().back(), 25.6, 0.26);
    ASSERT_IN_TIME(comesTrue([this] { return textOf(drive, "driveOutput").contains("25.6"); }));
    EXPECT_THAT(textOf(drive, "driveSays").toStdString(), HasSubstr("measured"));
    EXPECT_THAT(textOf(live, "commandWords").toStdString(), HasSubstr("firm"));
    EXPECT_THAT(textOf(live, "commandIndices").toStdString(), HasSubstr("P 1.00"));
    shot(live, "live_by_hand");
}

TEST_F(LiveBench, AStopComesBackToOffAndArmingAgainDeliversNothing) {
    RecordProperty("hazard", "H2");
    ASSERT_IN_TIME(openSimulated() && armed());
    auto* hand = find<QPushButton>(drive, "By hand");
    click(*hand);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered > 0; }));
    EXPECT_TRUE(hand->isChecked());
    controller.stop("test");
    EXPECT_IN_TIME(comesTrue([&] { return find<QPushButton>(drive, "Off")->isChecked(); }));
    const auto delivered = controller.telemetry().trainsDelivered;
    ASSERT_IN_TIME(armed());
    ASSERT_IN_TIME(passes(2.5));
    EXPECT_EQ(controller.telemetry().trainsDelivered, delivered);
    EXPECT_TRUE(find<QPushButton>(drive, "Off")->isChecked());
}

TEST_F(LiveBench, FromOffByHandBeginsAtNothingWhateverTheFingertipFelt) {
    RecordProperty("hazard", "H6");
    RecordProperty("hazard", "H12");
    ASSERT_IN_TIME(openSimulated() && armed());
    auto* hand = find<QPushButton>(drive, "By hand");
    auto* roughness = find<QSlider>(drive, "Roughness R");
    auto* pressure = find<QSlider>(drive, "Pressure P");
    controller.present("P120", 50, 1);
    click(*find<QPushButton>(drive, "Fingertip"));
    ASSERT_IN_TIME(comesTrue([&] { return roughness->value() > 30 && controller.telemetry().trainsDelivered > 1; }));
    click(*find<QPushButton>(drive, "Off"));
    ASSERT_IN_TIME(comesTrue([&] { return roughness->value() == 0 && pressure->value() == 0; }));
    EXPECT_THAT(textOf(drive, "driveSays").toStdString(), HasSubstr("By hand asks for 10.0"))
        << "it is said before the click";
    click(*hand);
    EXPECT_EQ(controller.lastDrive().source, DriveSource::Manual);
    EXPECT_EQ(controller.lastDrive().roughness, 0);
    EXPECT_EQ(controller.lastDrive().pressure, 0);
    // "By hand" starts next time with the values that a person set, not with those of the fingertip.
    roughness->setFocus();
    for (int i = 0; i < 2; ++i) QTest::keyClick(roughness, Qt::Key_PageUp);
    click(*find<QPushButton>(drive, "Fingertip"));
    ASSERT_IN_TIME(comesTrue([&] { return roughness->value() > 30; }));
    controller.stop("test");
    ASSERT_IN_TIME(comesTrue([&] { return roughness->value() == 20; }));
    ASSERT_IN_TIME(armed());
    click(*hand);
    EXPECT_EQ(controller.lastDrive().roughness, 0.2);
    EXPECT_EQ(controller.lastDrive().pressure, 0);
}

TEST_F(LiveBench, ByHandGoesOnWithWhatTheFingertipDelivers) {
    RecordProperty("hazard", "H6");
    ASSERT_IN_TIME(openSimulated() && armed());
    auto* hand = find<QPushButton>(drive, "By hand");
    auto* roughness = find<QSlider>(drive, "Roughness R");
    controller.present("P120", 50, 1);
    click(*find<QPushButton>(drive, "Fingertip"));
    ASSERT_IN_TIME(comesTrue([&] { return roughness->value() > 30 && controller.telemetry().trainsDelivered > 1; }));
    click(*hand);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().driving == DriveSource::Manual; }));
    EXPECT_GT(controller.telemetry().amplitude_v, 15) << "it does not jump";
    // While lifted, the fingertip delivers nothing, so there is nothing to continue.
    click(*find<QPushButton>(drive, "Fingertip"));
    controller.present("", 0, 0);
    ASSERT_IN_TIME(comesTrue([this] {
        return controller.telemetry().driving == DriveSource::Sensor &&
               !std::isfinite(controller.telemetry().amplitude_v);
    }));
    click(*hand);
    EXPECT_EQ(roughness->value(), 0);
    EXPECT_EQ(controller.lastDrive().source, DriveSource::Manual);
    EXPECT_EQ(controller.lastDrive().roughness, 0);
    EXPECT_EQ(controller.lastDrive().pressure, 0);
}

TEST_F(LiveBench, WhatWasSetByHandEndsWithItsBench) {
    RecordProperty("hazard", "H12");
    ASSERT_IN_TIME(openSimulated());
    auto* roughness = find<QSlider>(drive, "Roughness R");
    roughness->setFocus();
    QTest::keyClick(roughness, Qt::Key_PageUp);
    EXPECT_EQ(roughness->value(), 10);
    controller.setProfile(controller.profile());
    ASSERT_IN_TIME(passes(0.2));
    EXPECT_EQ(roughness->value(), 10) << "the same bench";
    controller.close();
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Closed; }));
    ASSERT_IN_TIME(openSimulated());
    EXPECT_EQ(roughness->value(), 0);
}

TEST_F(LiveBench, AStopWhileDisarmedShowsAsOffToo) {
    ASSERT_IN_TIME(openSimulated());
    auto* hand = find<QPushButton>(drive, "By hand");
    click(*hand);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().driving == DriveSource::Manual; }));
    ASSERT_IN_TIME(passes(0.1));
    EXPECT_TRUE(hand->isChecked());
    controller.stop("test");
    EXPECT_IN_TIME(comesTrue([&] { return !hand->isChecked(); }));
}

TEST_F(LiveBench, TaxelMapAndPlaneFollowTheSurface) {
    ASSERT_IN_TIME(openSimulated());
    auto* map = live.findChild<gui::TaxelMap*>();
    auto* surface = live.findChild<QComboBox*>("surface");
    ASSERT_TRUE(map != nullptr && surface != nullptr && surface->isVisible());
    choose(*surface, "");
    const auto mean = [&] {
        double sum = 0;
        for (const float v : map->values()) sum += double(v);
        return map->values().empty() ? std::nan("") : sum / double(map->values().size());
    };
    ASSERT_IN_TIME(comesTrue([&] { return mean() < 100; })) << mean();
    choose(*surface, "glass");
    EXPECT_IN_TIME(comesTrue([&] { return mean() > 3000; })) << mean();
    const auto* plane = live.findChild<gui::TactilePlane*>();
    EXPECT_IN_TIME(comesTrue([&] { return plane->point() && plane->point()->x() < 0.3; }));
    choose(*surface, "P60");
    EXPECT_IN_TIME(comesTrue([&] { return plane->point() && plane->point()->x() > 0.8; }));
    choose(*surface, "");
    EXPECT_IN_TIME(comesTrue([&] { return mean() < 100; })) << mean();
    EXPECT_IN_TIME(comesTrue([&] { return !plane->point(); })) << "nothing is felt, nothing is shown";
    EXPECT_TRUE(complaints.isEmpty()) << complaints.join(" ").toStdString();
}

TEST_F(LiveBench, TheExampleHasEveryStreamAndMovesRoughnessAndPressure) {
    auto* example = find<QPushButton>(live, "Replay the example");
    ASSERT_NE(example, nullptr);
    click(*example);
    ASSERT_IN_TIME(opens());
    for (const auto kind : {StreamKind::Acceleration, StreamKind::Force, StreamKind::Taxels})
        EXPECT_TRUE(live.plots().has(kind)) << nameOf(kind);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().roughness > 0.75; }, 60'000));
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().pressure > 0.5; }, 60'000));
}

TEST_F(LiveBench, ARecordingReplaysAtFiveTimesAndEnds) {
    const auto linen = sourceDir() / "resources" / "examples" / "linen-slide";
    ASSERT_TRUE(live.openRecording(QString::fromStdString(linen.string())));
    ASSERT_IN_TIME(opens());
    EXPECT_FALSE(live.plots().has(StreamKind::Acceleration));
    EXPECT_TRUE(live.plots().has(StreamKind::Taxels));
    auto* pace = live.findChild<QComboBox*>("pace");
    ASSERT_TRUE(pace != nullptr && pace->isVisible());
    choose(*pace, 5.0);
    const double from = live.history().now_s();
    const auto begun = std::chrono::steady_clock::now();
    ASSERT_IN_TIME(passes(3));
    const double real = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const double speed = (live.history().now_s() - from) / real;
    EXPECT_IN_TIME(std::abs(speed - 5) <= 1.5) << speed;
    shot(live, "live_recording");
    choose(*pace, 10.0);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().sensorFinished; }, 60'000));
    ASSERT_IN_TIME(comesTrue([this] { return textOf(live, "sensorHealth").contains("The recording has ended"); }));
    EXPECT_TRUE(live.findChild<gui::TaxelMap*>()->stale());
    auto* again = find<QPushButton>(live, "Replay again");
    ASSERT_NE(again, nullptr);
    shot(live, "live_recording_ended");
    const auto tap = controller.tap();
    click(*again);
    ASSERT_IN_TIME(comesTrue([&] { return controller.tap() && controller.tap() != tap; }));
    ASSERT_IN_TIME(opens());
    EXPECT_FALSE(controller.telemetry().sensorFinished);
    EXPECT_EQ(pace->currentData().toDouble(), 10);
    EXPECT_FALSE(again->isVisible());
}

TEST_F(LiveBench, AFolderThatIsNoRecordingIsRefusedWithATemplate) {
    QString why;
    QObject::connect(&live, &gui::LiveWorkspace::refusedRecording, [&](const QString& text) { why = text; });
    EXPECT_FALSE(live.openRecording(QString::fromStdString(std::filesystem::temp_directory_path().string())));
    EXPECT_THAT(why.toStdString(), HasSubstr("recording.json"));
    EXPECT_EQ(controller.activity(), gui::Activity::Closed);
}

TEST_F(LiveBench, ARecordingThatCannotBeReadLeavesTheWorkspaceEmptyAndSaysWhy) {
    const QTemporaryDir folder;
    QFile file(folder.filePath("recording.json"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(R"({"title": "t", "streams": [{"kind": "force", "file": "none.csv"}]})");
    file.close();
    EXPECT_TRUE(live.openRecording(folder.path())) << "there is something to read";
    ASSERT_IN_TIME(
        comesTrue([this] { return !complaints.isEmpty() && controller.activity() == gui::Activity::Closed; }));
    EXPECT_NE(find<QPushButton>(live, "Open the simulated bench"), nullptr);
}

TEST_F(LiveBench, FreezingThePictureDoesNotFreezeTheOutput) {
    ASSERT_IN_TIME(openSimulated() && armed());
    click(*find<QPushButton>(drive, "By hand"));
    ASSERT_IN_TIME(passes(1));
    auto* freeze = find<QPushButton>(live, "Freeze");
    click(*freeze);
    const auto shown = live.plots().shownTime();
    const auto delivered = controller.telemetry().trainsDelivered;
    ASSERT_IN_TIME(passes(2.5));
    EXPECT_EQ(live.plots().shownTime(), shown);
    EXPECT_GT(controller.telemetry().trainsDelivered, delivered);
    click(*freeze);
    EXPECT_IN_TIME(comesTrue([&] { return live.plots().shownTime().upper > shown.upper + 2; }));
}

TEST_F(LiveBench, AFrozenPictureIsZoomedFittedAndMarked) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(passes(1));
    auto* fit = find<QToolButton>(live, "Fit");
    auto* undo = find<QToolButton>(live, "Undo zoom");
    EXPECT_FALSE(fit->isEnabled()) << "a picture that moves shows all there is";
    click(*find<QPushButton>(live, "Freeze"));
    const auto whole = live.plots().shownTime();
    EXPECT_TRUE(fit->isEnabled());
    EXPECT_FALSE(undo->isEnabled());
    auto* plots = live.findChild<gui::StripPlots*>();
    const auto zoom = [&] {
        const QPointF at = plots->axisRects().last()->center();
        QWheelEvent wheel(at, plots->mapToGlobal(at), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                          false);
        QApplication::sendEvent(plots, &wheel);
        return live.plots().shownTime();
    };
    const auto once = zoom(), twice = zoom();
    EXPECT_LT(once.size(), whole.size());
    EXPECT_LT(twice.size(), once.size());
    live.activateWindow();
    ASSERT_IN_TIME(comesTrue([this] { return live.isActiveWindow(); }));
    QTest::keySequence(live.windowHandle(), QKeySequence("Ctrl+Z"));
    EXPECT_EQ(live.plots().shownTime(), once) << "by its key, whatever has the focus";
    click(*fit);
    EXPECT_EQ(live.plots().shownTime(), whole);
    click(*undo);
    EXPECT_EQ(live.plots().shownTime(), once) << "a fit is undone too";
    click(*undo);
    EXPECT_EQ(live.plots().shownTime(), whole);
    EXPECT_FALSE(undo->isEnabled());

    int marks = 0;
    QObject::connect(&live, &gui::LiveWorkspace::markWanted, [&] { ++marks; });
    click(*find<QToolButton>(live, "Mark"));
    EXPECT_EQ(marks, 1);
}

TEST_F(LiveBench, ASavedPictureIsOfTheMomentAndSaysWhatItShows) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(passes(1));
    click(*find<QToolButton>(live, "Copy picture"));
    EXPECT_EQ(QApplication::clipboard()->image().width(),
              2 * (live.findChild<gui::StripPlots*>()->width() + 2 * gui::PictureCaption::kMargin));
    click(*find<QToolButton>(live, "Save picture"));
    auto* dialog = live.findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(dialog, nullptr);
    const auto before = live.plots().readingsText();
    const auto scales = live.plots().scalesText();
    ASSERT_IN_TIME(passes(1));
    const QTemporaryDir folder;
    const auto path = folder.filePath("live.svg");
    dialog->findChild<QLineEdit*>("fileNameEdit")->setText(path);
    static_cast<QDialog*>(dialog)->accept();
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const auto drawing = QString::fromUtf8(file.readAll());
    for (const auto& said : {QString("Touch · simulated"), QString(" UTC"), QString("SIM-1"), QString("Force (N)"),
                             QString("SIMULATED"), QString("last 10")})
        EXPECT_TRUE(drawing.contains(said)) << said.toStdString();
    // Text that is too wide continues in another line; the minus comes from another font.
    for (const auto& part : before.split(" · ") + scales.split(" · ").filter(QRegularExpression("^[^−]*$")))
        EXPECT_TRUE(drawing.contains(part)) << part.toStdString() << ", though the bench went on";
    int alone = 0;
    QObject::connect(&live, &gui::LiveWorkspace::plotOnlyWanted, [&] { ++alone; });
    click(*find<QToolButton>(live, "Plot only"));
    EXPECT_EQ(alone, 1);
}

TEST_F(LiveBench, OldSamplesAreSaidAndMarked) {
    RecordProperty("hazard", "H7");
    ASSERT_IN_TIME(openSimulated("sim:finger?fault=unplug@2s", 4)) << complaints.join(" ").toStdString();
    ASSERT_IN_TIME(comesTrue([this] { return textOf(live, "sensorHealth").contains("Old: the newest sample is"); }))
        << textOf(live, "sensorHealth").toStdString();
    EXPECT_IN_TIME(comesTrue([this] { return live.plots().stale(StreamKind::Acceleration); }));
    // Each part is redrawn at its own rate.
    EXPECT_IN_TIME(comesTrue([this] { return live.findChild<gui::TaxelMap*>()->stale(); }));
    EXPECT_IN_TIME(comesTrue([this] { return !live.findChild<gui::TactilePlane*>()->point(); }));
    shot(live, "live_stale");
}

TEST_F(LiveBench, IsNotFrozenOrDrivingWhenAnotherBenchOpens) {
    ASSERT_IN_TIME(openSimulated());
    click(*find<QPushButton>(live, "Freeze"));
    click(*find<QPushButton>(drive, "By hand"));
    ASSERT_IN_TIME(passes(0.5));
    const auto tap = controller.tap();
    ASSERT_IN_TIME(openSimulated("sim:stimulator?mode=current"));
    ASSERT_IN_TIME(comesTrue([&] { return controller.tap() && controller.tap() != tap; }))
        << complaints.join(" ").toStdString();
    ASSERT_IN_TIME(passes(0.3));
    EXPECT_FALSE(live.plots().frozen());
    EXPECT_TRUE(find<QPushButton>(drive, "Off")->isChecked());
    EXPECT_IN_TIME(live.plots().shownTime().upper < 2) << "and begins anew";
}

TEST_F(LiveBench, ACurrentSourceIsDrawnInItsOwnUnit) {
    ASSERT_IN_TIME(openSimulated("sim:stimulator?mode=current"));
    ASSERT_IN_TIME(armed());
    controller.drive(DriveSource::Manual, 1, 1);
    ASSERT_IN_TIME(comesTrue([this] { return live.plots().trains().shownTrains().size() >= 3; }));
    EXPECT_NEAR(live.plots().trains().shownTrains().back(), 40, 1) << "40 V into 1 kΩ, in mA";
    EXPECT_FALSE(live.plots().trains().shownCommand().empty());
    EXPECT_NEAR(live.plots().trains().shownCommand().back(), 40, 1);
    shot(live, "live_current");
}

TEST_F(LiveBench, TheOscilloscopesReadingStandsBesideTheTrain) {
    ASSERT_IN_TIME(openSimulated() && armed());
    controller.drive(DriveSource::Manual, 1, 1);
    ScopeSettings settings;
    settings.sampleRate = Hertz(1e6);
    settings.samples = 2000;
    settings.triggerLevel = 2;
    controller.runScope(settings, false);
    ASSERT_IN_TIME(comesTrue([this] { return live.plots().trains().scopeReadings().size() >= 2; }));
    for (const double reading : live.plots().trains().scopeReadings()) EXPECT_NEAR(reading, 40, 2);
    EXPECT_LE(live.plots().trains().scopeReadings().size(), controller.telemetry().trainsDelivered) << "one a train";
    shot(live, "live_scope");
}

TEST_F(LiveBench, TheFingerKeepsItsOwnStrokesUntilASurfaceIsChosen) {
    ASSERT_IN_TIME(openSimulated());
    auto* surface = live.findChild<QComboBox*>("surface");
    EXPECT_EQ(surface->currentText(), "its own strokes");
    surface->setFocus();
    QTest::keyClick(surface, Qt::Key_End);
    EXPECT_EQ(surface->currentText(), "P60");
    EXPECT_EQ(surface->findText("its own strokes"), -1) << "there is no way back to them";
}

TEST_F(LiveBench, OnTheWayToTheFingertipNothingDrivesByHand) {
    RecordProperty("hazard", "H12");
    ASSERT_IN_TIME(openSimulated() && armed());
    auto* off = find<QPushButton>(drive, "Off");
    drive.raise();
    drive.activateWindow();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&drive));
    off->setFocus();
    QTest::keyClick(off, Qt::Key_Right);
    EXPECT_EQ(QApplication::focusWidget(), find<QPushButton>(drive, "By hand"));
    ASSERT_IN_TIME(passes(0.5));
    EXPECT_EQ(controller.telemetry().driving, DriveSource::Off);
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Right);
    EXPECT_EQ(controller.telemetry().trainsDelivered, 0U);
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
    EXPECT_IN_TIME(comesTrue([this] { return controller.telemetry().driving == DriveSource::Sensor; }));
}

TEST_F(LiveBench, LooksRightInBothThemesAndSizes) {
    const auto looks = [this](const char* name) {
        ASSERT_IN_TIME(passes(0.5));
        shot(live, name);
        EXPECT_EQ(faultsOf(live), "") << name;
    };
    ASSERT_IN_TIME(openSimulated() && armed());
    click(*find<QPushButton>(drive, "Fingertip"));
    ASSERT_IN_TIME(passes(2));
    choose(*live.findChild<QComboBox*>("surface"), "plastic");
    looks("live_light");
    live.resize(860, 520);
    looks("live_small");
    gui::applyTheme(gui::Theme::Dark);
    live.resize(1500, 950);
    looks("live_dark");
}

using testing::StartsWith;

class DriveThatWas : public LiveBench {
protected:
    DriveThatWas() {
        RecordProperty("hazard", "H2");
        RecordProperty("hazard", "H12");
    }
    [[nodiscard]] std::string says() { return drive.findChild<QLabel*>("driveSays")->text().toStdString(); }
    [[nodiscard]] bool saysOff() {
        return comesTrue([this] { return drive.chosen() == DriveSource::Off && drive.headline() == "Off"; });
    }
};

TEST_F(LiveBench, TheFirstOfTheDrivesChoicesHasItsLeftEdge) {
    ASSERT_IN_TIME(openSimulated());
    auto* hand = drive.findChild<QPushButton*>("driveByHand");
    hand->click();
    auto* off = find<QPushButton>(drive, "Off");
    ASSERT_IN_TIME(comesTrue([&] { return hand->isChecked() && drive.isEnabled(); }));
    const auto picture = drive.grab().toImage();
    const auto at = off->mapTo(&drive, QPoint());
    int edges = 0;
    for (int x = std::max(0, at.x() - 1); x < at.x() + 2; ++x)
        edges += picture.pixelColor(x, at.y() + off->height() / 2) == gui::colours().edge;
    EXPECT_EQ(edges, 1);
}

TEST_F(DriveThatWas, IsNamedAfterAStopAndStartsNothing) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return drive.isEnabled(); }));
    EXPECT_THAT(says(), StartsWith("Nothing drives the output."));
    ASSERT_IN_TIME(armed());
    controller.drive(DriveSource::Manual, 0.4, 0.6);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered > 0; }));
    ASSERT_IN_TIME(comesTrue([this] { return drive.chosen() == DriveSource::Manual; }));
    controller.stop("test");
    ASSERT_IN_TIME(saysOff());
    EXPECT_THAT(says(), StartsWith("Was by hand, R 0.40, P 0.60."));
    const auto delivered = controller.telemetry().trainsDelivered;
    ASSERT_IN_TIME(armed());
    ASSERT_IN_TIME(passes(2.5));
    EXPECT_EQ(controller.telemetry().trainsDelivered, delivered) << "what was does not go on by itself";
    EXPECT_EQ(controller.telemetry().driving, DriveSource::Off);
}

/// The reason given why the fingertip drives no train says only what is known.
TEST_F(LiveBench, TheDriveSaysOfTheFingertipWhatIsKnown) {
    RecordProperty("hazard", "H7");
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return drive.isEnabled(); }));
    ASSERT_IN_TIME(armed());
    controller.drive(DriveSource::Sensor);
    ASSERT_IN_TIME(comesTrue([this] { return drive.chosen() == DriveSource::Sensor; }));
    for (const auto finger : {FingerStanding::Stale, FingerStanding::Implausible, FingerStanding::Fresh}) {
        for (const bool contact : {false, true}) {
            auto telemetry = controller.telemetry();
            telemetry.state = InterlockState::Delivering;
            telemetry.finger = finger;
            telemetry.contact = contact;
            telemetry.amplitude_v = telemetry.interval_s = NAN;
            drive.refresh(telemetry);
            const auto says = drive.findChild<QLabel*>("driveSays")->text().toStdString();
            const bool feels = finger == FingerStanding::Fresh;
            EXPECT_EQ(says.find("touches nothing") != says.npos, feels && !contact) << says;
            EXPECT_EQ(says.find("no roughness") != says.npos, feels && contact) << says;
            EXPECT_EQ(says.find("samples are old") != says.npos, finger == FingerStanding::Stale) << says;
            EXPECT_EQ(says.find("no readings") != says.npos, finger == FingerStanding::Implausible) << says;
        }
    }
}

TEST_F(DriveThatWas, ByHandSaysBeforeArmingWhatItAsksForAndAfterwardsWhatWasSet) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return drive.isEnabled(); }));
    drive.findChild<QPushButton*>("driveByHand")->click();
    drive.findChild<QDoubleSpinBox*>("driveRoughness")->setValue(0.69);
    ASSERT_IN_TIME(comesTrue([this] {
        const auto telemetry = controller.telemetry();
        drive.refresh(telemetry);
        return telemetry.driving == DriveSource::Manual && std::isfinite(telemetry.roughness);
    }));
    ASSERT_NE(controller.telemetry().roughness, 0.69) << "while it is off the bench tells of the fingertip";
    EXPECT_EQ(drive.headline(), "Off") << "nothing is delivered";
    EXPECT_EQ(says(), "By hand asks for 30.7\u202fV every 2.00\u202fs once the output is armed.");
    controller.stop("test");
    ASSERT_IN_TIME(saysOff());
    EXPECT_THAT(says(), StartsWith("Was by hand, R 0.69, P 0.00."));
}

TEST_F(DriveThatWas, IsTheFingertipWhereItDroveAndAnotherBenchKnowsOfNone) {
    ASSERT_IN_TIME(openSimulated() && armed());
    controller.present("P120", 50, 1);
    controller.drive(DriveSource::Sensor);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered > 0; }));
    ASSERT_IN_TIME(comesTrue([this] { return drive.chosen() == DriveSource::Sensor; }));
    ASSERT_IN_TIME(comesTrue([this] {
        const auto telemetry = controller.telemetry();
        drive.refresh(telemetry);
        return std::isfinite(telemetry.roughness) && std::isfinite(telemetry.pressure);
    }));
    controller.disarm();
    ASSERT_IN_TIME(saysOff());
    EXPECT_THAT(says(), StartsWith("Was the fingertip, R "));
    controller.close();
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Closed; }));
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return says().starts_with("Nothing drives the output."); }));
}

}  // namespace
}  // namespace tacto::test
