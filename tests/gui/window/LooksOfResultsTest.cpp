// Tests the looks of screens that need a run or a fault first: results of a calibration, a safety check and a
// separability run, the faulted state, the second step of arming, the drive panel; in both themes, small and large.
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QStatusBar>
#include <QTableView>
#include <QToolButton>

#include "app/gui/live/TactilePlane.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/SignPage.h"
#include "app/gui/runner/SimulatedBenchDialog.h"
#include "app/gui/runner/StepButton.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/DayDialog.h"
#include "tests/gui/Looks.h"
#include "tests/gui/calibrate/CalibrationLab.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

class ResultsInTheWindow : public Window {
protected:
    void looksRight(const QString& name) {
        for (const auto theme : bothThemes()) {
            gui::applyTheme(theme);
            for (const auto size : sizesIn(theme, {QSize(1280, 720), QSize(1440, 900), QSize(1920, 1080)})) {
                window.resize(size);
                const auto file =
                    QString("%1-%2-%3").arg(name, theme == gui::Theme::Dark ? "dark" : "light").arg(size.width());
                EXPECT_IN_TIME(comesTrue([&] { return faultsOf(window).empty(); }))
                    << faultsOf(window) << ", " << file.toStdString();
                shot(window, file);
            }
        }
    }
    [[nodiscard]] static QStringList texts(const QCustomPlot& plot) {
        QStringList all;
        for (const auto* element : plot.plotLayout()->elements(false))
            if (const auto* text = dynamic_cast<const QCPTextElement*>(element)) all << text->text();
        return all;
    }
    [[nodiscard]] QString lastMessage() {
        const auto messages = window.statusBar()->findChildren<QToolButton*>();
        return messages.isEmpty() ? QString() : messages.front()->toolTip().section('\n', 0, 0);
    }
    [[nodiscard]] QString recorded() {
        QCoreApplication::processEvents();
        return find<QLabel>(window, "recording")->text();
    }
    void type(const char* field, const QString& text) {
        QLineEdit* line = nullptr;
        ASSERT_IN_TIME(comesTrue([&] { return (line = find<QLineEdit>(window, field)) != nullptr; })) << field;
        line->setText(text);
    }
    /// Drives by hand in the drive's dock, as a person does.
    void driveByHand(double roughness, double pressure) {
        click(*find<QPushButton>(window, "By hand"));
        find<QDoubleSpinBox>(window, "Roughness R")->setValue(roughness);
        find<QDoubleSpinBox>(window, "Pressure P")->setValue(pressure);
        ASSERT_IN_TIME(comesTrueWhileOn([this] { return state() == InterlockState::Delivering; }))
            << banner().toStdString();
    }
    /// Gives up when the output is off: on a stalled machine the control loop faults, and then nothing more comes.
    [[nodiscard]] bool comesTrueWhileOn(const std::function<bool()>& isSo, int limit_ms = 10'000) {
        const auto isOff = [this] { return state() == InterlockState::Faulted || state() == InterlockState::Disarmed; };
        return comesTrue([&] { return isSo() || isOff(); }, limit_ms) && !isOff();
    }

private:
    OwnDataHome home_;
};

TEST_F(ResultsInTheWindow, ACalibrationLooksRight) {
    visit(1);
    ASSERT_NO_FATAL_FAILURE(type("warm_up_s", "0"));
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    looksRight("result-calibrate");
    click(*find<QToolButton>(window, "Plot only"));
    EXPECT_IN_TIME(comesTrue([this] { return find<QWidget>(window, "path") == nullptr; })) << "as F11";
    click(*find<QToolButton>(window, "Plot only"));
    EXPECT_IN_TIME(comesTrue([this] { return find<QWidget>(window, "path") != nullptr; }));
    const LargeBesideDocks large(*this);
    large.fits("calibrate-result");
    click(*find<QPushButton>(window, "Tables"));
    large.fits("calibrate-tables", "QTableWidget");  // the tables scroll
    click(*find<QPushButton>(window, "Log"));
    large.fits("calibrate-log");
    for (const auto* step : {"Wiring", "Known reference", "Settings", "Run"}) {
        click(*find<gui::StepButton>(window, step));
        large.fits(QString("calibrate-%1").arg(step));
    }
    for (const int tab : {1, 2}) {
        window.findChild<gui::TabbedPage*>("calibratePages")->setCurrentIndex(tab);
        large.fits(QString("calibrate-tab-%1").arg(tab), "calibrationHistory");
    }
}

