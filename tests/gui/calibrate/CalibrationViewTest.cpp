// Tests how readings of a calibration are shown as they come: direction, outliers, tolerance bands.
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <gmock/gmock.h>
#include <random>

#include "app/gui/calibrate/CalibrationPlot.h"
#include "app/gui/calibrate/CalibrationReadings.h"
#include "app/gui/calibrate/CalibrationView.h"
#include "app/gui/calibrate/ToleranceCard.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::CalibrationPlot;
using testing::HasSubstr;
using Json = nlohmann::json;

Json reading(const char* condition, double commanded, double measured) {
    return {{"condition", condition},
            {"unit", "V"},
            {"amplitude", measured},
            {"width_s", 2e-4},
            {"instrument", {{"resolution", 0.025}}},
            {"commanded", {{"amplitude", commanded}, {"width_s", 2e-4}}}};
}

class View : public testing::Test {
protected:
    View() {
        view.resize(1000, 420);
        view.show();
        view.begin({{"tolerance_pct", 2.0}, {"timing_tolerance_pct", 1.0}});
    }
    [[nodiscard]] CalibrationPlot& errors() { return *view.findChild<CalibrationPlot*>("calibrationErrors"); }
    [[nodiscard]] CalibrationPlot& measured() { return *view.findChild<CalibrationPlot*>("calibrationMeasured"); }
    [[nodiscard]] std::string says() { return view.findChild<QLabel*>("calibrationSays")->text().toStdString(); }
    /// Sends five repeats of three levels in both directions, with one reading far off.
    void sweep() {
        for (int repeat = 0; repeat < 5; ++repeat) {
            for (const double volts : {10.0, 25.0, 40.0}) {
                const double wobble = 0.01 * (repeat - 2);
                view.add(reading("amplitude up", volts, 1.002 * volts + wobble));
                const bool odd = repeat == 3 && volts > 20 && volts < 30;
                view.add(reading("amplitude down", volts, 1.004 * volts + wobble + (odd ? 3 : 0)));
            }
        }
        view.draw();
    }
    gui::CalibrationView view;
};

TEST_F(View, NoLegendCoversAReadingOrAMean) {
    sweep();
    for (const auto& size : {QSize(1000, 420), QSize(1400, 700), QSize(700, 420)}) {
        view.resize(size);
        letLive(20);
        for (auto* plot : {&errors(), &measured()}) {
            view.findChild<QComboBox*>("calibrationPlotKind")->setCurrentIndex(plot == &measured());
            plot->replot(QCustomPlot::rpImmediateRefresh);
            const QRect legend = plot->legend->outerRect();
            ASSERT_FALSE(legend.isEmpty());
            EXPECT_TRUE(plot->axisRect()->rect().contains(legend)) << "it stands inside its plot";
            int points = 0;
            for (int g = 0; g < plot->graphCount(); ++g) {
                const auto* graph = plot->graph(g);
                if (graph->scatterStyle().isNone()) continue;
                for (const auto& point : *graph->data()) {
                    ++points;
                    const QPointF at(plot->xAxis->coordToPixel(point.key), plot->yAxis->coordToPixel(point.value));
                    EXPECT_FALSE(QRectF(legend).contains(at))
                        << plot->accessibleName().toStdString() << " at " << size.width() << ": " << point.key;
                }
            }
            EXPECT_GT(points, 20);
        }
    }
}

TEST_F(View, ThePlotThatIsShownIsCopiedAndSavedByButtons) {
    sweep();
    QGuiApplication::clipboard()->clear();
    auto* copy = find<QToolButton>(view, "Copy picture");
    ASSERT_NE(copy, nullptr);
    click(*copy);
    EXPECT_FALSE(QGuiApplication::clipboard()->image().isNull());
    EXPECT_NE(find<QToolButton>(view, "Save picture"), nullptr);
    auto* only = find<QToolButton>(view, "Plot only");
    ASSERT_NE(only, nullptr);
    QSignalSpy wanted(&view, &gui::CalibrationView::plotOnlyWanted);
    click(*only);
    EXPECT_EQ(wanted.count(), 1);
    shot(view, "calibrate-view-tools");
}

