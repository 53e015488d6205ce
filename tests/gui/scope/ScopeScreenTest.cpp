// Tests the oscilloscope's screen with mouse and keys, on captures with known values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/scope/screen/TimeFlags.h"
#include "app/gui/theme/Theme.h"
#include "core/base/Random.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/PlotLooks.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using gui::Grip;
using gui::Viewport;
using testing::HasSubstr;

class Screen : public testing::Test {
protected:
    Screen() {
        screen.resize(1000, 600);
        screen.QWidget::show();
        model.show(prepared(twoPulses()));
        draw();
    }
    void draw() { screen.replot(QCustomPlot::rpImmediateRefresh); }
    gui::LaneScale scaleOf(const QString& key) { return model.scaleOf(*model.lane(key)); }
    /// The lane's letter: voltage at the left edge, current at the right.
    QPoint letterOf(const QString& key) { return at(screen, key == amps ? 9.9 : 0.1, scaleOf(key).position); }

    gui::ScopeModel model;
    gui::ScopeScreen screen{model};
    gui::ScopeGestures gestures{model, screen};
    const QString volts = "channel/voltage";
    const QString amps = "channel/current";
};

TEST_F(Screen, WordsAndNumbersOfEachLaneCanBeRead) {
    const auto before = gui::currentTheme();
    gui::MathOptions math;
    math.power = math.charge = true;
    model.replaceMath(gui::withMath(*model.shown(), math));
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        draw();
        const auto& ground = gui::colours().base;
        for (const auto* axis : {screen.yAxis, screen.yAxis2}) {
            EXPECT_GE(contrast(axis->labelColor(), ground), 4.5) << axis->label().toStdString();
            EXPECT_GE(contrast(axis->tickLabelColor(), ground), 4.5) << axis->label().toStdString();
        }
        for (const auto& lane : screen.overlay().lanes)
            EXPECT_GE(contrast(lane.colour, ground), 4.5) << lane.letter.toStdString();
    }
    gui::applyTheme(before);
}

TEST_F(Screen, TwoLanesHaveTheirZerosOnLinesOfTheGridAndNumbersWhereTheyAre) {
    for (const double level : {40.0, 25.0, 12.0}) {
        gui::ScopeModel its;
        gui::ScopeScreen plot{its};
        plot.resize(1000, 600);
        its.show(prepared(twoPulses(99.999, level)));
        plot.replot(QCustomPlot::rpImmediateRefresh);
        const auto v = its.scaleOf(*its.lane(volts)), i = its.scaleOf(*its.lane(amps));
        EXPECT_DOUBLE_EQ(v.position, 1.5);
        EXPECT_DOUBLE_EQ(i.position, -1.5);
        EXPECT_DOUBLE_EQ(v.perDivision, i.perDivision * 1000) << "the same divisions at 1 kΩ: they never cross";
        EXPECT_GE(level / v.perDivision, 1.2) << "the room is used";
        EXPECT_LE(level / v.perDivision, 2.5);
        const auto ticks = plot.yAxis->tickVector();
        const auto onLine = [&](double height) {
            return std::any_of(ticks.begin(), ticks.end(), [&](double at) { return std::abs(at - height) < 1e-9; });
        };
        EXPECT_TRUE(onLine(v.position));
        EXPECT_TRUE(onLine(i.position));
        for (const auto* axis : {plot.yAxis, plot.yAxis2}) {
            for (auto label : axis->tickVectorLabels()) {
                if (label.isEmpty()) continue;
                EXPECT_LE(std::abs(label.replace(QChar(0x2212), '-').toDouble()), level + v.perDivision)
                    << "beside the other lane it says nothing";
            }
        }
        const auto& lanes = plot.overlay().lanes;
        EXPECT_FALSE(lanes[0].right);
        EXPECT_TRUE(lanes[1].right);
    }
    shot(screen, "pair");
    model.setLaneShown(amps, false);
    draw();
    const auto labels = screen.yAxis->tickVectorLabels();
    EXPECT_FALSE(labels.contains(QString())) << "alone it has the whole axis";
}

