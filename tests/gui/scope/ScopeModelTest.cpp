// Tests the oscilloscope's content by itself, without any widget.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/scope/model/ScopeModel.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Model : public testing::Test {
protected:
    Model() { model.show(prepared(twoPulses())); }
    gui::LaneScale scaleOf(const QString& key) { return model.scaleOf(*model.lane(key)); }

    gui::ScopeModel model;
    const QString volts = "channel/voltage";
    const QString amps = "channel/current";
};

TEST_F(Model, ShowsTheWholeRecordOfTheFirstCaptureWithItsLanesBelowEachOther) {
    ASSERT_EQ(model.lanes().size(), 2U);
    EXPECT_EQ(model.activeLane(), volts);
    EXPECT_EQ(model.lane(volts)->letter, "V");
    EXPECT_EQ(model.lane(amps)->letter, "I");
    EXPECT_NEAR(model.viewport().left_s, -1e-3, 1e-5) << "time 0 is the trigger";
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 1e-3);
    EXPECT_GT(scaleOf(volts).position, scaleOf(amps).position);
    ASSERT_EQ(model.lane(volts)->spans.size(), 1U);
    EXPECT_NEAR(model.lane(volts)->spans.front().key_s, -1e-3, 1e-9);
}

TEST_F(Model, GrowsWithTheSignalUntilTheUserChoosesAScale) {
    const double before = scaleOf(volts).perDivision;
    model.show(prepared(twoPulses(100.099, 49)));
    const double grown = scaleOf(volts).heightOf(49);
    EXPECT_LE(grown, 4.0) << "the louder signal is on the screen";
    model.setLaneScale(volts, before / 10);
    model.show(prepared(twoPulses(100.199, 49)));
    EXPECT_DOUBLE_EQ(scaleOf(volts).perDivision, before / 10) << "what the user chose stays";
}

TEST_F(Model, ATimeBaseKeepsTheTriggerWhereItStandsOnTheScreen) {
    const auto share = [&] { return -model.viewport().left_s / model.viewport().width_s(); };
    const double before = share();
    ASSERT_NEAR(before, 0.1, 0.01);
    for (const double base_s : {1e-6, 200e-6, 5e-3}) {
        model.setTimePerDivision(base_s);
        EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, base_s);
        EXPECT_NEAR(share(), before, 0.01) << base_s;
    }
    EXPECT_EQ(model.restingTime_s(), 0) << "so do + and -";
    // If the trigger is out of view, the middle stays in place.
    model.setTimePerDivision(100e-6);
    model.setTimeCentre(4.2e-3);
    model.setTimePerDivision(10e-6);
    EXPECT_NEAR(model.viewport().left_s + model.viewport().width_s() / 2, 4.2e-3, 1e-6);
}

TEST_F(Model, NoZoomGoesBelowFourSampleIntervals) {
    const double least_s = 4 / model.shown()->capture->rate_hz;
    for (int turns = 0; turns < 40; ++turns) model.zoomTime(-1, 0, "wheel");
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 200e-9);
    EXPECT_GE(model.viewport().width_s(), least_s * (1 - 1e-9));
    model.setTimePerDivision(1e-9);
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 200e-9);
    model.zoomToBox(0, 1e-9, -1, 1);
    EXPECT_GE(model.viewport().width_s(), least_s * (1 - 1e-9));
    model.zoomTime(1, 0, "wheel");
    EXPECT_GT(model.viewport().perDivision_s, 200e-9) << "out of it it goes on";
}

TEST_F(Model, ALevelAtATimeIsTheSameForFlagsAndWords) {
    model.setTimeCursors(true);
    const double onEdge_s = model.trace(volts)->edges.front().onset_s - model.zero_s() - 0.13e-6;
    model.dragTimeCursor(0, onEdge_s, 0);
    model.dragTimeCursor(1, 0.1e-3, 0);
    const auto read = model.readout();
    const auto values = model.cursorValues();
    ASSERT_EQ(values.front().lane, volts);
    EXPECT_EQ(read.at1, values.front().at[0].value);
    EXPECT_EQ(read.at2, values.front().at[1].value);
    EXPECT_LT(std::abs(read.at1), 20) << "between two samples, on the line between them";
    EXPECT_GT(std::abs(read.at1), 10);
    const auto words = readoutText(read, model.shown()->capture->rate_hz);
    EXPECT_TRUE(words.contains("there " + gui::levelText(values.front().at[0].value, "V") + " and "))
        << qPrintable(words);
}

