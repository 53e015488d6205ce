// Tests the memory of the live plots and their pictures with known samples: columns, gaps, old data, frequencies.
#include <QTest>
#include <cmath>
#include <gtest/gtest.h>

#include "app/gui/live/CommandPanel.h"
#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/live/TactilePlane.h"
#include "app/gui/live/TaxelMap.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Person.h"
#include "tests/gui/PlotLooks.h"

namespace tacto::test {
namespace {

using gui::LiveHistory;
using gui::RollingGraph;
using gui::Series;
using gui::StripPlots;

const std::vector<StreamInfo> kPlotted{{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "a"},
                                       {StreamKind::Force, StreamUnit::Newton, 1, 200, "f"},
                                       {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "t"}};

class Plots : public testing::Test {
protected:
    Plots() {
        history.begin(kPlotted);
        plots.begin(true, true, "V");
        plots.resize(900, 700);
        plots.show();
    }
    /// Feeds samples up to `until_s`: a tone of `hz` on the x axis.
    void feel(double until_s, double hz = 250) {
        Telemetry telemetry;
        for (; t_s < until_s; t_s += 0.02) {
            for (int i = 0; i < 80; ++i) {
                TapSample sample;
                sample.t_s = t_s + i / 4000.0;
                sample.channels = 3;
                sample.values[0] = static_cast<float>(std::sin(2 * M_PI * hz * sample.t_s));
                sample.values[2] = 9.8F;
                tap.samples.push(sample);
            }
            for (int i = 0; i < 4; ++i) {
                TapSample sample;
                sample.t_s = t_s + i / 200.0;
                sample.stream = 1;
                sample.channels = 1;
                sample.values[0] = 1;
                tap.samples.push(sample);
                sample.stream = 2;
                sample.channels = 8;
                sample.values.fill(taxels_Pa);
                tap.samples.push(sample);
            }
            telemetry.at = toInstant(t_s + 0.02);
            history.take(tap, telemetry);
        }
    }
    void idle(double until_s) {
        Telemetry telemetry;
        telemetry.at = toInstant(until_s);
        history.take(tap, telemetry);
        t_s = until_s;
    }
    void draw() {
        plots.redraw();
        plots.replot(QCustomPlot::rpImmediateRefresh);
    }
    /// Number of pixels of a strip's trace in the column at a time, in any colour but the background.
    int inked(const QImage& image, double at_s) {
        auto* axes = plots.axisRects().first();
        const int x = int(axes->axis(QCPAxis::atBottom)->coordToPixel(at_s));
        int count = 0;
        for (int y = axes->top() + 1; y < axes->bottom(); ++y) {
            const QColor c = image.pixelColor(x, y);
            if (std::abs(c.red() - c.green()) + std::abs(c.green() - c.blue()) > 60) ++count;
        }
        return count;
    }

    QStringList written() {
        QStringList all;
        for (const auto& word : wordsOf(plots)) all << word.text;
        return all;
    }

