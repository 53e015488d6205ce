// Tests that a notice ends with its state, each name has one limit, and texts about the output are true (H2, H7, H12).
#include <QCheckBox>
#include <QRegularExpression>
#include <QToolButton>
#include <map>
#include <random>
#include <set>

#include "app/gui/live/CommandPanel.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/FaultBanner.h"
#include "app/gui/window/LimitBar.h"
#include "app/gui/window/OutputDocks.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/StateWords.h"
#include "app/run/Shipped.h"
#include "core/acquisition/StreamHealth.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

/// All text visible in the program's windows, without the log, whose lines have a time.
std::vector<std::string> textsInSight() {
    std::vector<std::string> all;
    for (auto* top : QApplication::topLevelWidgets()) {
        if (!top->isVisible()) continue;
        for (const auto* each : top->findChildren<QWidget*>()) {
            if (!each->isVisible()) continue;
            if (const auto* label = qobject_cast<const QLabel*>(each)) all.push_back(label->text().toStdString());
            if (const auto* button = qobject_cast<const QAbstractButton*>(each))
                all.push_back(button->text().toStdString() + ' ' + button->toolTip().toStdString());
        }
    }
    return all;
}

std::string inSightWith(const std::string& words) {
    for (const auto& text : textsInSight())
        if (text.find(words) != text.npos) return text;
    return {};
}

class Notices : public Window {
protected:
    Notices() { RecordProperty("hazard", "H12"); }
    void stopAndWait() {
        window.controller().stop("operator (STOP)");
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    }
};

TEST_F(Notices, ThatTheOutputIsOffIsNotReadWhileItIsOn) {
    open();
    std::mt19937 random(47);
    const std::function<void()> complaints[] = {
        [this] { window.openFile("/nowhere/at/all.xyz"); },
        [this] { emit window.controller().failed("stopped: operator (Esc). Output is off."); },
        [this] { emit window.controller().failed("the declared load is not confirmed"); },
        [this] { stopAndWait(); },
    };
    for (int round = 0; round < 6; ++round) {
        complaints[random() % std::size(complaints)]();
        complaints[random() % std::size(complaints)]();
        letLive(80);
        EXPECT_NE(inSightWith("Output is off"), "") << "it is said while it is so";
        ASSERT_NO_FATAL_FAILURE(arm());
        if (random() % 2 == 0) ASSERT_NO_FATAL_FAILURE(deliver());
        ASSERT_IN_TIME(comesTrue([] { return inSightWith("Output is off").empty(); }))
            << nameOf(state()) << ": " << inSightWith("Output is off");
        window.showWorkspace(int(random() % 7));
        letLive(80);
        EXPECT_EQ(inSightWith("Output is off"), "") << "on every page";
        window.showWorkspace(0);
        ASSERT_NO_FATAL_FAILURE(stopAndWait());
    }
}

TEST_F(Notices, WhatARunEndedWithIsSaidOfThen) {
    ASSERT_NO_FATAL_FAILURE(visit(3));
    QPushButton* run = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        run = find<QPushButton>(window, "runButton");
        return run != nullptr && run->isEnabled();
    }));
    bool over = false;
    QObject::connect(&window.controller(), &gui::BenchController::finished, &window, [&over] { over = true; });
    click(*find<QAbstractButton>(window, "Wiring"));
    find<QCheckBox>(window, "realtime")->setChecked(true);
    click(*run);
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Delivering; }, 30'000));
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([&] { return over; }, 30'000));
    ASSERT_IN_TIME(comesTrue([] { return !inSightWith("was switched off").empty(); }));
    window.openSimulatedBench();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    window.showWorkspace(3);  // the opened bench led to Live
    ASSERT_NO_FATAL_FAILURE(arm());
    EXPECT_IN_TIME(comesTrue([] { return inSightWith("Output is off").empty(); })) << inSightWith("Output is off");
    EXPECT_NE(inSightWith("was switched off"), "") << "the result says it of its run";
}

