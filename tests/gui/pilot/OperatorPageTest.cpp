// Tests the operator's page: what it says, what it hides while blind, and that nothing is cut off.
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <gmock/gmock.h>
#include <set>

#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/pilot/OperatorStrip.h"
#include "app/gui/pilot/ParticipantFace.h"
#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/pilot/RehearsalPage.h"
#include "core/base/Random.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/SeatedPeople.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Operator8b : public testing::Test {
protected:
    Operator8b() {
        page.resize(880, 720);
        page.begin(start);
        page.setVisible(true);
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&page));
    }
    [[nodiscard]] std::string allText() {
        QStringList all;
        for (const auto* label : page.findChildren<QLabel*>()) {
            if (label->isVisible()) all << label->text();
        }
        return all.join('\n').toStdString();
    }
    void runTo(int trial) {
        Telemetry telemetry;
        for (int i = 1; i <= trial; ++i) {
            telemetry.impedance_ohm = 1e6;  // an impedance measured during a train would tell which train it is
            auto screen = testScreen(ScreenState::Feel, i);
            screen.impedance_ohm = 3400 + 6 * i + (i % 3) * 12;
            page.count({.answers = i - 1, .voided = i / 20, .blocks = 5});
            page.show(screen);
            page.refresh(telemetry);
            auto prompt = conditionPrompt(kFour);
            prompt.within = Seconds(10);
            page.ask(prompt, quint64(i));
            if (i < trial) page.closeQuestion(quint64(i));
        }
    }
    gui::PilotStart start;
    gui::OperatorPage page;
};

TEST_F(Operator8b, NothingMovesUnderAPointerWhateverIsInTheWay) {
    RecordProperty("hazard", "H12");
    Random random(21, "obstacles");
    for (const QSize size : {QSize(880, 720), QSize(620, 700), QSize(1300, 900)}) {
        page.resize(size);
        page.ask(yesNoPrompt("skin", "Is the skin as it was?", PromptTo::Operator), 1);
        const auto places = [&] {
            QCoreApplication::sendPostedEvents();
            QTest::qWait(1);
            std::vector<QRect> all;
            for (const auto* each : page.findChildren<QPushButton*>())
                if (each->isVisible() && each->text() != "&Hand over the keys")
                    all.push_back({each->mapToGlobal(QPoint()), each->size()});
            return all;
        };
        page.setObstacle({});
        const auto before = places();
        ASSERT_GE(before.size(), 4U);
        for (int i = 0; i < 20; ++i) {
            QString why;
            for (auto words = random.below(18); words > 0; --words) why += "the participant's window ";
            page.setObstacle(why.left(110));
            EXPECT_EQ(places(), before) << why.left(110).toStdString();
            page.setObstacle({});
            EXPECT_EQ(places(), before);
        }
    }
}

TEST_F(Operator8b, ATestOfTheOperatorsStopSaysWhichKeysAreTheirs) {
    RecordProperty("hazard", "H12");
    auto test = goOnPrompt("Press your STOP.", PromptTo::Operator);
    test.name = "stop-test";
    page.ask(test, 1);
    EXPECT_THAT(allText(), HasSubstr("Press the red STOP button, or Esc while this window has the keys."));
    QWidget theirs;
    theirs.setProperty("stopsAs", "participant");
    auto* strip = new gui::OperatorStrip(&theirs);
    strip->question().ask(test, 1);
    QStringList said;
    for (const auto* label : strip->findChildren<QLabel*>()) said << label->text();
    EXPECT_TRUE(said.join('\n').contains("Esc on this screen is the participant’s")) << said.join('\n').toStdString();
    const auto* stop = strip->findChild<gui::ParticipantStop*>("operatorStop");
    EXPECT_EQ(stop->accessibleName(), "STOP, the operator’s: interrupts the session");
    EXPECT_TRUE(stop->toolTip().contains("go on within 2 h"));
}

TEST_F(Operator8b, TheirStopSaysHowManyAreLeft) {
    RecordProperty("hazard", "H12");
    gui::ParticipantStop stop([] {}, nullptr);
    stop.resize(420, 700);
    std::set<QByteArray> pictures;
    for (int left = 3; left >= 0; --left) {
        stop.setLeft(left);
        EXPECT_TRUE(stop.accessibleName().contains(QString("%1 of 3 left").arg(left)));
        const auto picture = stop.grab().toImage();
        pictures.insert(QByteArray(reinterpret_cast<const char*>(picture.constBits()), int(picture.sizeInBytes())));
    }
    EXPECT_EQ(pictures.size(), 4U) << "it is written on it";
}