TEST_F(Model, AStillShowsWhatWasShownThen) {
    model.setTimeCursors(true);
    const auto still = model.still();
    const auto shown = model.shown();
    const auto view = model.viewport();
    model.show(prepared(twoPulses(100.099, 20)));
    model.setTimePerDivision(10e-6);
    EXPECT_EQ(still->shown(), shown);
    EXPECT_EQ(still->viewport(), view);
    EXPECT_TRUE(still->cursors().time_s());
    EXPECT_EQ(still->lanes().front().spans.front().trace, shown->traces.front());
}

TEST_F(Model, RefusesScalesThatAreNone) {
    const auto before = model.viewport();
    for (const double wrong : {0.0, -1.0, double(NAN)}) {
        model.setTimePerDivision(wrong);
        model.setLaneScale(volts, wrong);
    }
    model.setTimeCentre(NAN);
    model.setLanePosition(volts, INFINITY);
    model.setLaneScale("channel/none", 1);
    EXPECT_EQ(model.viewport(), before);
}

TEST_F(Model, ATimeCursorSnapsToAnEdgeWithinReach) {
    model.dragTimeCursor(0, 0, 1e-3);
    EXPECT_FALSE(model.cursors().time_s()) << "there is none to drag";
    model.setTimeCursors(true);
    model.dragTimeCursor(0, 0.02e-3, 0.05e-3);
    EXPECT_NEAR(model.readout().x1_s, 0, 1e-7) << "the first onset";
    model.dragTimeCursor(0, 0.02e-3, 0.01e-3);
    EXPECT_NEAR(model.readout().x1_s, 0.02e-3, 1e-9) << "out of reach";
    model.focusCursor(0);
    EXPECT_TRUE(model.jumpTimeCursor(1));
    EXPECT_NEAR(model.readout().x1_s, 0.2e-3, 1e-7) << "end of the first phase";
    EXPECT_FALSE(model.nudgeLevelCursor(1)) << "a time cursor has the focus";
}

TEST_F(Model, CursorsBeginAtTheEdgesOfThePulseInSight) {
    // Onsets at 0 and 4 ms; each pulse lasts 0.5 ms, its first phase 0.2 ms, at ±40 V.
    const auto begin = [this](double left_s, double right_s) {
        model.setTimeCursors(false);
        model.setLevelCursors(false);
        model.zoomToBox(left_s, right_s, -gui::kHalfUp, gui::kHalfUp);
        model.setTimeCursors(true);
        model.setLevelCursors(true);
        return model.readout();
    };
    for (const auto& [left_s, right_s, onset_s, end_s] :
         {std::array{-1e-3, 9e-3, 0.0, 0.5e-3}, std::array{-0.1e-3, 0.6e-3, 0.0, 0.5e-3},
          std::array{3e-3, 7e-3, 4e-3, 4.5e-3}, std::array{-0.1e-3, 0.25e-3, 0.0, 0.2e-3}}) {
        const auto read = begin(left_s, right_s);
        ASSERT_LE(model.viewport().left_s, onset_s);
        EXPECT_NEAR(read.x1_s, onset_s, 1e-7) << left_s;
        EXPECT_NEAR(read.x2_s, end_s, 1e-7) << left_s;
        EXPECT_NEAR(read.y1, 0, 0.1) << left_s;
        EXPECT_NEAR(read.y2, 40, 0.1) << left_s;
    }
    const auto none = begin(1e-3, 3e-3);
    EXPECT_GT(none.x1_s, model.viewport().left_s) << "within the view where no pulse is";
    EXPECT_LT(none.x2_s, model.viewport().right_s());
    EXPECT_LT(none.x1_s, none.x2_s);
}

TEST_F(Model, LevelCursorsStayOnTheScreenWhenAnotherLaneIsChosen) {
    model.setLevelCursors(true);
    const auto heights = [this](const QString& lane) {
        return std::pair{scaleOf(lane).heightOf(model.readout().y1), scaleOf(lane).heightOf(model.readout().y2)};
    };
    const auto before = heights(volts);
    model.setActiveLane(amps);
    EXPECT_EQ(model.readout().unit, "A");
    EXPECT_NEAR(heights(amps).first, before.first, 1e-9);
    EXPECT_NEAR(heights(amps).second, before.second, 1e-9);
}