/// If the stimulator stays on, no message may say that the output is off, however the run ended.
TEST_F(Notices, ARunThatLeavesAStimulatorStuckOnSaysSo) {
    RecordProperty("hazard", "H2");
    auto* line = window.findChild<QToolButton*>("lastMessage");
    ASSERT_NE(line, nullptr);
    for (const auto verdict : {ScriptVerdict::None, ScriptVerdict::Stopped}) {
        for (const auto cause : {FaultCause::StuckOn, FaultCause::OpenElectrode}) {
            auto run = std::make_shared<gui::FinishedRun>();
            run->order.script.name = "separability";
            run->result.outcome.verdict = verdict;
            run->result.outcome.error =
                Error{ErrorCode::Device, fmt::format("fault: the reason. {}", outputAfter(cause))};
            emit window.controller().finished(run);
            const auto said = line->text() + line->toolTip();
            EXPECT_EQ(said.contains("may still be on"), cause == FaultCause::StuckOn) << said.toStdString();
            EXPECT_EQ(said.contains("Output is off"), cause != FaultCause::StuckOn) << said.toStdString();
            emit window.controller().failed(QString::fromStdString(run->result.outcome.error->message));
            const auto notice = banner();
            EXPECT_EQ(notice.contains("Output is off"), cause != FaultCause::StuckOn) << notice.toStdString();
        }
    }
}

TEST(WordsOfTheOutput, OfAStimulatorThatIsStuckOnNeitherSayThatItIsOffNorBlameTheCable) {
    testing::Test::RecordProperty("hazard", "H2");
    Telemetry telemetry;
    telemetry.state = InterlockState::Faulted;
    telemetry.reason = "the stimulator still delivers 50 ms after its train should have ended";
    telemetry.fault = causeOf(TrainFinding::StuckOn);
    gui::FaultBanner banner(nullptr);
    for (int trains = 0; trains < 4; ++trains) {
        telemetry.trainsDelivered = std::uint64_t(trains);
        banner.refresh(telemetry, QTime(12, 0));
        for (const auto& said : {banner.text(), gui::stateWords(telemetry, {})}) {
            EXPECT_FALSE(said.contains("output is off", Qt::CaseInsensitive)) << said.toStdString();
            EXPECT_FALSE(said.contains("cable", Qt::CaseInsensitive)) << said.toStdString();
        }
        EXPECT_TRUE(banner.text().contains("its own switch")) << banner.text().toStdString();
    }
    // After all other faults the output is off.
    for (int cause = 0; cause < kFaultCauseCount; ++cause) {
        if (FaultCause(cause) == FaultCause::StuckOn) continue;
        telemetry.fault = FaultCause(cause);
        banner.refresh(telemetry, QTime(12, 0));
        EXPECT_TRUE(banner.text().contains("Output is off")) << nameOf(FaultCause(cause));
    }
}

TEST(WordsOfTheOutput, WhatTheFingertipDoesNotDriveIsNotCalledFreshOrDriven) {
    testing::Test::RecordProperty("hazard", "H7");
    std::mt19937 random(7);
    for (int i = 0; i < 400; ++i) {
        Telemetry telemetry;
        telemetry.state = random() % 2 == 0 ? InterlockState::Delivering : InterlockState::Armed;
        telemetry.driving = DriveSource::Sensor;
        telemetry.finger = FingerStanding(1 + random() % 3);
        telemetry.sensorAge_s = std::uniform_real_distribution(-0.3, 0.3)(random);
        const bool commanded = telemetry.finger == FingerStanding::Fresh && random() % 2 == 0;
        telemetry.interval_s = commanded ? 0.5 : NAN;
        const auto health = gui::healthWords(telemetry, true, 0);
        const bool drives =
            telemetry.finger == FingerStanding::Fresh && telemetry.sensorAge_s <= StreamHealth::kStale_s;
        if (telemetry.finger == FingerStanding::Fresh && !drives) continue;  // the loop calls no such fingertip fresh
        EXPECT_EQ(health.text.contains("fresh"), drives) << health.text.toStdString();
        const bool warns = telemetry.finger == FingerStanding::Implausible ||
                           telemetry.sensorAge_s > StreamHealth::kStale_s || telemetry.sensorAge_s < 0;
        if (!drives) EXPECT_EQ(health.stale, warns) << health.text.toStdString();
        if (telemetry.state != InterlockState::Delivering) continue;
        for (const auto* protocol : {"", "Separability"}) {
            const auto words = gui::stateWords(telemetry, protocol);
            if (telemetry.finger == FingerStanding::Fresh && *protocol != '\0') continue;
            EXPECT_EQ(words.startsWith("No train"), !commanded) << words.toStdString();
        }
    }
}