    BenchTap tap;
    LiveHistory history;
    StripPlots plots{history};
    double t_s = 0;
    float taxels_Pa = 5000;
};

TEST_F(Plots, HaveTheNewestAtTheRight) {
    plots.setWindow(5);
    feel(2);
    draw();
    EXPECT_NEAR(plots.shownTime().lower, -3, 0.05);
    EXPECT_NEAR(plots.shownTime().upper, 2, 0.05);
    const auto* axis = plots.axisRects().last()->axis(QCPAxis::atBottom);
    EXPECT_EQ(axis->tickVectorLabels().last(), "0") << "ticks count back from now";
    EXPECT_EQ(axis->tickVectorLabels().first().front(), QChar(0x2212));
    feel(8);
    draw();
    EXPECT_NEAR(plots.shownTime().upper, 8, 0.05);
    EXPECT_NEAR(plots.shownTime().size(), 5, 1e-9);
    feel(9);
    draw();
    EXPECT_NEAR(plots.shownTime().upper, 9, 0.05);
}

TEST_F(Plots, DrawTheWholeSwingOfAToneInEachColumn) {
    feel(6);
    draw();
    const auto image = plots.toPixmap().toImage();
    // The trace reaches ±1 on an axis from about -2 to 12.
    auto* axis = plots.axisRects().first()->axis(QCPAxis::atLeft);
    const double swing = std::abs(axis->coordToPixel(1) - axis->coordToPixel(-1));
    for (const double t : {2.0, 3.0, 4.5, 5.5}) EXPECT_GE(inked(image, t), int(0.8 * swing)) << t;
}

TEST_F(Plots, LeaveAGapWhereSamplesAreMissing) {
    feel(4);
    idle(5);
    feel(7);
    draw();
    const auto image = plots.toPixmap().toImage();
    EXPECT_GT(inked(image, 3.5), 0);
    EXPECT_EQ(inked(image, 4.5), 0) << "nothing was measured there";
    EXPECT_GT(inked(image, 5.5), 0);
}

TEST_F(Plots, HatchWhatHasStoppedComing) {
    feel(4);
    draw();
    EXPECT_FALSE(plots.stale(StreamKind::Acceleration));
    idle(5);
    draw();
    EXPECT_TRUE(plots.stale(StreamKind::Acceleration));
    EXPECT_TRUE(plots.stale(StreamKind::Force));
    EXPECT_TRUE(plots.stale(StreamKind::Taxels));
    feel(6);
    draw();
    EXPECT_FALSE(plots.stale(StreamKind::Force));
}

TEST_F(Plots, TheSpectrumIsBrightAtTheTone) {
    feel(6, 250);
    draw();
    const auto& spectrum = plots.spectrogram();
    for (const double t : {1.0, 3.0, 5.5}) {
        const double tone = spectrum.densityAt_db(t, 250);
        EXPECT_GT(tone, -30) << t;
        EXPECT_LT(spectrum.densityAt_db(t, 600), tone - 40) << t;
        EXPECT_LT(spectrum.densityAt_db(t, 16), tone - 40) << "gravity is not vibration";
    }
    EXPECT_TRUE(std::isnan(spectrum.densityAt_db(9, 250)));
}

TEST_F(Plots, ASpectrumThatFillsItsLaneSaysSimulatedInFront) {
    RecordProperty("hazard", "H9");
    const auto lightOverIt = [&] {
        const auto image = plots.toPixmap().toImage();
        const auto middle = plots.axisRects()[3]->center();
        int light = 0;
        for (int x = middle.x() - 60; x < middle.x() + 60; ++x)
            for (int y = middle.y() - 15; y < middle.y() + 15; ++y) light += qGray(image.pixel(x, y)) > 180;
        return light;
    };
    feel(11);
    draw();
    EXPECT_GT(lightOverIt(), 50) << "the outline of the word, over the darkest of the scale";
    plots.begin(false, false, "V");
    feel(22);
    draw();
    EXPECT_EQ(lightOverIt(), 0) << "nothing but the spectrum";
}

TEST_F(Plots, TheSpectrumSaysNothingOfAGap) {
    feel(2);
    idle(4);
    feel(6);
    draw();
    const auto& spectrum = plots.spectrogram();
    EXPECT_FALSE(std::isnan(spectrum.densityAt_db(1.5, 250)));
    EXPECT_TRUE(std::isnan(spectrum.densityAt_db(3, 250)));
    EXPECT_FALSE(std::isnan(spectrum.densityAt_db(5, 250)));
    EXPECT_LE(spectrum.transformed(), std::int64_t(4 / 0.032) + 1) << "each window once, none over the gap";
}

TEST_F(Plots, AFrozenPictureStandsStillWhileTheHistoryGoesOn) {
    feel(6);
    draw();
    const auto before = plots.shownTime();
    plots.setFrozen(true);
    plots.replot(QCustomPlot::rpImmediateRefresh);
    const auto picture = plots.toPixmap().toImage();
    feel(80);  // longer than the plots keep data
    draw();
    plots.replot(QCustomPlot::rpImmediateRefresh);
    EXPECT_EQ(plots.shownTime(), before);
    EXPECT_EQ(plots.toPixmap().toImage(), picture);
    plots.setFrozen(false);
    draw();
    EXPECT_NEAR(plots.shownTime().upper, 80, 0.05);
}

TEST_F(Plots, AFaultIsALineInEveryLaneWithItsCauseInTheTrains) {
    RecordProperty("hazard", "H12");
    feel(5);
    draw();
    EXPECT_EQ(plots.faultSaid(), "");
    Telemetry telemetry;
    telemetry.state = InterlockState::Faulted;
    telemetry.reason = "the stimulator is unplugged";
    telemetry.at = toInstant(5.02);
    history.take(tap, telemetry, QTime(3, 48, 53));
    t_s = 5.02;
    telemetry.at = toInstant(5.2);
    history.take(tap, telemetry);
    draw();
    EXPECT_FALSE(plots.trains().saysOff()) << "the shade is narrow";
    EXPECT_EQ(plots.faultSaid(), "03:48:53 · output off · the stimulator is unplugged");
    telemetry.at = toInstant(7);
    history.take(tap, telemetry);
    draw();
    EXPECT_TRUE(plots.trains().saysOff());
    EXPECT_EQ(plots.faultSaid(), "03:48:53 · the stimulator is unplugged") << "each is said once";
    const auto image = plots.grab().toImage();
    shot(plots, "strips-fault");
    for (auto* axes : plots.axisRects()) {
        if (!axes->visible()) continue;
        const int x = int(std::lround(axes->axis(QCPAxis::atBottom)->coordToPixel(5.02)));
        int red = 0;
        for (int y = axes->top(); y < axes->bottom(); ++y) {
            for (int beside = x - 1; beside <= x + 1; ++beside) {
                if (image.pixelColor(beside, y) != gui::colours().fault) continue;
                ++red;
                break;
            }
        }
        EXPECT_GT(red, axes->height() / 2) << "at the instant it came, not later";
    }
    history.begin(kPlotted);
    EXPECT_FALSE(history.fault()) << "another bench";
}

TEST_F(Plots, WhileAFaultHoldsTheOutputOffTheTrainsAreShadedAndNoneIsCalledNotDelivered) {
    RecordProperty("hazard", "H12");
    const auto ask = [&](double at_s) {
        TrainReport train;
        train.onset = toInstant(at_s);
        train.amplitude = 20;
        train.outcome = TrainOutcome::Voided;
        tap.trains.push(train);
    };
    ask(4.5);
    feel(5);
    draw();
    EXPECT_FALSE(plots.trains().shownOff());
    EXPECT_EQ(plots.trains().shownFailures(), QVector<double>{4.5}) << "no fault holds it off";
    Telemetry telemetry;
    telemetry.state = InterlockState::Faulted;
    telemetry.at = toInstant(5);
    history.take(tap, telemetry);
    ask(5.5);
    ask(4.98);  // the fault cut this train off, and its line says so
    telemetry.at = toInstant(6);
    history.take(tap, telemetry);
    t_s = 6;
    draw();
    ASSERT_TRUE(plots.trains().shownOff());
    EXPECT_NEAR(plots.trains().shownOff()->lower, 5, 1e-9);
    EXPECT_NEAR(plots.trains().shownOff()->upper, plots.shownTime().upper, 1e-9);
    EXPECT_EQ(plots.trains().shownFailures(), QVector<double>{4.5});
    telemetry.state = InterlockState::Disarmed;
    telemetry.at = toInstant(6.5);
    history.take(tap, telemetry);
    ask(7);
    feel(7.5);
    draw();
    ASSERT_TRUE(plots.trains().shownOff());
    EXPECT_NEAR(plots.trains().shownOff()->upper, 6.5, 1e-9) << "up to its reset";
    EXPECT_EQ(plots.trains().shownFailures(), (QVector<double>{4.5, 7.0}));
}

TEST_F(Plots, EveryTraceIsNamedInANarrowWindowToo) {
    feel(2);
    draw();
    for (const auto* name : {"x", "y", "z", "roughness R", "pressure P", "commanded", "delivered"})
        EXPECT_TRUE(written().contains(name)) << name << ": " << written().join('|').toStdString();
    for (const int width : {390, 310}) {  // 390 fits a window of 1024 pixels with open docks; 310 is narrower still
        plots.resize(width, 700);
        draw();
        const auto all = written();
        for (const auto* name : {"x", "y", "z", "commanded", "delivered"})
            EXPECT_TRUE(all.contains(name)) << width << ' ' << name << ": " << all.join('|').toStdString();
        for (const auto& [whole, brief] : {std::pair("roughness R", "R"), std::pair("pressure P", "P")})
            EXPECT_TRUE(all.contains(whole) || all.contains(brief)) << width << ": " << all.join('|').toStdString();
    }
    EXPECT_TRUE(written().contains("P")) << "for there is no room for more";
    shot(plots, "strips-narrow");
}

TEST_F(Plots, WhatConfirmsTheTrainsIsNamedInANarrowWindowToo) {
    TrainReport train;
    train.onset = toInstant(1);
    train.amplitude = 20;
    train.outcome = TrainOutcome::Delivered;
    train.measured = 19.8;
    tap.trains.push(train);
    feel(2);
    plots.addScopeReading(1, 19.9);
    const std::pair<const char*, const char*> keys[] = {
        {"commanded", "asked"}, {"delivered", "given"}, {"read back", "read"}, {"oscilloscope", "scope"}};
    for (const int width : {900, 390}) {  // 390 fits a window of 1024 pixels with open docks
        plots.resize(width, 700);
        draw();
        const auto all = written();
        for (const auto& [whole, brief] : keys)
            EXPECT_TRUE(all.contains(whole) || (width < 900 && all.contains(brief)))
                << width << ' ' << whole << ": " << all.join('|').toStdString();
        EXPECT_EQ(plotWordFaults(plots).join('\n').toStdString(), "") << width;
    }
    shot(plots, "strips-narrow-confirmed");
    gui::applyTheme(gui::Theme::Dark);
    draw();
    shot(plots, "strips-narrow-confirmed-dark");
}

TEST_F(Plots, NumbersOfALowStripDoNotLieOnEachOther) {
    feel(2);
    for (const int height : {1000, 700, 420, 330}) {
        plots.resize(900, height);
        draw();
        draw();
        EXPECT_EQ(plotWordFaults(plots).join('\n').toStdString(), "") << height;
    }
    shot(plots, "strips-low");
}

TEST_F(Plots, AnAxisOfWhatIsZeroThroughoutHasPlainNumbers) {
    taxels_Pa = 0;
    feel(2);
    draw();
    const auto* axis = plots.axisRects().at(2)->axis(QCPAxis::atLeft);
    EXPECT_GE(axis->range().size(), 0.4) << "not around a billionth";
    for (const auto& label : axis->tickVectorLabels()) EXPECT_FALSE(label.contains('e')) << label.toStdString();
}

TEST_F(Plots, AStripWithoutItsStreamIsLeftOut) {
    history.begin({kPlotted[2]});
    plots.begin(false, true, "mA");
    EXPECT_FALSE(plots.has(StreamKind::Acceleration));
    EXPECT_FALSE(plots.has(StreamKind::Force));
    EXPECT_TRUE(plots.has(StreamKind::Taxels));
    draw();
    EXPECT_LE(plots.axisRects().first()->outerRect().height(), 8);
    EXPECT_GT(plots.axisRects().at(2)->height(), 100) << "the others have its place";
}

TEST(TaxelMap, IsBluerWhereItIsPressed) {
    gui::TaxelMap map;
    map.resize(400, 200);
    const float rest[] = {100, 100, 100, 100, 100, 100, 100, 100};
    map.show(rest, "Pa");
    const float pressed[] = {100, 100, 5100, 100, 100, 100, 100, std::nanf("")};
    map.show(pressed, "Pa");
    EXPECT_FLOAT_EQ(map.values()[2], 5000);
    EXPECT_FLOAT_EQ(map.values()[1], 0);
    EXPECT_TRUE(std::isnan(map.values()[7]));
    const auto fresh = map.grab().toImage();
    const QColor there = fresh.pixelColor(210, 10), elsewhere = fresh.pixelColor(110, 10);
    EXPECT_LT(there.lightness(), elsewhere.lightness() - 40);
    EXPECT_GT(there.blue() - there.red(), 80);
    EXPECT_GE(gui::contrast(there, gui::colours().text), 4.5) << "a full cell is light enough for its number";
    map.setStale(true);
    EXPECT_NE(map.grab().toImage(), fresh) << "old values are marked";
}

TEST(TaxelMap, SaysThatItIsSimulatedWhereNoNumberStands) {
    RecordProperty("hazard", "H9");
    gui::TaxelMap map;
    const float eight[] = {0, 0, 0, 0, 0, 0, 0, 0};
    map.show(eight, "Pa");
    const auto before = map.sizeHint();
    map.setSimulated(true);
    const int line = map.sizeHint().height() - before.height();
    EXPECT_GE(line, QFontMetrics(gui::textFont(gui::TextSize::Small)).ascent());
    map.resize(map.sizeHint().expandedTo({280, 0}));
    const auto marked = map.grab().toImage();
    map.setSimulated(false);
    map.resize(before.expandedTo({280, 0}));
    const auto cells = map.grab().toImage();
    EXPECT_EQ(marked.copy(0, line, cells.width(), cells.height()), cells) << "the cells are as they are without it";
    shot(map, "taxels");
}

TEST(CommandPanel, NamesTheConditionThatThePointIsNear) {
    gui::CommandPanel panel;
    const std::vector<Condition> conditions{{"smooth-low", 0, 0}, {"rough-high", 1, 1}};
    Telemetry telemetry;
    telemetry.roughness = 0.95;
    telemetry.pressure = 0.9;
    panel.show(telemetry, false, conditions);
    EXPECT_EQ(panel.findChild<QLabel*>("commandIndices")->text(), "near rough-high · R 0.95, P 0.90");
    telemetry.pressure = 0.5;
    panel.show(telemetry, false, conditions);
    EXPECT_EQ(panel.findChild<QLabel*>("commandIndices")->text(), "R 0.95, P 0.50");
    panel.show(telemetry, true, conditions);
    EXPECT_EQ(panel.findChild<QLabel*>("commandIndices")->text(), "") << "not of old samples";
}

TEST(Plane, ThePresentPointIsSeenWhereItStandsOnACondition) {
    gui::TactilePlane plane;
    plane.resize(400, 400);
    plane.setConditions({{"rough-high", 1, 1}});
    plane.setVisible(true);
    const auto atTheMark = [&plane] {
        plane.replot();
        const QPointF at(plane.xAxis->coordToPixel(1), plane.yAxis->coordToPixel(1));
        return plane.grab().toImage().pixelColor((at * plane.devicePixelRatioF()).toPoint());
    };
    const auto without = atTheMark();
    plane.show(Series(1, 10), 0, 1, 1, true);
    EXPECT_NE(atTheMark(), without);
}

const std::vector<StreamInfo> kStreams{{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "a"},
                                       {StreamKind::Force, StreamUnit::Newton, 1, 200, "f"}};

TapSample sampleAt(double t_s, std::uint32_t stream, float value) {
    TapSample sample;
    sample.t_s = t_s;
    sample.stream = stream;
    sample.channels = stream == 0 ? 3 : 1;
    sample.values.fill(value);
    return sample;
}

Telemetry at(double t_s) {
    Telemetry telemetry;
    telemetry.at = toInstant(t_s);
    return telemetry;
}

TEST(Series, KeepsTheNewestInOrder) {
    Series series(2, 5);
    for (int i = 0; i < 12; ++i) series.push(i, std::array{float(i), float(-i)});
    ASSERT_EQ(series.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_DOUBLE_EQ(series.time(i), 7.0 + double(i));
        EXPECT_FLOAT_EQ(series.value(i, 0), 7.F + float(i));
        EXPECT_FLOAT_EQ(series.value(i, 1), -7.F - float(i));
    }
    EXPECT_EQ(series.firstFrom(8.5), 2U);
    EXPECT_EQ(series.firstFrom(100), 5U);
}

TEST(Series, AChannelThatWasNotSentIsAbsent) {
    Series series(3, 4);
    series.push(1, std::array{5.F});
    EXPECT_FLOAT_EQ(series.value(0, 0), 5.F);
    EXPECT_TRUE(std::isnan(series.value(0, 2)));
}

TEST(Series, LeavesOutRepeatsAndBeginsAnewOnAnotherClock) {
    Series series(1, 10);
    for (const double t : {10.0, 10.1, 10.1, 10.05, std::nan(""), 10.2}) series.push(t, std::array{float(t)});
    ASSERT_EQ(series.size(), 3U);
    EXPECT_DOUBLE_EQ(series.newest(), 10.2);
    series.push(2.0, std::array{2.F});
    ASSERT_EQ(series.size(), 1U);
    EXPECT_DOUBLE_EQ(series.newest(), 2.0);
}

TEST(LiveHistory, IsBoundedToAMinute) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    for (int second = 0; second < 100; ++second) {
        for (int i = 0; i < 4000; ++i) tap.samples.push(sampleAt(second + i / 4000.0, 0, float(second)));
        for (int i = 0; i < 70; ++i) {
            RoughnessFrame frame;
            frame.t_s = second + i / 70.0;
            tap.frames.push(frame);
            history.take(tap, at(frame.t_s));
        }
    }
    const auto& acceleration = *history.samples(StreamKind::Acceleration);
    EXPECT_EQ(acceleration.size(), std::size_t(4000 * LiveHistory::kKept_s));
    EXPECT_EQ(acceleration.size(), acceleration.capacity());
    EXPECT_NEAR(acceleration.newest() - acceleration.time(0), LiveHistory::kKept_s, 0.01);
    EXPECT_EQ(history.frames().size(), std::min<std::size_t>(7000, history.frames().capacity()));
    EXPECT_LE(history.commands().size(), history.commands().capacity());
    EXPECT_EQ(history.missed(), 0U);
}

TEST(LiveHistory, SaysWhatTheDisplayLeftOut) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    const auto room = tap.samples.capacity();
    for (std::size_t i = 0; i < room + 50; ++i) tap.samples.push(sampleAt(double(i) / 4000, 0, 0));
    history.take(tap, at(5));
    EXPECT_EQ(history.missed(), 50U);
    EXPECT_EQ(history.samples(StreamKind::Acceleration)->size(), room);
}