TEST_F(Model, TheTriggerIsDraggedUnlessItFollowsTheCommand) {
    double level = 0, fraction = 0;
    QObject::connect(&model, &gui::ScopeModel::triggerLevelChosen, [&](double l) { level = l; });
    QObject::connect(&model, &gui::ScopeModel::preTriggerChosen, [&](double f) { fraction = f; });
    model.setTrigger(volts, {.level = 8}, true);
    model.dragTriggerLevel(scaleOf(volts).heightOf(20));
    EXPECT_EQ(level, 0) << "held";
    model.setTrigger(volts, {.level = 8}, false);
    model.dragTriggerLevel(scaleOf(volts).heightOf(20));
    EXPECT_NEAR(level, 20, 0.1);
    EXPECT_THAT(model.trigger().text().toStdString(), HasSubstr("Trigger at 20.0"));
    model.setTrigger(volts, {.level = 8}, false);
    EXPECT_NEAR(model.trigger().level(), 20, 0.1) << "the hand on it knows better";
    model.dropTrigger();
    model.setTrigger(volts, {.level = 8}, false);
    EXPECT_EQ(model.trigger().level(), 8);

    model.dragTriggerMoment(2e-3);
    model.dropTrigger();
    EXPECT_EQ(fraction, 0) << "a record that cannot be set";
    model.setPreTrigger(0.1);
    model.dragTriggerMoment(2e-3);
    model.dropTrigger();
    EXPECT_NEAR(fraction, 0.3, 1e-6) << "of 10 ms";
    EXPECT_FALSE(model.trigger().moment_s());
}

TEST_F(Model, AReferenceIsStoredOnceAndGoesAlone) {
    const auto key = model.storeReference();
    ASSERT_NE(model.lane(key), nullptr);
    EXPECT_TRUE(model.lane(key)->reference());
    EXPECT_EQ(scaleOf(key), scaleOf(volts));
    model.setActiveLane(key);
    EXPECT_TRUE(model.storeReference().isEmpty()) << "a reference is not stored again";
    model.removeReference(volts);
    EXPECT_NE(model.lane(volts), nullptr) << "a channel is not a reference";
    model.removeReference(key);
    EXPECT_EQ(model.lane(key), nullptr);
    EXPECT_EQ(model.activeLane(), volts) << "some lane is always worked with";
}

TEST_F(Model, RemembersTheViewOfTheBenchWhileAFileIsLookedAt) {
    model.setTimePerDivision(0.2e-3);
    model.setTimeCentre(0);
    const auto chosen = model.viewport();
    auto file = std::make_shared<gui::ShownCapture>(*prepared(twoPulses(5, 10)));
    file->source = "file.csv";
    model.show(file);
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, 1e-3) << "the file is seen whole";
    model.show(prepared(twoPulses(100.099)));
    EXPECT_DOUBLE_EQ(model.viewport().perDivision_s, chosen.perDivision_s);
    EXPECT_DOUBLE_EQ(model.viewport().left_s, chosen.left_s);
}

TEST_F(Model, ShowsWhatTheOperatorMarkedWhereItLies) {
    model.show(prepared(twoPulses(99.999)));
    model.addMark({100.002, "moved the lead"});
    ASSERT_EQ(model.marksOnAxis().size(), 1U);
    EXPECT_NEAR(model.marksOnAxis().front().at_s, 2e-3, 1e-9);
    EXPECT_EQ(model.markBeside(), "") << "it is in the record";
    model.addMark({100.5, "gel"});
    EXPECT_EQ(model.marksOnAxis().size(), 1U);
    EXPECT_EQ(model.markBeside(), "after it: “gel”");
    model.show(prepared(twoPulses(101)));
    EXPECT_EQ(model.markBeside(), "before it: “gel”");
    model.show(prepared(twoPulses(102)));
    EXPECT_EQ(model.markBeside(), "") << "one capture says it";
    model.clearMarks();
    model.addMark({102.002, "again"});
    EXPECT_EQ(model.marksOnAxis().size(), 1U);
    model.clearMarks();
    EXPECT_TRUE(model.marksOnAxis().empty());
}

}  // namespace
}  // namespace tacto::test
