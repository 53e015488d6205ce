// Tests game pads and foot switches in a session: each press counts for its own person, in the same way as a key, and
// STOP comes in time.
#include <QAbstractButton>
#include <QComboBox>
#include <QEventLoop>
#include <QPushButton>
#include <QSettings>
#include <QTimer>
#include <gmock/gmock.h>

#include "app/gui/pilot/InputRows.h"
#include "app/gui/pilot/SessionInputs.h"
#include "app/gui/theme/Theme.h"
#include "drivers/hid_input/HidInput.h"
#include "tests/drivers/hid_input/PadDescriptors.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/PluggedButtons.h"
#include "tests/gui/pilot/SeatedPeople.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using enum gui::ButtonUse::Does;

gui::SeatedDevice seated(const std::string& name, PromptTo whose, std::size_t buttons = 12) {
    return {PluggedButtons::pad(name, buttons), whose, gui::usualUses(buttons)};
}

TEST(ButtonUse, EachDeviceHasAStopAndAPadTwo) {
    RecordProperty("hazard", "H2");
    for (std::size_t buttons = 1; buttons <= 20; ++buttons) {
        const auto uses = gui::usualUses(buttons);
        ASSERT_EQ(uses.size(), buttons);
        const auto stops = std::ranges::count(uses, Stop, &gui::ButtonUse::does);
        EXPECT_EQ(stops, buttons < 6 ? 1 : 2) << buttons;
    }
    EXPECT_EQ(seated("pad", PromptTo::Participant, 12).answers(), 6);
    EXPECT_EQ(seated("pad", PromptTo::Participant, 8).answers(), 4);
    EXPECT_EQ(seated("pedals", PromptTo::Participant, 3).answers(), 2);
    EXPECT_EQ(seated("pedal", PromptTo::Participant, 1).answers(), 0);
}

class SeatedWithPad : public Seated {
protected:
    void begin(const std::vector<gui::SeatedDevice>& seats) {
        plugged->set({PluggedButtons::pad("theirs"), PluggedButtons::pad("spare"), PluggedButtons::pad("operators")});
        ASSERT_EQ(inputs.begin(plugged, seats, atOnce()), QString());
        window.setButtonAnswers(inputs.participantAnswers());
        QObject::connect(&inputs, &gui::SessionInputs::participantMoved, &window, &gui::ParticipantWindow::moveButton);
        QObject::connect(&inputs, &gui::SessionInputs::operatorPressed, &window,
                         [this](const gui::ButtonUse& use) { operators.push_back(use); });
    }
    void click(const char* name, std::size_t button) {
        plugged->press(name, button, true);
        plugged->press(name, button, false);
        letLive(20);
    }
    /// Reacts as the window of a session does.
    [[nodiscard]] gui::InputsAtOnce atOnce() {
        gui::InputsAtOnce all;
        all.stop = [this](PromptTo whose) {
            if (whose == PromptTo::Participant) press("participant (button)");
        };
        all.letGo = [this](int code) {
            if (desk.letGoOf(code)) press(kParticipantLetGo);
        };
        all.heldMoved = [this](int code, bool down, gui::SteadyTime at) { desk.noteHoldButton(code, down, at); };
        return all;
    }
    std::shared_ptr<PluggedButtons> plugged = std::make_shared<PluggedButtons>();
    gui::SessionInputs inputs;
    std::vector<gui::ButtonUse> operators;
};

TEST_F(SeatedWithPad, EachAnswerIsAButton) {
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    const std::vector<std::string> places{"smooth-high", "rough-high", "smooth-low", "rough-low", "none", "not-sure"};
    const std::vector<std::size_t> buttons{1, 2, 3, 4, 9, 10};
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        desk.show(testScreen(ScreenState::Feel));
        ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
        click("theirs", buttons[i]);
        const auto said = answered();
        ASSERT_TRUE(said);
        EXPECT_THAT(said->keys, ElementsAre(places[i]));
    }
}

