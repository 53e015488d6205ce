// Tests that the oscilloscope's choices return at the next start, and that damaged settings do no harm.
#include <QCheckBox>
#include <QComboBox>
#include <QSpinBox>
#include <QSplitter>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/scope/panels/QuantitySpin.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::ScopeMode;
using gui::ScopeWorkspace;

void chooseItem(QWidget& in, const char* box, const QString& text) {
    auto* combo = find<QComboBox>(in, box);
    ASSERT_NE(combo, nullptr) << box;
    const int wanted = combo->findText(text);
    ASSERT_GE(wanted, 0) << text.toStdString();
    combo->setFocus();
    while (combo->currentIndex() != wanted) {
        QTest::keyClick(combo, combo->currentIndex() < wanted ? Qt::Key_Down : Qt::Key_Up);
    }
}

TEST_F(Scope, WhatWasChosenIsThereAgainAtTheNextStart) {
    showATrain();
    QTest::keyClick(&scope.screen(), Qt::Key_N);
    chooseItem(scope, "Record length", "20\u202fms");
    chooseItem(scope, "Sampling rate", "5\u202fMHz");
    chooseItem(scope, "Voltage range", "±100\u202fV");
    auto* level = find<gui::QuantitySpin>(scope, "Trigger level");
    level->setFocus();
    level->selectAll();
    QTest::keyClicks(level, "3.5 V");
    QTest::keyClick(level, Qt::Key_Return);
    auto* before = find<QSpinBox>(scope, "Pre-trigger");
    before->setFocus();
    before->selectAll();
    QTest::keyClicks(before, "25");
    QTest::keyClick(before, Qt::Key_Return);
    click(*find<QCheckBox>(scope, "Power V·I"));
    chooseItem(scope, "Average", "64 captures");
    scope.readings().choose(gui::Reading::Rms, true);
    chooseItem(scope, "Captures that stay", "and 8 before");
    ASSERT_IN_TIME(comes([&] { return find<QDoubleSpinBox>(scope, "Offset of Power") != nullptr; }));
    chooseItem(scope, "Time base", "100\u202fµs/div");  // the box may already show 200 µs: chooses another first
    chooseItem(scope, "Time base", "200\u202fµs/div");
    auto* offset = find<QDoubleSpinBox>(scope, "Offset of Current");
    offset->setFocus();
    offset->selectAll();
    QTest::keyClicks(offset, "-2.5");
    QTest::keyClick(offset, Qt::Key_Return);
    EXPECT_EQ(offset->value(), -2.5);
    EXPECT_EQ(offset->text(), "−2.50 div") << "a minus sign, as in every number";
    chooseItem(scope, "Scale of Current", "20\u202fmA/div");
    auto* panels = scope.findChild<QSplitter*>();
    auto* handle = panels->handle(2);
    drag(*handle, handle->rect().center(), handle->rect().center() - QPoint(0, 40));
    const auto sizes = panels->sizes();
    const auto view = scope.model().viewport();
    scope.hide();

    ScopeWorkspace next(controller);
    next.resize(scope.size());
    next.QWidget::show();
    EXPECT_EQ(next.mode(), ScopeMode::Normal);
    const auto settings = next.settings();
    EXPECT_NEAR(settings.triggerLevel, 3.5, 1e-9);
    EXPECT_NEAR(settings.preTrigger, 0.25, 1e-9);
    EXPECT_DOUBLE_EQ(settings.sampleRate.value(), 5e6);
    EXPECT_EQ(settings.samples, 100'000U);
    EXPECT_DOUBLE_EQ(settings.voltageRange.value(), 100);
    ASSERT_IN_TIME(comesTrue([&] {
        next.refresh(controller.telemetry());
        return next.model().shown() != nullptr;
    }));
    EXPECT_TRUE(find<QCheckBox>(next, "Power V·I")->isChecked());
    EXPECT_EQ(next.model().lanes().size(), 3U);
    EXPECT_DOUBLE_EQ(next.model().viewport().perDivision_s, 200e-6);
    EXPECT_DOUBLE_EQ(next.model().viewport().left_s, view.left_s);
    EXPECT_EQ(next.model().viewport().lanes.at("channel/current"), (gui::LaneScale{20e-3, -2.5}));
    EXPECT_EQ(next.model().viewport().lanes.at("channel/voltage"), view.lanes.at("channel/voltage"));
    EXPECT_EQ(find<QComboBox>(next, "Captures that stay")->currentText(), "and 8 before");
    EXPECT_EQ(find<QComboBox>(next, "Average")->currentText(), "64 captures");
    EXPECT_TRUE(next.readings().has(gui::Reading::Rms));
    const auto again = next.findChild<QSplitter*>()->sizes();
    ASSERT_EQ(again.size(), sizes.size());
    for (int i = 0; i < sizes.size(); ++i) EXPECT_NEAR(again[i], sizes[i], 3) << i;
}

TEST_F(Scope, AViewThatNobodyTouchedIsFittedAnewAtTheNextStart) {
    showATrain();
    scope.hide();
    EXPECT_FALSE(QSettings().contains("scope/time/left"));
    EXPECT_EQ(QSettings().value("scope/lanes/size", 0).toInt(), 0);
}

TEST_F(Scope, NonsenseInTheSettingsFallsBackToTheDefaults) {
    const auto expected = scope.settings();
    const auto sizes = scope.findChild<QSplitter*>()->sizes();
    scope.hide();
    QSettings settings;
    settings.beginGroup("scope");
    for (const auto* key : {"mode",
                            "trigger/level",
                            "trigger/preTrigger",
                            "trigger/onCurrent",
                            "record/length",
                            "record/rate",
                            "record/volts",
                            "record/amps",
                            "math/power",
                            "spectrum",
                            "persistence",
                            "panels",
                            "controls",
                            "time/left",
                            "time/perDivision",
                            "math/difference",
                            "average",
                            "readings",
                            "mask/volts",
                            "mask/amps",
                            "mask/time",
                            "fft/window",
                            "fft/log",
                            "fft/levels",
                            "fft/peaks",
                            "trigger/kind",
                            "trigger/edge",
                            "trigger/upper",
                            "trigger/hysteresis",
                            "trigger/shortest",
                            "trigger/longest",
                            "trigger/holdOff"}) {
        settings.setValue(key, "nonsense");
    }
    settings.setValue("trigger/level", -1e9);
    settings.setValue("trigger/preTrigger", 1e12);
    settings.setValue("record/length", "nan");
    settings.setValue("record/rate", 12345.0);
    settings.setValue("time/left", 0);
    settings.setValue("time/perDivision", 1e300);
    settings.setValue("lanes/size", 2'000'000'000);
    settings.setValue("lanes/1/key", "channel/voltage");
    settings.setValue("lanes/1/perDivision", -3.3);
    settings.setValue("lanes/1/position", 0);
    settings.setValue("lanes/2/key", "channel/current");
    settings.setValue("lanes/2/perDivision", 0.1);
    settings.setValue("lanes/2/position", "inf");
    settings.sync();

    ScopeWorkspace next(controller);
    next.resize(scope.size());
    next.QWidget::show();
    EXPECT_EQ(next.mode(), ScopeMode::Auto);
    const auto now = next.settings();
    EXPECT_EQ(now.triggerLevel, expected.triggerLevel);
    EXPECT_EQ(now.preTrigger, expected.preTrigger);
    EXPECT_EQ(now.triggerOnCurrent, expected.triggerOnCurrent);
    EXPECT_EQ(now.sampleRate, expected.sampleRate);
    EXPECT_EQ(now.samples, expected.samples);
    EXPECT_EQ(now.voltageRange, expected.voltageRange);
    EXPECT_EQ(now.currentRange, expected.currentRange);
    const auto chosen = next.model().chosenView();
    EXPECT_FALSE(chosen.time);
    EXPECT_TRUE(chosen.lanes.empty());
    next.show(std::make_shared<const Capture>(twoPulses()));
    ASSERT_IN_TIME(comesTrue([&] { return next.model().shown() != nullptr; }));
    EXPECT_EQ(next.model().lanes().size(), 2U) << "no calculation was switched on";
    EXPECT_FALSE(find<QToolButton>(next, "Controls")->isChecked());
    QCoreApplication::processEvents();
    const auto again = next.findChild<QSplitter*>()->sizes();
    EXPECT_GE(again[0], std::min(sizes[0], 50));
}

TEST(ScopeQuantityDigits, FourAreShownAndTheOthersKept) {
    gui::QuantitySpin spin("V", 0, 50);
    spin.show();
    spin.setValue(7.52317);
    EXPECT_EQ(spin.text(), "7.523\u202fV");
    spin.setFocus();
    QTest::keyClick(&spin, Qt::Key_Return);
    EXPECT_DOUBLE_EQ(spin.value(), 7.52317) << "looking at it changes nothing";
    spin.setValue(0.0123456);
    EXPECT_EQ(spin.text(), "12.35\u202fmV");
    spin.setValue(40);
    EXPECT_EQ(spin.text(), "40\u202fV");
}

}  // namespace
}  // namespace tacto::test
