// Breaks, pauses, a lost screen, electrodes seated again, an abort: each switches the output off and writes a row, and
// the output is armed again before the session goes on.
#include <thread>

#include "core/pilot/PilotCare.h"
#include "tests/pilot/StageFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::SizeIs;

class PilotOutputTest : public PilotStageTest {
protected:
    /// Runs a session in which 0.5 and 1 mA were accepted.
    void reachOne() {
        someone_.letsGo = true;
        someone_.holds = false;
        ASSERT_NO_FATAL_FAILURE(acceptOne());
        stage_->onSeatedAgain([this]() -> Result<void> {
            ++measured_;
            EXPECT_EQ(state(), InterlockState::Disarmed);
            return {};
        });
        someone_.asked.clear();
    }
    /// Calls `happens` the first time that trains may come.
    void atFirstFeel(std::function<void()> happens) {
        someone_.onShow = [this, happens = std::move(happens), done = false]() mutable {
            if (someone_.shown.back().state != ScreenState::Feel || std::exchange(done, true)) return;
            happens();
        };
    }
    void loseScreen() {
        atFirstFeel([this] {
            someone_.there = false;
            someone_.press("the participant's screen went");
        });
    }
    int measured_ = 0;
};

TEST_F(PilotOutputTest, ALostScreenIsAPauseAfterWhichTheLevelsAreReachedAgainWhileTheyHold) {
    RecordProperty("hazard", "H2");
    RecordProperty("hazard", "H6");
    reachOne();
    loseScreen();
    someone_.onAsk = [this](const PilotPrompt& prompt) {
        if (prompt.name != kScreenPrompt) return;
        EXPECT_EQ(state(), InterlockState::Disarmed);
        EXPECT_EQ(prompt.to, PromptTo::Operator);
        someone_.there = true;
    };
    const auto answer = accepted(stage_->trial(rising(1.5)));
    EXPECT_EQ(answer.response, "nothing") << "it is not a stop of the participant's";
    EXPECT_EQ(record_->count(row::kPause), 1U);
    EXPECT_EQ(record_->count(row::kContinue), 1U);
    EXPECT_EQ(record_->count(row::kParticipantStop) + record_->count(row::kFault), 0U);
    EXPECT_EQ(measured_, 1) << "who fetched the cable may have moved";
    EXPECT_THAT(answered(), ElementsAre("ascending 0.5", "ascending 1", "ramp 0 0.5", "ramp 0 1", "ascending 1.5"));
    EXPECT_THAT(someone_.asked,
                ElementsAre("screen-gone", "go-on", "hold", "strength", "strength", "hold", "strength"));
}

TEST_F(PilotOutputTest, AScreenThatIsStillGoneIsAskedForAgain) {
    RecordProperty("hazard", "H2");
    loseScreen();
    int asked = 0;
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name == kScreenPrompt) someone_.there = ++asked == 3;
    };
    ASSERT_TRUE(stage_->trial(trial()));
    EXPECT_EQ(asked, 3);
    EXPECT_EQ(record_->count(row::kPause), 1U);
}

TEST_F(PilotOutputTest, AScreenThatDoesNotComeBackBreaksTheSessionOff) {
    RecordProperty("hazard", "H2");
    loseScreen();
    someone_.silent = {kScreenPrompt};
    EXPECT_THAT(stage_->trial(trial()), test::refusedSaying("gone for 10 min"));
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished) << "it may be resumed";
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(PilotOutputTest, InTheOperatorsBreakTheOutputIsOffUntilTheParticipantGoesOn) {
    RecordProperty("hazard", "H2");
    reachOne();
    ASSERT_NE(state(), InterlockState::Disarmed);
    const auto before = bench_->telemetry().trainsDelivered;
    int looks = 0;
    someone_.onHindrance = [&]() -> std::optional<Hindrance> {
        if (looks++ > 20) return {};
        if (looks > 1) {
            EXPECT_EQ(state(), InterlockState::Disarmed);
        }
        return Hindrance{true, "a break"};
    };
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name != "go-on") return;
        EXPECT_EQ(prompt.to, PromptTo::Participant) << "the operator ended it: they press too";
        EXPECT_EQ(state(), InterlockState::Disarmed);
        EXPECT_EQ(bench_->telemetry().trainsDelivered, before);
    };
    ASSERT_TRUE(stage_->trial(trial("test 1", 1)));
    EXPECT_THAT(someone_.asked, ElementsAre("go-on", "strength"));
    EXPECT_THAT(bodies(row::kBreakBegin), SizeIs(1));
    EXPECT_THAT(bodies(row::kBreakEnd), SizeIs(1));
    EXPECT_EQ(bodies(row::kBreakBegin)[0]["by"], "operator");
    EXPECT_EQ(measured_, 1) << "the impedance, before it is armed again";
}