TEST_F(SeatedWithPad, BeforeTheTargetsItIsEarlyAndHeldFromBeforeItIsNoAnswer) {
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    click("theirs", 10);
    ASSERT_TRUE(answered());
    desk.show(testScreen(ScreenState::Feel));
    QCoreApplication::processEvents();
    plugged->press("theirs", 3);  // the button is held down
    letLive(20);
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    letLive(300);
    EXPECT_FALSE(isAnswered()) << "held: it counts once, and that was early";
    const auto early = desk.takeEarly();
    ASSERT_EQ(early.size(), 1U);
    EXPECT_EQ(early[0].key, "smooth-low");
    plugged->press("theirs", 3, false);
    click("theirs", 3);
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("smooth-low"));
}

TEST_F(SeatedWithPad, AQuestionWithMoreTargetsThanButtonsIsNotAnsweredByThem) {
    RecordProperty("hazard", "H9");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant, 8)}));  // four answers
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    click("theirs", 1);
    letLive(50);
    EXPECT_FALSE(isAnswered()) << "\"nothing\" and \"not sure\" would be chosen less";
    key(Qt::Key_1);
    ASSERT_TRUE(answered());
    ASSERT_NO_FATAL_FAILURE(ask(scalePrompt("pain", "How painful was it?", 0, 3)));
    click("theirs", 1);
    EXPECT_FALSE(isAnswered()) << "answer 1 is not 0";
    key(Qt::Key_2);
    ASSERT_TRUE(answered());
}

TEST_F(SeatedWithPad, OnlyTheAssignedOneAnswersAndNoOtherIsOpen) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant), seated("operators", PromptTo::Operator)}));
    EXPECT_EQ(plugged->open("theirs"), 1U);
    EXPECT_EQ(plugged->open("spare"), 0U);
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    click("spare", 1);
    click("spare", 5);
    click("operators", 1);
    click("operators", 5);
    EXPECT_FALSE(isAnswered());
    EXPECT_THAT(stops, IsEmpty()) << "the operator's STOP is told apart from theirs";
    EXPECT_THAT(operators, ElementsAre(gui::ButtonUse{Answer, 1}, gui::ButtonUse{Stop, 0}));
    key(Qt::Key_1);
    ASSERT_TRUE(answered());
    inputs.end();
    EXPECT_EQ(plugged->open("theirs"), 0U);
}

TEST_F(SeatedWithPad, EitherOfTwoButtonsStopsAndAHeldOneOnce) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    for (const std::size_t button : {5U, 6U}) {
        stops.clear();
        desk.show(testScreen(ScreenState::Feel));
        QCoreApplication::processEvents();
        plugged->press("theirs", button);
        ASSERT_IN_TIME(comesTrue([this] { return !stops.empty(); }));
        letLive(300);
        EXPECT_THAT(stops, ElementsAre("participant (button)"));
        plugged->press("theirs", button, false);
        letLive(20);
        EXPECT_EQ(stops.size(), 1U);
    }
}

TEST_F(SeatedWithPad, LettingGoOfTheButtonThatIsHeldIsAStop) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    click("theirs", 1);
    EXPECT_FALSE(desk.holding()) << "an answer holds nothing";
    plugged->press("theirs", 7);
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("held"));
    EXPECT_TRUE(desk.holding());
    QWidget other;
    other.show();
    other.activateWindow();
    letLive(50);
    EXPECT_TRUE(desk.holding()) << "a button is theirs whichever window has the keys";
    EXPECT_THAT(stops, IsEmpty());
    plugged->press("theirs", 7, false);
    EXPECT_THAT(stops, ElementsAre("participant let go")) << "before any event of the window";
    EXPECT_FALSE(desk.holding());
    letLive(50);
    EXPECT_THAT(stops, ElementsAre("participant let go")) << "and once";
}

TEST_F(SeatedWithPad, WhatWasHeldWhenAStopCameIsLetGoWithoutAnother) {
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    plugged->press("theirs", 7);
    ASSERT_TRUE(answered());
    plugged->press("theirs", 5);
    plugged->press("theirs", 7, false);
    letLive(50);
    EXPECT_THAT(stops, ElementsAre("participant (button)"));
}

