// Tests the Calibrate workspace on the simulated bench: from "never" to "calibrated today", and a check afterwards.
#include <QComboBox>
#include <QTest>
#include <QTimer>
#include <gmock/gmock.h>

#include "app/gui/calibrate/CalibrateWorkspace.h"
#include "app/gui/calibrate/CalibrationPlot.h"
#include "app/gui/calibrate/CalibrationView.h"
#include "app/gui/calibrate/CertificatePart.h"
#include "app/gui/calibrate/ToleranceCard.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/runner/StepButton.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/calibrate/CalibrationLab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

class Calibrate : public testing::Test {
protected:
    Calibrate() {
        QObject::connect(&controller, &gui::BenchController::finished,
                         [this](std::shared_ptr<const gui::FinishedRun> run) { ended = std::move(run); });
        QObject::connect(&frame, &QTimer::timeout, [this] {
            for (auto* runner : workspace.runners()) runner->refresh();
            drawnWhileRunning = std::max(drawnWhileRunning, drawn());
        });
        frame.start(33);
    }
    void show(QSize size) {
        workspace.resize(size);
        workspace.show();
        ASSERT_IN_TIME(comesTrue([this] { return workspace.runner().ready(); }));
    }
    /// The only button that starts a run.
    [[nodiscard]] QPushButton& run() { return *workspace.runner().findChild<QPushButton*>("runButton"); }
    template <class T>
    [[nodiscard]] T& the(const char* name) {
        T* found = nullptr;
        if (!comesTrue([&] { return (found = find<T>(workspace, name)) != nullptr; }))
            throw std::runtime_error(std::string("nothing visible is called ") + name);
        return *found;
    }
    [[nodiscard]] QPushButton* button(const char* name) { return workspace.findChild<QPushButton*>(name); }
    [[nodiscard]] std::string says(const char* label) {
        return workspace.findChild<QLabel*>(label)->text().toStdString();
    }
    [[nodiscard]] std::size_t drawn() {
        if (controller.activity() != gui::Activity::Running) return 0;
        return workspace.runner().findChild<gui::CalibrationView*>()->readings();
    }
    void type(const char* field, const QString& text) {
        workspace.runner().findChild<QLineEdit*>(field)->setText(text);
    }
    void withoutWarmUp() { type("warm_up_s", "0"); }
    [[nodiscard]] bool ends() {
        return comesTrue([this] { return ended != nullptr; }, 90'000) && ended->result.outcome.error == std::nullopt;
    }
    OwnDataHome home;
    gui::BenchController controller{simulatedRegistry};
    gui::CalibrationBook book{controller};
    gui::CalibrateWorkspace workspace{controller, book};
    std::shared_ptr<const gui::FinishedRun> ended;
    std::size_t drawnWhileRunning = 0;
    QTimer frame;
};

TEST_F(Calibrate, FromNeverToCalibratedAndChecked) {
    RecordProperty("hazard", "H1");
    show({1300, 820});
    EXPECT_THAT(says("calibrationState"), HasSubstr("No stimulator has been open yet"));
    EXPECT_FALSE(button("checkButton")->isEnabled());
    shot(workspace, "calibrate_first");
    const auto note = [this] { return the<gui::StepButton>("Settings").accessibleDescription().toStdString(); };
    EXPECT_THAT(note(), EndsWith("defaults")) << "what the page proposes is no change";
    withoutWarmUp();
    EXPECT_THAT(note(), EndsWith("1 changed"));
    auto& certificate = *workspace.runner().findChild<gui::CertificatePart*>();
    const auto* field = workspace.runner().findChild<QLineEdit*>("warm_up_s");
    EXPECT_LT(certificate.mapTo(&workspace, QPoint()).y(), field->mapTo(&workspace, QPoint()).y()) << "it is seen";
    click(*certificate.findChild<QPushButton*>("certificateDetails"));
    auto& form = *certificate.findChild<gui::CertificateForm*>();
    form.findChild<QLineEdit*>("customer")->setText("The customer of this item alone");
    click(*find<QPushButton>(form, "Keep"));
    click(run());
    EXPECT_FALSE(button("calibrateButton")->isEnabled());
    ASSERT_IN_TIME(ends()) << (ended ? ended->result.outcome.error->message : "it did not end");
    EXPECT_EQ(ended->result.verdict(), "pass");
    EXPECT_FALSE(ended->order.certificateDetails.empty());
    RunOrder next;
    certificate.fill(next);
    EXPECT_TRUE(next.certificateDetails.empty()) << "the next item has another customer";
    EXPECT_GT(drawnWhileRunning, 0U);
    EXPECT_THAT(says("calibrationState"), HasSubstr("✔ calibrated today, until "));
    EXPECT_THAT(says("calibrationFacts"), HasSubstr("simulated oscilloscope"));
    EXPECT_EQ(workspace.findChild<QTableWidget*>("calibrationHistory")->rowCount(), 1);
    auto* errors = workspace.runner().findChild<gui::CalibrationPlot*>("calibrationErrors");
    EXPECT_EQ(errors->drawnUp(), 55);
    EXPECT_EQ(errors->drawnDown(), 55);
    EXPECT_EQ(errors->drawnMeans(), 11);
    const auto tableOf = [&](const char* title) {
        const auto all = workspace.runner().findChildren<QTableWidget*>();
        const auto at = std::ranges::find(all, QString(title), &QTableWidget::accessibleName);
        return at == all.end() ? nullptr : *at;
    };
    const auto* budget = tableOf("Amplitude: uncertainty at the largest command");
    const auto* levels = tableOf("Amplitude: levels");
    ASSERT_TRUE(budget != nullptr && levels != nullptr);
    EXPECT_EQ(budget->item(0, 0)->text(), "repeatability");
    EXPECT_EQ(levels->rowCount(), 11);
    EXPECT_THAT(workspace.runner().findChild<QLabel*>("verdictWhy")->text().toStdString(),
                HasSubstr("of its tolerance at"));
    const auto more = workspace.runner().findChild<QLabel*>("verdictMore")->text().toStdString();
    EXPECT_THAT(more, HasSubstr("before this run it was not."));
    EXPECT_THAT(more, HasSubstr("Calibrated until 20"));
    EXPECT_THAT(more, Not(HasSubstr("(-"))) << "minus signs, as in the report";
    EXPECT_THAT(more, Not(HasSubstr("is not calibrated")));
    letLive(20);  // drawn in the next turn of the event loop
    shot(workspace, "calibrate_done");
    // The box that chooses the plot is in the row of tabs, and visible only with the plot.
    const auto* kind = workspace.findChild<QWidget*>("tabRow")->findChild<QComboBox*>();
    EXPECT_TRUE(kind->isVisible());
    EXPECT_LT(kind->mapTo(&workspace, QPoint(0, kind->height())).y(), errors->mapTo(&workspace, QPoint()).y() - 60);
    const auto first = workspace.runner().findChild<QLabel*>("verdictWhy")->text().section(':', 0, 0);
    EXPECT_EQ(errors->xAxis->label().section(" (", 0, 0), "Commanded " + first.toLower())
        << "the plot is of what the first reason is about";
    click(the<gui::StepButton>("Settings"));
    EXPECT_FALSE(kind->isVisible());
    click(the<gui::StepButton>("Result"));
    EXPECT_TRUE(kind->isVisible());
    gui::applyTheme(gui::Theme::Dark);
    letLive(20);
    shot(workspace, "calibrate_done_dark");

    // Then the short run, which stores nothing.
    ended = nullptr;
    ASSERT_IN_TIME(comesTrue([this] { return button("checkButton")->isEnabled(); }));
    click(the<QPushButton>("Run check"));
    ASSERT_IN_TIME(ends());
    EXPECT_EQ(ended->result.verdict(), "pass");
    EXPECT_EQ(workspace.findChild<QTableWidget*>("calibrationHistory")->rowCount(), 1);
    EXPECT_EQ(errors->drawnUp() + errors->drawnDown(), 12);
    EXPECT_EQ(errors->drawnMeans(), 3) << "each level checked, with its U";
    EXPECT_FALSE(errors->nearestShown().isEmpty());
    const auto cards = workspace.runner().findChildren<gui::ToleranceCard*>();
    EXPECT_EQ(cards.size(), 4);
    for (const auto* card : cards)
        EXPECT_THAT(card->accessibleDescription().toStdString(), HasSubstr("of the tolerance used"));
    letLive(20);
    shot(workspace, "calibrate_checked_dark");
}

TEST_F(Calibrate, TheFingertipSensorHasARunOfItsOwn) {
    RecordProperty("hazard", "H7");
    show({1300, 820});
    auto* tabs = workspace.findChild<gui::TabbedPage*>("calibratePages");
    tabs->setCurrentIndex(1);
    ASSERT_IN_TIME(comesTrue([this] { return workspace.runners()[1]->ready(); }));
    letLive(50);
    shot(workspace, "calibrate_sensor");
    workspace.runners()[1]->runAsked();
    ASSERT_IN_TIME(ends()) << (ended ? ended->result.outcome.error->message : "it did not end");
    EXPECT_EQ(ended->order.script.name, "sensor-calibration");
    EXPECT_EQ(ended->result.verdict(), "pass");
    EXPECT_EQ(tabs->currentIndex(), 1);
    auto* plane = workspace.runners()[1]->findChild<gui::TrialPlane*>();
    EXPECT_TRUE(plane->isVisible());
    EXPECT_GE(plane->drawn(), 10) << "a point per slide";
    EXPECT_GT(plane->graphCount(), 1) << "surface by surface";
    EXPECT_GT(plane->yAxis->range().upper, 0);
    EXPECT_FALSE(workspace.runners()[1]->findChild<gui::CaptureStrip*>()->isVisible()) << "there is no oscilloscope";
    shot(workspace, "calibrate_sensor_done");
    ASSERT_FALSE(controller.profile().roughness.calibrated);
    click(the<QPushButton>("Use this profile"));
    EXPECT_IN_TIME(comesTrue([this] { return controller.profile().roughness.calibrated; }));
    EXPECT_THAT(controller.profile().name, HasSubstr("SIM-1"));
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disconnected) << "a profile arms nothing";
}

