// Tests where the session's thread and the windows meet: the thread waits, the windows answer, a stop ends the wait.
#include <future>
#include <gtest/gtest.h>

#include "app/gui/pilot/ParticipantDesk.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

class Desk : public testing::Test {
protected:
    Desk() {
        desk.stop = [this](const char* by) { stops.emplace_back(by); };
        desk.begin(nullptr);
        desk.show({});
        QObject::connect(&desk, &gui::ParticipantDesk::asked, &desk,
                         [this](const PilotPrompt&, quint64 id) { asked = id; });
    }
    ~Desk() override {
        desk.leave();
        if (answer.valid()) answer.wait();
    }
    void ask(const PilotPrompt& prompt) {
        asked = 0;
        answer = std::async(std::launch::async, [this, prompt] { return desk.ask(prompt); });
        ASSERT_IN_TIME(comesTrue([this] { return asked != 0; }));
    }
    [[nodiscard]] bool waits() const { return answer.wait_for(30ms) != std::future_status::ready; }
    static PilotAnswer with(const char* key) {
        PilotAnswer made;
        made.keys.emplace_back(key);
        return made;
    }
    gui::ParticipantDesk desk;
    std::vector<std::string> stops;
    quint64 asked = 0;
    std::future<Result<PilotAnswer>> answer;
};

TEST_F(Desk, TheTimeRunsFromTheTargetsToThePress) {
    ask(yesNoPrompt("code", "Is this your code?"));
    const auto shown = std::chrono::steady_clock::now();
    desk.targetsShown(asked, shown);
    desk.answerAsParticipant(asked, with("yes"), shown + 412ms);
    const auto said = answer.get();
    ASSERT_TRUE(said);
    EXPECT_EQ(said->key(), "yes");
    EXPECT_NEAR(said->after.count(), 0.412, 1e-9);
}

TEST_F(Desk, NoAnswerCountsBeforeTheTargetsAreShown) {
    ask(yesNoPrompt("code", "Is this your code?"));
    desk.answerAsParticipant(asked, with("yes"), std::chrono::steady_clock::now());
    EXPECT_TRUE(waits());
}

TEST_F(Desk, AnAnswerToAnotherQuestionIsNone) {
    ask(yesNoPrompt("code", "Is this your code?"));
    desk.targetsShown(asked, std::chrono::steady_clock::now());
    desk.answerAsParticipant(asked + 1, with("yes"), std::chrono::steady_clock::now());
    EXPECT_TRUE(waits());
}

TEST_F(Desk, WhatBothAreAskedBothHaveToAnswer) {
    ask(goOnPrompt("Go on?"));
    desk.targetsShown(asked, std::chrono::steady_clock::now());
    desk.answerAsOperator(asked, with("go-on"));
    EXPECT_TRUE(waits()) << "the operator alone";
    desk.answerAsParticipant(asked, with("go-on"), std::chrono::steady_clock::now());
    EXPECT_TRUE(answer.get());
}

TEST_F(Desk, TheParticipantCannotAnswerForTheOperator) {
    RecordProperty("hazard", "H12");
    ask(goOnPrompt("See to the electrodes.", PromptTo::Operator));
    desk.answerAsParticipant(asked, with("go-on"), std::chrono::steady_clock::now());
    EXPECT_TRUE(waits());
    desk.answerAsOperator(asked, with("go-on"));
    EXPECT_TRUE(answer.get());
}

TEST_F(Desk, WithoutAnAnswerInTimeItIsEmpty) {
    auto prompt = conditionPrompt({"rough-high", "rough-low", "smooth-high", "smooth-low"});
    prompt.within = Seconds(0.15);
    ask(prompt);
    EXPECT_TRUE(waits()) << "the time begins with the targets";
    const auto shown = std::chrono::steady_clock::now();
    desk.targetsShown(asked, shown);
    const auto said = answer.get();
    EXPECT_GE(std::chrono::steady_clock::now() - shown, 140ms);
    ASSERT_TRUE(said);
    EXPECT_FALSE(said->given);
    EXPECT_TRUE(said->keys.empty());
}