TEST_F(Screen, TheTriggersLevelStandsBesideAHandleAtTheSameHeight) {
    model.setTrigger(amps, {.level = 2e-3}, false);
    draw();
    const auto zero = letterOf(amps);
    EXPECT_EQ(screen.gripAt(zero).grip, Grip::Lane);
    const int level = at(screen, 0, scaleOf(amps).heightOf(2e-3)).y();
    EXPECT_EQ(screen.gripAt(QPoint(zero.x() - 30, level)).grip, Grip::TriggerLevel);
    shot(screen, "trigger-beside-handle");
}

TEST_F(Screen, TheWheelZoomsTimeAroundTheMouseAndCtrlZGoesBack) {
    const Viewport before = model.viewport();
    const auto where = atTime(screen, 0, 2);
    turnWheel(screen, where, 1);
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 0.5e-3);
    EXPECT_NEAR((where - atTime(screen, 0, 2)).x(), 0, 3) << "what is under the mouse stays there";
    turnWheel(screen, where, 1);
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 0.2e-3);
    QTest::keyClick(&screen, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(model.viewport(), before) << "one turn of the wheel is undone whole";
    QTest::keyClick(&screen, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(model.viewport(), before) << "there is nothing before";
}

TEST_F(Screen, CtrlWheelZoomsTheLevelOfTheActiveLaneOnly) {
    const auto other = scaleOf(amps);
    turnWheel(screen, at(screen, 5, scaleOf(volts).position), 1, Qt::ControlModifier);
    EXPECT_DOUBLE_EQ(scaleOf(volts).perDivision, 10);
    EXPECT_EQ(scaleOf(amps), other);
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 1e-3);
}

TEST_F(Screen, DraggingPansAndADoubleClickFits) {
    const Viewport before = model.viewport();
    drag(screen, at(screen, 5, 3.5), at(screen, 3, 2.5));
    EXPECT_NEAR(model.viewport().left_s - before.left_s, 2e-3, 3e-5);
    EXPECT_NEAR(scaleOf(volts).position - before.lanes.at(volts).position, -1, 0.05);
    QTest::mouseDClick(&screen, Qt::LeftButton, {}, at(screen, 5, 3.5));
    EXPECT_NEAR(500e-6 / model.viewport().width_s(), 1.0 / 3, 0.02) << "the pulse takes a third";
    EXPECT_NEAR(model.viewport().left_s, -500e-6, 20e-6) << "the middle one";
    EXPECT_EQ(model.viewport().lanes, before.lanes);
    shot(screen, "fit");
    QTest::mouseDClick(&screen, Qt::LeftButton, {}, at(screen, 5, 3.5));
    EXPECT_EQ(model.viewport(), before) << "once more: the whole record";
    QTest::keyClick(&screen, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_NE(model.viewport(), before) << "a fit can be undone too";
}

TEST_F(Screen, ABoxBecomesTheScreen) {
    const Viewport before = model.viewport();
    const auto lane = scaleOf(volts);
    const auto from = atTime(screen, -0.1e-3, lane.position + 0.98);
    const auto to = atTime(screen, 0.63e-3, lane.position - 1.1);
    const double left = screen.timeAt(from.x()), right = screen.timeAt(to.x());
    const double top = lane.levelAt(screen.heightAt(from.y())), bottom = lane.levelAt(screen.heightAt(to.y()));
    drag(screen, from, to, Qt::ShiftModifier);
    EXPECT_NEAR(model.viewport().left_s, left, 1e-9) << "just what the box held, on no ladder";
    EXPECT_NEAR(model.viewport().right_s(), right, 1e-9);
    EXPECT_NEAR(scaleOf(volts).levelAt(4), top, 1e-6);
    EXPECT_NEAR(scaleOf(volts).levelAt(-4), bottom, 1e-6);
    draw();
    shot(screen, "box");
    EXPECT_TRUE(model.undoZoom());
    EXPECT_EQ(model.viewport(), before);
}

TEST_F(Screen, ALanesLetterDragsItsOffsetAndMakesItActive) {
    const double before = scaleOf(amps).position;
    drag(screen, letterOf(amps), letterOf(amps) - QPoint(0, screen.axisRect()->height() / 8));
    EXPECT_NEAR(scaleOf(amps).position, before + 1, 0.05);
    EXPECT_EQ(model.activeLane(), amps);
}

TEST_F(Screen, EveryChannelHasOneColourAndNoOtherHasIt) {
    auto capture = twoPulses();
    for (const auto* name : {"probe", "second current", "pulse", "gate", "clock", "spare"}) {
        auto more = capture.channels[capture.channels.size() % 2];
        more.name = name;
        if (QString(name).size() == 5) more.unit = "";
        capture.channels.push_back(std::move(more));
    }
    model.show(prepared(std::move(capture)));
    model.setTimeCursors(true);
    gui::LaneLegend legend(model, nullptr);
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        draw();
        std::set<QRgb> inks;
        const auto& flags = screen.overlay().flags;
        for (std::size_t c = 0; c < model.lanes().size(); ++c) {
            const auto& lane = model.lanes()[c];
            const auto colour = gui::laneColour(model, lane);
            const auto ink = gui::laneInk(model, lane);
            EXPECT_TRUE(inks.insert(ink.rgb()).second) << lane.title.toStdString();
            EXPECT_EQ(gui::channelColour(lane.letter, c), colour);
            EXPECT_EQ(gui::channelInk(lane.letter, c), ink);
            EXPECT_EQ(screen.graph(lane.key)->pen().color(), colour);
            EXPECT_EQ(screen.overlay().lanes[c].colour, ink);
            EXPECT_EQ(flags[0].rows[c].colour, ink);
            EXPECT_TRUE(legend.text().contains(colour.name()) && legend.text().contains(ink.name()));
            if (lane.key == model.activeLane()) EXPECT_EQ(screen.yAxis->labelColor(), ink);
        }
        shot(screen, theme == gui::Theme::Dark ? "channels-dark" : "channels");
    }
    gui::applyTheme(gui::Theme::Light);
}