TEST_F(SeatedWithPad, OneThatIsUnpluggedIsNamedAndNoPresentationStartsUntilItIsBack) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant), seated("operators", PromptTo::Operator)}));
    QStringList told;
    QObject::connect(&inputs, &gui::SessionInputs::lost, &window, [&] {
        told << inputs.gone();
        window.setInputGone(inputs.gone());
    });
    QObject::connect(&inputs, &gui::SessionInputs::back, &window, [&] { window.setInputGone(inputs.gone()); });
    plugged->plug("theirs", false);
    plugged->plug("theirs", false);
    plugged->plug("operators", false);
    ASSERT_IN_TIME(comesTrue([&] { return told.size() == 2; }));
    EXPECT_EQ(told.at(0), "the participant's theirs is unplugged");
    EXPECT_EQ(told.at(1), "the participant's theirs is unplugged, and the operator's operators is unplugged");
    ASSERT_TRUE(desk.hindrance().has_value());
    EXPECT_FALSE(desk.hindrance()->isBreak);
    EXPECT_EQ(desk.hindrance()->why, told.at(1).toStdString());
    plugged->plug("theirs", true);
    plugged->plug("operators", true);
    EXPECT_IN_TIME(comesTrue([&] { return !desk.hindrance().has_value(); }));
}

TEST_F(SeatedWithPad, OneThatCannotBeOpenedIsASentenceAndNoneStaysOpen) {
    auto blocked = PluggedButtons::pad("blocked");
    blocked.obstacle = "Another program has it.";
    plugged->set({PluggedButtons::pad("theirs"), blocked});
    EXPECT_EQ(
        inputs.begin(plugged, {seated("theirs", PromptTo::Participant), seated("blocked", PromptTo::Operator)}, {}),
        "Another program has it.");
    EXPECT_EQ(plugged->open("theirs"), 0U);
}

TEST_F(SeatedWithPad, OneDeviceIsNotBothPeoples) {
    RecordProperty("hazard", "H12");
    plugged->set({PluggedButtons::pad("theirs")});
    EXPECT_EQ(
        inputs.begin(plugged, {seated("theirs", PromptTo::Participant), seated("theirs", PromptTo::Operator)}, {}),
        "theirs is assigned twice; a device is one person’s.");
    EXPECT_EQ(plugged->open("theirs"), 0U);
}

TEST_F(SeatedWithPad, WhatCameUpBeforeTheWindowHeardOfItIsNotHeld) {
    RecordProperty("hazard", "H6");
    const auto now = std::chrono::steady_clock::now();
    desk.noteHoldButton(7, true, now);
    EXPECT_TRUE(desk.setHolding(true, 7));
    EXPECT_TRUE(desk.holding());
    desk.noteHoldButton(7, false, now);
    EXPECT_TRUE(desk.letGoOf(7));
    EXPECT_FALSE(desk.setHolding(true, 7)) << "the window's thread comes late with what it was";
    EXPECT_FALSE(desk.holding());
    EXPECT_TRUE(desk.setHolding(true)) << "a key, the mouse or a finger";
    EXPECT_TRUE(desk.holding());
    desk.setHolding(false);
}

TEST_F(SeatedWithPad, TheBounceOfAHeldContactSwitchesOffAndIsNoStopOfTheirs) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    const auto hold = [this] {
        ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
        plugged->press("theirs", 7);
        ASSERT_TRUE(answered());
        ASSERT_TRUE(desk.holding());
    };
    ASSERT_NO_FATAL_FAILURE(hold());
    const auto moment = std::chrono::steady_clock::now();
    const auto move = [&](bool down, int after_ms) {
        plugged->press("theirs", 7, down, moment + std::chrono::milliseconds(after_ms));
    };
    move(false, 0);
    EXPECT_THAT(stops, ElementsAre(kParticipantLetGo)) << "off at once, whatever comes next";
    EXPECT_FALSE(desk.holding());
    move(true, 5);
    EXPECT_TRUE(desk.letGoWasBounce());
    EXPECT_FALSE(desk.letGoWasBounce()) << "once";
    EXPECT_FALSE(desk.holding()) << "they let go and hold again before anything goes on";
    move(false, 6);

    // A finger that lets go and presses again after a time, and one that stays away (-1).
    for (const int back_ms : {25, 40, -1}) {
        stops.clear();
        desk.show(testScreen(ScreenState::Rest));
        QCoreApplication::processEvents();
        ASSERT_NO_FATAL_FAILURE(hold());
        move(false, 0);
        EXPECT_THAT(stops, ElementsAre(kParticipantLetGo));
        if (back_ms > 0) move(true, back_ms);
        EXPECT_FALSE(desk.letGoWasBounce()) << back_ms;
        move(false, 50);
    }
    // Shows another STOP at the side.
    desk.show(testScreen(ScreenState::Rest));
    QCoreApplication::processEvents();
    ASSERT_NO_FATAL_FAILURE(hold());
    move(false, 0);
    move(true, 5);
    desk.notePressed();
    EXPECT_FALSE(desk.letGoWasBounce());
}