TEST_F(ResultsInTheWindow, ASafetyCheckLooksRight) {
    visit(2);
    ASSERT_NO_FATAL_FAILURE(type("area", "4"));
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    // The message must not be about the last fault that the check provoked, or about the bench that it closed.
    EXPECT_EQ(lastMessage(), "Safety check finished: pass. Output is off.");
    EXPECT_TRUE(recorded().startsWith("Recorded to load-safety-")) << recorded().toStdString();
    looksRight("result-safety");
}

TEST_F(ResultsInTheWindow, InLargeTextASafetyCheckAndItsReportAreReadWhole) {
    visit(2);
    ASSERT_NO_FATAL_FAILURE(type("area", "4"));
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    const auto reported = [this] {
        return std::ranges::any_of(window.findChildren<gui::SignPage*>(),
                                   [](const auto* sign) { return sign->note() == "Not signed yet"; });
    };
    ASSERT_IN_TIME(comesTrue(reported, 60'000));
    const auto isWhole = [this](const char* name) {
        window.resize(1280, 720);
        EXPECT_IN_TIME(comesTrue([this] { return faultsOf(window).empty(); })) << faultsOf(window) << ", " << name;
        shot(window, QString("large-%1").arg(name));
    };
    gui::applyTextSize(200);
    isWhole("safety-result");
    LargeBesideDocks(*this).fits("safety-result", "limitMatrix");  // the matrix has its own scroll bars
    click(*find<QPushButton>(window, "Tables"));
    const auto numbersCut = [this] { return cutCells(window).filter("no tool tip"); };
    EXPECT_IN_TIME(comesTrue([&] { return numbersCut().isEmpty(); })) << numbersCut().join('\n').toStdString();
    shot(window, "large-safety-tables");
    LargeBesideDocks(*this).fits("safety-tables", "QTableWidget");  // numbers are not cut off: the tables scroll
    click(*find<QPushButton>(window, "Sign report…"));
    isWhole("sign");
    LargeBesideDocks(*this).fits("sign");
    for (const auto* step : {"Known reference", "Settings", "Run"}) {
        click(*find<gui::StepButton>(window, step));
        isWhole(step);
    }
}

TEST_F(ResultsInTheWindow, ThePlaneOfTrialsLooksRight) {
    visit(3);
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    looksRight("result-separability");
    window.resize(1440, 900);  // room for both side by side
    letLive(100);
    const auto* plane = find<gui::TrialPlane>(window, "Trials");
    const auto* train = find<gui::CaptureStrip>(window, "Last capture");
    ASSERT_TRUE(plane != nullptr && train != nullptr);
    EXPECT_IN_TIME(comesTrue([&] { return texts(*plane).contains("Trials in the plane, 100"); }));
    for (const auto* axis : {plane->xAxis, plane->yAxis, train->xAxis, train->yAxis, train->yAxis2})
        EXPECT_TRUE(axis->label().at(0).isUpper()) << axis->label().toStdString();
    click(*find<QToolButton>(window, "Copy picture"));
    const auto copied = QGuiApplication::clipboard()->image();
    EXPECT_EQ(copied.width(), 2 * (plane->width() + 2 * gui::PictureCaption::kMargin));
    EXPECT_GT(copied.height(), 2 * plane->height() + 100) << "with what it is of above it";
    if (const auto shots = qEnvironmentVariable("TACTO_SHOTS"); !shots.isEmpty())
        copied.save(shots + "/separability_picture.png");
    click(*find<QPushButton>(window, "Log"));
    EXPECT_FALSE(find<QToolButton>(window, "Save picture")->isEnabled()) << "a log has nothing to draw";
    click(*find<QPushButton>(window, "Plot"));
    EXPECT_TRUE(find<QToolButton>(window, "Save picture")->isEnabled());
    click(*find<QToolButton>(window, "Plot only"));
    EXPECT_IN_TIME(comesTrue([this] { return find<QWidget>(window, "path") == nullptr; })) << "as F11";
    click(*find<QToolButton>(window, "Plot only"));
    EXPECT_IN_TIME(comesTrue([this] { return find<QWidget>(window, "path") != nullptr; }));
}

TEST_F(ResultsInTheWindow, ASessionThatIsChosenLooksRight) {
    open();
    window.controller().present("P120", 50, 1);
    ASSERT_IN_TIME(comesTrue([this] { return std::isfinite(window.controller().telemetry().roughness); }));
    letLive(1000);
    window.controller().close();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    visit(3);
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    click(*find<QPushButton>(window, "Open session"));
    const auto is = [this](const QString& procedure) {
        const auto* title = find<QLabel>(window, "sessionTitle");
        return title != nullptr && title->text().startsWith(procedure);
    };
    ASSERT_IN_TIME(comesTrue([&] { return is("Separability"); }));
    looksRight("session-separability");
    const auto& table = *window.findChild<QTableView*>("sessionsTable");
    QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualRect(table.model()->index(1, 0)).center());
    ASSERT_IN_TIME(comesTrue([&] { return is("Live"); }));
    looksRight("session-live");
}

TEST_F(ResultsInTheWindow, AFaultLooksRight) {
    ASSERT_NO_FATAL_FAILURE(open());
    visit(0);
    ASSERT_NO_FATAL_FAILURE(unplugWhile(1, 1));
    looksRight("faulted");
}

TEST_F(ResultsInTheWindow, WhatTheFingertipFeelsIsSeenWithoutScrolling) {
    open();
    visit(0);
    for (const auto size : {QSize(1280, 720), QSize(1440, 900), QSize(1920, 1080)}) {
        window.resize(size);
        const auto* side = find<QScrollArea>(window, "fingertipSide");
        ASSERT_NE(side, nullptr);
        EXPECT_IN_TIME(comesTrue([&] { return side->verticalScrollBar()->maximum() == 0; })) << size.height();
        EXPECT_NE(find<QDoubleSpinBox>(window, "fingerForce"), nullptr);
    }
}

TEST_F(ResultsInTheWindow, TheArmDialogLooksRight) {
    open();
    window.controller().drive(DriveSource::Manual, 0.69, 0.8);
    auto* first = window.findChild<QPushButton*>("armButton");
    ASSERT_IN_TIME(comesTrue([&] { return first->isEnabled() && first->text().contains("…"); }));
    click(*first);
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_NE(second, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return second->isVisible(); }));
    auto& dialog = *second->window();
    ASSERT_NE(&dialog, &window);
    EXPECT_TRUE(dialog.findChild<QLabel*>("armingText")->text().contains("40\u202fV")) << "on one line";
    ASSERT_IN_TIME(comesTrue([&] { return dialog.findChild<QLabel*>("firstOutput")->text().contains("30.7"); }));
    QString said;
    for (const auto* label : dialog.findChildren<QLabel*>()) said += label->text() + '\n';
    EXPECT_THAT(said.toStdString(), AllOf(HasSubstr("Encoding profile: default"), HasSubstr("FDA guidance"),
                                          HasSubstr("IEC 60601-2-10"), HasSubstr("design paper")));
    test::looksRight(dialog, "arm");
    dialog.close();
    ASSERT_IN_TIME(comesTrue([&] { return window.findChild<QPushButton*>("armOutput") == nullptr; }));
    EXPECT_NE(state(), InterlockState::Armed) << "closing it arms nothing";
}

