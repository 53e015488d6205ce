// Tests that a mark has the time of its key press, appears in plots, session, export and report, and blocks no stop.
#include <QLineEdit>
#include <QSettings>
#include <QToolButton>
#include <fstream>
#include <gmock/gmock.h>

#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/sessions/ExportDialog.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/DayDialog.h"
#include "app/gui/window/MarkLine.h"
#include "app/report/SessionReport.h"
#include "core/session/SessionReader.h"
#include "tests/gui/Looks.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Marks : public Window {
protected:
    ~Marks() override { QSettings().clear(); }
    [[nodiscard]] QLineEdit& word() { return *window.findChild<QLineEdit*>("markWord"); }
    /// Activates the window: on the tests' platform no window is active after a dialog closes.
    void comeBack() {
        window.activateWindow();
        ASSERT_IN_TIME(comesTrue([this] { return window.isActiveWindow(); }));
    }
    void begin() {
        ASSERT_NO_FATAL_FAILURE(comeBack());
        key(Qt::Key_M, Qt::ControlModifier);
        ASSERT_IN_TIME(comesTrue([this] { return word().isVisible() && word().hasFocus(); }));
    }
    /// Closes the bench and returns the marks of its session.
    [[nodiscard]] std::vector<SessionRow> marksOf(const std::filesystem::path& session) {
        window.controller().close();
        EXPECT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
        auto events = SessionReader::open(session)->events().value();
        std::erase_if(events, [](const auto& event) { return event.name != kOperatorMarkEvent; });
        return events;
    }
};

TEST_F(Marks, AreOfTheMomentOfTheKeyAndStandEverywhere) {
    visit(0);
    open();
    const auto session = window.controller().open()->session;
    const auto before = window.controller().telemetry().at;
    ASSERT_NO_FATAL_FAILURE(begin());
    const auto pressed = window.controller().telemetry().at;
    ASSERT_IN_TIME(comesTrue([&] { return window.controller().telemetry().at > pressed + toInstant(0.5); }));
    QTest::keyClicks(&word(), "table bumped");
    shot(window, "mark-line");
    EXPECT_EQ(faultsOf(*window.findChild<gui::MarkLine*>()), "");
    QTest::keyClick(&word(), Qt::Key_Return);
    EXPECT_FALSE(word().isVisible());
    const auto& plots = window.findChild<gui::LiveWorkspace*>()->plots();
    EXPECT_IN_TIME(comesTrue([&] { return plots.marks().words() == QStringList{"table bumped"}; })) << "in the plots";
    letLive(150);
    shot(window, "mark-in-plots");

    const auto marks = marksOf(session);
    ASSERT_EQ(marks.size(), 1U);
    EXPECT_EQ(marks[0].body["text"], "table bumped");
    EXPECT_GE(marks[0].at, before);
    EXPECT_LE(marks[0].at, pressed) << "of the key, and not of Return";

    const ScratchDir folder;
    const gui::WorkPort port{std::make_shared<std::atomic<bool>>(false), [](int, int) {}};
    ASSERT_TRUE(gui::exportWith(port, session, *exportFormat("csv"), folder.path() / "csv"));
    std::ifstream csv(folder.path() / "csv" / "events.csv");
    const std::string exported{std::istreambuf_iterator<char>(csv), {}};
    EXPECT_THAT(exported, HasSubstr("operator mark,\"{\"\"text\"\":\"\"table bumped\"\"}\""));

    const auto report = readSessionReport(session);
    ASSERT_TRUE(report);
    EXPECT_TRUE(std::ranges::any_of(report->events, [](const auto& event) { return event.text == "table bumped"; }));
    for (const auto& mark : report->marks)
        EXPECT_FALSE(mark.contains("table bumped")) << "it is not a reservation about the results";
}