TEST_F(Screen, AClickOnATracePicksItsLane) {
    QTest::mouseClick(&screen, Qt::LeftButton, {}, at(screen, 8, scaleOf(amps).position));
    EXPECT_EQ(model.activeLane(), amps);
}

TEST_F(Screen, TimeCursorsSnapToEdgesAndReadWhatIsBetween) {
    model.setTimeCursors(true);
    model.dragTimeCursor(0, 2e-3, 0);
    model.dragTimeCursor(1, 6e-3, 0);
    draw();
    const auto grab = [&](int cursor, double to_s) {
        const auto& place = screen.overlay().timeCursors_s[static_cast<std::size_t>(cursor)];
        drag(screen, atTime(screen, place, 3), atTime(screen, to_s, 3));
    };
    grab(0, 0.02e-3);  // two pixels beyond the first onset
    grab(1, 3.98e-3);  // two pixels before the second pulse's onset
    const auto read = model.readout();
    EXPECT_NEAR(read.dx_s(), 4e-3, 1e-7);
    EXPECT_NEAR(1 / read.dx_s(), 250, 0.01);
    EXPECT_NEAR(read.x1_s, 0, 1e-7);
    EXPECT_EQ(read.unit, "V");
    shot(screen, "cursors");
}

TEST_F(Screen, CursorsReadEveryLaneInFlagsBeyondThePulse) {
    model.fit();
    model.setTimeCursors(true);
    model.dragTimeCursor(0, 0.001e-3, 1e-5);
    model.dragTimeCursor(1, 0.2e-3, 1e-5);
    draw();
    const auto& o = screen.overlay();
    ASSERT_EQ(o.flags.size(), 2U);
    EXPECT_EQ(o.flags[0].name, "t₁");
    EXPECT_EQ(o.flags[1].position, "200.0\u202fµs");
    ASSERT_EQ(o.flags[0].rows.size(), 2U) << "voltage and current";
    EXPECT_EQ(o.flags[0].rows[0].letter, "V");
    EXPECT_THAT(o.flags[0].rows[0].text.toStdString(), testing::AllOf(HasSubstr("20."), HasSubstr("V ↑")));
    EXPECT_THAT(o.flags[1].rows[1].text.toStdString(), testing::AllOf(HasSubstr("mA ↓")));
    EXPECT_EQ(o.timeSpan, "Δ 200.0\u202fµs · 1/Δ 5.000\u202fkHz");
    shot(screen, "flags");
    // A flag can be gripped; there is no edge on the plateau.
    const auto grip = screen.gripAt(atTime(screen, -10e-6, 3.3));
    EXPECT_EQ(grip.grip, Grip::TimeCursor);
    EXPECT_EQ(grip.which, 0);
    model.dragTimeCursor(0, 0.1e-3, 0);
    EXPECT_FALSE(screen.overlay().flags[0].rows[0].text.contains("↑"));
    EXPECT_THAT(screen.overlay().flags[0].rows[0].text.toStdString(), HasSubstr("40."));
    model.setLaneShown(amps, false);
    EXPECT_EQ(screen.overlay().flags[0].rows.size(), 1U);
    // At the edge and when crossed, the flags stay on the screen and do not overlap.
    model.dragTimeCursor(0, model.viewport().right_s(), 0);
    model.dragTimeCursor(1, model.viewport().left_s, 0);
    draw();
    const gui::ScopePlane plane(screen.xAxis, screen.yAxis);
    const auto flags = gui::TimeFlags(plane, screen.overlay()).boxes();
    ASSERT_EQ(flags.size(), 2U);
    for (const auto& box : flags) EXPECT_TRUE(plane.area().adjusted(-1, -1, 1, 1).contains(box));
    EXPECT_FALSE(flags[0].intersects(flags[1]));
    shot(screen, "flags-edge");
}