TEST_F(ResultsInTheWindow, TheDialogOfFaultsLooksRightAndDoesWhatTheReadmePromises) {
    RecordProperty("hazard", "H4");
    visit(0);  // opens the page with its docks
    ASSERT_IN_TIME(comesTrue([this] { return find<QPushButton>(window, "Faults…") != nullptr; }));
    click(*find<QPushButton>(window, "Faults…"));
    auto* dialog = window.findChild<gui::SimulatedBenchDialog*>();
    ASSERT_NE(dialog, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return dialog->isVisible(); }));
    test::looksRight(*dialog, "faults");
    dialog->findChild<QComboBox*>("fault")->setCurrentText("electrode lifts (open)");
    auto* after = dialog->findChild<QLineEdit*>("faultAt");
    auto* open = find<QPushButton>(*dialog, "Open");
    for (const auto* refused : {"0", "3601", "nan", ""}) {
        after->setText(refused);
        EXPECT_FALSE(open->isEnabled()) << refused;
    }
    after->setText("4");  // seconds; the default is thirty
    click(*open);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    arm();
    window.controller().drive(DriveSource::Manual, 0.5, 1);
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }, 20'000));
    EXPECT_IN_TIME(comesTrue([this] { return banner().contains("Output is off"); })) << banner().toStdString();
}

