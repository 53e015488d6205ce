// Tests hardware in the window as a person meets it: ticked, opened, not permitted, unplugged, plugged in again.
#include <QComboBox>
#include <QHeaderView>
#include <QLineEdit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/window/HardwareBench.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr const char* kStimulator = "sciencemode:P24-0017";
constexpr const char* kBoard = "sensor:EMU-0001";

MATCHER_P(Says, part, "") { return arg.contains(QString::fromUtf8(part)); }

TEST_F(HardwareWindow, WhatIsPluggedInIsTickedOpenedAndSaysWhoItIs) {
    RecordProperty("hazard", "H4");
    choose(row(kStimulator));
    EXPECT_THAT(facts(), Says("Not open."));
    EXPECT_THAT(facts(), Says("Serial P24-0017"));
    open({kStimulator, kBoard});
    choose(row(kStimulator));
    EXPECT_THAT(facts(), Says(serial.text().c_str())) << "by its own word, not by the plug's";
    EXPECT_THAT(facts(), Says("Current source, at most"));
    EXPECT_THAT(facts(), testing::Not(Says("Simulated"))) << "what an emulated device says of itself does not count";
    EXPECT_TRUE(row(kStimulator).font(0).bold());
    int lines = 0;
    for (int i = 0; i < tree().topLevelItemCount(); ++i)
        lines += tree().topLevelItem(i)->data(0, Qt::UserRole).toString().startsWith("sciencemode:") ? 1 : 0;
    EXPECT_EQ(lines, 1) << "open, and not offered once more";
    shot(window, "hardware_open");
}

TEST_F(HardwareWindow, ASensorBoardShowsWhatItsLineIsLike) {
    RecordProperty("hazard", "H7");
    open({kBoard});
    choose(row(kBoard));
    EXPECT_THAT(facts(), Says("<br>Acceleration: 3 channels, "));
    ASSERT_IN_TIME(
        comesTrue([this] { return facts().contains("<br>Samples: ") && facts().contains("Nothing was lost."); }));
    EXPECT_IN_TIME(!facts().contains("clock drift", Qt::CaseInsensitive)) << "not known before 2 s";
    ASSERT_IN_TIME(
        comesTrue([this] { return facts().contains("Clock drift: ") && facts().contains("Drift uncertainty"); }));
    EXPECT_FALSE(facts().contains("⚠"));
    board->inspect([](auto& b, Instant) { b.dropNext(0); });
    EXPECT_IN_TIME(comesTrue([this] { return facts().contains("Samples lost: 32") && facts().contains("⚠"); }));
    shot(window, "hardware_board");
}

TEST_F(HardwareWindow, ANameHasAsManyLinesAsItNeeds) {
    const QFontMetrics metrics(row(kStimulator).font(0));
    const auto high = [this] { return tree().visualItemRect(&row(kStimulator)).height(); };
    for (const QString name : {"Pad", "Vibrating pad of the second laboratory, number 2"}) {
        // The name can bring a scroll bar, which makes the column narrower.
        QRect lines;
        EXPECT_IN_TIME(comesTrue([&] {
            row(kStimulator).setText(0, name);
            emit tree().header()->sectionResized(0, 0, tree().columnWidth(0));
            QCoreApplication::processEvents();
            // Check box and edges take part of the width.
            const int beside = 2 * tree().style()->pixelMetric(QStyle::PM_IndicatorWidth);
            lines = metrics.boundingRect({0, 0, tree().columnWidth(0) - beside, 1000}, Qt::TextWordWrap, name);
            return high() >= lines.height() && high() < lines.height() + metrics.height();
        })) << name.toStdString()
            << ": " << high() << " of " << lines.height();
    }
    shot(window, "hardware_long_name");
}

TEST_F(HardwareWindow, OneThatMayNotBeOpenedSaysWhatHelpsAndCannotBeTicked) {
    plugs->permitted = false;
    ASSERT_IN_TIME(comesTrue([this] { return row(kStimulator).text(0).contains("⚠"); }));
    choose(row(kStimulator));
    EXPECT_THAT(facts(), Says("./dev install-rules"));
    letLive(50);
    const auto* text = window.findChild<QLabel*>("deviceFacts");
    EXPECT_GE(text->height(), text->heightForWidth(text->width())) << "the sentence that helps is cut";
    QTest::keyClick(&tree(), Qt::Key_Return);
    EXPECT_TRUE(window.findChild<QPushButton*>("openBench")->text().remove('&').contains("simulated"));
    shot(window, "hardware_not_permitted");
    plugs->permitted = true;
    ASSERT_IN_TIME(comesTrue([this] { return !row(kStimulator).text(0).contains("⚠"); }));
    tick(kStimulator);
}

TEST_F(HardwareWindow, OneThatDoesNotAnswerIsABannerAndNoBench) {
    stimulator->unplug();  // the list is up to a second old and still has it
    tick(kStimulator);
    click(*window.findChild<QPushButton*>("openBench"));
    ASSERT_IN_TIME(comesTrue([this] { return !banner().isEmpty(); }));
    EXPECT_THAT(banner(), Says("no stimulator \"P24-0017\" answers"));
    EXPECT_EQ(window.controller().activity(), gui::Activity::Closed);
}