TEST_F(Marks, EveryStopWorksWhileTheWordIsTyped) {
    RecordProperty("hazard", "H2");
    open();
    auto* stop = window.findChild<QPushButton*>("stopButton");
    const std::pair<const char*, std::function<void()>> hands[] = {
        {"STOP", [&] { click(*stop); }},
        {"Esc", [&] { key(Qt::Key_Escape); }},
        {"Pause", [&] { key(Qt::Key_Pause); }},
        {"Shift+F5", [&] { key(Qt::Key_F5, Qt::ShiftModifier); }}};
    for (const auto& [name, hand] : hands) {
        arm();
        deliver();
        ASSERT_NO_FATAL_FAILURE(begin());
        QTest::keyClicks(&word(), "the lead came off");  // here a blank is typed
        ASSERT_EQ(word().text(), "the lead came off") << name;
        ASSERT_EQ(state(), InterlockState::Delivering) << name << ": typing is not a stop";
        hand();
        EXPECT_EQ(state(), InterlockState::Disarmed) << name << ": before the event returned";
        if (word().isVisible()) QTest::keyClick(&word(), Qt::Key_Return);
    }
    ASSERT_NO_FATAL_FAILURE(begin());
    key(Qt::Key_Escape);
    EXPECT_FALSE(word().isVisible()) << "Esc closes the line as well";
    arm();
    deliver();
    key(Qt::Key_Space);
    EXPECT_EQ(state(), InterlockState::Disarmed) << "the focus went back to where Space stops";
}

TEST_F(Marks, ChangeNothingOfTheOutput) {
    RecordProperty("hazard", "H2");
    open();
    const auto session = window.controller().open()->session;
    arm();
    deliver();
    const auto trains = window.controller().telemetry().trainsDelivered;
    const auto drive = window.controller().lastDrive();
    for (int i = 0; i < 50; ++i) ASSERT_TRUE(window.controller().markMoment(window.controller().telemetry().at, "now"));
    EXPECT_IN_TIME(state() == InterlockState::Delivering);
    EXPECT_EQ(window.controller().lastDrive().roughness, drive.roughness);
    EXPECT_IN_TIME(comesTrue([&] { return window.controller().telemetry().trainsDelivered > trains + 2; }))
        << "it goes on";
    EXPECT_EQ(marksOf(session).size(), 50U);
}

TEST_F(Marks, ASecondMomentKeepsTheFirst) {
    open();
    const auto session = window.controller().open()->session;
    ASSERT_NO_FATAL_FAILURE(begin());
    QTest::keyClicks(&word(), "first");
    const auto between = window.controller().telemetry().at;
    ASSERT_IN_TIME(comesTrue([&] { return window.controller().telemetry().at > between; }));
    ASSERT_NO_FATAL_FAILURE(begin());
    EXPECT_EQ(word().text(), "");
    QTest::keyClick(&word(), Qt::Key_Return);
    const auto marks = marksOf(session);
    ASSERT_EQ(marks.size(), 2U);
    EXPECT_EQ(marks[0].body["text"], "first");
    EXPECT_EQ(marks[1].body["text"], "mark") << "a moment without a word of its own";
    EXPECT_LE(marks[0].at, between);
    EXPECT_GT(marks[1].at, between);
}

TEST_F(Marks, NeedARecordingAndSayWhenThereIsNone) {
    key(Qt::Key_M, Qt::ControlModifier);
    EXPECT_FALSE(word().isVisible());
    EXPECT_THAT(banner().toStdString(), HasSubstr("There is nothing to mark: no bench is open"));
    open();
    ASSERT_NO_FATAL_FAILURE(begin());
    QTest::keyClicks(&word(), "late");
    window.controller().close();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    QTest::keyClick(&word(), Qt::Key_Return);
    EXPECT_THAT(banner().toStdString(), HasSubstr("“late” was not marked: its recording has ended"));
}