TEST_F(Operator8b, ShowsNoImpedanceOfAMassager) {
    runTo(3);
    EXPECT_THAT(allText(), HasSubstr("Impedance"));
    start.massager = true;
    page.begin(start);
    EXPECT_THAT(allText(), Not(HasSubstr("Impedance")));
    start.massager = false;
    page.begin(start);
    EXPECT_THAT(allText(), HasSubstr("Impedance"));
}

TEST_F(Operator8b, SaysWhereTheSessionIs) {
    runTo(27);
    const auto says = allText();
    EXPECT_THAT(says, HasSubstr("Test, block 2 of 5, trial 27 of 90"));
    EXPECT_THAT(says, HasSubstr("1 trial voided · next break after trial 36, in about 2 min"));
    EXPECT_THAT(says, HasSubstr("26 answers on disk"));
}

TEST_F(Operator8b, SaysWhatIsWaitedFor) {
    PilotScreen screen;
    screen.phase = "checklist";
    screen.operatorText = "Waiting 30 s between the two checks of the electrodes";
    screen.operatorMayKnow = true;
    screen.until = toInstant(Seconds(100));
    page.show(screen);
    Telemetry telemetry;
    for (const auto& [at_s, left] : {std::pair{71.2, "29 s left"}, {99.5, "1 s left"}, {101.0, "the time is over"}}) {
        telemetry.at = toInstant(Seconds(at_s));
        page.refresh(telemetry);
        EXPECT_THAT(allText(), HasSubstr("between the two checks of the electrodes: " + std::string(left)));
    }
    screen = testScreen(ScreenState::Break);
    screen.until = toInstant(Seconds(160));
    page.show(screen);
    EXPECT_THAT(allText(), HasSubstr("Break: both go on when they want to: 59 s left"));
    EXPECT_TRUE(page.whereAndWaits().endsWith(": 59 s left")) << "for the strip on the participant's screen";
}

TEST_F(Operator8b, SaysTheSameStepAsThePath) {
    PilotScreen screen;
    screen.phase = "checklist";
    page.show(screen);
    EXPECT_EQ(page.where(), "Checklist");
    auto stop = goOnPrompt("Press STOP now: the participant's is being tested.", PromptTo::Participant);
    stop.name = "stop-test";
    page.ask(stop, 1);
    EXPECT_EQ(page.where(), "Stop test");
    page.closeQuestion(1);
    page.show(screen);
    EXPECT_EQ(page.where(), "Stop test") << "it is not gone back to";
    page.ask(yesNoPrompt("erythema", "Is there a reddening?", PromptTo::Operator), 2);
    EXPECT_EQ(page.where(), "Skin and electrodes");
    screen.phase = "ascending";
    page.show(screen);
    EXPECT_EQ(page.where(), "Rising levels");
    screen.phase = "ratings";
    page.show(screen);
    EXPECT_EQ(page.where(), "Ratings");
    page.ask(yesNoPrompt("erythema", "Is there a reddening?", PromptTo::Operator), 3);
    EXPECT_EQ(page.where(), "Electrodes off, skin");
    start.massager = true;
    page.begin(start);
    page.ask(yesNoPrompt("erythema", "Is there a reddening?", PromptTo::Operator), 4);
    EXPECT_EQ(page.where(), "Skin and massager");
}

TEST_F(Operator8b, WhileBlindNothingOfAConditionIsShown) {
    RecordProperty("hazard", "H9");
    auto screen = testScreen(ScreenState::Feel);
    screen.operatorText = "rough-high, 6.5 mA, 0.5 s";
    page.show(screen);
    EXPECT_THAT(allText(), Not(HasSubstr("6.5 mA")));
    EXPECT_THAT(allText(), HasSubstr("Hidden until the session ends"));
    screen.operatorText = "electrodes: 3.4 kohm";
    screen.operatorMayKnow = true;
    page.show(screen);
    EXPECT_THAT(allText(), HasSubstr("3.4 kohm"));
    start.blind = false;
    page.begin(start);
    screen.operatorText = "rough-high, 6.5 mA, 0.5 s";
    screen.operatorMayKnow = false;
    page.show(screen);
    EXPECT_THAT(allText(), HasSubstr("6.5 mA"));
}