TEST_F(SeatedWithPad, AContactThatBouncesWhenItIsPressedLetsNothingGo) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    for (const bool down : {true, false, true, false}) plugged->press("theirs", 7, down);
    letLive(60);
    EXPECT_FALSE(isAnswered()) << "it is not down";
    for (const bool down : {true, false, true}) plugged->press("theirs", 7, down);
    const auto said = answered();
    ASSERT_TRUE(said);
    EXPECT_THAT(said->keys, ElementsAre("held"));
    EXPECT_THAT(stops, IsEmpty());
    plugged->press("theirs", 7, false);
    EXPECT_THAT(stops, ElementsAre(kParticipantLetGo)) << "and its release is one";
}

TEST_F(SeatedWithPad, EachTargetShowsTheButtonThatAnswersIt) {
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    window.setButtonLabels(inputs.labels());
    for (const auto& target : {"smooth-high", "rough-high", "smooth-low", "rough-low", "none", "not-sure"}) {
        desk.show(testScreen(ScreenState::Feel));
        ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
        const auto written = this->target(target).button();
        ASSERT_FALSE(written.isEmpty()) << target;
        EXPECT_TRUE(this->target(target).accessibleName().endsWith("button " + written));
        click("theirs", written.toULong());
        const auto said = answered();
        ASSERT_TRUE(said);
        EXPECT_THAT(said->keys, ElementsAre(target));
    }
    ASSERT_NO_FATAL_FAILURE(ask(scalePrompt("pain", "How painful was it?", 0, 3)));
    for (const auto* each : window.field().targets()) EXPECT_TRUE(each->button().isEmpty()) << "no button answers it";
    key(Qt::Key_2);
    ASSERT_TRUE(answered());
    ASSERT_NO_FATAL_FAILURE(ask(holdPrompt()));
    EXPECT_EQ(target("hold").button(), "7");
    EXPECT_EQ(window.findChild<QAbstractButton*>("participantStop")->accessibleName(),
              "STOP · button 5 or 6, 3 of 3 left");
    const auto pedal = gui::labelsOf({seated("pedal", PromptTo::Participant, 1), seated("pad", PromptTo::Operator)});
    EXPECT_TRUE(pedal.answers.isEmpty()) << "the operator's are not theirs";
    window.setButtonLabels(pedal);
    EXPECT_EQ(window.findChild<QAbstractButton*>("participantStop")->accessibleName(), "STOP · pedal, 3 of 3 left");
}

TEST_F(SeatedWithPad, ButtonsAreNotShownOnAQuestionThatTheyDoNotReach) {
    RecordProperty("hazard", "H9");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant, 8)}));  // four answers
    window.setButtonLabels(inputs.labels());
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    for (const auto* each : window.field().targets()) EXPECT_TRUE(each->button().isEmpty());
}