TEST(LiveHistory, KeepsTheCommandOverTime) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    auto telemetry = at(1);
    history.take(tap, telemetry);
    telemetry = at(2);
    telemetry.amplitude_v = 25;
    telemetry.interval_s = 0.5;
    telemetry.impedance_ohm = 1000;
    history.take(tap, telemetry);
    ASSERT_EQ(history.commands().size(), 2U);
    EXPECT_TRUE(std::isnan(history.commands().value(0, LiveHistory::kAmplitude_v)));
    EXPECT_FLOAT_EQ(history.commands().value(1, LiveHistory::kAmplitude_v), 25);
    EXPECT_FLOAT_EQ(history.commands().value(1, LiveHistory::kInterval_s), 0.5F);
    EXPECT_FLOAT_EQ(history.commands().value(1, LiveHistory::kImpedance_ohm), 1000);
}

TEST(LiveHistory, AnotherBenchLeavesNothingOfTheOneBefore) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    tap.samples.push(sampleAt(1, 1, 3));
    for (std::size_t i = 0; i < LiveHistory::kMaxTrains + 30; ++i) {
        TrainReport train;
        train.amplitude = double(i);
        tap.trains.push(train);
        history.take(tap, at(1));
    }
    tap.frames.push(RoughnessFrame{});
    history.take(tap, at(1));
    ASSERT_EQ(history.trains().size(), LiveHistory::kMaxTrains) << "the oldest go";
    EXPECT_DOUBLE_EQ(history.trains().front().amplitude, 30);
    history.begin({kStreams.back()});
    EXPECT_EQ(history.samples(StreamKind::Acceleration), nullptr);
    EXPECT_TRUE(history.samples(StreamKind::Force)->empty());
    EXPECT_TRUE(history.frames().empty());
    EXPECT_TRUE(history.commands().empty());
    EXPECT_TRUE(history.trains().empty());
    EXPECT_EQ(history.now_s(), 0);
}