/// Up to eight lanes, cursors anywhere, screens of any size and text of any size.
TEST_F(Screen, FlagsOfManyLanesStandApartAndWithinTheScreen) {
    Random random(55, "flags of many lanes");
    model.setTimeCursors(true);
    for (int trial = 0; trial < 60; ++trial) {
        gui::applyTextSize(trial % 20 == 19 ? 200 : 100);
        screen.resize(900 + int(random.below(700)), 420 + int(random.below(500)));
        const auto& view = model.viewport();
        const double first = view.left_s + random.uniform() * view.width_s();
        model.dragTimeCursor(0, first, 0);
        model.dragTimeCursor(1,
                             random.below(2) == 0 ? first + 1e-3 * random.uniform() * view.width_s()
                                                  : view.left_s + random.uniform() * view.width_s(),
                             0);
        draw();
        auto state = screen.overlay();
        const auto row = state.flags.at(0).rows.at(0);
        const auto lanes = 1 + random.below(8);
        for (auto& flag : state.flags) flag.rows.assign(lanes, row);
        const gui::ScopePlane plane(screen.xAxis, screen.yAxis);
        const auto flags = gui::TimeFlags(plane, state).boxes();
        ASSERT_EQ(flags.size(), 2U);
        const double wide = flags[0].width() + flags[1].width(), high = flags[0].height() + flags[1].height();
        if (wide + 10 > plane.area().width() && high + 60 > plane.area().height()) continue;  // there is no room
        EXPECT_FALSE(flags[0].intersects(flags[1])) << trial << ' ' << lanes;
        for (const auto& box : flags) {
            EXPECT_GE(box.left(), plane.area().left() - 1) << trial;
            EXPECT_LE(box.right(), plane.area().right() + 1) << trial << ' ' << lanes;
            if (box.height() + 60 <= plane.area().height()) {
                EXPECT_LE(box.bottom(), plane.area().bottom() + 1) << trial << ' ' << lanes;
            }
        }
    }
    gui::applyTextSize(100);
}

TEST_F(Screen, ALevelCursorDoesNotStrikeOutWhatIsReadBetweenTheTimeCursors) {
    model.fit();
    model.setTimeCursors(true);
    model.dragTimeCursor(0, -100e-6, 0);
    model.dragTimeCursor(1, 500e-6, 0);
    draw();
    const auto span = [&] {
        QRectF ink;
        for (const auto& word : wordsOf(screen))
            if (word.text.contains("1/")) ink = word.ink;
        return ink;
    };
    const auto before = span();
    QString all;
    for (const auto& word : wordsOf(screen)) all += word.text + '|';
    ASSERT_FALSE(before.isEmpty()) << all.toStdString();
    model.setLevelCursors(true);
    const auto* heights = screen.yAxis;
    for (const double aside : {-4.0, 0.0, 4.0}) {
        model.dragLevelCursor(0, heights->pixelToCoord(before.center().y() + aside), 0);
        draw();
        const double line = heights->coordToPixel(screen.overlay().levelCursors[0]);
        const auto now = span();
        EXPECT_TRUE(line < now.top() || line > now.bottom())
            << line << " within " << now.top() << " to " << now.bottom();
    }
    shot(screen, "level-cursor-beside-span");
}