TEST_F(ResultsInTheWindow, InLargeTextTheDialogsOfTheBenchFitASmallScreen) {
    open();
    gui::applyTextSize(200);
    window.resize(1280, 720);
    letLive(100);
    // tests/e2e tests where the dialogs stand on such a screen.
    const auto fits = [](QWidget& dialog) {
        EXPECT_IN_TIME(comesTrue([&] { return dialog.isVisible() && faultsOf(dialog).empty(); })) << faultsOf(dialog);
        EXPECT_LE(dialog.height(), 720);
        EXPECT_LE(dialog.width(), 1280);
        dialog.close();
    };
    window.askForDay(false);
    fits(*window.findChild<gui::DayDialog*>());
    window.askForSimulatedBench();
    auto* bench = window.findChild<gui::SimulatedBenchDialog*>();
    ASSERT_NE(bench, nullptr);
    fits(*bench);
    window.askToArm();
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_NE(second, nullptr);
    fits(*second->window());
}

TEST_F(ResultsInTheWindow, TheDrivePanelLooksRight) {
    open();
    visit(0);
    arm();
    auto* dock = window.findChild<QWidget*>("driveDock");
    ASSERT_NE(dock, nullptr);
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (const bool byHand : {true, false}) {
            if (byHand) {
                driveByHand(0.69, 0.8);
                // The output rises in steps, because the limits bound each step.
                ASSERT_IN_TIME(comesTrueWhileOn(
                    [&] { return dock->findChild<QLabel*>("driveOutput")->text().startsWith("30.7"); }, 60'000))
                    << banner().toStdString();
            } else {
                click(*find<QPushButton>(window, "driveFingertip"));
            }
            letLive(300);  // time for the panel to follow
            const auto file = QString("drive-%1-%2")
                                  .arg(theme == gui::Theme::Dark ? "dark" : "light", byHand ? "by-hand" : "fingertip");
            EXPECT_IN_TIME(comesTrue([&] { return faultsOf(*dock).empty(); })) << faultsOf(*dock);
            shot(*dock, file);
        }
    }
}

/// Makes the pictures of the README (./dev readme-pictures).
TEST_F(ResultsInTheWindow, TheReadmesPicturesLookRight) {
    open();
    auto* tabs = window.findChild<gui::TabbedPage*>("livePage");
    visit(0);
    arm();
    window.controller().drive(DriveSource::Sensor);
    window.controller().present("P120", 50, 1);
    const auto delivered = [this](std::uint64_t more) {
        const auto before = window.controller().telemetry().trainsDelivered;
        return comesTrue([&] { return window.controller().telemetry().trainsDelivered >= before + more; }, 60'000);
    };
    ASSERT_IN_TIME(delivered(12));
    EXPECT_EQ(faultsOf(window), "");
    const auto* plane = find<gui::TactilePlane>(window, "Tactile plane");
    EXPECT_EQ(plane->viewport().height(), plane->height()) << "drawn as high as it is";
    shot(window, "readme-window");
    driveByHand(0.96, 0.81);
    tabs->setCurrentIndex(1);
    gui::applyTheme(gui::Theme::Dark);
    ASSERT_IN_TIME(delivered(8));
    window.activateWindow();  // the arming dialog had the focus
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&window));
    key(Qt::Key_T);
    auto& model = window.findChild<gui::ScopeWorkspace*>()->model();
    ASSERT_TRUE(model.cursors().time_s());
    const double reach_s = model.viewport().width_s() / 50;
    model.dragTimeCursor(0, 0, reach_s);
    model.dragTimeCursor(1, 200e-6, reach_s);
    EXPECT_IN_TIME(comesTrue([this] { return faultsOf(window).empty(); })) << faultsOf(window);
    shot(window, "readme-oscilloscope");
}

}  // namespace
}  // namespace tacto::test