TEST_F(Plots, ShowWhatABoardEncodesOverTheBenchsWithTheDifference) {
    feel(1);
    EXPECT_FALSE(plots.readingsText().contains("board"));
    for (int k = 0; k < 60; ++k) {
        const double t = 1 + 0.016 * k;
        tap.frames.push(
            {.t_s = t, .contact = true, .sliding = true, .h = 1, .v = 1, .R = 0.5, .pressure_pa = 1, .P = 0.3});
        EncodedFrame board;
        board.t_s = t + 0.001;
        board.R = k == 30 ? 0.504 : 0.501;
        board.P = 0.2995;
        tap.boardFrames.push(board);
    }
    EncodedFrame alone;
    alone.t_s = 1.97;
    alone.R = 0.9;
    tap.boardFrames.push(alone);
    EncodedTrain train;
    train.onset_s = 1.5;
    train.amplitude = 24;
    tap.boardTrains.push(train);
    feel(2);
    ASSERT_EQ(history.boardFrames().size(), 61U);
    EXPECT_NEAR(history.boardFrames().value(30, LiveHistory::kAboveR), 0.004, 1e-6);
    EXPECT_NEAR(history.boardFrames().value(0, LiveHistory::kAboveP), -0.0005, 1e-6);
    EXPECT_TRUE(std::isnan(history.boardFrames().value(60, LiveHistory::kAboveR))) << "the bench has no such frame";
    for (int i = 0; i < 4; ++i) draw();
    EXPECT_TRUE(plots.readingsText().contains("board within 0.0040 and 0.0005")) << plots.readingsText().toStdString();
    EXPECT_EQ(plots.trains().boardTrains(), std::vector<double>{24});
    history.begin(kPlotted);
    EXPECT_TRUE(history.boardFrames().empty() && history.boardTrains().empty());
}

}  // namespace
}  // namespace tacto::test