TEST_F(Screen, FlagsLeaveTheTracesInSightWhereThereIsRoom) {
    model.setTimePerDivision(200e-6);
    model.setTimeCursors(true);
    model.dragTimeCursor(0, -130e-9, 0);
    model.dragTimeCursor(1, 380e-9, 0);
    draw();
    shot(screen, "flags-on-one-edge");
    // The right flag once covered the top of the positive phase.
    const auto grip = [&](const QString& lane, double time_s, double level) {
        return screen.gripAt(atTime(screen, time_s, scaleOf(lane).heightOf(level))).grip;
    };
    for (const double time_s : {50e-6, 100e-6, 150e-6}) {
        EXPECT_EQ(grip(volts, time_s, 40), Grip::None) << time_s;
        EXPECT_EQ(grip(amps, time_s, 40e-3), Grip::None) << time_s;
    }
    for (const double time_s : {350e-6, 450e-6}) EXPECT_EQ(grip(volts, time_s, -40), Grip::None) << time_s;
    EXPECT_EQ(grip(volts, 250e-6, 0), Grip::None);
    const auto flag = screen.gripAt(atTime(screen, 20e-6, scaleOf(volts).heightOf(20)));
    EXPECT_EQ(flag.grip, Grip::TimeCursor) << "but stays beside its cursor";
}

TEST_F(Screen, TicksAreRoundWhateverABoxMakesOfThem) {
    const auto roundOn = [&](const QCPAxis& axis) {
        auto labels = axis.tickVectorLabels();
        labels.removeAll(QString());  // no numbers in the other lane's part
        ASSERT_GE(labels.size(), 3);
        const double first = QString(labels[0]).replace(QChar(0x2212), '-').toDouble();
        const double step = QString(labels[1]).replace(QChar(0x2212), '-').toDouble() - first;
        const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
        EXPECT_TRUE(std::abs(mantissa - std::round(mantissa)) < 1e-6) << step;
        EXPECT_NEAR(std::remainder(first, step), 0, 1e-6 * step);
        const QFontMetrics metrics(axis.tickLabelFont());
        const auto ticks = axis.tickVector();
        for (int i = 1; axis.orientation() == Qt::Horizontal && i < ticks.size(); ++i) {
            EXPECT_LT(0.5 * (metrics.horizontalAdvance(labels[i - 1]) + metrics.horizontalAdvance(labels[i])),
                      axis.coordToPixel(ticks[i]) - axis.coordToPixel(ticks[i - 1]))
                << "no number lies on the next";
        }
    };
    Random random(11, "boxes");
    for (int i = 0; i < 60; ++i) {
        const double width = std::pow(10, 4 * random.uniform() - 6), from = 8e-3 * random.uniform() - 1e-3;
        model.zoomToBox(from, from + width, -4 + 3 * random.uniform(), 1 + 3 * random.uniform());
        draw();
        for (const auto* axis : {screen.xAxis, screen.yAxis, screen.yAxis2}) roundOn(*axis);
        model.undoZoom();
    }
}

TEST_F(Screen, AMasksBandLiesBehindItsLaneAndAFailureIsSaidLarge) {
    const auto mask = CaptureMask::around(*model.shown()->capture, {{{"V", 4}, {"A", 4e-3}}, 20e-6});
    ASSERT_TRUE(mask);
    screen.setMask(std::make_shared<const CaptureMask>(*mask));
    model.fit();
    draw();
    EXPECT_GT(pixelsOf(screen.grab().toImage(), gui::colours().passCell), 5000);
    const auto* traces = screen.axisRect();
    const auto inked = [&] { return pixelsOf(screen.grab().toImage().copy(traces->rect()), gui::colours().fail); };
    const auto before = inked();
    const int high = traces->height();
    screen.setAlarm("✕ Mask failed: 1 of 3 captures outside");
    draw();
    shot(screen, "mask");
    EXPECT_GT(pixelsOf(screen.grab().toImage(), gui::colours().fail), 2000);
    EXPECT_LT(inked(), before + 200) << "it covers no trace";
    EXPECT_LT(traces->height(), high);
    screen.setMask(nullptr);
    screen.setAlarm({});
    draw();
    EXPECT_EQ(traces->height(), high) << "its room is kept only as long as it is there";
    EXPECT_EQ(screen.plottableCount(), 2);
}