/// A fingertip without numbers, on the bench: the text while nothing is sent.
TEST_F(Notices, AFingertipWithoutReadingsIsSaidWhereTheStateStands) {
    RecordProperty("hazard", "H7");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:finger?fault=nan@6s"));
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = window.controller().profile();
    window.controller().openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    window.controller().present("P120", 50, 1);
    window.showWorkspace(0);
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(0);
    ASSERT_NO_FATAL_FAILURE(arm());
    window.controller().drive(DriveSource::Sensor);
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Delivering; }));
    ASSERT_IN_TIME(
        comesTrue([this] { return window.controller().telemetry().finger == FingerStanding::Implausible; }, 15'000));
    ASSERT_IN_TIME(comesTrue([] { return !inSightWith("No train: the fingertip").empty(); }));
    const auto trains = window.controller().telemetry().trainsDelivered;
    letLive(1200);
    EXPECT_LE(window.controller().telemetry().trainsDelivered, trains + 1) << "none is sent";
    EXPECT_EQ(inSightWith("Samples are fresh"), "");
    EXPECT_NE(inSightWith("No readings"), "");
    EXPECT_EQ(inSightWith("touches nothing"), "") << "it is not known";
    EXPECT_NE(inSightWith("gives no readings: no train"), "") << "in the dock of the drive";
}

/// In bar and dock, the same name always stands next to the same limit, whatever is judged.
TEST(NamesOfLimits, EachHasOneLimit) {
    testing::Test::RecordProperty("hazard", "H12");
    std::map<QString, std::pair<Quantity, JudgedAt>> named;
    for (std::size_t i = 0; i < kQuantityCount; ++i) {
        for (const auto judged : {JudgedAt::LoadRange, JudgedAt::Ohm500}) {
            ExposureRow row;
            row.quantity = Quantity(i);
            row.judged = judged;
            const auto [at, isNew] = named.try_emplace(gui::shortRowTitle(row), row.quantity, judged);
            EXPECT_TRUE(isNew) << at->first.toStdString() << " is of two quantities";
        }
    }
}

TEST_F(Notices, ALimitIsNamedAboveAsInTheDock) {
    ASSERT_NO_FATAL_FAILURE(open());
    ASSERT_NO_FATAL_FAILURE(arm());
    static const QRegularExpression limit(QString::fromUtf8(R"(of\s([^,]+))"));
    std::map<std::string, std::set<std::string>> limits;  // the limits by the name next to them
    std::mt19937 random(47);
    for (int i = 0; i < 8; ++i) {
        window.controller().drive(DriveSource::Manual, std::uniform_real_distribution(0.0, 1.0)(random), 1);
        letLive(300);
        for (const auto* bar : window.findChildren<gui::LimitBar*>()) {
            const auto found = limit.match(bar->text());
            if (!found.hasMatch()) continue;
            limits[bar->title().toStdString()].insert(found.captured(1).toStdString());
        }
    }
    EXPECT_GE(limits.size(), 4U);
    for (const auto& [name, its] : limits) EXPECT_EQ(its.size(), 1U) << name << ": " << testing::PrintToString(its);
}

}  // namespace
}  // namespace tacto::test