TEST_F(Desk, AStopEndsTheWaitAndGoesToTheOutputFirst) {
    RecordProperty("hazard", "H2");
    ask(goOnPrompt("Go on?"));
    EXPECT_TRUE(desk.stopBy("participant"));
    EXPECT_EQ(stops, std::vector<std::string>{"participant"});
    const auto said = answer.get();
    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().code, ErrorCode::Stopped);
    ask(goOnPrompt("Go on?", PromptTo::Operator));
    desk.answerAsOperator(asked, with("go-on"));
    EXPECT_TRUE(answer.get()) << "one stop, one question";
}

TEST_F(Desk, AStopBetweenTwoQuestionsEndsTheNextOne) {
    RecordProperty("hazard", "H2");
    EXPECT_TRUE(desk.stopBy("participant"));
    const auto said = desk.ask(goOnPrompt("Go on?"));
    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().code, ErrorCode::Stopped);
    EXPECT_TRUE(desk.stopBy("participant"));
    desk.show({});  // the session has noticed the stop and continued
    ask(goOnPrompt("Go on?", PromptTo::Operator));
    desk.answerAsOperator(asked, with("go-on"));
    EXPECT_TRUE(answer.get());
}

TEST_F(Desk, ACancelledSessionAsksNothingMore) {
    ask(goOnPrompt("Go on?"));
    desk.cancel();
    EXPECT_FALSE(answer.get());
    const auto again = desk.ask(goOnPrompt("Go on?"));
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::Stopped);
}

TEST_F(Desk, AfterTheSessionAStopLeadsNowhere) {
    RecordProperty("hazard", "H2");
    desk.leave();
    EXPECT_FALSE(desk.stopBy("participant"));
    EXPECT_TRUE(stops.empty());
    desk.begin(nullptr);
    desk.show({});  // the session asks for the next person's code
    EXPECT_FALSE(desk.stopBy("participant")) << "a stop while devices open is the program's to hear";
}

TEST_F(Desk, AScreenThatGoesEndsTheQuestion) {
    RecordProperty("hazard", "H2");
    ask(yesNoPrompt("code", "Is this your code?"));
    desk.setScreenThere(false);
    const auto said = answer.get();
    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().code, ErrorCode::Device);
}

TEST_F(Desk, NoPresentationStartsWhileSomethingIsInTheWay) {
    desk.setObstacle("the participant's window does not have the keys");
    auto hindrance = desk.hindrance();
    ASSERT_TRUE(hindrance);
    EXPECT_FALSE(hindrance->isBreak);
    EXPECT_EQ(hindrance->why, "the participant's window does not have the keys");
    desk.setObstacle({});
    EXPECT_FALSE(desk.hindrance());
    desk.setBreak(true);
    hindrance = desk.hindrance();
    ASSERT_TRUE(hindrance);
    EXPECT_TRUE(hindrance->isBreak);
    desk.setBreak(false);
    EXPECT_FALSE(desk.hindrance());
    desk.setBreak(true);
    desk.cancel();
    EXPECT_FALSE(desk.hindrance()) << "a session that is over waits for no break";
}

TEST_F(Desk, AQuestionToTheOperatorRunsOutOfTimeWithoutTheParticipantsScreen) {
    desk.setScreenThere(false);
    EXPECT_FALSE(desk.hasScreen());
    auto prompt = goOnPrompt("See to it.", PromptTo::Operator);
    prompt.within = Seconds(0.05);
    const auto said = desk.ask(prompt);
    ASSERT_TRUE(said) << said.error().message;
    EXPECT_FALSE(said->given);
}

TEST_F(Desk, TargetsDoNotAppearBeforeTheirMoment) {
    const auto clock = std::make_shared<SteadyClock>();
    desk.begin(clock);
    desk.show({});
    auto prompt = yesNoPrompt("code", "Is this your code?");
    prompt.targetsAt = clock->now() + 200ms;
    ask(prompt);
    EXPECT_GE(clock->now(), prompt.targetsAt);
}

}  // namespace
}  // namespace tacto::test