TEST_F(Marks, AreMadeWhileAProtocolRuns) {
    visit(3);
    auto* run = find<QPushButton>(window, "runButton");
    ASSERT_NE(run, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return run->isEnabled(); }));
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&window.controller(), &gui::BenchController::finished, &window,
                     [&](std::shared_ptr<const gui::FinishedRun> finished) { ended = std::move(finished); });
    click(*run);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Running; }));
    const auto at = window.controller().telemetry().at;
    ASSERT_TRUE(window.controller().markMoment(at, "during the run"));
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }, 60'000));
    const auto events = SessionReader::open(ended->result.session)->events().value();
    EXPECT_TRUE(std::ranges::any_of(events, [&](const auto& event) {
        return event.name == kOperatorMarkEvent && event.at == at && event.body["text"] == "during the run";
    }));
}

TEST_F(Marks, OperatorAndSampleOfTheDayStandInEverySessionAndAreShown) {
    auto* button = window.findChild<QToolButton*>("dayButton");
    ASSERT_TRUE(button->isVisible());
    EXPECT_EQ(button->text(), "Operator and sample…");
    click(*button);
    auto* dialog = window.findChild<gui::DayDialog*>();
    ASSERT_NE(dialog, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return dialog->isVisible(); }));
    QTest::keyClicks(dialog->findChild<QLineEdit*>("operator"), "A. Weber");
    QTest::keyClicks(dialog->findChild<QLineEdit*>("sample"), "S-014");
    shot(*dialog, "day");
    EXPECT_EQ(faultsOf(*dialog), "");
    click(*find<QPushButton>(*dialog, "Done"));
    EXPECT_EQ(button->text(), "A. Weber · sample S-014");
    EXPECT_GE(button->width(), button->sizeHint().width()) << "the text is cut";
    shot(window, "day-in-the-menu-bar");
    window.controller().day().set({.operatorName = std::string(200, 'w'), .sample = "S-014"});
    EXPECT_GE(button->width(), button->sizeHint().width());
    EXPECT_LT(button->width(), window.width() / 2) << "the menus keep their room";
    EXPECT_TRUE(button->toolTip().contains("S-014"));
    window.controller().day().set({.operatorName = "A. Weber", .sample = "S-014"});
    for (const auto* edit : window.findChildren<QLineEdit*>("sample")) EXPECT_EQ(edit->text(), "S-014");
    window.askForDay(true);
    EXPECT_EQ(find<QLabel>(window, "Who is working today, and on what?"), nullptr) << "asked once a day";
    ASSERT_NO_FATAL_FAILURE(comeBack());
    ASSERT_NO_FATAL_FAILURE(open());
    const auto session = window.controller().open()->session;
    const auto labels = SessionReader::open(session)->labels().value();
    EXPECT_EQ(labels.operatorName, "A. Weber");
    EXPECT_EQ(labels.sample, "S-014");
}

class ANewDay : public testing::Test {
protected:
    ANewDay() {
        window.resize(1440, 900);
        window.show();
        day().set({.operatorName = "A. Weber", .sample = "S-014", .reviewer = {}, .ambient = {}});
    }
    ~ANewDay() override {
        window.close();
        QSettings().clear();
    }
    [[nodiscard]] gui::DayNotes& day() { return window.controller().day(); }
    [[nodiscard]] gui::Activity activity() { return window.controller().activity(); }
    void passMidnight() { today = today.addDays(1); }
    [[nodiscard]] gui::DayDialog* question() {
        for (auto* dialog : window.findChildren<gui::DayDialog*>())
            if (dialog->isVisible()) return dialog;
        return nullptr;
    }
    void open() {
        window.openSimulatedBench();
        ASSERT_IN_TIME(comesTrue([this] { return activity() == gui::Activity::Live; }));
    }
    [[nodiscard]] QPushButton& run() { return *find<QPushButton>(window, "runButton"); }

    QDate today{2026, 11, 23};
    gui::MainWindow window{simulatedRegistry, [this] { return today; }};
};