TEST_F(View, EachPlotHasItsOwnTitleAndLegend) {
    sweep();
    auto* title = view.findChild<QLabel*>("calibrationShown");
    EXPECT_EQ(title->text(), "Amplitude: residuals in their tolerance");
    view.findChild<QComboBox*>("calibrationPlotKind")->setCurrentIndex(1);
    EXPECT_EQ(title->text(), "Amplitude: measured against commanded");
    EXPECT_TRUE(measured().legend->visible());
    EXPECT_GE(measured().legend->itemCount(), 3);
    view.findChild<QComboBox*>("calibrationPlotKind")->setCurrentIndex(0);
    EXPECT_EQ(title->text(), "Amplitude: residuals in their tolerance");
}

TEST_F(View, WaysAreToldApartAndWhatStandsOutIsMarkedAndKept) {
    shot(view, "calibrate_view_empty");
    sweep();
    EXPECT_EQ(view.readings(), 30U);
    for (auto* plot : {&errors(), &measured()}) {
        EXPECT_EQ(plot->drawnUp(), 15);
        EXPECT_EQ(plot->drawnDown(), 15);
        EXPECT_EQ(plot->drawnMarked(), 1);
    }
    ASSERT_TRUE(errors().hasBand());
    EXPECT_EQ(errors().bandReach(), errors().xAxis->range()) << "to the plot's edges";
    EXPECT_TRUE(measured().hasLine());
    EXPECT_THAT(says(), HasSubstr("marked and kept"));
    letLive(20);  // drawn in the next turn of the event loop
    shot(view, "calibrate_view");
}

TEST_F(View, TheFirstReadingIsDrawnBeforeThereIsALine) {
    view.add(reading("amplitude up", 10, 10.02));
    view.draw();
    EXPECT_EQ(errors().drawnUp(), 1);
    EXPECT_FALSE(measured().hasLine());
    EXPECT_THAT(says(), testing::Not(HasSubstr("gain")));
}

TEST_F(View, AReadingThatWasNotMeasuredIsCountedAndNotDrawn) {
    RecordProperty("hazard", "H9");
    auto none = reading("amplitude up", 10, 0);
    none["amplitude"] = nullptr;
    view.add(none);
    view.draw();
    EXPECT_EQ(view.readings(), 1U);
    EXPECT_EQ(errors().drawnUp(), 0);
}

TEST_F(View, FollowsTheRunUntilOneIsChosen) {
    sweep();
    view.add(reading("width up", 40, 40));
    view.draw();
    EXPECT_EQ(view.quantityShown(), "Phase width");
    letLive(20);  // time for the layout
    auto* amplitude = find<gui::ToleranceCard>(view, "Amplitude");
    ASSERT_NE(amplitude, nullptr);
    click(*amplitude);
    EXPECT_EQ(errors().drawnUp(), 15);
    view.add(reading("gap up", 40, 40));
    view.draw();
    EXPECT_EQ(view.quantityShown(), "Amplitude");
}

TEST_F(View, LowItsCardsAreOneLineSoThatThePlotHasTheRoom) {
    sweep();
    auto* card = view.findChild<gui::ToleranceCard*>();
    ASSERT_NE(card, nullptr);
    view.resize(1000, 900);
    EXPECT_IN_TIME(comesTrue([&] { return card->height() >= 80; })) << card->height();
    view.resize(1000, 560);
    EXPECT_IN_TIME(comesTrue([&] { return card->height() > 40 && card->height() < 70; }))
        << card->height() << ": two lines say the same";
    shot(view, "calibrate-view-two-lines");
    view.resize(1000, 420);
    EXPECT_IN_TIME(comesTrue([&] { return card->height() <= 40; })) << card->height();
    EXPECT_GE(errors().height(), 340);
}

