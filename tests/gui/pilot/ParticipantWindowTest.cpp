// Tests the participant's answers by key, mouse and finger (once, after the targets), and stops from everywhere.
#include <QAbstractButton>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPointingDevice>
#include <QPushButton>
#include <QSpinBox>
#include <algorithm>
#include <gmock/gmock.h>
#include <set>

#include "app/gui/pilot/ParticipantStop.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/SeatedPeople.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using namespace std::chrono_literals;

TEST_F(Seated, EachKeyOfEachSetAnswersItsTarget) {
    const std::vector<std::string> places{"smooth-high", "rough-high", "smooth-low", "rough-low", "none", "not-sure"};
    const std::pair<gui::KeySet, std::vector<Qt::Key>> sets[] = {
        {gui::KeySet::Figures, {Qt::Key_1, Qt::Key_2, Qt::Key_3, Qt::Key_4, Qt::Key_5, Qt::Key_6}},
        {gui::KeySet::LeftHand, {Qt::Key_W, Qt::Key_E, Qt::Key_S, Qt::Key_D, Qt::Key_X, Qt::Key_C}},
        {gui::KeySet::RightHand, {Qt::Key_U, Qt::Key_I, Qt::Key_J, Qt::Key_K, Qt::Key_M, Qt::Key_Comma}},
    };
    for (const auto& [set, pressed] : sets) {
        window.setKeys(set);
        for (std::size_t i = 0; i < pressed.size(); ++i) {
            desk.show(testScreen(ScreenState::Feel));
            ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
            key(pressed[i]);
            const auto said = answered();
            ASSERT_TRUE(said);
            EXPECT_THAT(said->keys, ElementsAre(places[i]));
        }
    }
}

TEST_F(Seated, KeysStandWhereTheTargetsDo) {
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));  // the study decides the order of the targets
    const auto& firm = target("smooth-high");
    const auto& light = target("smooth-low");
    EXPECT_EQ(firm.x(), light.x());
    EXPECT_LT(firm.y(), light.y());
    EXPECT_LT(firm.x(), target("rough-high").x());
    EXPECT_EQ(firm.y(), target("rough-high").y());
    EXPECT_GT(target("none").y(), light.y());
}

TEST_F(Seated, ThePressOfAMouseAnswersNotItsRelease) {
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    letLive(120);
    QTest::mousePress(&target("none"), Qt::LeftButton);
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("none"));
    EXPECT_GE(said->after.count(), 0.115);
    EXPECT_IN_TIME(said->after.count() < 1);
}

TEST_F(Seated, AFingerAnswers) {
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    std::unique_ptr<QPointingDevice> screen(QTest::createTouchDevice());
    auto& touched = target("rough-low");
    const auto at = touched.mapTo(&window, touched.rect().center());
    QTest::touchEvent(&window, screen.get()).press(0, at, &window).commit();
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("rough-low"));
    QTest::touchEvent(&window, screen.get()).release(0, at, &window).commit();
}

TEST_F(Seated, OnePressIsTheAnswer) {
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    key(Qt::Key_1);
    key(Qt::Key_2);
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("smooth-high"));
    EXPECT_TRUE(window.field().targets().empty()) << "the targets are gone";
}

TEST_F(Seated, WhatComesBeforeTheTargetsIsEarlyAndNoAnswer) {
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    key(Qt::Key_6);
    ASSERT_TRUE(answered());
    desk.show(testScreen(ScreenState::Feel));
    QCoreApplication::processEvents();
    key(Qt::Key_3);
    QTest::mouseClick(const_cast<gui::ParticipantField*>(&window.field()), Qt::LeftButton);
    key(Qt::Key_F7);  // no answer has this key
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    letLive(50);
    EXPECT_FALSE(isAnswered());
    const auto early = desk.takeEarly();
    ASSERT_EQ(early.size(), 3U);
    EXPECT_EQ(early[0].key, "smooth-low");
    EXPECT_EQ(early[1].key, "");
    EXPECT_EQ(early[2].key, "");
    EXPECT_TRUE(desk.takeEarly().empty());
}

