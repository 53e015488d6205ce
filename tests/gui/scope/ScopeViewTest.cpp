// The oscilloscope's screen, driven by mouse and keys on captures whose truth is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/look/Look.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using gui::Grip;
using gui::ScopeView;
using gui::Viewport;
using testing::HasSubstr;

class Screen : public testing::Test {
protected:
    Screen() {
        view.resize(1000, 600);
        view.QWidget::show();
        view.show(prepared(twoPulses()));
        draw();
    }
    void draw() { view.replot(QCustomPlot::rpImmediateRefresh); }
    gui::LaneInfo laneOf(const QString& key) {
        for (const auto& lane : view.lanes()) {
            if (lane.key == key) return lane;
        }
        return {};
    }
    QPoint letterOf(const QString& key) { return at(view, 0.1, laneOf(key).scale.position); }

    ScopeView view;
    const QString volts = "channel/voltage";
    const QString amps = "channel/current";
};

TEST_F(Screen, FitsTheWholeRecordAroundItsTriggerInStepsOfOneTwoFive) {
    EXPECT_NEAR(view.viewport().left_s, -1e-3, 1e-5);
    EXPECT_DOUBLE_EQ(view.viewport().perDivision_s, 1e-3);
    const auto v = laneOf(volts), i = laneOf(amps);
    EXPECT_DOUBLE_EQ(v.scale.perDivision, 20) << "80 V in about four divisions";
    EXPECT_DOUBLE_EQ(i.scale.perDivision, 20e-3);
    EXPECT_GT(v.scale.position, 0) << "voltage above";
    EXPECT_LT(i.scale.position, 0) << "current below";
    shot(view, "view");
}