TEST_F(HardwareWindow, OnlyTheOperatorSaysWhatIsConnected) {
    RecordProperty("hazard", "H12");
    open({kStimulator});
    auto* first = window.findChild<QPushButton*>("armButton");
    ASSERT_IN_TIME(comesTrue([&] { return first->isEnabled() && first->text().contains("…"); }));
    click(*first);
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_NE(second, nullptr);
    auto* load = second->window()->findChild<QLineEdit*>();
    EXPECT_EQ(load->text(), "");
    EXPECT_FALSE(second->isEnabled());
    shot(*second->window(), "arm_which_load");
    QTest::keyClicks(load, "470 ohm");
    EXPECT_TRUE(second->isEnabled());
    EXPECT_THAT(second->window()->findChild<QLabel*>("armingText")->text(), Says("into 470\u202fΩ"));
    click(*second);
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted || !banner().isEmpty(); }))
        << "1 kohm is connected";
}

TEST_F(HardwareWindow, APulledPlugFaultsSaysSoAndComesBackOnlyByAReset) {
    RecordProperty("hazard", "H2");
    open({kStimulator});
    arm();
    deliver();
    unplugStimulator();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }));
    ASSERT_IN_TIME(comesTrue([this] { return banner().contains("Output is off"); }));
    EXPECT_THAT(banner(), Says("Fault: "));
    ASSERT_IN_TIME(comesTrue([this] { return row(kStimulator).text(0).contains("⚠"); }));
    choose(row(kStimulator));
    EXPECT_THAT(facts(), Says("It was unplugged. Plug it in again, then reset the fault."));
    shot(window, "hardware_unplugged");
    pressReset();
    ASSERT_IN_TIME(comesTrue([this] { return banner().contains("ot reset"); }));
    EXPECT_EQ(state(), InterlockState::Faulted);

    plugStimulator();
    ASSERT_IN_TIME(comesTrue([this] { return !row(kStimulator).text(0).contains("⚠"); }));
    EXPECT_EQ(state(), InterlockState::Faulted) << "nothing comes back by itself";
    pressReset();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; })) << banner().toStdString();
    arm();
}

TEST_F(HardwareWindow, APulledSensorBoardEndsTheOutputToo) {
    RecordProperty("hazard", "H2");
    open({kStimulator, kBoard});
    arm();
    deliver();
    board->unplug();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }));
    ASSERT_IN_TIME(comesTrue([this] { return banner().contains("fingertip sensor failed"); }));
    const auto pulses = stimulator->pulses();
    letLive(700);
    EXPECT_EQ(stimulator->pulses(), pulses);
    board->plug();
    ASSERT_IN_TIME(comesTrue([this] { return !row(kBoard).text(0).contains("⚠"); }));
    pressReset();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; })) << banner().toStdString();
    EXPECT_IN_TIME(comesTrue([this] { return window.controller().telemetry().sensorAge_s < 0.1; }));
    EXPECT_IN_TIME(comesTrue([this] { return banner().isEmpty(); })) << banner().toStdString();
}