TEST_F(PilotOutputTest, AStopInTheOperatorsBreakIsARowAndTheBreakGoesOn) {
    RecordProperty("hazard", "H2");
    int looks = 0;
    someone_.onHindrance = [&]() -> std::optional<Hindrance> {
        if (looks == 5) someone_.press("participant");
        return looks++ > 20 ? std::nullopt : std::optional(Hindrance{true, "a break"});
    };
    ASSERT_TRUE(stage_->trial(trial()));
    EXPECT_EQ(record_->count(row::kParticipantStop), 1U);
    EXPECT_THAT(someone_.asked, ElementsAre("go-on", "strength"));
    EXPECT_THAT(bodies(row::kBreakBegin), SizeIs(1));
    EXPECT_GT(looks, 20);
}

TEST_F(PilotOutputTest, WithoutTheKeysNothingIsPresentedAndSoonTheOutputIsOff) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(stage_->ready());
    std::vector<std::pair<double, InterlockState>> seen;
    const double begun_s = toSeconds(clock_->now());
    someone_.onHindrance = [&]() -> std::optional<Hindrance> {
        seen.emplace_back(toSeconds(clock_->now()) - begun_s, state());
        return seen.size() > 200 ? std::nullopt : std::optional(Hindrance{false, "the keys are elsewhere"});
    };
    ASSERT_TRUE(stage_->trial(trial()));
    EXPECT_GT(toSeconds(clock_->now()) - begun_s, 19.9);
    const auto lost = bodies(row::kFocusLost);
    ASSERT_THAT(lost, SizeIs(1)) << "one row, however long";
    EXPECT_EQ(lost[0]["why"], "the keys are elsewhere");
    EXPECT_EQ(bodies(row::kTrialBegin).size(), 1U) << "nothing was begun meanwhile";
    bool whileArmed = false, whileOff = false;
    for (const auto& [at_s, was] : seen) {
        if (at_s < 9) whileArmed = whileArmed || was == InterlockState::Armed;
        if (at_s > 11 && at_s < 19) {
            EXPECT_EQ(was, InterlockState::Disarmed) << at_s;
            whileOff = true;
        }
    }
    EXPECT_TRUE(whileArmed) << "a moment elsewhere costs no arming";
    EXPECT_TRUE(whileOff);
}

TEST_F(PilotOutputTest, ABreakNowSwitchesOffAtOnceAndTheTrialIsRepeatedAfterIt) {
    RecordProperty("hazard", "H2");
    int looks = 0;
    bool wanted = false;
    atFirstFeel([&] {
        wanted = true;
        someone_.press(kOperatorPauses);
        EXPECT_EQ(state(), InterlockState::Disarmed);
    });
    someone_.onHindrance = [&]() -> std::optional<Hindrance> {
        if (!wanted || looks++ > 20) return {};
        EXPECT_EQ(state(), InterlockState::Disarmed);
        return Hindrance{true, "break now"};
    };
    const auto answer = accepted(stage_->trial(trial()));
    EXPECT_EQ(answer.attempt, 2U) << "what was paused is void";
    EXPECT_EQ(record_->count(row::kPause), 1U);
    EXPECT_THAT(bodies(row::kBreakEnd), SizeIs(1));
    EXPECT_EQ(record_->count(row::kParticipantStop) + record_->count(row::kOperatorStop), 0U);
    EXPECT_THAT(someone_.asked, ElementsAre("go-on", "strength"));
}