TEST_F(Seated, AKeyHeldFromBeforeIsNoAnswer) {
    desk.show(testScreen(ScreenState::Feel));
    QCoreApplication::processEvents();
    QTest::keyPress(window.windowHandle(), Qt::Key_2);
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    QKeyEvent marked(QEvent::KeyPress, Qt::Key_2, Qt::NoModifier, "2", true);
    QApplication::sendEvent(&window, &marked);
    QKeyEvent unmarked(QEvent::KeyPress, Qt::Key_2, Qt::NoModifier, "2", false);  // X sends some repeats unmarked
    QApplication::sendEvent(&window, &unmarked);
    letLive(30);
    EXPECT_FALSE(isAnswered());
    QTest::keyRelease(window.windowHandle(), Qt::Key_2);
    letLive(200);
    key(Qt::Key_2);
    ASSERT_TRUE(answered());
}

TEST_F(Seated, WithoutTheKeysNoPresentationStarts) {
    QWidget other;
    QStringList said;
    QObject::connect(&desk, &gui::ParticipantDesk::obstacleChanged, &other, [&](const QString& why) { said << why; });
    other.show();
    other.activateWindow();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&other));
    EXPECT_TRUE(desk.hindrance());
    ASSERT_FALSE(said.isEmpty());
    EXPECT_EQ(said.last().toStdString(), "keys do not reach the participant's window");
    QTest::keyClick(other.windowHandle(), Qt::Key_1);  // the operator types, which answers nothing
    window.takeKeys();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&window));
    EXPECT_FALSE(desk.hindrance());
    EXPECT_TRUE(desk.takeEarly().empty());
}

TEST_F(Seated, EveryStopOfTheirsStopsAtOnceInRealTime) {
    RecordProperty("hazard", "H2");
    auto* target = window.findChild<gui::ParticipantStop*>();
    const std::pair<const char*, std::function<void()>> hands[] = {
        {"participant", [&] { QTest::mousePress(target, Qt::LeftButton); }},
        {"participant (Esc)", [this] { key(Qt::Key_Escape); }},
        {"participant (Pause)", [this] { key(Qt::Key_Pause); }},
        {"participant (Space)", [this] { key(Qt::Key_Space); }},
    };
    double slowest_ms = 0;
    for (const auto asking : {false, true}) {
        for (const auto& [by, hand] : hands) {
            stops.clear();
            desk.show(testScreen(ScreenState::Feel));
            QCoreApplication::processEvents();
            if (asking) {
                ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
            }
            const auto pressed = std::chrono::steady_clock::now();
            hand();
            ASSERT_FALSE(stops.empty()) << by << ": before the event returned";
            EXPECT_EQ(stops.front(), by);
            slowest_ms = std::max(slowest_ms, std::chrono::duration<double, std::milli>(stoppedAt - pressed).count());
            EXPECT_FALSE(window.asking());
            EXPECT_EQ(window.title().toStdString(), "Stopped. The output is off.");
            if (!asking) continue;
            const auto said = answered();
            ASSERT_FALSE(said);
            EXPECT_EQ(said.error().code, ErrorCode::Stopped);
        }
    }
    RecordProperty("slowest_us", int(slowest_ms * 1000));
    EXPECT_IN_TIME(slowest_ms <= 10) << slowest_ms << " ms";
}

TEST_F(Seated, AHeldEscIsOneStop) {
    key(Qt::Key_Escape);
    const auto before = stops.size();
    for (int i = 0; i < 5; ++i) {
        QKeyEvent repeated(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier, {}, true);
        QApplication::sendEvent(&window, &repeated);
    }
    EXPECT_EQ(stops.size(), before);
}

TEST_F(Seated, LettingGoWhileLevelsRiseStops) {
    RecordProperty("hazard", "H6");
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    QTest::keyPress(window.windowHandle(), Qt::Key_H);
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("held"));
    EXPECT_TRUE(desk.holding());
    ASSERT_NO_FATAL_FAILURE(ask(strengthPrompt()));
    key(Qt::Key_2);
    ASSERT_TRUE(answered());
    EXPECT_TRUE(desk.holding()) << "an answer is given with the other hand";
    EXPECT_TRUE(stops.empty());
    QTest::keyRelease(window.windowHandle(), Qt::Key_H);
    EXPECT_THAT(stops, ElementsAre("participant let go"));
    EXPECT_FALSE(desk.holding());
}