TEST_F(ANewDay, IsAskedForBeforeABenchIsOpenedAndNotWhileOneIsOpen) {
    ASSERT_NO_FATAL_FAILURE(open());
    const auto first = window.controller().open()->session;
    passMidnight();
    letLive(200);
    EXPECT_EQ(question(), nullptr) << "the bench that is open goes on";
    window.controller().close();
    ASSERT_IN_TIME(comesTrue([this] { return activity() == gui::Activity::Closed; }));
    EXPECT_EQ(SessionReader::open(first)->labels().value().operatorName, "A. Weber");

    window.openSimulatedBench();
    ASSERT_NE(question(), nullptr) << "asked before the session begins";
    letLive(200);
    EXPECT_EQ(activity(), gui::Activity::Closed) << "and nothing is recorded without the answer";
    QTest::keyClicks(question()->findChild<QLineEdit*>("operator"), "B. Ott");
    click(*find<QPushButton>(*question(), "Done"));
    ASSERT_NO_FATAL_FAILURE(open());
    EXPECT_EQ(question(), nullptr);
    EXPECT_EQ(SessionReader::open(window.controller().open()->session)->labels().value().operatorName, "B. Ott");
}

TEST_F(ANewDay, IsAskedForBeforeAProtocolRunsAndNeverDuringTheRun) {
    window.showWorkspace(3);
    ASSERT_IN_TIME(comesTrue([this] { return run().isEnabled(); }));
    passMidnight();
    click(run());
    ASSERT_NE(question(), nullptr);
    letLive(200);
    EXPECT_EQ(activity(), gui::Activity::Closed);
    question()->close();  // postponed for today
    click(run());
    ASSERT_IN_TIME(comesTrue([this] { return activity() == gui::Activity::Running; }));
    passMidnight();
    ASSERT_IN_TIME(comesTrue([this] { return activity() == gui::Activity::Closed; }, 60'000));
    EXPECT_EQ(question(), nullptr);
    click(run());
    EXPECT_NE(question(), nullptr) << "the next one asks";
}

TEST(DayNotes, AreAskedForOnTheFirstDayAtTheStartAlone) {
    QDate today(2026, 11, 23);
    gui::DayNotes day(nullptr, [&] { return today; });
    int asked = 0;
    QObject::connect(&day, &gui::DayNotes::wanted, [&] { ++asked; });
    EXPECT_FALSE(day.asksFirst()) << "the question of the start was passed over";
    today = today.addDays(1);
    EXPECT_TRUE(day.asksFirst());
    EXPECT_EQ(asked, 1);
    day.noteAsked();
    EXPECT_FALSE(day.asksFirst()) << "put off";
    today = today.addDays(1);
    day.set({.operatorName = "A. Weber", .sample = {}, .reviewer = {}, .ambient = {}});
    EXPECT_FALSE(day.asksFirst());
    EXPECT_EQ(asked, 1);
    QSettings().clear();
}

TEST(DayNotes, OfAnotherDayCountNoLongerAndAreOffered) {
    QDate today(2026, 11, 23);
    gui::DayNotes day(nullptr, [&] { return today; });
    EXPECT_FALSE(day.asked());
    day.set({.operatorName = "A. Weber", .sample = "S-014", .reviewer = "B. Ott", .ambient = {}});
    EXPECT_TRUE(day.asked());
    EXPECT_EQ(day.words(), "A. Weber · sample S-014");
    EXPECT_EQ(gui::DayNotes(nullptr, [&] { return today; }).words(), day.words()) << "beyond the end of the program";
    today = today.addDays(1);
    EXPECT_FALSE(day.asked());
    EXPECT_EQ(day.words(), "");
    EXPECT_EQ(day.notes().reviewer, "");
    EXPECT_EQ(day.before().sample, "S-014");
    day.noteAsked();
    EXPECT_TRUE(day.asked()) << "put off";
    EXPECT_EQ(day.words(), "");
    EXPECT_EQ(day.before().operatorName, "A. Weber") << "and still offered";
    QSettings().clear();
}

}  // namespace
}  // namespace tacto::test