TEST_F(HardwareWindow, ARunThatAFaultEndedIsRunAgainByAResetThatAsks) {
    RecordProperty("hazard", "H12");
    visit(6);
    gui::ProtocolWorkspace* runner = nullptr;
    for (auto* each : window.findChildren<gui::ProtocolWorkspace*>())
        if (each->isVisible()) runner = each;
    ASSERT_NE(runner, nullptr);
    auto* chooser = runner->findChild<QComboBox*>("chooser");
    chooser->setCurrentIndex(chooser->findData("live"));
    ASSERT_IN_TIME(comesTrue([&] { return !runner->reads() && runner->findChild<QLineEdit*>("duration") != nullptr; }));
    runner->findChild<QLineEdit*>("devices")->setText(kStimulator + QString(" sim:finger"));
    runner->findChild<QLineEdit*>("duration")->setText("60");
    const auto presses = [&](const QString& text) {
        QPushButton* button = nullptr;
        ASSERT_IN_TIME(comesTrue([&] {
            button = find<QPushButton>(*runner, text);
            return button != nullptr && button->isEnabled();
        })) << text.toStdString();
        letLive(600);  // longer than a second step's wait
        click(*button);
    };
    const auto ended = [&] {
        return comesTrue([&] { return find<QPushButton>(*runner, "Reset fault and run again…") != nullptr; });
    };
    presses("Run");
    presses("Arm and run");
    const auto delivers = [this] {
        return comesTrue([this] { return window.controller().telemetry().trainsDelivered > 0; });
    };
    presses("Arm output");
    ASSERT_IN_TIME(delivers()) << runner->findChild<QLabel*>("runTrouble")->text().toStdString()
                               << runner->findChild<QLabel*>("verdictWhy")->text().toStdString()
                               << banner().toStdString();
    unplugStimulator();
    ASSERT_IN_TIME(ended());
    plugStimulator();
    presses("Run again");
    presses("Arm and run");
    ASSERT_IN_TIME(comesTrue([&] { return runner->findChild<QLabel*>("runTrouble")->text().contains("in a fault"); }))
        << "a run alone resets nothing";
    ASSERT_IN_TIME(ended());
    // As if another program had used the unit meanwhile.
    const auto unit = unitOf(serial.text(), kStimulator);
    const auto leaves = [&](FaultCause cause, const char* why) {
        SteadyClock clock;
        auto record = UnitRecord::open(unitFolders(), unit, clock);
        ASSERT_TRUE(record) << record.error().message;
        (*record)->clearFault();
        (*record)->keepFault(cause, why);
    };
    const auto* question = runner->findChild<QLabel*>("armQuestion");
    const auto* trouble = runner->findChild<QLabel*>("runTrouble");
    leaves(FaultCause::OpenElectrode, "the electrode is open");
    presses("Reset fault and run again…");
    EXPECT_THAT(question->text(), Says("fault is reset first"));
    EXPECT_THAT(question->text(), Says(unit.c_str()));
    EXPECT_THAT(question->text(), testing::Not(Says("electrode is open"))) << "not seen yet";
    presses("Arm and run");
    ASSERT_IN_TIME(comesTrue([&] { return trouble->text().contains("othing was reset"); }))
        << trouble->text().toStdString();
    EXPECT_THAT(trouble->text(), Says("electrode is open"));
    ASSERT_IN_TIME(ended());
    leaves(FaultCause::LimitBroken, "44 V were measured");
    presses("Run again");
    presses("Arm and run");
    ASSERT_IN_TIME(comesTrue([&] { return find<QPushButton>(*runner, "Go to safety check") != nullptr; }))
        << trouble->text().toStdString();
    EXPECT_EQ(find<QPushButton>(*runner, "Reset fault and run again…"), nullptr) << "the safety check comes first";
    leaves(FaultCause::OpenElectrode, "the electrode is open");
    presses("Run again");
    presses("Arm and run");
    ASSERT_IN_TIME(ended());
    presses("Reset fault and run again…");
    EXPECT_THAT(question->text(), Says("electrode is open"));
    EXPECT_EQ(window.controller().activity(), gui::Activity::Closed) << "nothing is opened before the answer";
    presses("Arm and run");
    presses("Arm output");
    EXPECT_IN_TIME(delivers()) << runner->findChild<QLabel*>("verdictWhy")->text().toStdString();
    window.controller().stop("a test");
    EXPECT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
}

TEST_F(HardwareWindow, LooksRightInEachThemeAndSmall) {
    open({kStimulator, kBoard});
    arm();
    deliver();
    const auto* stop = window.findChild<QPushButton*>("stopButton");
    for (const auto& [theme, name] : {std::pair(gui::Theme::Light, "light"), std::pair(gui::Theme::Dark, "dark")}) {
        gui::applyTheme(theme);
        for (const auto& [size, label] : {std::pair(QSize(1440, 900), ""), std::pair(QSize(1100, 700), "_small")}) {
            window.resize(size);
            letLive(150);
            EXPECT_TRUE(window.rect().contains(QRect(stop->mapTo(&window, QPoint(0, 0)), stop->size())));
            EXPECT_IN_TIME(window.findChild<QLabel*>("interlockState")->text() == "DELIVERING");
            EXPECT_EQ(faultsOf(window), "") << name << label;
            shot(window, QString("hardware_delivering_%1%2").arg(name, label));
        }
    }
    window.resize(1100, 700);
    unplugStimulator();
    ASSERT_IN_TIME(comesTrue([this] { return !banner().isEmpty() && row(kStimulator).text(0).contains("⚠"); }));
    choose(row(kStimulator));
    letLive(100);
    EXPECT_EQ(faultsOf(window), "");
    shot(window, "hardware_faulted_dark_small");
    gui::applyTheme(gui::Theme::Light);
    letLive(100);
    EXPECT_EQ(faultsOf(window), "");
    shot(window, "hardware_faulted_light_small");
}

TEST_F(HardwareWindow, AMinimisedWindowDeliversNothing) {
    RecordProperty("hazard", "H2");
    open({kStimulator});
    arm();
    deliver();
    window.showMinimized();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Paused; }, 2000));
    letLive(500);  // time for a train in progress to end
    const auto pulses = stimulator->pulses();
    letLive(700);
    EXPECT_EQ(stimulator->pulses(), pulses);
    EXPECT_TRUE(banner().contains("minimised")) << banner().toStdString();
    window.showNormal();
    letLive(300);
    EXPECT_EQ(state(), InterlockState::Paused) << "nothing comes back by itself";
    EXPECT_EQ(stimulator->pulses(), pulses);
    window.controller().close();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
}

}  // namespace
}  // namespace tacto::test