TEST_F(PilotOutputTest, ABenchThatIsPausedIsWaitedForAndTheTrialIsRepeatedHoweverOften) {
    RecordProperty("hazard", "H2");
    reachOne();
    constexpr int kPauses = 6;  // more than may be late in a row
    int paused = 0;
    std::jthread resumes;
    someone_.onShow = [&] {
        const auto& screen = someone_.shown.back();
        if (screen.text.starts_with("Paused")) {
            EXPECT_EQ(state(), InterlockState::Disarmed);
        }
        if (screen.state != ScreenState::Feel || paused == kPauses) return;
        ++paused;
        bench_->pause();
        resumes = std::jthread([this] {  // resumes during the presentation, or in the pause that the stage makes
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            bench_->resume();
        });
    };
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name != "go-on") return;
        EXPECT_FALSE(bench_->telemetry().paused) << "they are asked once it is over";
    };
    const auto answer = accepted(stage_->trial(trial("test 1", 1)));
    EXPECT_EQ(answer.attempt, 1U + kPauses);
    EXPECT_EQ(record_->count(row::kPause), std::size_t(kPauses));
    EXPECT_EQ(record_->count(row::kContinue), std::size_t(kPauses));
    EXPECT_EQ(measured_, kPauses) << "the impedance, before it is armed again";
}

TEST_F(PilotOutputTest, AStopInAPauseIsARowAndThePauseGoesOn) {
    RecordProperty("hazard", "H2");
    reachOne();
    bool paused = false, pressed = false;
    std::jthread acts;
    someone_.onShow = [&] {
        const auto& screen = someone_.shown.back();
        if (screen.state == ScreenState::Feel && !std::exchange(paused, true)) bench_->pause();
        if (!screen.text.starts_with("Paused")) return;
        const bool first = !std::exchange(pressed, true);
        acts = std::jthread([this, first] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            if (first)
                someone_.stop("participant");
            else
                bench_->resume();
        });
    };
    accepted(stage_->trial(trial()));
    EXPECT_TRUE(pressed);
    EXPECT_EQ(record_->count(row::kParticipantStop), 1U);
    EXPECT_EQ(record_->count(row::kPause), 1U);
    EXPECT_THAT(someone_.asked, ElementsAre("go-on", "strength"));
}

TEST_F(PilotOutputTest, WithoutTheKeysWhileAQuestionWaitsTheOutputIsSoonOff) {
    RecordProperty("hazard", "H2");
    someone_.onAsk = [this](const PilotPrompt& prompt) {
        if (prompt.name != "strength") return;
        const auto elsewhere = [] { return std::optional(Hindrance{false, "the keys are elsewhere"}); };
        someone_.onHindrance = elsewhere;
        for (int looks = 0; looks < 60; ++looks) someone_.waiting();
        someone_.onHindrance = {};
        someone_.waiting();  // the participant's window had the keyboard for a moment
        someone_.onHindrance = elsewhere;
        for (int looks = 0; looks < 99; ++looks) someone_.waiting();
        EXPECT_NE(state(), InterlockState::Disarmed) << "9.9 s";
        for (int looks = 0; looks < 50; ++looks) someone_.waiting();
        EXPECT_EQ(state(), InterlockState::Disarmed) << "14.9 s";
        someone_.onHindrance = {};
    };
    ASSERT_TRUE(stage_->trial(trial()));
    ASSERT_THAT(bodies(row::kFocusLost), SizeIs(1));
    EXPECT_EQ(bodies(row::kFocusLost)[0]["why"], "the keys are elsewhere");
    someone_.onAsk = {};
    ASSERT_TRUE(stage_->trial(trial("test 2"))) << "armed anew";
}