TEST_F(SeatedWithPad, ButtonsOnTheTargetsLookRightAndAreTheSameForEveryCondition) {
    RecordProperty("hazard", "H9");
    ASSERT_NO_FATAL_FAILURE(begin({seated("theirs", PromptTo::Participant)}));
    window.setButtonLabels(inputs.labels());
    std::vector<QImage> seen;
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (const double level : {4.0, 4.0, 6.5}) {  // the first round does not count: letters are drawn anew then
            desk.show(testScreen(ScreenState::Feel));
            FeltPresentation felt;
            felt.level = level;
            desk.delivered(felt);
            ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
            letLive(60);
            seen.push_back(window.grab().toImage());
            shot(window, QString("buttons-%1").arg(theme == gui::Theme::Dark ? "dark" : "light"));
            EXPECT_EQ(faultsOf(window), "");
            click("theirs", 1);
            ASSERT_TRUE(answered());
        }
    }
    EXPECT_TRUE(seen[1] == seen[2]);
    EXPECT_TRUE(seen[4] == seen[5]);
    EXPECT_FALSE(seen[2] == seen[5]) << "and the pictures are of the themes";
    gui::applyTheme(gui::Theme::Light);
    for (const auto& [percent, size] : {std::pair{100, QSize(1280, 720)}, std::pair{200, QSize(1280, 800)}}) {
        gui::applyTextSize(percent);
        window.resize(size);
        desk.show(testScreen(ScreenState::Feel));
        ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
        letLive(60);
        shot(window, QString("buttons-%1").arg(percent));
        EXPECT_EQ(faultsOf(window), "") << percent;
        click("theirs", 1);
        ASSERT_TRUE(answered());
    }
}

/// A game pad with its real driver; records what the driver reports on its own thread.
class OwnThread : public testing::Test {
protected:
    OwnThread() {
        const hid::HidDeviceInfo info{0x046D, 0xC216, "", "Pad", "/dev/hidraw0", 0x10004, true};
        backend->plugged.push_back(std::make_shared<FakeHidDevice>(clock, info, padDescriptor()));
        const auto devices = hid::makeHidInput(backend);
        const auto list = devices->list();
        EXPECT_EQ(list.size(), 1U);
        gui::InputsAtOnce atOnce;
        atOnce.stop = [this](PromptTo /*whose*/) { hear(stops); };
        atOnce.letGo = [this](int /*code*/) { hear(releases); };
        atOnce.lost = [this](const std::string& which) {
            const std::scoped_lock lock(mutex);
            lost = which;
            changed.notify_all();
        };
        EXPECT_EQ(inputs.begin(devices, {{list.at(0), PromptTo::Participant, gui::usualUses(12)}}, atOnce), QString());
    }
    ~OwnThread() override { inputs.end(); }
    void hear(std::vector<std::chrono::steady_clock::time_point>& at) {
        const std::scoped_lock lock(mutex);
        at.push_back(std::chrono::steady_clock::now());
        changed.notify_all();
    }
    /// Waits while the window's thread (this one) handles no events.
    [[nodiscard]] bool heldUntil(const std::function<bool()>& heard) {
        std::unique_lock lock(mutex);
        return changed.wait_for(lock, std::chrono::seconds(5), heard);
    }
    FakeHidDevice& pad() { return *backend->plugged[0]; }

    const SteadyClock clock;
    std::shared_ptr<FakeHidBackend> backend = std::make_shared<FakeHidBackend>();
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::chrono::steady_clock::time_point> stops, releases;  // guarded by mutex
    std::string lost;                                                    // guarded by mutex
    gui::SessionInputs inputs;
};

TEST_F(OwnThread, AStopTakesLessThan10MillisecondsWhileTheWindowsThreadIsHeld) {
    RecordProperty("hazard", "H2");
    std::vector<double> took_ms;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto pressed = std::chrono::steady_clock::now();
        pad().send(padReport({6}));
        ASSERT_IN_TIME(heldUntil([&] { return stops.size() == i + 1; }));
        took_ms.push_back(std::chrono::duration<double, std::milli>(stops.back() - pressed).count());
        pad().send(padReport({}));
    }
    std::ranges::sort(took_ms);
    RecordProperty("median_ms", std::to_string(took_ms[10]));
    EXPECT_IN_TIME(took_ms.back() <= 10) << took_ms.back() << " ms";
}