TEST_F(Seated, TheHoldTargetShowsWhetherItIsHeld) {
    RecordProperty("hazard", "H6");
    auto* hold = window.findChild<gui::AnswerTarget*>("hold");
    for (const bool byKey : {true, false}) {
        ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
        const auto free = hold->grab().toImage();
        byKey ? QTest::keyPress(window.windowHandle(), Qt::Key_H) : QTest::mousePress(hold, Qt::LeftButton);
        ASSERT_TRUE(answered());
        EXPECT_NE(hold->grab().toImage(), free) << "by key: " << byKey;
        ASSERT_NO_FATAL_FAILURE(ask(strengthPrompt()));
        EXPECT_NE(hold->grab().toImage(), free) << "also beside the next question";
        byKey ? QTest::keyRelease(window.windowHandle(), Qt::Key_H) : QTest::mouseRelease(hold, Qt::LeftButton);
        EXPECT_EQ(hold->grab().toImage(), free);
        key(Qt::Key_1);
        ASSERT_TRUE(answered());
    }
}

TEST_F(Seated, LettingGoIsHeardWhateverHasTheFocus) {
    RecordProperty("hazard", "H6");
    auto* strip = new QWidget;
    const std::vector<QWidget*> fields{new QLineEdit(strip), new QPlainTextEdit(strip), new QPushButton(strip),
                                       new QComboBox(strip), new QSpinBox(strip),       new QMenu(strip)};
    window.setStrip(strip);
    window.openStrip(true);
    for (auto* field : fields) {
        window.setFocus();
        ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
        QTest::keyPress(window.windowHandle(), Qt::Key_H);
        ASSERT_TRUE(answered());
        ASSERT_NO_FATAL_FAILURE(ask(strengthPrompt()));
        ASSERT_TRUE(desk.holding());
        field->show();
        field->setFocus();
        QTest::keyRelease(field, Qt::Key_H);
        EXPECT_FALSE(desk.holding()) << field->metaObject()->className();
        field->hide();
        window.setFocus();
        key(Qt::Key_1);
        ASSERT_TRUE(answered());
    }
}

TEST_F(Seated, WithOneHandTheyLetGoToAnswerAndHoldAgain) {
    RecordProperty("hazard", "H6");
    auto* hold = window.findChild<gui::AnswerTarget*>("hold");
    for (const char* word : {"weak", "strong", "nothing"}) {
        ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
        QTest::mousePress(hold, Qt::LeftButton);
        ASSERT_TRUE(answered());
        ASSERT_NO_FATAL_FAILURE(ask(strengthPrompt()));
        QTest::mouseRelease(hold, Qt::LeftButton);
        EXPECT_TRUE(stops.empty()) << "nothing is delivered while the question waits";
        EXPECT_FALSE(desk.holding()) << "and nothing is before they hold again";
        QTest::mousePress(&target(word), Qt::LeftButton);
        const auto said = answered();
        ASSERT_TRUE(said);
        EXPECT_THAT(said->keys, ElementsAre(word));
    }
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    QTest::mousePress(hold, Qt::LeftButton);
    ASSERT_TRUE(answered());
    QTest::mouseRelease(hold, Qt::LeftButton);
    EXPECT_THAT(stops, ElementsAre("participant let go")) << "outside a question it is a stop";
}

TEST_F(Seated, ReadsAllInTheirLanguage) {
    const auto& all = ParticipantWords::builtIn();
    const auto german = std::ranges::find(all, "de", &ParticipantWords::code);
    ASSERT_NE(german, all.end());
    window.setWords(*german);
    const auto texts = [this] {
        QStringList said;
        for (const auto* label : window.findChildren<QLabel*>())
            if (label->isVisible()) said << label->text();
        for (const auto* button : window.findChildren<QAbstractButton*>())
            if (button->isVisible()) said << button->text() << button->accessibleName();
        return said.join('|');
    };
    std::set<QString> english;
    for (const auto& [key, text] : ParticipantWords::english().all())
        if (text.size() > 8 && german->text(key) != text && text.find('{') == std::string::npos)
            english.insert(QString::fromStdString(text));
    const PilotPrompt asked[] = {strengthPrompt(*german),
                                 intervalPrompt(*german),
                                 conditionPrompt(kFour, *german),
                                 meantPrompt(*german),
                                 holdPrompt(*german),
                                 goOnPrompt(german->text("introduction.3"), PromptTo::Participant, *german)};
    int pictures = 0;
    for (const auto& prompt : asked) {
        ASSERT_NO_FATAL_FAILURE(ask(prompt));
        for (const auto& each : english) EXPECT_FALSE(texts().contains(each)) << each.toStdString();
        EXPECT_EQ(faultsOf(window), "") << prompt.name;
        if (pictures++ % 2 == 1 || pictures == 6) shot(window, ("participant-german-" + prompt.name).c_str());
        if (prompt.kind == PromptKind::Hold)
            QTest::keyPress(window.windowHandle(), Qt::Key_H);
        else
            key(Qt::Key_1);
        ASSERT_TRUE(answered());
    }
    for (const auto state : {ScreenState::Feel, ScreenState::Interval, ScreenState::Break, ScreenState::Ended}) {
        desk.show(testScreen(state));
        QCoreApplication::processEvents();
        for (const auto& each : english) EXPECT_FALSE(texts().contains(each)) << each.toStdString();
    }
    // Qt has no words of its own here, which would need a translation: no menu opens wherever the participant clicks.
    PilotPrompt typed;
    typed.kind = PromptKind::Text;
    typed.name = "typed";
    typed.text = german->text("introduction.1");
    ASSERT_NO_FATAL_FAILURE(ask(typed));
    auto widgets = window.findChildren<QWidget*>();
    widgets << &window;
    for (auto* widget : widgets) {
        if (!widget->isVisible()) continue;
        QContextMenuEvent menu(QContextMenuEvent::Mouse, QPoint(2, 2), widget->mapToGlobal(QPoint(2, 2)));
        QCoreApplication::sendEvent(widget, &menu);
        EXPECT_EQ(QApplication::activePopupWidget(), nullptr) << widget->metaObject()->className();
        EXPECT_EQ(widget->toolTip(), "") << widget->metaObject()->className();
    }
    for (const auto& each : english) EXPECT_FALSE(texts().contains(each)) << each.toStdString();
}