TEST_F(PilotOutputTest, AStopAtGoOnIsNoAnswerToTheTrialThatWasInterrupted) {
    RecordProperty("hazard", "H2");
    loseScreen();
    someone_.onAsk = [this](const PilotPrompt& prompt) {
        if (prompt.name == kScreenPrompt) someone_.there = true;
    };
    someone_.stopsAtGoOn = 1;
    const auto answer = accepted(stage_->trial(rising(0.5)));
    EXPECT_EQ(record_->count(row::kParticipantStop), 1U);
    EXPECT_EQ(answer.response, "nothing") << "they did not stop what they felt";
}

TEST_F(PilotOutputTest, AStopOfARisingLevelIsItsAnswerAlsoWhereTheProgramWasKilledBeforeItWasWritten) {
    RecordProperty("hazard", "H6");
    atFirstFeel([this] { someone_.press("participant"); });
    ASSERT_EQ(stage_->trial(rising(0.5)).value().response, "stop");
    begin(rowsUntil(row::kParticipantStop));
    const auto answer = accepted(stage_->trial(rising(0.5)));
    EXPECT_EQ(answer.response, "stop");
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U) << "it is not presented once more";
}

TEST_F(PilotOutputTest, AStopWithAFaultCounts) {
    RecordProperty("hazard", "H2");
    more_ = "&fault=open@20.2s..21s";
    begin();
    ASSERT_TRUE(stage_->pass(Seconds(19)));
    operatorTakesTime();
    record_->onWritten = [this](std::size_t) {
        if (record_->count(row::kFault) == 1 && record_->count(row::kParticipantStop) == 0) {
            record_->onWritten = {};
            someone_.stop("participant");
        }
    };
    ASSERT_TRUE(stage_->trial(trial()));
    EXPECT_EQ(record_->count(row::kFault), 1U);
    EXPECT_EQ(record_->count(row::kParticipantStop), 1U);
}

TEST_F(PilotOutputTest, AFaultBeforeAKillIsOneFaultAfterIt) {
    RecordProperty("hazard", "H8");
    more_ = "&fault=open@20.2s..21s";
    begin();
    ASSERT_TRUE(stage_->pass(Seconds(19)));
    operatorTakesTime();
    ASSERT_TRUE(stage_->trial(trial()));
    ASSERT_EQ(record_->count(row::kFault), 1U);
    close();
    const auto earlier = rows();
    EXPECT_EQ(std::ranges::count(earlier, row::kFault, &SessionRow::name), 2) << "the bench's own and the session's";
    more_ = {};
    begin(earlier);
    EXPECT_EQ(record_->count(row::kFault), 1U);
    EXPECT_EQ(endedBy(*record_), "") << "it can go on";
    more_ = "&fault=open@20.2s..21s";
    begin(earlier);
    ASSERT_TRUE(stage_->pass(Seconds(19)));
    auto next = trial();
    next.name = "another";
    EXPECT_THAT(stage_->trial(next), refusedSaying("a second fault ends the session"));
}

/// Told once, in a sentence that does not say "off" if the output may still be on.
TEST_F(PilotOutputTest, OfEachFaultTheOperatorReadsWhatItLeavesOfTheOutput) {
    RecordProperty("hazard", "H2");
    for (const auto* fault : {"open", "short", "unplug", "garbage", "stuck-on"}) {
        SCOPED_TRACE(fault);
        more_ = fmt::format("&fault={}@20.2s..22s", fault);
        begin();
        someone_.texts.clear();
        ASSERT_TRUE(stage_->pass(Seconds(19)));
        operatorTakesTime();
        static_cast<void>(stage_->trial(trial()));
        const auto asked = std::ranges::find_if(someone_.texts, [](const auto& text) {
            return text.find(", then go on") != std::string::npos && text.find(" the electrodes") != std::string::npos;
        });
        ASSERT_NE(asked, someone_.texts.end());
        const bool stuck = std::string_view(fault) == "stuck-on";
        EXPECT_THAT(*asked, HasSubstr(stuck ? "he output may still be on" : "utput is off"));
        EXPECT_EQ(asked->find("utput is off") == std::string::npos, stuck) << *asked;
        EXPECT_EQ(asked->find("utput", asked->find("utput") + 1), std::string::npos) << "twice: " << *asked;
        EXPECT_THAT(*asked, Not(HasSubstr(".."))) << *asked;
    }
}