TEST_F(View, AnEmptyPlotSaysWhyItIsEmpty) {
    const auto said = [&] {
        QString all;
        for (int i = 0; i < errors().itemCount(); ++i) {
            const auto* text = qobject_cast<QCPItemText*>(errors().item(i));
            if (text != nullptr && text->visible()) all += text->text();
        }
        return all.toStdString();
    };
    EXPECT_THAT(said(), HasSubstr("appears here"));
    for (const Json& results : {Json(), Json::object({{"kind", "stimulator-calibration"}}), Json::array({1, 2})}) {
        view.end(results);
        EXPECT_THAT(said(), HasSubstr("before a level was read"));
    }
    view.begin({{"tolerance_pct", 2.0}});
    EXPECT_THAT(said(), HasSubstr("appears here")) << "for the next run";
    sweep();
    EXPECT_EQ(said(), "");
}

TEST_F(View, OtherTrialsAreNone) {
    EXPECT_EQ(gui::calibratedQuantity({{"condition", "rough-high"}, {"amplitude_v", 30}}), "");
    EXPECT_EQ(gui::calibratedQuantity({{"condition", "amplitude up"}, {"commanded", 30}}), "");
    EXPECT_EQ(gui::calibratedQuantity(reading("gap down", 1, 1)), "gap");
}

TEST_F(View, AResultShowsTheQuantityThatUsesMostOfItsTolerance) {
    const auto found = [](const char* unit, double command, double error, double tolerance) {
        const Json level{{"commanded", command}, {"mean", command + error},         {"expanded_uncertainty", 0},
                         {"worst_error", error}, {"worst_expanded_uncertainty", 0}, {"tolerance", tolerance}};
        return Json{{"unit", unit},
                    {"gain", 1.0},
                    {"verdict", "pass"},
                    {"levels", Json::array({level})},
                    {"readings", Json::array({{{"commanded", command}, {"measured", command}, {"direction", "up"}}})}};
    };
    sweep();
    view.end({{"amplitude", found("V", 10, 0.06, 0.2)}, {"width", found("s", 1e-4, 0.4e-6, 1e-6)}});
    EXPECT_EQ(view.quantityShown(), "Phase width") << "40 % against 30 %";
}