TEST_F(Seated, TheHeadLineCountsSeriesWhileLevelsRiseAndBlocksInTheTest) {
    auto rising = testScreen(ScreenState::Feel);
    rising.phase = "ascending";
    rising.block = 2;
    rising.blocks = 3;
    rising.trial = rising.trials = 0;
    for (const auto& words : ParticipantWords::builtIn()) {
        window.setWords(words);
        const auto heads = [&](const PilotScreen& screen) {
            desk.show(screen);
            QCoreApplication::processEvents();
            QStringList said;
            for (const auto* label : window.findChildren<QLabel*>()) said << label->text();
            return said.join('|').toStdString();
        };
        const auto range = words.text("phase.range"), block = words.text("phase.block", {{"block", "2"}, {"of", "3"}});
        EXPECT_THAT(heads(rising), testing::HasSubstr(range + "  2 / 3"));
        EXPECT_THAT(heads(rising), testing::Not(testing::HasSubstr(block))) << "the test has not begun";
        shot(window, ("participant-series-" + words.code()).c_str());
        auto test = rising;
        test.phase = "test";
        EXPECT_THAT(heads(test), testing::HasSubstr(block));
    }
}

TEST_F(Seated, LettingGoOfTheTargetStopsAndAtRestItDoesNot) {
    RecordProperty("hazard", "H6");
    auto* hold = window.findChild<gui::AnswerTarget*>("hold");
    for (const bool rests : {false, true}) {
        stops.clear();
        desk.show(testScreen(ScreenState::Feel));
        ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
        QTest::mousePress(hold, Qt::LeftButton);
        ASSERT_TRUE(answered());
        desk.show(testScreen(ScreenState::Feel));
        QCoreApplication::processEvents();
        EXPECT_TRUE(hold->isVisible()) << "it stays under the finger";
        if (rests) {
            desk.show(testScreen(ScreenState::Rest));
            QCoreApplication::processEvents();
        }
        QTest::mouseRelease(hold, Qt::LeftButton);
        EXPECT_EQ(stops.empty(), rests);
    }
}

TEST_F(Seated, LosingTheKeysWhileHoldingIsLettingGo) {
    RecordProperty("hazard", "H6");
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    QTest::keyPress(window.windowHandle(), Qt::Key_H);
    ASSERT_TRUE(answered());
    QWidget other;
    other.show();
    other.activateWindow();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&other));
    EXPECT_THAT(stops, ElementsAre("participant let go"));
}

TEST_F(Seated, AScaleAndSeveralAnswers) {
    ASSERT_NO_FATAL_FAILURE(ask(scalePrompt("pain", "How painful was it?", 0, 10)));
    key(Qt::Key_0);
    EXPECT_EQ(answered()->value, 0);
    ASSERT_NO_FATAL_FAILURE(ask(scalePrompt("pain", "How painful was it?", 0, 10)));
    key(Qt::Key_T);
    EXPECT_EQ(answered()->value, 10);
    auto prompt = choicePrompt("qualities", "What was it like?",
                               {{"touch", "Touch"}, {"tapping", "Tapping"}, {"burning", "Burning"}});
    prompt.kind = PromptKind::Several;
    ASSERT_NO_FATAL_FAILURE(ask(prompt));
    key(Qt::Key_1);
    letLive(200);
    key(Qt::Key_3);
    key(Qt::Key_Return);
    EXPECT_THAT(answered()->keys, ElementsAre("touch", "burning"));
}