TEST_F(Calibrate, TheCardLeadsToTheSettingsAndStartsNothing) {
    RecordProperty("hazard", "H12");
    show({1300, 820});
    workspace.findChild<gui::TabbedPage*>("calibratePages")->setCurrentIndex(2);
    click(the<QPushButton>("calibrateButton"));
    EXPECT_TRUE(the<gui::StepButton>("Settings").isChecked());
    EXPECT_FALSE(workspace.runner().running());
    EXPECT_TRUE(run().isVisible());
}

TEST_F(Calibrate, AnExpiredOneWarnsAndCannotBeChecked) {
    RecordProperty("hazard", "H1");
    store(calibration(400, 365));
    show({760, 500});
    auto* pages = workspace.findChild<gui::TabbedPage*>("calibratePages");
    pages->setCurrentIndex(2);
    EXPECT_THAT(says("calibrationState"), HasSubstr("⚠ calibration expired 35 d ago"));
    EXPECT_FALSE(button("checkButton")->isEnabled());
    EXPECT_LE(workspace.width(), 760);
    shot(workspace, "calibrate_expired_small");
    pages->setCurrentIndex(0);
    withoutWarmUp();
    click(run());
    ASSERT_IN_TIME(ends());
    EXPECT_THAT(says("calibrationState"), HasSubstr("✔ calibrated today"));
    EXPECT_EQ(workspace.findChild<QTableWidget*>("calibrationHistory")->rowCount(), 2);
    letLive(20);  // drawn in the next turn of the event loop
    EXPECT_LE(workspace.minimumSizeHint().width(), 760) << "the window would be widened with one of the next events";
    EXPECT_LE(workspace.width(), 760);
    shot(workspace, "calibrate_done_small");
}