TEST_F(Operator8b, ItsPixelsAreTheSameForEveryCondition) {
    RecordProperty("hazard", "H9");
    std::vector<QImage> seen;
    for (const auto* condition : {"rough-high", "smooth-low"}) {
        page.begin(start);
        auto screen = testScreen(ScreenState::Feel, 1);
        screen.operatorText = condition;
        page.show(screen);
        letLive(30);
        seen.push_back(page.grab().toImage());
    }
    EXPECT_EQ(seen[0], seen[1]);
}

TEST_F(Operator8b, AQuestionOfTheOperatorsIsAnsweredThere) {
    std::vector<std::string> given;
    QObject::connect(&page.question(), &gui::OperatorAsk::answered, &page, [&](quint64 id, const PilotAnswer& answer) {
        EXPECT_EQ(id, 7U);
        given = answer.keys;
    });
    page.ask(yesNoPrompt("implant", "Does the participant have an active implant?", PromptTo::Operator), 7);
    auto* no = find<QPushButton>(page, "No");
    ASSERT_NE(no, nullptr);
    click(*no);
    EXPECT_THAT(given, ElementsAre("no"));
    EXPECT_FALSE(page.question().open());
    page.ask(yesNoPrompt("code", "Is this your code?"), 8);
    EXPECT_FALSE(page.question().open()) << "the participant's";
}

TEST_F(Operator8b, EndingTheSessionTakesTwoSteps) {
    int ended = 0;
    QObject::connect(&page, &gui::OperatorPage::abortWanted, &page, [&] { ++ended; });
    click(*page.findChild<QPushButton*>("abortSession"));
    EXPECT_EQ(ended, 0);
    click(*page.findChild<QPushButton*>("reallyAbort"));
    EXPECT_EQ(ended, 1);
}

TEST_F(Operator8b, ANoteIsKeptByEnter) {
    QStringList kept;
    QObject::connect(&page.notes(), &gui::SessionNotes::noted, &page, [&](const QString& note) { kept << note; });
    auto* line = page.findChild<QLineEdit*>("noteLine");
    QTest::keyClicks(line, "Moved the elbow rest.");
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_EQ(kept, QStringList("Moved the elbow rest."));
    EXPECT_TRUE(line->text().isEmpty());
}

TEST_F(Operator8b, LooksRightInBothThemesAndSizes) {
    runTo(27);
    page.notes().add("Comfortable, seat lowered.");
    page.notes().add("Moved the elbow rest.");
    looksRight(page, "operator", {QSize(880, 720), QSize(1200, 900)});
}

TEST(BlockShares, FillInOrder) {
    EXPECT_THAT(gui::blockShares(2, 5, 27, 90), ElementsAre(1, testing::DoubleNear(8.0 / 18, 1e-9), 0, 0, 0));
    EXPECT_THAT(gui::blockShares(1, 3, 1, 9), ElementsAre(0, 0, 0));
    EXPECT_TRUE(gui::blockShares(0, 0, 0, 0).empty());
}

TEST(Rehearsal, PageSaysWhoAnswersAndBegins) {
    gui::RehearsalPage page;
    page.resize(900, 700);
    page.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&page));
    EXPECT_FALSE(page.rehearsal().person);
    EXPECT_TRUE(page.rehearsal().blind);
    auto* who = page.findChild<QComboBox*>("whoAnswers");
    who->setCurrentIndex(1);
    EXPECT_TRUE(page.rehearsal().person);
    const auto* lasts = page.findChild<QLabel*>("whyNotRehearse");
    EXPECT_EQ(lasts->text(), "") << "four times as fast it does not take as long as a session";
    auto* pace = page.findChild<QComboBox*>("ownPace");
    pace->setCurrentIndex(pace->findData("own"));
    EXPECT_EQ(lasts->text(), "With you it takes about 66 min.");
    pace->setCurrentIndex(pace->findData("fourfold"));
    int begun = 0;
    QObject::connect(&page, &gui::RehearsalPage::beginWanted, &page, [&] { ++begun; });
    auto* button = page.findChild<QPushButton*>("beginRehearsal");
    click(*button);
    EXPECT_EQ(begun, 1);
    page.findChild<QLineEdit*>("studyFolder")->clear();
    EXPECT_FALSE(button->isEnabled());
    letLive(50);  // rows that came and went are laid out
    EXPECT_EQ(faultsOf(page), "");
}

}  // namespace
}  // namespace tacto::test