TEST_F(PilotOutputTest, AGraveFaultEndsTheSessionAndIsNotReset) {
    RecordProperty("hazard", "H2");
    more_ = "&fault=stuck-on@20.2s..22s";
    begin();
    ASSERT_TRUE(stage_->pass(Seconds(19)));
    operatorTakesTime();
    EXPECT_THAT(stage_->trial(trial()), refusedSaying("a fault of stuck on ends the session"));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_THAT(someone_.texts, ElementsAre(HasSubstr("Take the electrodes off the participant"))) << "nobody else";
    EXPECT_EQ(record_->count(row::kContinue), 0U);
    const auto fault = bench_->unitFault();
    ASSERT_TRUE(fault) << "it was reset";
    EXPECT_EQ(graveCause(fault->causes), FaultCause::StuckOn);
    ASSERT_THAT(bodies(row::kGate), SizeIs(1));
    EXPECT_EQ(bodies(row::kGate)[0][row::kEnds], true) << "killed now, the session is over all the same";
}

TEST_F(PilotOutputTest, AnotherCauseThatComesWhileTheOperatorIsAskedIsShownBeforeTheReset) {
    RecordProperty("hazard", "H2");
    more_ = "&fault=open@20.2s..21s&fault=unplug@22s..24s";
    begin();
    ASSERT_TRUE(stage_->pass(Seconds(19)));
    someone_.onAsk = [this](const PilotPrompt& prompt) {
        if (prompt.to == PromptTo::Operator) bench_->idle(Seconds(6));
    };
    accepted(stage_->trial(trial()));
    EXPECT_THAT(someone_.texts, Contains(HasSubstr("another cause of the fault came meanwhile, device fault")));
    EXPECT_EQ(record_->count(row::kFault), 1U);
}

TEST_F(PilotOutputTest, AnAbortIsAskedForItsReasonOnceTheOutputIsOff) {
    RecordProperty("hazard", "H2");
    atFirstFeel([this] { someone_.press(kOperatorAborts); });
    someone_.answers[kReasonPrompt] = "fire alarm";
    someone_.onAsk = [this](const PilotPrompt& prompt) {
        if (prompt.name != kReasonPrompt) return;
        EXPECT_EQ(state(), InterlockState::Disarmed);
        EXPECT_THAT(kinds(), Contains(row::kOperatorStop)) << "killed now, the abort is known";
        EXPECT_EQ(prompt.to, PromptTo::Operator);
    };
    EXPECT_THAT(stage_->trial(trial()), test::refused(ErrorCode::Stopped));
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished) << "resumable";
    const auto notes = bodies(row::kNote);
    ASSERT_THAT(notes, SizeIs(1));
    EXPECT_EQ(notes[0]["reason"], "fire alarm");
    EXPECT_FALSE(stage_->trial(trial("test 2"))) << "a script that goes on gets nothing";
    EXPECT_THAT(bodies(row::kNote), SizeIs(1)) << "asked once";
}

TEST_F(PilotOutputTest, AnAbortWhileAStopIsHandledIsNotForgotten) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    bool aborted = false;
    someone_.onShow = [&] {  // after the stop was recorded, before the question whether to continue
        if (someone_.shown.back().text.starts_with("Stopped.") && !std::exchange(aborted, true))
            someone_.stop(kOperatorAborts);
    };
    const auto answer = stage_->trial(trial());
    ASSERT_TRUE(aborted);
    ASSERT_FALSE(answer) << "it went on after an abort";
    EXPECT_EQ(answer.error().code, ErrorCode::Stopped);
    EXPECT_THAT(someone_.asked, testing::Not(Contains("go-on"))) << "the participant is not asked to";
    EXPECT_EQ(record_->count(row::kOperatorStop), 1U);
    EXPECT_NE(state(), InterlockState::Armed);
}