TEST_F(Calibrate, AWrongLoadStoresNothing) {
    RecordProperty("hazard", "H9");
    show({1000, 640});
    withoutWarmUp();
    type("load", "1000");
    workspace.runner().findChild<QLineEdit*>("devices")->setText("sim:stimulator?load=2kohm sim:");
    click(run());
    ASSERT_IN_TIME(comesTrue([this] { return ended != nullptr; }, 60'000));
    EXPECT_NE(ended->result.verdict(), "pass");
    EXPECT_FALSE(std::filesystem::exists(calibrationFile()));
    EXPECT_THAT(says("calibrationState"), HasSubstr("⚠ not calibrated"));
    shot(workspace, "calibrate_wrong_load");
}

/// Sets the text size before any text is measured, as the program does.
class LargeText {
protected:
    LargeText() { gui::applyTextSize(200); }
    ~LargeText() { gui::applyTextSize(100); }
};
class CalibrateInLargeText : private LargeText, public Calibrate {};

TEST_F(CalibrateInLargeText, FitsALargeWindow) {
    store(calibration(12, 365));
    show({1600, 1000});
    letLive(50);  // the page needs another layout
    EXPECT_LE(workspace.width(), 1600);
    shot(workspace, "calibrate_200");
}

TEST_F(Calibrate, TheWiringIsDrawnBeforeTheRun) {
    show({1024, 640});
    click(the<gui::StepButton>("Wiring"));
    const auto* drawing = workspace.runner().findChild<QLabel*>("wiringDrawing");
    ASSERT_NE(drawing, nullptr);
    EXPECT_TRUE(drawing->isVisible());
    EXPECT_IN_TIME(comesTrue([&] { return drawing->visibleRegion().boundingRect().size() == drawing->size(); }))
        << "the whole of it is in sight";
    shot(workspace, "calibrate_wiring");
    gui::applyTheme(gui::Theme::Dark);
    const auto ink = [&] {
        return pixelsOf(workspace.grab(QRect(drawing->mapTo(&workspace, QPoint()), drawing->size())).toImage(),
                        gui::colours().text);
    };
    EXPECT_IN_TIME(comesTrue([&] { return ink() > 500; })) << "in the theme's ink";
    EXPECT_EQ(
        pixelsOf(workspace.grab(QRect(drawing->mapTo(&workspace, QPoint()), drawing->size())).toImage(), Qt::white), 0)
        << "no white sheet";
    shot(workspace, "calibrate_wiring_dark");
}

}  // namespace
}  // namespace tacto::test