TEST_F(Screen, TheWheelZoomsTimeAroundTheMouseAndCtrlZGoesBack) {
    const Viewport before = view.viewport();
    const auto where = atTime(view, 0, 2);
    turnWheel(view, where, 1);
    EXPECT_DOUBLE_EQ(view.viewport().perDivision_s, 0.5e-3);
    EXPECT_NEAR((where - atTime(view, 0, 2)).x(), 0, 3) << "what is under the mouse stays there";
    turnWheel(view, where, 1);
    EXPECT_DOUBLE_EQ(view.viewport().perDivision_s, 0.2e-3);
    QTest::keyClick(&view, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(view.viewport(), before) << "one turn of the wheel is undone whole";
    QTest::keyClick(&view, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(view.viewport(), before) << "there is nothing before";
}

TEST_F(Screen, CtrlWheelZoomsTheLevelOfTheActiveLaneOnly) {
    const auto other = laneOf(amps).scale;
    turnWheel(view, at(view, 5, laneOf(volts).scale.position), 1, Qt::ControlModifier);
    EXPECT_DOUBLE_EQ(laneOf(volts).scale.perDivision, 10);
    EXPECT_EQ(laneOf(amps).scale, other);
    EXPECT_DOUBLE_EQ(view.viewport().perDivision_s, 1e-3);
}

TEST_F(Screen, DraggingPansAndADoubleClickFits) {
    const Viewport before = view.viewport();
    drag(view, at(view, 5, 3.5), at(view, 3, 2.5));
    EXPECT_NEAR(view.viewport().left_s - before.left_s, 2e-3, 3e-5);
    EXPECT_NEAR(laneOf(volts).scale.position - before.lanes.at(volts).position, -1, 0.05);
    QTest::mouseDClick(&view, Qt::LeftButton, {}, at(view, 5, 3.5));
    EXPECT_EQ(view.viewport(), before);
    QTest::keyClick(&view, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_NE(view.viewport(), before) << "a fit can be undone too";
}

TEST_F(Screen, ABoxBecomesTheScreen) {
    const Viewport before = view.viewport();
    const auto lane = laneOf(volts).scale;
    drag(view, atTime(view, -0.1e-3, lane.position + 0.98), atTime(view, 0.6e-3, lane.position - 0.98),
         Qt::ShiftModifier);
    EXPECT_DOUBLE_EQ(view.viewport().perDivision_s, 0.1e-3);
    EXPECT_LE(view.viewport().left_s, -0.1e-3 + 2e-5);
    EXPECT_GE(view.viewport().right_s(), 0.6e-3 - 2e-5);
    EXPECT_DOUBLE_EQ(laneOf(volts).scale.perDivision, 5) << "40 V on eight divisions";
    EXPECT_TRUE(view.undoZoom());
    EXPECT_EQ(view.viewport(), before);
}

TEST_F(Screen, ALanesLetterDragsItsOffsetAndMakesItActive) {
    const double before = laneOf(amps).scale.position;
    drag(view, letterOf(amps), letterOf(amps) - QPoint(0, view.axisRect()->height() / 8));
    EXPECT_NEAR(laneOf(amps).scale.position, before + 1, 0.05);
    EXPECT_EQ(view.activeLane(), amps);
}

TEST_F(Screen, AClickOnATracePicksItsLane) {
    QTest::mouseClick(&view, Qt::LeftButton, {}, at(view, 8, laneOf(amps).scale.position));
    EXPECT_EQ(view.activeLane(), amps);
}

TEST_F(Screen, TimeCursorsSnapToEdgesAndReadWhatIsBetween) {
    view.setTimeCursors(true);
    draw();
    const auto grab = [&](int cursor, double to_s) {
        const auto& place = view.overlay().timeCursors_s[static_cast<std::size_t>(cursor)];
        drag(view, atTime(view, place, 3), atTime(view, to_s, 3));
    };
    grab(0, 0.02e-3);  // two pixels off the first onset
    grab(1, 3.98e-3);  // and off the second pulse's
    const auto read = view.readout();
    EXPECT_NEAR(read.dx_s(), 4e-3, 1e-7);
    EXPECT_NEAR(1 / read.dx_s(), 250, 0.01);
    EXPECT_NEAR(read.x1_s, 0, 1e-7);
    EXPECT_EQ(read.unit, "V");
    shot(view, "cursors");
}

TEST_F(Screen, ArrowsNudgeTheFocusedCursorAndCtrlJumpsToTheNextEdge) {
    view.setTimeCursors(true);
    QTest::keyClick(&view, Qt::Key_2);
    const double x2 = view.readout().x2_s;
    const double pixel = view.viewport().width_s() / view.axisRect()->width();
    QTest::keyClick(&view, Qt::Key_Right);
    EXPECT_NEAR(view.readout().x2_s - x2, pixel, pixel / 100);
    QTest::keyClick(&view, Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_NEAR(view.readout().x2_s - x2, -9 * pixel, pixel / 100);
    QTest::keyClick(&view, Qt::Key_1);
    QTest::keyClick(&view, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_NEAR(view.readout().x1_s, 0.5e-3, 1e-7) << "end of the first pulse's second phase";
    QTest::keyClick(&view, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_NEAR(view.readout().x1_s, 0.3e-3, 1e-7);
    const Viewport before = view.viewport();
    view.setTimeCursors(false);
    QTest::keyClick(&view, Qt::Key_Right);
    EXPECT_GT(view.viewport().left_s, before.left_s) << "without a cursor arrows pan";
}

TEST_F(Screen, LevelCursorsSnapToWhereTheSignalRests) {
    view.setLevelCursors(true);
    draw();
    const auto lane = laneOf(volts).scale;
    const auto height = [&](double level) { return level / lane.perDivision + lane.position; };
    drag(view, at(view, 5, view.overlay().levelCursors[0]), at(view, 5, height(-38)));
    drag(view, at(view, 5, view.overlay().levelCursors[1]), at(view, 5, height(42)));
    const auto read = view.readout();
    EXPECT_NEAR(read.y1, -40, 0.2);
    EXPECT_NEAR(read.y2, 40, 0.2);
    EXPECT_NEAR(read.dy(), 80, 0.3);
    const double y2 = read.y2;
    QTest::keyClick(&view, Qt::Key_Up);
    EXPECT_GT(view.readout().y2, y2);
    // On the current they stand where they stood and read amperes.
    view.setActiveLane(amps);
    EXPECT_EQ(view.readout().unit, "A");
}

TEST_F(Screen, BetweenTwoEdgesTheMouseReadsWidthAndInterval) {
    hoverAt(view, atTime(view, 0.1e-3, 0.2));
    ASSERT_TRUE(view.overlay().hover);
    EXPECT_THAT(view.overlay().hover->text.toStdString(), HasSubstr("Width 200.0"));
    EXPECT_THAT(view.overlay().hover->text.toStdString(), HasSubstr("interval 4.000"));
    shot(view, "hover");
    hoverAt(view, atTime(view, 2e-3, 0.2));
    ASSERT_TRUE(view.overlay().hover);
    EXPECT_NEAR(view.overlay().hover->to_s - view.overlay().hover->from_s, 3.5e-3, 1e-6) << "the rest between pulses";
    hoverAt(view, atTime(view, -0.5e-3, 0.2));
    EXPECT_FALSE(view.overlay().hover);
}

TEST_F(Screen, ACursorMovedByArrowsReadsWhatTheMouseWould) {
    view.setTimeCursors(true);
    QTest::keyClick(&view, Qt::Key_1);
    // From the rest between the pulses back over the edges of the first one, then into its leading phase.
    for (int i = 0; i < 4; ++i) QTest::keyClick(&view, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_NEAR(view.readout().x1_s, 0, 1e-7) << "onset of the first pulse";
    QTest::keyClick(&view, Qt::Key_Right);
    ASSERT_TRUE(view.overlay().hover);
    EXPECT_THAT(view.overlay().hover->text.toStdString(), HasSubstr("Width 200.0"));
    EXPECT_THAT(view.overlay().hover->text.toStdString(), HasSubstr("interval 4.000"));
    QTest::keyClick(&view, Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_FALSE(view.overlay().hover) << "before the first pulse there is nothing to read";
}

TEST_F(Screen, GapsAreHatchedAndClippedSamplesMarked) {
    EXPECT_EQ(view.graph(volts)->gapColumns(), 0);
    EXPECT_EQ(view.graph(volts)->clippedColumns(), 0);
    auto capture = twoPulses();
    for (std::size_t i = 15'000; i < 16'000; ++i) capture.channels[0].samples[i] = NAN;
    for (auto& x : capture.channels[0].samples) x = std::min(x, 30.0F);
    capture.channels[0].high = 30;
    view.show(prepared(std::move(capture)));
    draw();
    const double perColumn = 20'000.0 / view.axisRect()->width() / view.devicePixelRatioF();
    EXPECT_NEAR(view.graph(volts)->gapColumns(), 1000 / perColumn, 2);
    EXPECT_GT(view.graph(volts)->clippedColumns(), 2 * 400 / perColumn - 3);
    EXPECT_EQ(view.graph(amps)->gapColumns(), 0);
    ASSERT_EQ(view.overlay().marks.size(), 2U);
    EXPECT_EQ(view.overlay().marks[0].why, "clipped");
    shot(view, "gaps-clipped");
}

TEST_F(Screen, APulseThatTheRecordCutsIsNamed) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(1e-3));
    append(phases, biphasic(9.9e-3));
    auto capture = recordOf(phases);
    view.show(prepared(std::move(capture)));
    ASSERT_EQ(view.overlay().marks.size(), 1U);
    EXPECT_EQ(view.overlay().marks[0].why, "cut by the record's end");
    EXPECT_NEAR(view.overlay().marks[0].from_s, 9.9e-3, 1e-5);
}

TEST_F(Screen, FewSamplesAreDrawnOneByOne) {
    EXPECT_FALSE(view.graph(volts)->drewSamples());
    for (int i = 0; i < 5; ++i) turnWheel(view, atTime(view, 0, 0), 1);
    draw();
    EXPECT_TRUE(view.graph(volts)->drewSamples());
    shot(view, "samples");
}

TEST_F(Screen, OlderCapturesStayWhenAskedTo) {
    view.setPersistence(4);
    for (int i = 1; i <= 6; ++i) view.show(prepared(twoPulses(99.999 + 0.02 * i, 40 - 2 * i)));
    draw();
    shot(view, "persistence");
    int drawn = 0;
    for (int i = 0; i < view.plottableCount(); ++i) {
        const auto* graph = qobject_cast<gui::EnvelopeGraph*>(view.plottable(i));
        if (graph != nullptr && !graph->spans().empty()) ++drawn;
    }
    EXPECT_EQ(drawn, 2 * (1 + 4));
    view.setPersistence(0);
    EXPECT_EQ(view.plottableCount(), 2);
}

TEST_F(Screen, AReferenceStaysHidesAndGoes) {
    const auto key = view.storeReference();
    ASSERT_FALSE(key.isEmpty());
    view.show(prepared(twoPulses(100.2, 20)));
    draw();
    shot(view, "reference");
    EXPECT_NEAR(*std::max_element(view.trace(key)->samples->begin(), view.trace(key)->samples->end()), 40, 0.5);
    EXPECT_EQ(laneOf(key).scale, laneOf(volts).scale) << "to be compared, it has the scale of its source";
    view.setLaneShown(key, false);
    EXPECT_FALSE(view.graph(key)->visible());
    view.removeReference(key);
    EXPECT_EQ(view.graph(key), nullptr);
}

TEST_F(Screen, RollStringsCapturesOnTheSessionsTime) {
    view.setRoll(true);
    for (int i = 1; i <= 40; ++i) view.show(prepared(twoPulses(100 + 0.1 * i)));
    draw();
    shot(view, "roll");
    EXPECT_GE(view.viewport().width_s(), 10);
    EXPECT_NEAR(view.viewport().right_s(), 104.01, 0.1);
    const auto& spans = view.graph(volts)->spans();
    ASSERT_GE(spans.size(), 40U);
    EXPECT_NEAR(spans.back().key_s - spans[spans.size() - 2].key_s, 0.1, 1e-9);
    EXPECT_THAT(view.xAxis->label().toStdString(), HasSubstr("Session time"));
    view.setRoll(false);
    EXPECT_NEAR(view.viewport().left_s, -1e-3, 1e-5);
}

TEST_F(Screen, CalculatedLanesComeAndGo) {
    gui::MathOptions wish;
    wish.power = true;
    wish.charge = true;
    view.replaceMath(gui::withMath(*view.shown(), wish));
    ASSERT_EQ(view.lanes().size(), 4U);
    view.fit();
    draw();
    shot(view, "math");
    EXPECT_EQ(laneOf("math/power").unit, "W");
    EXPECT_NEAR(view.trace("math/power")->valueAt(view.shown()->zero_s + 0.1e-3), 1.6, 0.05);
    view.replaceMath(gui::withMath(*view.shown(), {}));
    EXPECT_EQ(view.lanes().size(), 2U);
}

TEST_F(Screen, TakesTheColoursOfTheTheme) {
    const auto before = laneOf(volts).colour;
    gui::applyTheme(gui::Theme::Dark);
    QCoreApplication::processEvents();
    EXPECT_NE(laneOf(volts).colour, before);
    EXPECT_EQ(laneOf(volts).colour, gui::colours().voltage);
    EXPECT_EQ(view.graph(volts)->pen().color(), gui::colours().voltage);
    draw();
    const auto ground = view.grab().toImage().pixelColor(2, 2);
    EXPECT_EQ(ground, gui::colours().base);
    shot(view, "view-dark");
    gui::applyTheme(gui::Theme::Light);
}

}  // namespace
}  // namespace tacto::test
