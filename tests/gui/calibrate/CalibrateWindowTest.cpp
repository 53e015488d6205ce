// Tests what the safety bar says about the calibration, in the whole window.
#include <QScrollArea>
#include <QScrollBar>
#include <QTreeWidget>
#include <gmock/gmock.h>

#include "app/gui/calibrate/CalibrationPlot.h"
#include "app/gui/calibrate/ToleranceCard.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/calibrate/CalibrationLab.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class CalibrateWindow : public Window {
protected:
    [[nodiscard]] QLabel& label() { return *window.findChild<QLabel*>("calibrationAge"); }
    [[nodiscard]] std::string says() { return label().text().toStdString(); }
    /// True if the label on the screen contains the warning colour.
    [[nodiscard]] bool warns() {
        const auto drawn = label().grab().toImage();
        const auto amber = gui::colours().amberText;
        for (int y = 0; y < drawn.height(); ++y) {
            for (int x = 0; x < drawn.width(); ++x) {
                const auto pixel = drawn.pixelColor(x, y);
                const int off = std::abs(pixel.red() - amber.red()) + std::abs(pixel.green() - amber.green()) +
                                std::abs(pixel.blue() - amber.blue());
                if (off < 60) return true;
            }
        }
        return false;
    }

private:
    OwnDataHome home_;
};

TEST_F(CalibrateWindow, NotCalibratedWarnsAndTeaches) {
    RecordProperty("hazard", "H1");
    open();
    EXPECT_EQ(says(), "⚠ not calibrated");
    EXPECT_TRUE(warns());
    EXPECT_THAT(label().toolTip().toStdString(), HasSubstr("bench loads only"));
}

TEST_F(CalibrateWindow, AnExpiredOneWarns) {
    RecordProperty("hazard", "H1");
    store(calibration(400, 365));
    open();
    ASSERT_IN_TIME(comesTrue([this] { return says() == "⚠ calibration expired 35 d ago"; })) << says();
    EXPECT_TRUE(warns());
    window.resize(1024, 640);
    window.showWorkspace(1);
    letLive(100);
    shot(window, "calibrate_window_small");
    gui::applyTheme(gui::Theme::Dark);
    ASSERT_IN_TIME(comesTrue([this] { return warns(); }));
    shot(window, "calibrate_window_small_dark");
}

TEST_F(CalibrateWindow, TheDeviceDockSaysTheSameAsTheSafetyBar) {
    RecordProperty("hazard", "H9");
    store(calibration(0, 365));
    open();
    ASSERT_IN_TIME(comesTrue([this] { return says().rfind("calibrated until ", 0) == 0; })) << says();
    auto* devices = window.findChild<QTreeWidget*>();
    const auto facts = [this] { return window.findChild<QLabel*>("deviceFacts")->text(); };
    bool said = false;
    for (int i = 0; i < devices->topLevelItemCount(); ++i) {
        devices->setCurrentItem(devices->topLevelItem(i));
        EXPECT_FALSE(facts().contains("not calibrated", Qt::CaseInsensitive)) << facts().toStdString();
        said = said || facts().contains("Calibrated today, until ");
    }
    EXPECT_TRUE(said);
}

TEST_F(CalibrateWindow, ARunTurnsTheWord) {
    RecordProperty("hazard", "H1");
    open();
    ASSERT_EQ(says(), "⚠ not calibrated");
    window.showWorkspace(1);
    auto* calibrate = find<QPushButton>(window, "runButton");
    ASSERT_NE(calibrate, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return calibrate->isEnabled(); }));
    window.findChild<QLineEdit*>("warm_up_s")->setText("0");
    bool over = false;
    QObject::connect(&window.controller(), &gui::BenchController::finished, &window, [&] { over = true; });
    click(*calibrate);
    ASSERT_IN_TIME(comesTrue([&] { return over; }, 90'000));
    letLive(100);
    shot(window, "calibrate_window_done");
    window.resize(1280, 720);
    auto* errors = find<gui::CalibrationPlot>(window, "calibrationErrors");
    ASSERT_NE(errors, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return window.size() == QSize(1280, 720); }))
        << window.width() << " x " << window.height();
    EXPECT_IN_TIME(comesTrue([&] { return errors->height() >= 300; })) << errors->height();
    EXPECT_GE(errors->width(), 800);
    const auto inSight = [this](const char* text) {
        auto* button = find<QPushButton>(window, text);
        return button != nullptr && button->visibleRegion() == QRegion(button->rect());
    };
    EXPECT_IN_TIME(comesTrue([&] { return inSight("Sign report…"); })) << "what comes next stands below the plot";
    const auto frame = [errors] { return errors->axisRect()->rect().height(); };
    EXPECT_IN_TIME(comesTrue([&] { return frame() >= 300; })) << frame() << " px for the residuals, with it in sight";
    // However long the text is, no line of it is cut in half.
    auto* more = find<QLabel>(window, "verdictMore");
    const auto before = more->text();
    more->setText(QStringList(12, "Not evaluated: the width, whose uncertainty is not known.").join('\n'));
    window.resize(1280, 721);
    window.resize(1281, 720);
    EXPECT_IN_TIME(comesTrue([&] { return window.width() == 1281 && frame() >= 300; })) << frame() << " px beside it";
    const auto* reasons = find<QScrollArea>(window, "verdictReasons");
    const int rest = reasons->viewport()->height() - find<QLabel>(window, "verdictWhy")->height();
    EXPECT_EQ(rest % more->fontMetrics().lineSpacing(), 0) << rest;
    EXPECT_TRUE(reasons->verticalScrollBar()->isVisible());
    shot(window, "calibrate_window_1280_much_to_say");
    more->setText(before);
    window.resize(1280, 720);
    for (const auto* card : window.findChildren<gui::ToleranceCard*>()) {
        if (!card->isVisible()) continue;
        EXPECT_IN_TIME(comesTrue([&] { return card->wordedWidth() <= card->width(); }))
            << card->text().toStdString() << " has the verdict's shape without its word: " << card->width() << " of "
            << card->wordedWidth() << " px";
    }
    letLive(100);
    shot(window, "calibrate_window_1280");
    gui::applyTheme(gui::Theme::Dark);
    letLive(100);
    shot(window, "calibrate_window_1280_dark");
    gui::applyTheme(gui::Theme::Light);
    window.resize(1920, 1080);
    letLive(200);
    shot(window, "calibrate_window_1920");
    click(*find<QPushButton>(window, "Open session"));
    EXPECT_EQ(window.workspace(), 5);
    window.showWorkspace(1);
    click(*find<QPushButton>(window, "Go to safety check"));
    EXPECT_EQ(window.workspace(), 2);
    window.resize(1280, 720);
    letLive(200);
    shot(window, "safety_window_1280");
    open();
    ASSERT_IN_TIME(comesTrue([this] { return says().rfind("calibrated until ", 0) == 0; })) << says();
    EXPECT_FALSE(warns());
    const auto* age = window.findChild<QLabel*>("calibrationAge");
    EXPECT_LE(age->fontMetrics().horizontalAdvance(age->text()), age->width()) << "the year is not cut";
}

}  // namespace
}  // namespace tacto::test