TEST_F(OwnThread, LettingGoAndUnpluggingDoNotWaitForTheWindowEither) {
    RecordProperty("hazard", "H2");
    pad().send(padReport({7}));
    pad().send(padReport({}));
    ASSERT_IN_TIME(heldUntil([&] { return releases.size() == 1; }));
    pad().send(padReport({5}));
    ASSERT_IN_TIME(heldUntil([&] { return stops.size() == 1; }));
    pad().unplug();  // unplugged while STOP is held
    ASSERT_IN_TIME(heldUntil([&] { return !lost.empty(); }));
    EXPECT_EQ(lost, "the participant's Pad is unplugged");
    EXPECT_EQ(stops.size(), 1U);
}

TEST_F(OwnThread, AStopHeldWhileTheDeviceWasOpenedCountsWithItsFirstReport) {
    RecordProperty("hazard", "H2");
    pad().send(padReport({5, 12}));  // 12 is pressed now; 5 was already down
    ASSERT_IN_TIME(heldUntil([&] { return stops.size() == 1; }));
}

TEST_F(OwnThread, ABouncingContactAmongReportsOfEachMillisecondIsHeardAtItsFirstTouch) {
    RecordProperty("hazard", "H2");
    const auto pressed = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) {
        pad().send(i % 2 == 0 ? padReport({5}) : padReport({}));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));  // as the device does
    }
    ASSERT_IN_TIME(heldUntil([&] { return !stops.empty(); }));
    EXPECT_IN_TIME(stops.front() - pressed <= std::chrono::milliseconds(10));
}

class Inputs : public testing::Test {
protected:
    void show(std::vector<ButtonDeviceInfo> devices) {
        plugged->set(std::move(devices));
        rows.setDevices(plugged);
        rows.resize(560, 400);
        rows.show();
        ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&rows));
    }
    [[nodiscard]] QComboBox* box(const QString& name) { return rows.findChild<QComboBox*>(name); }
    /// Chooses an entry as a person does.
    static void choose(QComboBox& box, int index) {
        box.setCurrentIndex(index);
        emit box.activated(index);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    std::shared_ptr<PluggedButtons> plugged = std::make_shared<PluggedButtons>();
    gui::InputRows rows;
};

TEST_F(Inputs, OneIsAssignedToOnePersonAndItsButtonsToWhatTheyDo) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(show({PluggedButtons::pad("pad"), PluggedButtons::pad("pedal", 1)}));
    ASSERT_IN_TIME(comesTrue([this] { return box("inputOf pad") != nullptr; }));
    EXPECT_TRUE(rows.seats().empty()) << "none is assigned beforehand";
    choose(*box("inputOf pad"), 1);
    ASSERT_EQ(rows.seats().size(), 1U);
    EXPECT_EQ(rows.seats()[0].whose, PromptTo::Participant);
    EXPECT_EQ(rows.seats()[0].uses, gui::usualUses(12));
    choose(*box("use 12"), 1);
    EXPECT_EQ(rows.seats()[0].uses[11].does, Stop);
    choose(*box("inputOf pedal"), 2);
    ASSERT_EQ(rows.seats().size(), 2U);
    EXPECT_EQ(rows.seats()[1].whose, PromptTo::Operator);
    EXPECT_EQ(rows.seats()[0].uses[11].does, Stop) << "and keeps what was chosen";
    EXPECT_EQ(rows.missing(), QString());
    choose(*box("inputOf pedal"), 0);
    EXPECT_EQ(rows.seats().size(), 1U);
}

TEST_F(Inputs, APressedButtonLightsUpUntilItIsLetGo) {
    ASSERT_NO_FATAL_FAILURE(show({PluggedButtons::pad("pad")}));
    ASSERT_IN_TIME(comesTrue([this] { return plugged->open("pad") == 1; }));
    const auto hint = [this] { return rows.findChild<QLabel*>("pressIt")->text(); };
    plugged->press("pad", 3);
    EXPECT_IN_TIME(comesTrue([&] { return hint() == "● button 3 is down"; }));
    plugged->press("pad", 3, false);
    EXPECT_IN_TIME(comesTrue([&] { return hint().startsWith("Press"); }));
    choose(*box("inputOf pad"), 1);
    const auto lamp = [this] { return rows.findChild<QLabel*>("lamp 5")->text(); };
    EXPECT_EQ(lamp(), "○ 5");
    plugged->press("pad", 5);
    EXPECT_IN_TIME(comesTrue([&] { return lamp() == "● 5"; }));
    rows.hide();
    EXPECT_EQ(plugged->open("pad"), 0U) << "a session's devices are its own";
}