TEST_F(Seated, NoKeyAnswersWhatIsNotAsked) {
    RecordProperty("hazard", "H6");
    auto several = choicePrompt("qualities", "What was it like?", {{"touch", "Touch"}, {"burning", "Burning"}});
    several.kind = PromptKind::Several;
    auto text = goOnPrompt("Anything else?", PromptTo::Participant);
    text.kind = PromptKind::Text;
    text.targets.clear();
    const std::pair<PilotPrompt, std::set<int>> questions[] = {
        {holdPrompt(), {Qt::Key_H, Qt::Key_G}},
        {goOnPrompt("Go on?", PromptTo::Participant), {Qt::Key_1, Qt::Key_W, Qt::Key_U}},
        {several, {Qt::Key_Return, Qt::Key_Enter, Qt::Key_3, Qt::Key_S, Qt::Key_J}},
        {text, {}},
    };
    for (const auto set : {gui::KeySet::Figures, gui::KeySet::LeftHand, gui::KeySet::RightHand}) {
        window.setKeys(set);
        for (const auto& [question, answers] : questions) {
            ASSERT_NO_FATAL_FAILURE(ask(question));
            for (int each = Qt::Key_Exclam; each <= Qt::Key_Z; ++each) {
                if (!answers.contains(each)) key(static_cast<Qt::Key>(each));
            }
            letLive(10);
            EXPECT_FALSE(isAnswered()) << question.name;
            desk.leave();
            EXPECT_FALSE(answered());
            desk.begin(nullptr);
        }
    }
}

TEST_F(Seated, TheStopTestIsAnsweredByStopAlone) {
    RecordProperty("hazard", "H2");
    auto prompt = goOnPrompt("Press STOP once.", PromptTo::Participant);
    prompt.name = "stop-test";
    ASSERT_NO_FATAL_FAILURE(ask(prompt));
    key(Qt::Key_1);
    letLive(30);
    EXPECT_FALSE(isAnswered());
    key(Qt::Key_Escape);
    EXPECT_FALSE(answered());
}

TEST_F(Seated, TheOperatorsStripHoldsThePresentationsBack) {
    auto* strip = new QWidget;
    window.setStrip(strip);
    key(Qt::Key_F2);
    EXPECT_TRUE(window.stripOpen());
    EXPECT_TRUE(desk.hindrance());
    key(Qt::Key_F2);
    EXPECT_FALSE(desk.hindrance());
}

/// After 10 s with an obstacle the output is off, and a STOP that is pressed then proves nothing.
TEST_F(Seated, TheStripIsInTheWayOfNoTestOfTheOperatorsStop) {
    RecordProperty("hazard", "H2");
    window.setStrip(new QWidget);
    auto prompt = goOnPrompt("Press STOP now.", PromptTo::Operator);
    for (const bool test : {true, false}) {
        prompt.name = test ? "stop-test" : "ready";
        answer = std::async(std::launch::async, [this, prompt] { return desk.ask(prompt); });
        ASSERT_IN_TIME(comesTrue([this] { return window.title() == "One moment, please."; }));
        window.openStrip(true);
        EXPECT_EQ(desk.hindrance().has_value(), !test);
        desk.show(testScreen(ScreenState::Rest));
        letLive(20);
        EXPECT_TRUE(desk.hindrance()) << "after the test it is one as any other";
        desk.leave();
        EXPECT_FALSE(answered());
        desk.begin(nullptr);
        window.openStrip(false);
    }
}

TEST_F(Seated, AKeyThatTheOperatorStillHoldsSaysSo) {
    RecordProperty("hazard", "H2");
    std::vector<std::string> said;
    const gui::StopKeys theirs([&](const char* by) { said.emplace_back(by); }, nullptr);
    QWidget operators;
    for (const bool repeats : {false, true}) {
        QKeyEvent event(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier, QString(), repeats);
        QApplication::sendEvent(&operators, &event);
    }
    said.erase(std::unique(said.begin(), said.end()), said.end());  // each press is heard several times
    EXPECT_EQ(said, (std::vector<std::string>{"operator (Esc)", "operator (Esc, held)"}));
}

}  // namespace
}  // namespace tacto::test