TEST_F(PilotOutputTest, AnAbortWithoutAReasonEndsAllTheSame) {
    RecordProperty("hazard", "H2");
    atFirstFeel([this] { someone_.press(kOperatorAborts); });
    someone_.silent = {kReasonPrompt};
    EXPECT_FALSE(stage_->trial(trial()));
    ASSERT_THAT(bodies(row::kNote), SizeIs(1));
    EXPECT_TRUE(bodies(row::kNote)[0]["reason"].is_null());
}

class SeatedElectrodesTest : public PilotOutputTest {
protected:
    void SetUp() override {
        PilotOutputTest::SetUp();
        someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    }
    /// After the n-th measurement of the electrodes, fits the load given for n, in ohms.
    void fitAfter(std::map<std::size_t, double> loads) {
        record_->onWritten = [this, loads = std::move(loads), done = std::size_t(0)](std::size_t) mutable {
            const auto measured = record_->count(row::kImpedance);
            if (measured == std::exchange(done, measured)) return;
            if (const auto next = loads.find(measured); next != loads.end()) fit(next->second);
        };
    }
    void fit(double ohm) {
        ASSERT_TRUE(bench_->devices().load);
        ASSERT_TRUE(bench_->devices().load->fitLoad(fmt::format("{} ohm", ohm)));
    }
    [[nodiscard]] std::vector<bool> held(const std::string& name) const {
        std::vector<bool> all;
        for (const auto& body : bodies(row::kGate))
            if (body["name"] == name) all.push_back(body["holds"].get<bool>());
        return all;
    }
};

TEST_F(SeatedElectrodesTest, TwoChecksThatDisagreeAreMadeAnewOnceTheyAreSeatedAgain) {
    RecordProperty("hazard", "H3");
    fitAfter({{1, 1300}});  // between the two measurements
    PilotCare care(*stage_);
    accepted(care.checklist());
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(4));
    EXPECT_THAT(held("part 1 impedance"), ElementsAre(false, true)) << "each seating is a row";
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished);
    EXPECT_THAT(someone_.texts, Contains(HasSubstr("a difference of at most 20 % is accepted. See to the electrodes")));
}

TEST_F(SeatedElectrodesTest, ThreeSeatingsWithoutAgreementEndTheSession) {
    RecordProperty("hazard", "H3");
    fitAfter({{1, 1300}, {2, 1000}, {3, 1300}, {4, 1000}, {5, 1300}});
    PilotCare care(*stage_);
    EXPECT_THAT(care.checklist(), test::refusedSaying("a difference of at most 20 % is accepted"));
    EXPECT_THAT(held("part 1 impedance"), ElementsAre(false, false, false));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
}

TEST_F(SeatedElectrodesTest, ThoseThatMeasureOtherwiseBeforeABlockAreSeatedAgainAndTheLevelsReachedAgain) {
    RecordProperty("hazard", "H3");
    RecordProperty("hazard", "H6");
    PilotCare care(*stage_);
    ASSERT_TRUE(care.checklist());
    ASSERT_NO_FATAL_FAILURE(acceptOne());
    fit(1400);
    fitAfter({{3, 1100}});
    accepted(care.beforeBlock(2));
    EXPECT_THAT(held("block 2 impedance"), ElementsAre(false, true));
    ASSERT_TRUE(stage_->trial(trial("test 1", 1)));
    EXPECT_THAT(answered(), IsSupersetOf({std::string("ramp 0 0.5"), std::string("ramp 0 1")}));
}

}  // namespace
}  // namespace tacto::test
