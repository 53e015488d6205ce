// Tests sessions of a study in the whole window: which begin, which are refused without leaving files, which continue.
#include <QLineEdit>
#include <QRadioButton>
#include <QTableWidget>
#include <filesystem>
#include <gmock/gmock.h>
#include <set>

#include "app/gui/pilot/OperatorStrip.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/PilotResult.h"
#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/pilot/SessionStartPage.h"
#include "app/gui/runner/StepButton.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/study/StudyPage.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/run/Shipped.h"
#include "app/run/StudyProgram.h"
#include "core/study/Study.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/gui/Looks.h"
#include "tests/gui/pilot/PluggedDevices.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr const char* kWords = "correct horse 4711";

struct Plugged {
    std::shared_ptr<Plugs> plugs = std::make_shared<Plugs>();
};

class StudyInTheWindow : protected Plugged, public Window {
protected:
    StudyInTheWindow()
        : Window([plugs = plugs] {
              std::vector<std::unique_ptr<Driver>> drivers;
              drivers.push_back(makeSimulatedDriver());
              drivers.push_back(std::make_unique<PluggedDevices>(plugs));
              return Registry(std::move(drivers));
          }) {}
    /// Makes a study with one participant who has consented; `virtualSeed` nothing: a real person.
    void make(std::optional<std::uint64_t> virtualSeed, Modality modality = Modality::Electrodes, double gap_h = 20) {
        StudySettings settings;
        settings.gapMin_h = gap_h;
        settings.modality = modality;
        settings.title = "Four conditions";
        settings.approval.reference = "EC-2026-17";
        settings.approval.from = std::chrono::year(2020) / 1 / 1;
        settings.approval.expires = std::chrono::year(2090) / 12 / 31;
        settings.consentVersion = "2";
        settings.blocks = 3;  // long enough to be stopped before its end
        ASSERT_TRUE(stateProgram(settings, shippedProfile().value()));
        auto study = Study::create(place(), settings, Passphrase::from(kWords).value());
        ASSERT_TRUE(study) << study.error().message;
        Participant enrolled;
        enrolled.virtualSeed = virtualSeed;
        code = QString::fromStdString(study->enrol(enrolled).value().code);
        ASSERT_TRUE(study->consent(code.toStdString(), {"2", study->today(), "KL"}));
    }
    void openIt() {
        window.showWorkspace(4);
        pilot = window.findChild<gui::PilotWorkspace*>();
        pilot->findChild<gui::TabbedPage*>()->setCurrentIndex(1);
        pilot->findChild<gui::StudyPage*>()->open(QString::fromStdString(place().string()));
        QLineEdit* line = nullptr;
        ASSERT_IN_TIME(comesTrue([&] {
            line = window.findChild<QLineEdit*>("passphrase");
            return line != nullptr && line->hasFocus();
        }));
        QTest::keyClicks(line, kWords);
        QTest::keyClick(line, Qt::Key_Return);
        ASSERT_NO_FATAL_FAILURE(seeList());
    }
    void seeList() {
        auto* start = pilot->findChild<QPushButton*>("startSession");
        ASSERT_IN_TIME(comesTrue([&] { return start->isVisible() && start->isEnabled(); }, 20'000));
    }
    void start() {
        click(*pilot->findChild<QPushButton*>("startSession"));
        ASSERT_TRUE(page().isVisible());
    }
    void plugIn(const DeviceIdentity& device) {
        plugs->set({device});
        auto& watch = window.controller().watch();
        watch.look();
        ASSERT_IN_TIME(comesTrue([&] { return std::ranges::find(watch.devices(), device) != watch.devices().end(); }));
    }
    void answerNoToAll() {
        for (const auto& item : exclusionItems())
            page().findChild<QRadioButton*>(QString::fromStdString(std::string(item.key)) + "-no")->click();
    }
    /// Begins a session of a massager study with a real person: the participant's own screen asks for the code.
    void seatAtMassager() {
        ASSERT_NO_FATAL_FAILURE(make({}, Modality::Massager));
        ASSERT_NO_FATAL_FAILURE(plugIn(PluggedDevices::massager("M1")));
        ASSERT_NO_FATAL_FAILURE(openIt());
        ASSERT_NO_FATAL_FAILURE(start());
        answerNoToAll();
        shot(window, "study-window-massager");
        begin();
        ASSERT_NO_FATAL_FAILURE(waitForCode());
    }
    void waitForCode() {
        const auto* theirs = pilot->participantWindow();
        ASSERT_NE(theirs, nullptr);
        ASSERT_IN_TIME(comesTrue([&] { return theirs->asking(); }));
    }
    void answer(Qt::Key key) { QTest::keyClick(pilot->participantWindow()->windowHandle(), key); }
    void confirmCode() {
        ASSERT_NO_FATAL_FAILURE(waitForCode());
        answer(Qt::Key_1);  // answers yes
    }
    [[nodiscard]] static std::set<std::string> filesIn(const std::filesystem::path& folder) {
        std::set<std::string> names;
        for (const auto& file : std::filesystem::directory_iterator(folder)) names.insert(file.path().filename());
        return names;
    }
    [[nodiscard]] QPushButton& showResult() { return *pilot->findChild<QPushButton*>("showResult"); }
    [[nodiscard]] std::string said(const char* label) { return pilot->findChild<QLabel*>(label)->text().toStdString(); }
    void expectTheResultReopens(const std::string& headline) {
        pilot->findChild<QLabel*>("pilotHeadline")->clear();
        ASSERT_IN_TIME(comesTrue([this] { return showResult().isEnabled(); }));
        click(showResult());
        auto* result = pilot->findChild<gui::PilotResult*>();
        ASSERT_IN_TIME(comesTrue([&] { return result->isVisible(); }, 20'000));
        EXPECT_EQ(said("pilotHeadline"), headline);
        EXPECT_EQ(pilot->findChild<QTableWidget*>("confusion")->rowCount(), 4);
        EXPECT_THAT(said("pilotNote"),
                    HasSubstr("Simulated: answered by a virtual participant. Study folder: " + place().string()));
        EXPECT_FALSE(pilot->findChild<gui::StepList*>()->isVisible()) << "nothing is under way";
        looksRight(*pilot, "pilot-reopened-result", {QSize(1280, 720), QSize(1280, 720)}, &window);
        LargeBesideDocks(*this).fits("pilot-reopened-result", "confusion");  // the matrix has its own scroll bars
        click(*pilot->findChild<QPushButton*>("backFromResult"));
        ASSERT_NO_FATAL_FAILURE(seeList());
        looksRight(*pilot, "pilot-study-with-a-session", {QSize(1280, 720), QSize(1280, 720)}, &window);
        LargeBesideDocks(*this).fits("pilot-study-with-a-session");
    }
    void expectABrokenRecordIsNamed() {
        const auto file = *std::filesystem::directory_iterator(place() / "sessions");
        std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) / 2);
        click(showResult());
        ASSERT_IN_TIME(comesTrue([this] { return !said("studyTrouble").empty(); }, 20'000));
        EXPECT_THAT(said("studyTrouble"), HasSubstr(file.path().filename().string()));
        EXPECT_FALSE(pilot->findChild<gui::PilotResult*>()->isVisible());
    }
    void expectRefusedBeforehand(const std::vector<const char*>& parts) {
        click(*pilot->findChild<QPushButton*>("startSession"));
        for (const auto* part : parts) EXPECT_THAT(said("studyTrouble"), HasSubstr(part));
        EXPECT_FALSE(page().isVisible()) << "no question is asked in vain";
    }
    void begin() { click(*page().findChild<QPushButton*>("beginSession")); }
    [[nodiscard]] gui::SessionStartPage& page() { return *pilot->findChild<gui::SessionStartPage*>(); }
    [[nodiscard]] std::string trouble() { return page().findChild<QLabel*>("sessionTrouble")->text().toStdString(); }
    [[nodiscard]] std::filesystem::path place() const { return folder.path() / "study"; }
    [[nodiscard]] bool nothingWasMade() const { return std::filesystem::is_empty(place() / "sessions"); }
    [[nodiscard]] std::string cell(int row, int column) const {
        return pilot->findChild<QTableWidget*>("studySessions")->item(row, column)->text().toStdString();
    }

    const ScratchDir folder;
    QString code;
    gui::PilotWorkspace* pilot = nullptr;
};

TEST_F(StudyInTheWindow, AVirtualParticipantsSessionRunsIsBrokenOffAndGoesOn) {
    RecordProperty("hazard", "H8");
    ASSERT_NO_FATAL_FAILURE(make(7));
    ASSERT_NO_FATAL_FAILURE(openIt());
    shot(window, "study-window-list");
    EXPECT_EQ(faultsOf(window), "");
    ASSERT_NO_FATAL_FAILURE(start());
    shot(window, "study-window-start");
    EXPECT_EQ(faultsOf(window), "");
    begin();
    ASSERT_TRUE(pilot->running()) << trouble();
    ASSERT_IN_TIME(comesTrue([this] { return !nothingWasMade(); }, 20'000));
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    auto* goOn = pilot->findChild<QPushButton*>("goOnWithSession");
    ASSERT_IN_TIME(comesTrue([&] { return goOn->isVisible(); }, 20'000)) << "once the study is open again";
    click(*goOn);
    ASSERT_TRUE(page().isVisible());
    EXPECT_TRUE(page().findChild<QRadioButton*>("goOnWithIt")->isChecked()) << "it goes on with it";
    click(*pilot->findChild<QPushButton*>("backToStudy"));
    ASSERT_NO_FATAL_FAILURE(seeList());
    EXPECT_EQ(cell(0, 5), "interrupted, can continue");
    EXPECT_FALSE(showResult().isEnabled());
    EXPECT_THAT(showResult().toolTip().toStdString(), HasSubstr("ended"));
    ASSERT_NO_FATAL_FAILURE(start());
    const auto says = page().findChild<QLabel*>("unfinishedSays")->text().toStdString();
    EXPECT_THAT(says, HasSubstr("Session 1 was interrupted at "));
    EXPECT_FALSE(page().findChild<QPushButton*>("beginSession")->isEnabled());
    page().findChild<QRadioButton*>("goOnWithIt")->click();
    begin();
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 100'000));
    const auto& path = *pilot->findChild<gui::StepList*>();
    EXPECT_EQ(pixelsOf(path.window()->grab().copy(QRect(path.mapTo(path.window(), QPoint()), path.size())).toImage(),
                       gui::colours().selection),
              0)
        << "steps that cannot be clicked do not look chosen";
    const auto headline = said("pilotHeadline");
    EXPECT_THAT(headline, HasSubstr(code.toStdString()));
    shot(window, "study-window-result");
    EXPECT_EQ(faultsOf(window), "");
    click(*pilot->findChild<QPushButton*>("backFromResult"));
    ASSERT_NO_FATAL_FAILURE(seeList());
    EXPECT_EQ(pilot->findChild<QTableWidget*>("studySessions")->rowCount(), 1) << "the same session";
    EXPECT_EQ(cell(0, 5), "complete");
    expectTheResultReopens(headline);
    expectRefusedBeforehand({"at least 20 h must lie between two sessions", "the next session is possible from"});
    expectABrokenRecordIsNamed();
}

TEST_F(StudyInTheWindow, WhatIsKnownRefusesBeforeTheChecklist) {
    RecordProperty("hazard", "H11");
    ASSERT_NO_FATAL_FAILURE(make({}, Modality::Massager));
    ASSERT_NO_FATAL_FAILURE(openIt());
    auto& opened = *pilot->findChild<gui::OpenStudy*>();
    ASSERT_NO_FATAL_FAILURE(start());
    click(*pilot->findChild<QPushButton*>("backToStudy"));
    auto amended = opened.study()->settings();
    amended.consentVersion = "3";
    ASSERT_TRUE(opened.study()->amend(amended, "EC-2026-18"));
    opened.noteChange();
    expectRefusedBeforehand({"version 3 is in force"});
    ASSERT_TRUE(opened.study()->consent(code.toStdString(), {"3", opened.study()->today(), "KL"}));
    opened.noteChange();
    ASSERT_NO_FATAL_FAILURE(start());
    click(*pilot->findChild<QPushButton*>("backToStudy"));
    ASSERT_TRUE(opened.study()->leave(code.toStdString()));
    opened.noteChange();
    expectRefusedBeforehand({"has left the study"});
    EXPECT_TRUE(nothingWasMade());
}

TEST_F(StudyInTheWindow, ASessionThatWasStoppedForGoodOpensAgainWithItsResult) {
    RecordProperty("hazard", "H8");
    ASSERT_NO_FATAL_FAILURE(make(7, Modality::Electrodes, 0));
    ASSERT_NO_FATAL_FAILURE(openIt());
    const auto stopOnceBegun = [this](std::size_t files) {
        ASSERT_IN_TIME(comesTrue([&] { return filesIn(place() / "sessions").size() >= files; }, 20'000));
        ASSERT_IN_TIME(comesTrue(
            [this] {
                window.controller().stop("operator (STOP)");
                return !pilot->running();
            },
            20'000));
        click(*pilot->findChild<QPushButton*>("backFromResult"));
        ASSERT_NO_FATAL_FAILURE(seeList());
    };
    ASSERT_NO_FATAL_FAILURE(start());
    begin();
    ASSERT_NO_FATAL_FAILURE(stopOnceBegun(1));
    ASSERT_EQ(cell(0, 5), "interrupted, can continue");
    ASSERT_NO_FATAL_FAILURE(start());
    page().findChild<QRadioButton*>("endIt")->click();
    begin();
    ASSERT_NO_FATAL_FAILURE(stopOnceBegun(2));
    ASSERT_EQ(cell(0, 5), "ended before its end");
    pilot->findChild<QTableWidget*>("studySessions")->selectRow(0);
    pilot->findChild<QLabel*>("pilotHeadline")->clear();
    pilot->findChild<QLabel*>("pilotReason")->clear();
    ASSERT_IN_TIME(comesTrue([this] { return showResult().isEnabled(); }));
    click(showResult());
    auto* result = pilot->findChild<gui::PilotResult*>();
    ASSERT_IN_TIME(comesTrue([&] { return result->isVisible(); }, 20'000)) << said("studyTrouble");
    EXPECT_THAT(said("pilotHeadline") + said("pilotReason"), HasSubstr("topped"));
    EXPECT_THAT(said("pilotNote"), HasSubstr(place().string()));
    EXPECT_FALSE(pilot->findChild<QPushButton*>("goOnWithSession")->isVisible()) << "it has ended";
    looksRight(*pilot, "pilot-reopened-stopped", {QSize(1280, 720), QSize(1280, 720)}, &window);
}

TEST_F(StudyInTheWindow, WithNothingPluggedInAPersonsSessionCannotBegin) {
    RecordProperty("hazard", "H11");
    ASSERT_NO_FATAL_FAILURE(make({}));
    ASSERT_NO_FATAL_FAILURE(openIt());
    ASSERT_NO_FATAL_FAILURE(start());
    answerNoToAll();
    const auto* button = page().findChild<QPushButton*>("beginSession");
    EXPECT_FALSE(button->isEnabled()) << "the simulated bench delivers nothing";
    EXPECT_EQ(button->toolTip(), "No stimulator is plugged in.");
    EXPECT_TRUE(nothingWasMade());
    shot(window, "study-window-nothing-plugged-in");
}

TEST_F(StudyInTheWindow, AYesStaysThoughTheOperatorGoesBack) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(make({}, Modality::Massager));
    ASSERT_NO_FATAL_FAILURE(plugIn(PluggedDevices::massager("M1")));
    ASSERT_NO_FATAL_FAILURE(openIt());
    ASSERT_NO_FATAL_FAILURE(start());
    page().findChild<QRadioButton*>("heart-yes")->click();
    click(*page().findChild<QPushButton*>("backToStudy"));
    EXPECT_THAT(said("studyTrouble"), HasSubstr("there is no session today"));
    expectRefusedBeforehand({"answered yes to the exclusion checklist today", "the next session is possible from"});
}

TEST_F(StudyInTheWindow, AYesIsKeptByTheButtonAndByClosingAndSaysSoOnlyThen) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(make({}, Modality::Massager));
    ASSERT_NO_FATAL_FAILURE(openIt());
    auto& study = *pilot->findChild<gui::OpenStudy*>();
    const auto yes = [this](const char* item) {
        ASSERT_NO_FATAL_FAILURE(start());
        page().findChild<QRadioButton*>(QString(item) + "-yes")->click();
        page().findChild<QRadioButton*>(QString(item) + "-no")->click();
    };
    const auto head = [&] { return study.study() == nullptr ? std::string() : study.study()->ledgerHead(); };
    ASSERT_NO_FATAL_FAILURE(yes("heart"));
    shot(window, "study-window-yes");
    auto before = head();
    click(*page().findChild<QPushButton*>("endDay"));
    EXPECT_NE(head(), before) << "the study keeps it";
    EXPECT_THAT(said("studyTrouble"), HasSubstr("there is no session today"));
    ASSERT_NO_FATAL_FAILURE(seeList());

    const auto another = study.study()->enrol({}).value().code;
    ASSERT_TRUE(study.study()->consent(another, {"2", study.study()->today(), "KL"}));
    study.noteChange();
    pilot->findChild<QTableWidget*>("participants")->selectRow(1);
    ASSERT_NO_FATAL_FAILURE(yes("epilepsy"));
    before = head();
    study.lend();
    click(*page().findChild<QPushButton*>("endDay"));
    EXPECT_TRUE(page().isVisible()) << "the answers are not left while the study cannot keep them";
    EXPECT_THAT(trouble(), HasSubstr("not kept"));
    window.close();
    EXPECT_TRUE(window.isVisible());
    study.takeBack();
    ASSERT_IN_TIME(comesTrue([&] { return head() == before; }, 20'000));
    window.close();
    EXPECT_FALSE(window.isVisible());
    EXPECT_NE(head(), before) << "closing keeps it";
}

TEST_F(StudyInTheWindow, APersonConfirmsTheirCodeAndTheSessionRunsOnTheMassagerThatWasChosen) {
    RecordProperty("hazard", "H11");
    ASSERT_NO_FATAL_FAILURE(seatAtMassager());
    auto* theirs = pilot->participantWindow();
    EXPECT_EQ(theirs->title(), "Is " + code + " your code?");
    shot(*theirs, "pilot-code");
    EXPECT_EQ(faultsOf(*theirs), "");
    answer(Qt::Key_2);  // answers no
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }));
    EXPECT_THAT(trouble(), HasSubstr("is not their code. Nothing was begun."));
    EXPECT_EQ(pilot->participantWindow(), nullptr);
    EXPECT_TRUE(nothingWasMade());

    ASSERT_IN_TIME(comesTrue(
        [this] {
            if (!pilot->running()) begin();  // fails while the study is being opened again
            return pilot->running();
        },
        20'000));
    theirs = pilot->participantWindow();
    ASSERT_NO_FATAL_FAILURE(confirmCode());
    for (const char* page : {"Welcome", "You decide", "This screen"}) {
        ASSERT_IN_TIME(comesTrue([&] { return theirs->asking() && theirs->title().startsWith(page); }, 20'000));
        answer(Qt::Key_1);
    }
    const QPointer strip = theirs->findChild<gui::OperatorStrip*>();
    ASSERT_IN_TIME(
        comesTrue([&] { return !pilot->running() || (strip->isVisible() && strip->question().open()); }, 20'000));
    ASSERT_TRUE(pilot->running()) << trouble();
    QStringList asked;
    for (const auto* label : strip->question().findChildren<QLabel*>()) asked << label->text();
    EXPECT_THAT(asked.join(' ').toStdString(), HasSubstr("Arm haptic pad M1, vibrating up to its strongest?"))
        << "what may move is confirmed by name";
    shot(*theirs, "pilot-arm-massager");
    click(*find<QPushButton>(*strip, "Yes"));
    ASSERT_IN_TIME(
        comesTrue([&] { return !pilot->running() || (theirs->asking() && theirs->title().contains("STOP")); }, 20'000));
    ASSERT_TRUE(pilot->running()) << trouble();
    const auto open = window.controller().open();
    ASSERT_TRUE(open);
    EXPECT_FALSE(open->simulated());
    ASSERT_EQ(open->about.devices.size(), 1U) << "nothing simulated beside it";
    EXPECT_EQ(open->about.devices[0].uri, "plugged:M1");
    EXPECT_FALSE(nothingWasMade());
    shot(window, "study-window-massager-session");
    EXPECT_EQ(faultsOf(window), "");
    EXPECT_EQ(pilot->findChild<gui::StepList*>()->findChildren<gui::StepButton*>()[2]->text(), "Skin and massager");
    window.controller().stop("operator (abort)");
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
}

TEST_F(StudyInTheWindow, ASessionThatWasBrokenOffGoesOnWithNoOtherMassager) {
    RecordProperty("hazard", "H6");
    ASSERT_NO_FATAL_FAILURE(seatAtMassager());
    ASSERT_NO_FATAL_FAILURE(confirmCode());
    ASSERT_IN_TIME(comesTrue([this] { return !nothingWasMade(); }, 20'000));
    ASSERT_IN_TIME(comesTrue(
        [this] {
            window.controller().stop("operator (STOP)");
            return !pilot->running();
        },
        20'000));
    click(*pilot->findChild<QPushButton*>("backFromResult"));
    ASSERT_NO_FATAL_FAILURE(seeList());
    ASSERT_EQ(cell(0, 5), "interrupted, can continue");
    const auto files = filesIn(place() / "sessions");

    ASSERT_NO_FATAL_FAILURE(plugIn(PluggedDevices::massager("M2")));
    ASSERT_NO_FATAL_FAILURE(start());
    answerNoToAll();
    page().findChild<QRadioButton*>("goOnWithIt")->click();
    begin();
    ASSERT_NO_FATAL_FAILURE(confirmCode());
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }, 20'000));
    EXPECT_THAT(trouble(), HasSubstr("was begun with haptic pad M1 and haptic pad M2 is connected"));
    EXPECT_THAT(trouble(), testing::AllOf(HasSubstr("End it as stopped"), testing::Not(HasSubstr("--set"))));
    EXPECT_EQ(filesIn(place() / "sessions"), files);
}

TEST_F(StudyInTheWindow, AWindowThatIsClosedWhileTheCodeIsAskedBeginsNothing) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(seatAtMassager());
    pilot->participantWindow()->close();
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); })) << "the question is gone, and none would follow";
    EXPECT_THAT(trouble(), HasSubstr("was confirmed. Nothing was begun."));
    EXPECT_EQ(pilot->participantWindow(), nullptr);
    EXPECT_TRUE(nothingWasMade());
}

TEST_F(StudyInTheWindow, AStopInPlaceOfTheCodeBeginsNothing) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(seatAtMassager());
    answer(Qt::Key_Escape);
    ASSERT_IN_TIME(comesTrue([this] { return !pilot->running(); }));
    EXPECT_THAT(trouble(), HasSubstr("Stopped before"));
    EXPECT_TRUE(nothingWasMade());
}

TEST_F(StudyInTheWindow, EveryPageLooksRightAtEverySize) {
    ASSERT_NO_FATAL_FAILURE(make({}));
    window.showWorkspace(4);
    pilot = window.findChild<gui::PilotWorkspace*>();
    auto* tabs = pilot->findChild<gui::TabbedPage*>();
    const auto look = [&](const char* name) {
        looksRight(*pilot, QString("pilot-%1").arg(name), {QSize(1280, 720), QSize(1280, 720)}, &window);
        LargeBesideDocks(*this).fits(QString("pilot-%1").arg(name));
    };
    look("rehearsal");
    tabs->setCurrentIndex(1);
    look("no-study");
    click(*pilot->findChild<QPushButton*>("newStudyWanted"));
    look("new-study");
    ASSERT_NO_FATAL_FAILURE(openIt());
    look("study");
    ASSERT_NO_FATAL_FAILURE(start());
    look("start");
}

}  // namespace
}  // namespace tacto::test