TEST_F(Inputs, OneThatIsGoneOrIdleIsInTheWayAndOneThatCannotBeUsedSaysWhy) {
    auto blocked = PluggedButtons::pad("blocked", 0);
    blocked.obstacle = "HID device 046d:0002 at /dev/hidraw1 cannot answer: it has 2 other inputs and no button.";
    ASSERT_NO_FATAL_FAILURE(show({PluggedButtons::pad("pad", 1), blocked}));
    ASSERT_IN_TIME(comesTrue([this] { return box("inputOf blocked") != nullptr; }));
    EXPECT_FALSE(box("inputOf blocked")->isEnabled());
    EXPECT_EQ(rows.missing(), QString()) << "it is not used";
    choose(*box("inputOf pad"), 1);
    choose(*box("use 1"), 0);
    EXPECT_EQ(rows.missing(), "No button of pad does anything. Choose STOP or an answer for one.");
    choose(*box("use 1"), 1);
    plugged->set({blocked});
    plugged->plug("pad", false);
    EXPECT_IN_TIME(comesTrue([&] { return rows.missing() == "pad is unplugged. Plug it in, or choose “not used”."; }));
    plugged->set({PluggedButtons::pad("pad", 1), blocked});
    EXPECT_IN_TIME(comesTrue([&] { return rows.missing().isEmpty(); }));
    ASSERT_EQ(rows.seats().size(), 1U);
    EXPECT_EQ(rows.seats()[0].uses[0].does, Stop) << "it keeps its person and its uses";
}

class RememberedInputs : public Inputs {
protected:
    RememberedInputs() { gui::rememberInputs(kStudy, {}); }
    ~RememberedInputs() override { gui::rememberInputs(kStudy, {}); }
    static ButtonDeviceInfo numbered(const std::string& name) {
        auto info = PluggedButtons::pad(name);
        info.hasSerial = true;
        return info;
    }
    static gui::SeatedDevice theirs(const ButtonDeviceInfo& device) {
        gui::SeatedDevice seat{device, PromptTo::Participant, gui::usualUses(12)};
        seat.uses[11] = {Stop, 0};
        return seat;
    }
    [[nodiscard]] QLabel* asLastTime() { return rows.findChild<QLabel*>("asLastTime"); }
    static constexpr const char* kStudy = "0123456789abcdef";
};

TEST_F(RememberedInputs, OneWithASerialNumberIsSeatedAsBeforeAndThatIsShown) {
    RecordProperty("hazard", "H12");
    const auto known = numbered("046d:c216 17"), other = numbered("046d:c216 18");
    gui::rememberInputs(kStudy, {theirs(known)});
    rows.setPlace(kStudy);
    ASSERT_NO_FATAL_FAILURE(show({known, other}));
    ASSERT_IN_TIME(comesTrue([this] { return rows.seats().size() == 1; }));
    EXPECT_EQ(rows.seats()[0].device.identity, "046d:c216 17");
    EXPECT_EQ(rows.seats()[0].whose, PromptTo::Participant);
    EXPECT_EQ(rows.seats()[0].uses, theirs(known).uses);
    ASSERT_NE(asLastTime(), nullptr);
    EXPECT_EQ(asLastTime()->text(), "As in the last session.");
    choose(*box("use 12"), 0);
    choose(*box("inputOf 046d:c216 17"), 0);
    EXPECT_TRUE(rows.seats().empty()) << "the operator's choice counts";
    rows.setPlace("fedcba9876543210");
    ASSERT_IN_TIME(comesTrue([this] { return box("inputOf 046d:c216 18") != nullptr; }));
    EXPECT_TRUE(rows.seats().empty()) << "another study has its own";
}