TEST_F(View, ACheckShowsErrorUAndToleranceOfEachQuantityFromTheStoredLine) {
    RecordProperty("hazard", "H9");
    std::mt19937 random(4908);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int draw = 0; draw < 8; ++draw) {
        view.begin({{"tolerance_pct", 2.0}, {"timing_tolerance_pct", 1.0}});
        const double gain = between(0.9, 1.1), offset = between(-0.5, 0.5);
        Json rows = Json::array();
        double most = 0, mostAt = 0;
        for (const double volts : {10.0, 25.0, 40.0}) {
            const double expected = gain * volts + offset, off = between(-0.1, 0.1), u = between(0.01, 0.09);
            view.add(reading("amplitude up", volts, expected + off));
            view.add(reading("amplitude down", volts, expected + off));
            rows.push_back({{"quantity", "amplitude"},
                            {"unit", "V"},
                            {"commanded", volts},
                            {"expected", expected},
                            {"off", off},
                            {"measured", expected + off},
                            {"expanded_uncertainty", u},
                            {"allowed", 0.02 * volts},
                            {"verdict", "pass"}});
            const double share = (std::abs(off) + u) / (0.02 * volts);
            if (share <= most) continue;
            most = share;
            mostAt = volts;
        }
        // Times are stated in µs, and plotted in the axis' own unit.
        for (const double us : {100.0, 400.0}) {
            view.add(reading("width up", us * 1e-6, us * 1e-6));
            rows.push_back({{"quantity", "width"},
                            {"unit", "us"},
                            {"commanded", us},
                            {"expected", us},
                            {"off", 0.001 * us},
                            {"measured", 1.001 * us},
                            {"expanded_uncertainty", 0.0},
                            {"allowed", 0.01 * us},
                            {"verdict", "pass"}});
        }
        view.end({{"kind", "stimulator-calibration"}, {"type", "check"}, {"check", rows}, {"verdict", "pass"}});
        letLive(20);  // time for the layout
        const auto used = QString::number(100 * most, 'f', 0).toStdString() + "\u202f%";
        auto* amplitude = find<gui::ToleranceCard>(view, "Amplitude");
        ASSERT_NE(amplitude, nullptr);
        EXPECT_THAT(amplitude->accessibleDescription().toStdString(), HasSubstr(used + " of the tolerance used"));
        EXPECT_THAT(find<gui::ToleranceCard>(view, "Phase width")->accessibleDescription().toStdString(),
                    HasSubstr("10\u202f% of the tolerance used"));
        click(*amplitude);
        EXPECT_EQ(errors().drawnMeans(), 3);
        EXPECT_THAT(errors().nearestShown().toStdString(), HasSubstr(used));
        EXPECT_THAT(errors().nearestShown().toStdString(),
                    testing::StartsWith(QString::number(mostAt).toStdString() + "\u202fV:"));
        EXPECT_THAT(says(), HasSubstr("the calibration checked"));
        EXPECT_THAT(errors().yAxis->label().toStdString(), HasSubstr("as calibrated"));
        for (int g = 0; g < errors().graphCount(); ++g) {
            if (!errors().graph(g)->name().startsWith("going")) continue;
            for (const auto& point : *errors().graph(g)->data())
                EXPECT_LE(std::abs(point.value), errors().yAxis->label().contains("mV") ? 101 : 0.101)
                    << "errors count from what was calibrated, whatever its gain and offset";
        }
        if (draw == 0) shot(view, "calibrate_view_check");
    }
}

TEST_F(View, TheResultHasTheLastWord) {
    sweep();
    Json levels = Json::array();
    for (const double volts : {10.0, 25.0, 40.0})
        levels.push_back({{"commanded", volts},
                          {"mean", 1.003 * volts},
                          {"expanded_uncertainty", 0.1},
                          {"worst_error", 0.003 * volts},
                          {"worst_expanded_uncertainty", 0.07},
                          {"tolerance", 0.02 * volts}});
    view.end(
        {{"amplitude",
          {{"unit", "V"},
           {"gain", 1.003},
           {"gain_expanded_uncertainty", 0.0047},
           {"offset", 0.018},
           {"offset_expanded_uncertainty", 0.049},
           {"tolerance_pct", 2.0},
           {"verdict", "pass"},
           {"levels", levels},
           {"readings",
            Json::array({{{"commanded", 10.0}, {"measured", 10.03}, {"direction", "up"}, {"outlier", true}},
                         {{"commanded", 40.0}, {"measured", 40.1}, {"direction", "down"}, {"outlier", false}}})}}}});
    EXPECT_THAT(says(), HasSubstr("gain 1.0030 ± 0.0047 · offset 18 ± 49"));
    EXPECT_EQ(errors().drawnMeans(), 3);
    EXPECT_EQ(errors().drawnUp(), 1);
    EXPECT_EQ(errors().drawnMarked(), 1);
    // (0.03 + 0.07) of 0.2 V at 10 V is 50 %; less at the other levels.
    EXPECT_THAT(errors().nearestShown().toStdString(), HasSubstr("50\u202f% used"));
    EXPECT_THAT(errors().nearestShown().toStdString(), HasSubstr("10\u202fV:"));
    letLive(20);  // time for the layout
    auto* card = find<gui::ToleranceCard>(view, "Amplitude");
    ASSERT_NE(card, nullptr);
    EXPECT_THAT(card->accessibleDescription().toStdString(), HasSubstr("50\u202f% of the tolerance used"));
    EXPECT_THAT(card->accessibleDescription().toStdString(), HasSubstr("pass"));
    letLive(20);
    shot(view, "calibrate_view_result");
}

}  // namespace
}  // namespace tacto::test