TEST_F(Screen, ArrowsNudgeTheFocusedCursorAndCtrlJumpsToTheNextEdge) {
    model.setTimeCursors(true);
    model.dragTimeCursor(0, 2e-3, 0);
    QTest::keyClick(&screen, Qt::Key_2);
    const double x2 = model.readout().x2_s;
    const double pixel = model.viewport().width_s() / screen.axisRect()->width();
    QTest::keyClick(&screen, Qt::Key_Right);
    EXPECT_NEAR(model.readout().x2_s - x2, pixel, pixel / 100);
    QTest::keyClick(&screen, Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_NEAR(model.readout().x2_s - x2, -9 * pixel, pixel / 100);
    QTest::keyClick(&screen, Qt::Key_1);
    QTest::keyClick(&screen, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_NEAR(model.readout().x1_s, 0.5e-3, 1e-7) << "end of the first pulse's second phase";
    QTest::keyClick(&screen, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_NEAR(model.readout().x1_s, 0.3e-3, 1e-7);
    const Viewport before = model.viewport();
    model.setTimeCursors(false);
    QTest::keyClick(&screen, Qt::Key_Right);
    EXPECT_GT(model.viewport().left_s, before.left_s) << "without a cursor arrows pan";
}

TEST_F(Screen, LevelCursorsSnapToWhereTheSignalRests) {
    model.setLevelCursors(true);
    draw();
    const auto lane = scaleOf(volts);
    const auto height = [&](double level) { return level / lane.perDivision + lane.position; };
    drag(screen, at(screen, 5, screen.overlay().levelCursors[0]), at(screen, 5, height(-38)));
    drag(screen, at(screen, 5, screen.overlay().levelCursors[1]), at(screen, 5, height(42)));
    const auto read = model.readout();
    EXPECT_NEAR(read.y1, -40, 0.2);
    EXPECT_NEAR(read.y2, 40, 0.2);
    EXPECT_NEAR(read.dy(), 80, 0.3);
    const double y2 = read.y2;
    QTest::keyClick(&screen, Qt::Key_Up);
    EXPECT_GT(model.readout().y2, y2);
    // On the current's lane the cursors stay in place and read amperes.
    model.setActiveLane(amps);
    EXPECT_EQ(model.readout().unit, "A");
}

TEST_F(Screen, BetweenTwoEdgesTheMouseReadsWidthAndInterval) {
    hoverAt(screen, atTime(screen, 0.1e-3, 0.2));
    ASSERT_TRUE(screen.overlay().hover);
    EXPECT_THAT(screen.overlay().hover->text.toStdString(), HasSubstr("Width 200.0"));
    EXPECT_THAT(screen.overlay().hover->text.toStdString(), HasSubstr("interval 4.000"));
    shot(screen, "hover");
    hoverAt(screen, atTime(screen, 2e-3, 0.2));
    ASSERT_TRUE(screen.overlay().hover);
    EXPECT_NEAR(screen.overlay().hover->to_s - screen.overlay().hover->from_s, 3.5e-3, 1e-6)
        << "the rest between pulses";
    hoverAt(screen, atTime(screen, -0.5e-3, 0.2));
    EXPECT_FALSE(screen.overlay().hover);
    // A cursor moved by arrow keys reads the same: back over the edges of the first pulse, then into its leading phase.
    model.setTimeCursors(true);
    QTest::keyClick(&screen, Qt::Key_1);
    for (int i = 0; i < 4; ++i) QTest::keyClick(&screen, Qt::Key_Left, Qt::ControlModifier);
    EXPECT_NEAR(model.readout().x1_s, 0, 1e-7) << "onset of the first pulse";
    QTest::keyClick(&screen, Qt::Key_Right);
    ASSERT_TRUE(screen.overlay().hover);
    EXPECT_THAT(screen.overlay().hover->text.toStdString(), HasSubstr("Width 200.0"));
    QTest::keyClick(&screen, Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_FALSE(screen.overlay().hover) << "before the first pulse there is nothing to read";
}

TEST_F(Screen, GapsAreHatchedAndClippedSamplesMarked) {
    EXPECT_EQ(screen.graph(volts)->gapColumns(), 0);
    EXPECT_EQ(screen.graph(volts)->clippedColumns(), 0);
    auto capture = twoPulses();
    for (std::size_t i = 15'000; i < 16'000; ++i) capture.channels[0].samples[i] = NAN;
    for (auto& x : capture.channels[0].samples) x = std::min(x, 30.0F);
    capture.channels[0].high = 30;
    model.show(prepared(std::move(capture)));
    draw();
    const double perColumn = 20'000.0 / screen.axisRect()->width() / screen.devicePixelRatioF();
    EXPECT_NEAR(screen.graph(volts)->gapColumns(), 1000 / perColumn, 2);
    EXPECT_GT(screen.graph(volts)->clippedColumns(), 2 * 400 / perColumn - 3);
    EXPECT_EQ(screen.graph(amps)->gapColumns(), 0);
    ASSERT_EQ(screen.overlay().marks.size(), 2U);
    EXPECT_EQ(screen.overlay().marks[0].why, "clipped");
    shot(screen, "gaps-clipped");
}

TEST_F(Screen, APulseThatTheRecordCutsIsNamed) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(1e-3));
    append(phases, biphasic(9.9e-3));
    auto capture = recordOf(phases);
    model.show(prepared(std::move(capture)));
    ASSERT_EQ(screen.overlay().marks.size(), 1U);
    EXPECT_EQ(screen.overlay().marks[0].why, "cut by the record's end");
    EXPECT_NEAR(screen.overlay().marks[0].from_s, 9.9e-3, 1e-5);
}

TEST_F(Screen, OlderCapturesStayWhenAskedTo) {
    model.setPersistence(4);
    for (int i = 1; i <= 6; ++i) model.show(prepared(twoPulses(99.999 + 0.02 * i, 40 - 2 * i)));
    draw();
    shot(screen, "persistence");
    int drawn = 0;
    for (int i = 0; i < screen.plottableCount(); ++i) {
        const auto* graph = qobject_cast<gui::EnvelopeGraph*>(screen.plottable(i));
        if (graph != nullptr && !graph->spans().empty()) ++drawn;
    }
    EXPECT_EQ(drawn, 2 * (1 + 4));
    model.setPersistence(0);
    EXPECT_EQ(screen.plottableCount(), 2);
}

TEST_F(Screen, AReferenceStaysHidesAndGoes) {
    const auto key = model.storeReference();
    ASSERT_FALSE(key.isEmpty());
    model.show(prepared(twoPulses(100.2, 20)));
    draw();
    shot(screen, "reference");
    EXPECT_NEAR(*std::max_element(model.trace(key)->samples->begin(), model.trace(key)->samples->end()), 40, 0.5);
    EXPECT_EQ(scaleOf(key), scaleOf(volts)) << "to be compared, it has the scale of its source";
    model.setLaneShown(key, false);
    EXPECT_FALSE(screen.graph(key)->visible());
    model.removeReference(key);
    EXPECT_EQ(screen.graph(key), nullptr);
}

TEST_F(Screen, RollStringsCapturesOnTheSessionsTime) {
    model.setRoll(true);
    for (int i = 1; i <= 40; ++i) model.show(prepared(twoPulses(100 + 0.1 * i)));
    draw();
    shot(screen, "roll");
    EXPECT_GE(model.viewport().width_s(), 10);
    EXPECT_NEAR(model.viewport().right_s(), 104.01, 0.1);
    const auto& spans = screen.graph(volts)->spans();
    ASSERT_GE(spans.size(), 40U);
    EXPECT_NEAR(spans.back().key_s - spans[spans.size() - 2].key_s, 0.1, 1e-9);
    EXPECT_THAT(screen.xAxis->label().toStdString(), HasSubstr("Session time"));
    model.setRoll(false);
    EXPECT_NEAR(model.viewport().left_s, -1e-3, 1e-5);
}

}  // namespace
}  // namespace tacto::test