TEST_F(RememberedInputs, OneWithoutIsOfferedAndNeverAssumed) {
    RecordProperty("hazard", "H12");
    const auto pad = PluggedButtons::pad("046d:c216");
    gui::rememberInputs(kStudy, {theirs(pad)});
    rows.setPlace(kStudy);
    ASSERT_NO_FATAL_FAILURE(show({pad}));
    ASSERT_IN_TIME(comesTrue([this] { return asLastTime() != nullptr; }));
    EXPECT_TRUE(rows.seats().empty());
    EXPECT_TRUE(asLastTime()->text().contains("no serial number"));
    rows.findChild<QPushButton*>("seatAsBefore 046d:c216")->click();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    ASSERT_EQ(rows.seats().size(), 1U);
    EXPECT_EQ(rows.seats()[0].uses, theirs(pad).uses);
    EXPECT_EQ(asLastTime()->text(), "As in the last session.");
    rows.setPlace(kStudy);  // begins the next session
    ASSERT_IN_TIME(comesTrue([this] { return box("inputOf 046d:c216") != nullptr; }));
    EXPECT_TRUE(rows.seats().empty());
}

TEST_F(RememberedInputs, TwinsOtherButtonsAndBrokenSettingsSeatNone) {
    RecordProperty("hazard", "H12");
    auto twin = numbered("046d:c216 1");
    gui::rememberInputs(kStudy, {theirs(twin)});
    twin.obstacle = "2 devices are 046d:c216 1 and nothing tells them apart; one of them is accepted.";
    rows.setPlace(kStudy);
    ASSERT_NO_FATAL_FAILURE(show({twin, twin}));
    ASSERT_IN_TIME(comesTrue([this] { return box("inputOf 046d:c216 1") != nullptr; }));
    EXPECT_TRUE(rows.seats().empty());
    auto fewer = PluggedButtons::pad("046d:c216 1", 8);
    fewer.hasSerial = true;
    EXPECT_FALSE(gui::rememberedInput(kStudy, fewer));
    const auto asItWas = numbered("046d:c216 1");
    EXPECT_TRUE(gui::rememberedInput(kStudy, asItWas));
    for (const char* broken : {"046d:c216 1\tnobody", "046d:c216 1\tparticipant\t9 0", "046d:c216 1", "\t\t"}) {
        QSettings().setValue(QString("pilot/inputs/") + kStudy, QStringList{broken});
        EXPECT_FALSE(gui::rememberedInput(kStudy, asItWas)) << broken;
    }
}

TEST_F(RememberedInputs, LookRightInBothThemesAndSizes) {
    const auto known = numbered("Logitech Dual Action 17"), unknown = PluggedButtons::pad("VEC USB Footpedal", 3);
    gui::rememberInputs(kStudy, {theirs(known), {unknown, PromptTo::Operator, gui::usualUses(3)}});
    rows.setPlace(kStudy);
    ASSERT_NO_FATAL_FAILURE(show({known, unknown}));
    ASSERT_IN_TIME(comesTrue([this] { return rows.findChild<QPushButton*>("seatAsBefore VEC USB Footpedal"); }));
    looksRight(rows, "remembered", {QSize(480, 460), QSize(900, 900)});
}

TEST_F(Inputs, LooksRightInBothThemesAndSizes) {
    auto blocked = PluggedButtons::pad("Dual Action", 0);
    blocked.obstacle =
        "2 devices are 046d:c216 and nothing tells them apart when one is plugged in again; one of them is accepted.";
    ASSERT_NO_FATAL_FAILURE(
        show({PluggedButtons::pad("Logitech Logitech Dual Action"), PluggedButtons::pad("VEC USB Footpedal", 3),
              blocked, PluggedButtons::pad("8BitDo SN30 Pro")}));
    ASSERT_IN_TIME(comesTrue([this] { return box("inputOf VEC USB Footpedal") != nullptr; }));
    choose(*box("inputOf Logitech Logitech Dual Action"), 1);
    choose(*box("inputOf VEC USB Footpedal"), 2);
    plugged->press("Logitech Logitech Dual Action", 6);
    looksRight(rows, "inputs", {QSize(480, 560), QSize(900, 1100)});
}

}  // namespace
}  // namespace tacto::test
