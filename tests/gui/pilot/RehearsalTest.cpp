// Tests a rehearsal in the whole window, from "new rehearsal" to the result, with a virtual and a real participant.
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QPointer>
#include <QTableWidget>
#include <QToolButton>
#include <algorithm>
#include <filesystem>
#include <future>
#include <set>
#include <thread>

#include "app/gui/pilot/InputRows.h"
#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/pilot/OperatorStrip.h"
#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/pilot/RehearsalPage.h"
#include "app/gui/pilot/SeatRows.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/window/RecordingLine.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionVerify.h"
#include "core/study/Study.h"
#include "tests/gui/Looks.h"
#include "tests/gui/pilot/PluggedButtons.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/MarkerRecorder.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

class RehearsalInTheWindow : public Window {
protected:
    explicit RehearsalInTheWindow(std::function<Registry()> makeRegistry = nullptr) : Window(std::move(makeRegistry)) {
        window.showWorkspace(4);
        letLive(50);
    }
    void begin(bool person, const char* modality = "electrodes", const char* pace = "own") {
        pilot = window.findChild<gui::PilotWorkspace*>();
        pilot->findChild<QLineEdit*>("studyFolder")
            ->setText(QString::fromStdString((folder.path() / "study").string()));
        pilot->findChild<QComboBox*>("whoAnswers")->setCurrentIndex(person ? 1 : 0);
        pilot->findChild<QLineEdit*>("rehearsalBlocks")->setText("1");
        auto* ownPace = pilot->findChild<QComboBox*>("ownPace");
        EXPECT_EQ(ownPace->isVisible(), person);
        ownPace->setCurrentIndex(ownPace->findData(pace));
        auto* through = pilot->findChild<QComboBox*>("rehearsalModality");
        through->setCurrentIndex(through->findData(modality));
        click(*pilot->findChild<QPushButton*>("beginRehearsal"));
        const auto* trouble = pilot->findChild<QLabel*>("rehearsalTrouble");
        ASSERT_TRUE(pilot->running()) << trouble->text().toStdString();
    }
    /// Reads the introduction to its end.
    void readOn() {
        auto* theirs = pilot->participantWindow();
        ASSERT_NE(theirs, nullptr);
        for (int page = 1; page <= 3; ++page) {
            const auto text = gui::qtext(ParticipantWords::english().text(fmt::format("introduction.{}", page)));
            ASSERT_IN_TIME(comesTrue([&] { return theirs->asking() && theirs->title() == text; }, 20'000))
                << theirs->title().toStdString();
            shot(*theirs, ("pilot-introduction-" + std::to_string(page)).c_str());
            QTest::keyClick(theirs->windowHandle(), Qt::Key_1);
        }
        ASSERT_IN_TIME(
            comesTrue([&] { return theirs->asking() && theirs->title().contains("try your STOP"); }, 20'000));
    }
    [[nodiscard]] bool matrixShown() const {
        return pilot->findChild<QTableWidget*>("confusion")->isVisible() && headline().size() > 10;
    }
    [[nodiscard]] std::string headline() const {
        return (pilot->findChild<QLabel*>("pilotHeadline")->text() + '\n' +
                pilot->findChild<QLabel*>("pilotReason")->text())
            .toStdString();
    }
    /// The rows of the only session in the study.
    [[nodiscard]] Result<std::vector<SessionRow>> rows() const {
        const auto study = Study::open(folder.path() / "study", nullptr, Study::Access::Read);
        if (!study) return failure(study);
        return study->events(study->sessions().at(0));
    }
    [[nodiscard]] std::ptrdiff_t count(std::string_view row) const {
        const auto all = rows();
        EXPECT_TRUE(all) << all.error().message;
        return all ? std::ranges::count(*all, std::string(row), &SessionRow::name) : -1;
    }
    const ScratchDir folder;
    gui::PilotWorkspace* pilot = nullptr;
};

TEST_F(RehearsalInTheWindow, ThroughAMassagerTheResultSpeaksOfStrength) {
    begin(false, "massager");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 100'000));
    SCOPED_TRACE(headline());
    ASSERT_IN_TIME(headline().find("told the four apart in") != std::string::npos);
    EXPECT_NE(headline().find("between strengths of"), std::string::npos);
    EXPECT_EQ(headline().find("mA"), std::string::npos);
    shot(window, "pilot-massager-done");
}

TEST_F(RehearsalInTheWindow, AVirtualParticipantComesToAResult) {
    shot(window, "pilot-new");
    begin(false);
    EXPECT_TRUE(pilot->blind());
    window.showWorkspace(0);
    EXPECT_EQ(window.workspace(), 4) << "other workspaces would show what is delivered";
    letLive(500);
    shot(window, "pilot-virtual-running");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 100'000));
    SCOPED_TRACE(headline());
    // A session ends early if the output is not seen to go off within 10 ms of the tested STOP.
    ASSERT_IN_TIME(headline().find("told the four apart in") != std::string::npos);
    const auto* matrix = pilot->findChild<QTableWidget*>("confusion");
    EXPECT_TRUE(matrix->isVisible());
    EXPECT_EQ(matrix->rowCount(), 4);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "study" / "study.json"));
    static_cast<void>(comesTrue([this] { return faultsOf(window).empty(); }, 2'000));  // waits for the layout
    EXPECT_EQ(faultsOf(window), "");
    shot(window, "pilot-virtual-result");
    LargeBesideDocks(*this).fits("pilot-result", "confusion");
    window.showWorkspace(0);
    EXPECT_EQ(window.workspace(), 0) << "the session has ended";
    window.showWorkspace(4);
    const auto text = [this](const char* name) { return pilot->findChild<QLabel*>(name)->text(); };
    click(*find<QPushButton>(*pilot, "Open the folder"));
    EXPECT_TRUE(text("pilotNote").contains("This desktop has no program that opens"))
        << text("pilotNote").toStdString();
    click(*pilot->findChild<QPushButton*>("reportOfResult"));
    QDialog* report = nullptr;
    EXPECT_IN_TIME(comesTrue([&] { return (report = pilot->findChild<QDialog*>("reportWindow")) != nullptr; }, 60'000))
        << text("pilotNote").toStdString();
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "study-report.pdf"));
    ASSERT_NE(report, nullptr);
    report->findChild<QLineEdit*>("signedBy")->setText("A. Lind");
    click(*report->findChild<QPushButton*>("signReport"));
    const auto files =
        QDir(QString::fromStdString((folder.path() / "study/sessions").string())).entryInfoList({"*.tacto"});
    ASSERT_EQ(files.size(), 1);
    EXPECT_IN_TIME(comesTrue([&] {
        const auto verified = verifySession(files.front().filePath().toStdString());
        return verified && verified->signatures.size() == 1 && verified->signatures[0].signature.by == "A. Lind" &&
               verified->status == SessionStatus::Intact;
    }));
    report->close();
    click(*pilot->findChild<QPushButton*>("exportOfResult"));
    auto* asks = pilot->findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(asks, nullptr);
    const auto place = QString::fromStdString((folder.path() / "shared").string());
    emit asks->fileSelected(place);
    asks->close();
    ASSERT_IN_TIME(comesTrue([&] { return text("pilotNote").contains("The results lie in " + place); }, 60'000))
        << text("pilotNote").toStdString();
    EXPECT_TRUE(QFile::exists(place + "/participants.tsv"));
    click(*pilot->findChild<QPushButton*>("exportOfResult"));
    emit pilot->findChildren<QFileDialog*>("fileChooser").back()->fileSelected(place);
    ASSERT_IN_TIME(comesTrue([&] { return text("pilotNote").contains("⚠"); }, 60'000)) << "into a folder that is full";
    click(*pilot->findChild<QPushButton*>("backFromResult"));
    EXPECT_EQ(text("rehearsalTitle"), "Another session of this rehearsal");
    EXPECT_TRUE(pilot->findChild<gui::TabbedPage*>()->isVisible()) << "the way to the study";
    auto* last = pilot->findChild<QPushButton*>("lastResult");
    ASSERT_TRUE(last->isVisible());
    const auto before = headline();
    pilot->findChild<QLabel*>("pilotHeadline")->clear();
    click(*last);
    ASSERT_IN_TIME(comesTrue([this] { return matrixShown(); }, 20'000));
    EXPECT_EQ(headline(), before) << "an ended session opens again with its result";
    EXPECT_FALSE(pilot->findChild<QPushButton*>("goOnWithSession")->isVisible());
    click(*pilot->findChild<QPushButton*>("backFromResult"));
    EXPECT_EQ(pilot->findChild<QComboBox*>("whoAnswers")->currentData(), "virtual");
    EXPECT_FALSE(pilot->findChild<QComboBox*>("whoAnswers")->isEnabled()) << "who began it goes on with it";

    std::filesystem::copy(folder.path() / "study", folder.path() / "other", std::filesystem::copy_options::recursive);
    pilot->findChild<QLineEdit*>("studyFolder")->setText(QString::fromStdString((folder.path() / "other").string()));
    pilot->findChild<QLabel*>("pilotHeadline")->clear();
    click(*last);
    ASSERT_IN_TIME(comesTrue([this] { return matrixShown(); }, 20'000));
    click(*pilot->findChild<QPushButton*>("reportOfResult"));
    EXPECT_IN_TIME(comesTrue([&] { return std::filesystem::exists(folder.path() / "other-report.pdf"); }, 60'000))
        << "of the rehearsal shown: " << text("pilotNote").toStdString();
}

TEST_F(RehearsalInTheWindow, TenTimesAsFastThereIsSomethingToWatch) {
    RecordProperty("hazard", "H9");
    auto* page = window.findChild<gui::RehearsalPage*>();
    auto* pace = page->findChild<QComboBox*>("rehearsalPace");
    pace->setCurrentIndex(pace->findData("tenfold"));
    EXPECT_EQ(page->rehearsal().pace, 10);
    begin(false);
    auto* operators = pilot->findChild<gui::OperatorPage*>();
    std::set<QString> places;
    ASSERT_IN_TIME(comesTrue(
        [&] {
            places.insert(operators->where());
            return places.size() >= 3 || !pilot->running();
        },
        30'000));
    EXPECT_TRUE(pilot->running()) << "it is not over in seconds";
    EXPECT_TRUE(places.contains("Rising levels, series 1 of 3"))
        << QStringList(places.begin(), places.end()).join('|').toStdString();
    shot(window, "pilot-tenfold");
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
}

TEST_F(RehearsalInTheWindow, AtTheSessionsOwnPaceThereIsSomethingToWatch) {
    auto* page = window.findChild<gui::RehearsalPage*>();
    auto* pace = page->findChild<QComboBox*>("rehearsalPace");
    EXPECT_FALSE(page->rehearsal().realTime) << "else it is over in seconds";
    page->findChild<QComboBox*>("whoAnswers")->setCurrentIndex(1);
    EXPECT_FALSE(pace->isVisible()) << "a person has a pace of their own";
    page->findChild<QComboBox*>("whoAnswers")->setCurrentIndex(0);
    EXPECT_TRUE(pace->isVisible());
    pace->setCurrentIndex(pace->findData("own"));
    page->findChild<QCheckBox*>("blind")->setChecked(false);
    shot(window, "pilot-new-own-pace");
    begin(false);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Running; }, 20'000));
    EXPECT_FALSE(window.controller().open()->about.virtualClock) << "a second takes a second";
    window.showWorkspace(0);
    EXPECT_EQ(window.workspace(), 0) << "trains are seen there as they come";
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
}

TEST_F(RehearsalInTheWindow, ALongFolderIsReadFromItsBeginningAndASeedIsTyped) {
    pilot = window.findChild<gui::PilotWorkspace*>();
    auto* place = pilot->findChild<QLineEdit*>("studyFolder");
    const auto path = QString("/data/").leftJustified(400, 'x');
    place->clearFocus();
    place->setText(path);
    EXPECT_EQ(place->cursorPosition(), 0) << "its beginning is in sight";
    EXPECT_TRUE(place->toolTip().startsWith(path)) << "and all of it in the tip";
    auto* seed = pilot->findChild<QLineEdit*>("rehearsalSeed");
    const auto* begin = pilot->findChild<QPushButton*>("beginRehearsal");
    for (const char* refused : {"0", "1000001", "1.5", "two", ""}) {
        seed->setText(refused);
        EXPECT_FALSE(begin->isEnabled()) << refused;
    }
    seed->setText("2");
    const auto* whyNot = pilot->findChild<QLabel*>("whyNotRehearse");
    place->clear();
    EXPECT_FALSE(begin->isEnabled());
    EXPECT_TRUE(whyNot->text().contains("folder")) << whyNot->text().toStdString();
    place->setText(QString::fromStdString((folder.path() / "study").string()));
    EXPECT_TRUE(begin->isEnabled());
    EXPECT_TRUE(whyNot->text().isEmpty());
}

TEST_F(RehearsalInTheWindow, ANewOneHasAFolderOfItsOwnAndKeepsTheRest) {
    begin(false, "massager");
    const auto first = pilot->findChild<QLineEdit*>("studyFolder")->text();
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 100'000));
    click(*pilot->findChild<QPushButton*>("anotherRehearsal"));
    EXPECT_EQ(pilot->findChild<QLabel*>("rehearsalTitle")->text(), "A new rehearsal");
    EXPECT_NE(pilot->findChild<QLineEdit*>("studyFolder")->text(), first);
    EXPECT_EQ(pilot->findChild<QLineEdit*>("rehearsalBlocks")->text(), "1");
    const auto* through = pilot->findChild<QComboBox*>("rehearsalModality");
    EXPECT_EQ(through->currentData(), "massager");
    EXPECT_TRUE(through->isEnabled());
}

TEST_F(RehearsalInTheWindow, ItsMarkersReachARecorderAndTheResultSaysSo) {
    HeldPort held;
    pilot = window.findChild<gui::PilotWorkspace*>();
    auto* markers = pilot->findChild<gui::RehearsalPage*>()->findChild<QLineEdit*>("markers");
    markers->setText(QString::number(held.port()));
    begin(false);
    const auto* trouble = pilot->findChild<QLabel*>("rehearsalTrouble");
    ASSERT_IN_TIME(comesTrue([&] { return !pilot->running(); }));
    EXPECT_TRUE(trouble->text().contains("another program has that port")) << trouble->text().toStdString();
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "study")) << "nothing was begun";
    held.letGo();
    const MarkerRecorder recorder(held.port());
    begin(false);
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 100'000));
    ASSERT_IN_TIME(headline().find("told the four apart in") != std::string::npos);
    EXPECT_IN_TIME(comesTrue([&] { return recorder.ended(); }));
    EXPECT_GT(recorder.lines().size(), 100U);
    EXPECT_TRUE(pilot->findChild<QLabel*>("pilotNote")->text().contains("markers were made"));
    EXPECT_EQ(faultsOf(window), "");
    markers->setText("off");
}

TEST_F(RehearsalInTheWindow, BothStopsAreTestedAndTheSessionIsEndedByTheOperator) {
    RecordProperty("hazard", "H2");
    begin(true);
    auto* theirs = pilot->participantWindow();
    ASSERT_NE(theirs, nullptr);
    ASSERT_NO_FATAL_FAILURE(readOn());
    shot(*theirs, "pilot-stop-test");
    QTest::keyClick(theirs->windowHandle(), Qt::Key_Escape);
    const QPointer strip = theirs->findChild<gui::OperatorStrip*>();
    ASSERT_NE(strip, nullptr);
    const auto runs = [this] { return pilot->running(); };
    const auto asked = [&] {
        const auto* says = strip->findChild<QLabel*>("operatorQuestion");
        return strip->isVisible() && says != nullptr ? says->text().toStdString() : std::string();
    };
    // If the machine stalls while the output is armed, the program asks about that fault instead.
    const auto testsIt = [&] { return asked().find("the operator's is being tested") != std::string::npos; };
    ASSERT_IN_TIME(comesTrue([&] { return !runs() || testsIt(); }, 20'000)) << asked();
    ASSERT_IN_TIME(runs()) << headline();
    const auto* title = theirs->findChild<QLabel*>("participantTitle");
    EXPECT_IN_TIME(comesTrue([&] { return title->fontInfo().pixelSize() >= 40; })) << "as before the looks changed";
    const auto* red = strip->findChild<gui::ParticipantStop*>("operatorStop");
    EXPECT_GE(red->height(), 100) << "seen, and hit by a hand";
    const auto at = red->mapTo(theirs, red->rect().center());
    EXPECT_EQ(theirs->childAt(at), red);
    letLive(100);  // so that it does not count as the participant's press
    ASSERT_IN_TIME(testsIt()) << asked();
    QTest::mousePress(theirs->windowHandle(), Qt::LeftButton, {}, at);
    ASSERT_IN_TIME(
        comesTrue([&] { return !pilot->running() || find<QPushButton>(*strip, "0 none") != nullptr; }, 20'000))
        << asked();
    ASSERT_TRUE(pilot->running()) << "a test of STOP ends no session: " << headline();
    letLive(150);
    window.controller().stop("operator (Esc, held)");  // the same press as in the test, repeating
    letLive(150);
    ASSERT_TRUE(pilot->running()) << "a key that is held counts once: " << headline();
    // Nothing is armed here, so the pictures do not disturb the control loop.
    looksRight(*pilot, "pilot-running", {QSize(1280, 720), QSize(1280, 720)}, &window);
    LargeBesideDocks(*this).fits("pilot-running");
    looksRight(*strip, "pilot-strip", {}, theirs);
    click(*find<QPushButton>(*strip, "0 none"));
    ASSERT_IN_TIME(comesTrue(
        [&] { return !runs() || (strip->isVisible() && find<QPushButton>(*strip, "0 none") != nullptr); }, 20'000));
    ASSERT_IN_TIME(runs()) << headline();
    letLive(150);  // so that it does not count as the press of the test
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_EQ(pilot->participantWindow(), nullptr);
    EXPECT_NE(find<QPushButton>(*pilot, "Go on with the session"), nullptr);
    shot(window, "pilot-stopped");
    gui::RehearsalPage nextDay;
    EXPECT_EQ(nextDay.folder().toStdString(), (folder.path() / "study").string()) << "it is offered to go on";
    EXPECT_TRUE(nextDay.mayGoOn());
    nextDay.resize(1140, 560);
    nextDay.show();
    letLive(50);
    const auto* says = nextDay.findChild<QLabel*>("unfinishedSays");
    EXPECT_LT(says->height(), 2 * says->fontMetrics().height()) << "no room is left blank";
    shot(nextDay, "rehearsal-to-go-on");
}

/// Nothing is felt, so nobody waits for it; the person still answers in their own time, and stops.
TEST_F(RehearsalInTheWindow, FourTimesAsFastAllButTheAnswersPass) {
    RecordProperty("hazard", "H2");
    pilot = window.findChild<gui::PilotWorkspace*>();
    EXPECT_EQ(pilot->findChild<QComboBox*>("ownPace")->currentData(), "fourfold") << "unless it is chosen otherwise";
    pilot->findChild<gui::RehearsalPage*>()->findChild<QCheckBox*>("blind")->setChecked(false);
    begin(true, "electrodes", "fourfold");
    const QPointer theirs = pilot->participantWindow();
    ASSERT_NE(theirs, nullptr);
    const auto says = [&](const QString& words) {
        return theirs && std::ranges::any_of(theirs->findChildren<QLabel*>(), [&](const QLabel* each) {
                   return each->isVisible() && each->text().contains(words);
               });
    };
    EXPECT_TRUE(says("4 times as fast"));
    ASSERT_NO_FATAL_FAILURE(readOn());
    QTest::keyClick(theirs->windowHandle(), Qt::Key_Escape);
    const QPointer strip = theirs->findChild<gui::OperatorStrip*>();
    ASSERT_IN_TIME(comesTrue([&] { return strip->isVisible() && strip->question().open(); }, 20'000));
    letLive(150);  // so that it does not count as the participant's press
    const auto* red = strip->findChild<gui::ParticipantStop*>("operatorStop");
    QTest::mousePress(theirs->windowHandle(), Qt::LeftButton, {}, red->mapTo(theirs, red->rect().center()));
    for (const char* what : {"Redness", "Swelling"}) {
        ASSERT_IN_TIME(comesTrue([&] { return says(what) && find<QPushButton>(*strip, "0 none") != nullptr; }, 20'000))
            << what;
        click(*find<QPushButton>(*strip, "0 none"));
    }
    ASSERT_IN_TIME(comesTrue([&] { return says("Lot of the new pair"); }, 20'000));
    const auto enteredAt = std::chrono::steady_clock::now();
    click(*find<QPushButton>(*strip, "Enter"));
    ASSERT_IN_TIME(comesTrue([&] { return says("Which of these do you notice"); }, 25'000)) << "30 s, at its pace";
    EXPECT_GE(std::chrono::steady_clock::now() - enteredAt, std::chrono::seconds(7));
    QTest::keyClick(theirs->windowHandle(), Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([&] { return theirs->asking() && says("pulses that rise"); }, 20'000));
    QTest::keyClick(theirs->windowHandle(), Qt::Key_1);
    ASSERT_IN_TIME(comesTrue([&] { return theirs->asking() && says("Series 1 of 3"); }, 20'000));
    QTest::keyPress(theirs->windowHandle(), Qt::Key_H);
    const auto asksStrength = [&] { return theirs->asking() && says("What did you feel?"); };
    for (int answers = 0; answers < 12; ++answers) {  // some are empty
        ASSERT_IN_TIME(comesTrue(asksStrength, 20'000)) << theirs->title().toStdString();
        if (says("perhaps")) break;
        QTest::keyClick(theirs->windowHandle(), Qt::Key_1);
        ASSERT_IN_TIME(comesTrue([&] { return !theirs->asking(); }, 20'000));
    }
    EXPECT_TRUE(says("felt: 0.5 mA every 0.5 s, perhaps “Nothing”"));
    shot(*theirs, "pilot-rehearsal-likely");
    QTest::keyClick(theirs->windowHandle(), Qt::Key_Escape);
    ASSERT_IN_TIME(comesTrue([&] { return says("Stopped."); }, 20'000));
    EXPECT_NE(window.controller().telemetry().state, InterlockState::Armed);
    EXPECT_IN_TIME(comesTrue([&] { return count(row::kParticipantStop) == 1; }, 20'000));
    window.controller().stop("operator (signal)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_EQ(faultsOf(window), "");
}

TEST_F(RehearsalInTheWindow, AnAbortIsNoTestOfTheOperatorsStop) {
    RecordProperty("hazard", "H2");
    begin(true);
    auto* theirs = pilot->participantWindow();
    ASSERT_NE(theirs, nullptr);
    ASSERT_NO_FATAL_FAILURE(readOn());
    QTest::keyClick(theirs->windowHandle(), Qt::Key_Escape);
    const QPointer strip = theirs->findChild<gui::OperatorStrip*>();
    ASSERT_IN_TIME(comesTrue([&] { return strip->isVisible() && strip->question().open(); }, 20'000));
    click(*find<QPushButton>(*strip, "End the session"));
    const auto reason = [&] { return strip->findChild<QLineEdit*>("operatorAnswer"); };
    ASSERT_IN_TIME(comesTrue([&] { return reason() != nullptr && reason()->isVisible(); }, 20'000));
    EXPECT_EQ(window.controller().telemetry().state, InterlockState::Disarmed) << "the reason comes after it is off";
    QTest::keyClicks(reason(), "fire alarm");
    QTest::keyClick(reason(), Qt::Key_Return);
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_NE(find<QPushButton>(*pilot, "Go on with the session"), nullptr) << headline();
    const auto study = Study::open(folder.path() / "study", nullptr, Study::Access::Read);
    ASSERT_TRUE(study) << study.error().message;
    ASSERT_EQ(study->sessions().size(), 1U);
    EXPECT_EQ(study->sessions()[0].state, StudySessionState::Unfinished) << "it may be gone on with";
    const auto events = rows().value();
    const auto note = std::ranges::find(events, row::kNote, &SessionRow::name);
    ASSERT_NE(note, events.end());
    EXPECT_EQ(note->body["reason"], "fire alarm");
    auto* page = pilot->findChild<gui::RehearsalPage*>();
    EXPECT_TRUE(page->rehearsal().person) << "a person's rehearsal preselects no model";
    const auto answers = count(row::kPhase);
    click(*find<QPushButton>(*pilot, "Go on with the session"));
    ASSERT_TRUE(pilot->running()) << headline();
    auto* again = pilot->participantWindow();
    ASSERT_IN_TIME(comesTrue([&] { return again->asking() && again->title().contains("try your STOP"); }, 20'000))
        << "the introduction was read: " << again->title().toStdString();
    window.controller().stop("operator (abort)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_EQ(count(row::kPhase), answers) << "nothing was asked twice";
    const auto after = Study::open(folder.path() / "study", nullptr, Study::Access::Read);
    EXPECT_EQ(after->sessions().size(), 1U) << "it went on with it, and began no other";
}

/// A stimulator whose fault names a train.
class FaultWhileBlind : public RehearsalInTheWindow {
protected:
    FaultWhileBlind()
        : RehearsalInTheWindow([plug = plugged] {
              return unpluggableRegistry(plug, "12.34 mA was read back in pulse 7 of 98765, and 4.567 mA was sent");
          }) {}
    /// All texts of all widgets in all windows, with tool tips and texts for screen readers, and the message log.
    [[nodiscard]] std::string allTexts() const {
        QStringList all;
        for (const auto* top : QApplication::topLevelWidgets()) {
            auto widgets = top->findChildren<QWidget*>();
            widgets << const_cast<QWidget*>(top);
            for (const auto* each : widgets) {
                all << each->windowTitle() << each->toolTip() << each->statusTip() << each->whatsThis()
                    << each->accessibleName() << each->accessibleDescription();
                for (const char* property : {"text", "plainText", "placeholderText"})
                    all << each->property(property).toString();
            }
        }
        if (const auto* line = window.findChild<gui::RecordingLine*>()) all << line->log();
        return all.join('\n').toStdString();
    }
    static inline const Plug plugged = std::make_shared<std::atomic<bool>>(true);
};

TEST_F(FaultWhileBlind, NoTextInAnyWindowNamesANumberOfItsTrain) {
    RecordProperty("hazard", "H9");
    for (const bool blind : {true, false}) {
        SCOPED_TRACE(blind ? "blind" : "not blind: the numbers would be found");
        *plugged = true;
        window.findChild<gui::RehearsalPage*>()->findChild<QCheckBox*>("blind")->setChecked(blind);
        begin(true);
        ASSERT_EQ(pilot->blind(), blind);
        auto* theirs = pilot->participantWindow();
        ASSERT_NO_FATAL_FAILURE(readOn());
        *plugged = false;
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }));
        std::string said;
        // In the message line, the safety bar and the operator's question, while the fault lasts.
        const auto comes = [&](const char* words) {
            return comesTrue([&] {
                const auto now = allTexts();
                said += now;
                return now.find(words) != std::string::npos;
            });
        };
        ASSERT_IN_TIME(comes("Fault: ")) << said;
        QTest::keyClick(theirs->windowHandle(), Qt::Key_Escape);  // ends the test of the participant's STOP
        ASSERT_IN_TIME(comes("See to the electrodes")) << said;
        for (const char* words : {"12.34", "98765", "4.567", "No train was delivered"})
            if (!blind) ASSERT_IN_TIME(comes(words)) << said;  // the log still holds the fault of before
        EXPECT_NE(said.find("was read back in pulse"), std::string::npos) << "it says what happened";
        for (const char* number : {"12.34", "98765", "4.567"})
            EXPECT_EQ(said.find(number) == std::string::npos, blind) << number;
        EXPECT_EQ(said.find("No train was delivered") == std::string::npos, blind) << "which it does not know";
        *plugged = true;
        window.controller().stop("operator (signal)");
        ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
        if (!blind) continue;
        click(*pilot->findChild<QPushButton*>("anotherRehearsal"));
        std::filesystem::remove_all(folder.path() / "study");
    }
}

TEST_F(RehearsalInTheWindow, OnlyWhereItIsNotBlindTheirScreenSaysWhatWouldBeFelt) {
    RecordProperty("hazard", "H9");
    for (const bool blind : {true, false}) {
        window.findChild<gui::RehearsalPage*>()->findChild<QCheckBox*>("blind")->setChecked(blind);
        begin(true);
        auto* theirs = pilot->participantWindow();
        ASSERT_IN_TIME(comesTrue([&] { return theirs->asking(); }, 20'000));
        auto* desk = pilot->findChild<gui::ParticipantDesk*>();
        ASSERT_NE(desk, nullptr);
        const auto says = [theirs](const char* words) {
            return std::ranges::any_of(theirs->findChildren<QLabel*>(),
                                       [&](const QLabel* each) { return each->text().contains(words); });
        };
        FeltPresentation felt;
        felt.level = 2.4;
        felt.interval = Seconds(0.5);
        felt.inInterval = 2;
        desk->delivered(felt);
        EXPECT_EQ(says("felt: 2.4"), !blind);
        EXPECT_EQ(says("second interval"), !blind);
        PilotScreen next;
        next.state = ScreenState::Dot;
        desk->show(next);
        EXPECT_FALSE(says("felt")) << "it was of the trial before";
        felt.level = 0;
        desk->delivered(felt);
        EXPECT_EQ(says("felt: nothing"), !blind);
        window.controller().stop("operator (signal)");
        ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
        if (!blind) continue;
        click(*pilot->findChild<QPushButton*>("anotherRehearsal"));
        std::filesystem::remove_all(folder.path() / "study");
    }
}

TEST_F(RehearsalInTheWindow, AScreenThatGoesIsAPauseUntilTheWindowIsSeatedAgain) {
    RecordProperty("hazard", "H2");
    begin(true);
    auto* theirs = pilot->participantWindow();
    ASSERT_NO_FATAL_FAILURE(readOn());
    for (auto* each : pilot->findChildren<gui::ScreenChoice*>()) emit each->lost("HDMI-1");  // one is the session's
    EXPECT_FALSE(theirs->isVisible()) << "it would lie over the operator's";
    auto* asks = pilot->findChild<gui::OperatorAsk*>("operatorAsk");
    ASSERT_NE(asks, nullptr);
    const auto goOn = [&] { return find<QPushButton>(*asks, "Go on"); };
    ASSERT_IN_TIME(comesTrue([&] { return asks->isVisible() && goOn() != nullptr; }, 20'000));
    EXPECT_TRUE(pilot->running()) << headline();
    letLive(150);
    click(*goOn());
    ASSERT_IN_TIME(comesTrue([&] { return theirs->isVisible() && theirs->asking(); }, 20'000));
    EXPECT_EQ(theirs->title().indexOf("try your STOP"), -1) << "their own go on comes first";
    QTest::keyClick(theirs->windowHandle(), Qt::Key_1);
    ASSERT_IN_TIME(
        comesTrue([&] { return theirs->asking() && theirs->title().indexOf("try your STOP") != -1; }, 20'000));
    letLive(150);
    window.controller().stop("operator (signal)");  // a press would count for the wrong STOP
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_EQ(count(row::kPause), 1);
    EXPECT_EQ(count(row::kParticipantStop), 0);
}

TEST_F(RehearsalInTheWindow, PauseFromTheMenuIsTheSessionsOwnBreak) {
    RecordProperty("hazard", "H2");
    begin(true);
    auto* theirs = pilot->participantWindow();
    ASSERT_IN_TIME(comesTrue([&] { return theirs->asking(); }, 20'000));
    const auto choose = [this](const QString& words) {
        for (auto* action : window.findChildren<QAction*>())
            if (action->text().remove('&') == words) action->trigger();
    };
    const auto* button = window.findChild<QPushButton*>("pauseButton");
    ASSERT_NE(button, nullptr);
    choose("Pause");
    EXPECT_TRUE(pilot->sessionPaused());
    EXPECT_FALSE(window.controller().paused()) << "the bench itself is not: the session would be late and broken off";
    ASSERT_IN_TIME(comesTrue([&] { return button->text().remove('&') == "Resume"; }, 5'000));
    choose("Resume");
    EXPECT_FALSE(pilot->sessionPaused());
    ASSERT_IN_TIME(comesTrue([&] { return button->text().remove('&') == "Pause"; }, 5'000));
    EXPECT_TRUE(pilot->running()) << headline();
    ASSERT_IN_TIME(comesTrue(
        [this] {
            window.controller().stop("operator (STOP)");
            return !pilot->running();
        },
        20'000));
    EXPECT_EQ(count(row::kPause), 1);
    EXPECT_EQ(count(row::kParticipantStop), 0);
}

TEST_F(RehearsalInTheWindow, AStopByTheirPadIsTheirsAndOneThatIsUnpluggedIsABreak) {
    RecordProperty("hazard", "H2");
    const auto plugged = std::make_shared<PluggedButtons>();
    plugged->set({PluggedButtons::pad("pad"), PluggedButtons::pad("pedal", 1)});
    pilot = window.findChild<gui::PilotWorkspace*>();
    pilot->findChild<QComboBox*>("whoAnswers")->setCurrentIndex(1);
    pilot->setButtonDevices(plugged);
    const auto assign = [&](const char* name, int to) {
        const auto box = [&] { return pilot->findChild<QComboBox*>(QString("inputOf ") + name); };
        ASSERT_IN_TIME(comesTrue([&] { return box() != nullptr; }));
        box()->setCurrentIndex(to);
        emit box()->activated(to);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    };
    ASSERT_NO_FATAL_FAILURE(assign("pad", 1));
    ASSERT_NO_FATAL_FAILURE(assign("pedal", 2));
    begin(true);
    auto* theirs = pilot->participantWindow();
    ASSERT_NE(theirs, nullptr);
    const auto before = gui::rememberedInput(gui::kRehearsals, PluggedButtons::pad("pedal", 1));
    ASSERT_TRUE(before) << "offered in the next one";
    EXPECT_EQ(before->whose, PromptTo::Operator);
    ASSERT_NO_FATAL_FAILURE(readOn());
    const auto tests = [&] { return theirs->asking() && theirs->title().indexOf("try your STOP") != -1; };
    ASSERT_IN_TIME(comesTrue(tests, 20'000));

    plugged->plug("pad", false);  // an unplugged STOP does not count as pressed
    ASSERT_IN_TIME(comesTrue([&] { return !theirs->asking(); }));
    EXPECT_EQ(window.controller().telemetry().state, InterlockState::Disarmed);
    const auto* obstacle = pilot->findChild<QLabel*>("presentationObstacle");
    ASSERT_IN_TIME(comesTrue([&] { return obstacle->text().contains("the participant's pad is unplugged"); }));
    plugged->plug("pad", true);
    pilot->pauseSession(false);
    ASSERT_IN_TIME(comesTrue([&] { return theirs->asking(); }, 20'000));
    EXPECT_EQ(theirs->title().indexOf("try your STOP"), -1) << "their own go on comes first";
    plugged->press("pad", 1);
    plugged->press("pad", 1, false);
    ASSERT_IN_TIME(comesTrue(tests, 20'000));

    letLive(150);
    std::async(std::launch::async, [&] { plugged->press("pad", 6); }).get();  // this press is the test of STOP
    const auto tested = [&] {
        const auto all = rows();
        return all && std::ranges::count(*all, std::string(row::kStopTest), &SessionRow::name) == 1;
    };
    bool seen = false;  // whether the test was noticed while the window's thread was held and handled no events
    for (int i = 0; i < 500 && !(seen = tested()); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_IN_TIME(seen) << "a STOP waits for no window";
    const QPointer strip = theirs->findChild<gui::OperatorStrip*>();
    ASSERT_IN_TIME(comesTrue([&] { return strip->isVisible() && strip->question().open(); }, 20'000));
    letLive(150);
    plugged->press("pedal", 1);  // a press by the operator
    ASSERT_IN_TIME(
        comesTrue([&] { return !pilot->running() || find<QPushButton>(*strip, "0 none") != nullptr; }, 20'000));
    ASSERT_TRUE(pilot->running()) << headline();
    letLive(150);
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_EQ(plugged->open("pad") + plugged->open("pedal"), 0U);

    const auto events = rows().value();
    const auto pause = std::ranges::find(events, row::kPause, &SessionRow::name);
    ASSERT_NE(pause, events.end());
    EXPECT_EQ(pause->body["why"], "the participant's pad is unplugged");
    EXPECT_EQ(count(row::kParticipantStop), 0);
    EXPECT_EQ(count(row::kStopTest), 2) << "each at the first try";
}

TEST_F(RehearsalInTheWindow, ClosingTheParticipantsWindowPausesAndStopsNothingForGood) {
    RecordProperty("hazard", "H2");
    begin(true);
    auto* theirs = pilot->participantWindow();
    ASSERT_IN_TIME(comesTrue([&] { return theirs->asking(); }, 20'000));
    theirs->close();
    EXPECT_TRUE(theirs->isVisible());
    EXPECT_FALSE(theirs->asking());
    // The first press may count as the test of the operator's STOP; the next ends the session.
    ASSERT_IN_TIME(comesTrue(
        [this] {
            window.controller().stop("operator (STOP)");
            return !pilot->running();
        },
        20'000));
}

}  // namespace
}  // namespace tacto::test
