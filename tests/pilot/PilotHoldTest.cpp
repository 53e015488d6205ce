// Events that hold a session until the operator has answered by name: too strong, pain, adverse events.
#include <fstream>

#include "core/base/JsonText.h"
#include "core/pilot/PilotCare.h"
#include "core/pilot/PilotSettings.h"
#include "core/pilot/PilotThresholds.h"
#include "core/study/Study.h"
#include "tests/pilot/StageFixture.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

class PilotHoldTest : public PilotStageTest {
protected:
    /// Returns the names of the session's rows of three kinds, in order.
    [[nodiscard]] std::vector<std::string> course() const {
        std::vector<std::string> all;
        for (const auto& each : rows()) {
            if (each.name == row::kTrialBegin || each.name == row::kHold) all.push_back(each.name);
            if (each.name == row::kAnswer && textOr(each.body, "response") == row::kTooStrong)
                all.emplace_back(row::kTooStrong);
        }
        return all;
    }
};

TEST_F(PilotHoldTest, AfterTooStrongNothingIsPresentedBeforeTheOperatorHasAnsweredByName) {
    RecordProperty("hazard", "H11");
    PilotThresholds thresholds(*stage_);
    someone_.answers = {{"strength", "too-strong"}};
    int asked = 0;
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name != kHoldPrompt) return;
        EXPECT_FALSE(stage_->isArmed()) << "the output is off";
        EXPECT_EQ(prompt.to, PromptTo::Operator);
        someone_.answers[kHoldPrompt] = ++asked % 2 == 1 ? "" : "KL";  // the first answer contains no name
    };
    accepted(thresholds.ascendingLimits());
    const auto rowsInOrder = course();
    int strong = 0;
    for (std::size_t i = 0; i < rowsInOrder.size(); ++i) {
        if (rowsInOrder[i] != row::kTooStrong) continue;
        ++strong;
        ASSERT_LT(i + 1, rowsInOrder.size());
        EXPECT_EQ(rowsInOrder[i + 1], row::kHold) << "before anything else begins";
    }
    EXPECT_EQ(strong, 3) << "each series";
    EXPECT_EQ(asked, 2 * strong) << "an empty line does not answer";
    for (const auto& each : rows()) {
        if (each.name != row::kHold) continue;
        EXPECT_EQ(each.body["by"], "KL");
    }
}

TEST_F(PilotHoldTest, PainFromTheCeilingOnHoldsTheNextPresentationAndNoneBelowIt) {
    RecordProperty("hazard", "H11");
    for (int ceiling = 1; ceiling <= 10; ++ceiling) {
        for (int pain = 0; pain <= 10; ++pain) {
            SCOPED_TRACE(fmt::format("pain {} of a ceiling of {}", pain, ceiling));
            const nlohmann::json rating{{"asked", "pain"}, {"name", "rough-high pain"}, {"value", pain}};
            EXPECT_EQ(painHold(rating, ceiling).has_value(), pain >= ceiling);
            auto other = rating;
            other["asked"] = "intensity";
            EXPECT_FALSE(painHold(other, ceiling));
        }
    }
    stage_->settings().painCeiling = 7;
    PilotCare care(*stage_);
    someone_.values = {{"intensity", 10}, {"unpleasantness", 10}, {"pain", 6}};
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name == "naturalness") someone_.values["pain"] = 9;  // at the second rating
        if (prompt.name == kHoldPrompt) {
            EXPECT_FALSE(stage_->isArmed());
            EXPECT_THAT(prompt.text, testing::HasSubstr("pain 9 of 10, and the study's ceiling is 7"));
        }
    };
    accepted(care.ratings({{"rough-high", 0.5, Seconds(2)}, {"smooth-low", 0.5, Seconds(2)}}));
    EXPECT_EQ(course(), (std::vector<std::string>{row::kTrialBegin, row::kTrialBegin, row::kHold}));
}

TEST_F(PilotHoldTest, WhatNobodyAnsweredHoldsTheNextSessionBeforeItsFirstPresentation) {
    RecordProperty("hazard", "H11");
    stage_->settings().holds = {{"session 0123456789abcdef, 1 times", "In session 1 and unanswered: pain"}};
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}, {kHoldPrompt, "KL"}};
    ASSERT_TRUE(care.checklist());
    const auto first = std::ranges::find(someone_.asked, kHoldPrompt);
    ASSERT_NE(first, someone_.asked.end());
    EXPECT_EQ(std::ranges::count(someone_.asked, kHoldPrompt), 1);
    EXPECT_LT(first, std::ranges::find(someone_.asked, "stop-test")) << "before the output is on for the first time";
}

class OpenHolds : public StudyDesk {
protected:
    struct Row {
        const char* kind;
        nlohmann::json body;
    };
    /// A complete session of `code` with these rows, after the study was released by name from its serious events.
    std::string session(Study& study, const std::string& code, const std::vector<Row>& rows) {
        time.now += std::chrono::hours(24);
        const auto events = study.adverseEvents().value();
        for (std::size_t i = 0; i < events.size(); ++i)
            EXPECT_EQ(study.release(i + 1, "KL", "").has_value(),
                      events[i].second.serious && events[i].second.releasedBy.empty());
        const auto begun = study.beginSession(someRequest(code)).value();
        VirtualClock clock;
        auto writer = SessionWriter::create(begun.path, {}, clock, begun.seal).value();
        for (const auto& each : rows) EXPECT_TRUE(writer->event(clock.now(), each.kind, each.body));
        EXPECT_TRUE(writer->close());
        EXPECT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, writer->chainHead()));
        return begun.session.id;
    }
};

TEST_F(OpenHolds, AreThoseOfTheParticipantAndOfEventsUntilSomeoneHasAnswered) {
    RecordProperty("hazard", "H11");
    auto settings = someStudy();
    settings.painCeiling = 5;
    settings.sessionsMax = 20;
    auto study = make(settings);
    const auto code = enrolled(study, 1), other = enrolled(study, 2);
    const auto open = [&](const std::string& of) { return openHolds(study, study.find(of).value()); };
    const Row strong{row::kAnswer, {{"name", "ascending 4"}, {"response", row::kTooStrong}}};
    const Row pain{row::kRating, {{"name", "rough-high pain"}, {"asked", "pain"}, {"value", 5}}};
    const Row mild{row::kRating, {{"name", "rough-low pain"}, {"asked", "pain"}, {"value", 4}}};
    const auto answer = [](const std::string& name) { return Row{row::kHold, {{"name", name}, {"by", "KL"}}}; };
    session(study, code, {strong, answer(tooStrongHold("ascending 4").name), mild});
    EXPECT_TRUE(open(code).empty()) << "answered while it ran";
    session(study, code, {strong, pain});
    ASSERT_EQ(open(code).size(), 1U);
    EXPECT_TRUE(open(other).empty()) << "of another person";
    EXPECT_THAT(open(code).front().said, testing::HasSubstr("In session 2 and unanswered: "));
    session(study, code, {answer(open(code).front().name)});
    EXPECT_TRUE(open(code).empty());
    const auto id = study.sessions().front().id;
    for (const auto& [serious, reported] : {std::pair{false, true}, {true, true}, {false, false}, {true, false}}) {
        const auto before = open(other).size();
        ASSERT_TRUE(study.adverseEvent(id, {.what = "itching", .serious = serious, .reported = reported}));
        EXPECT_EQ(open(other).size(), before + (serious || !reported ? 1U : 0U)) << serious << reported;
    }
    std::vector<Row> all;
    for (const auto& each : open(other)) all.push_back(answer(each.name));
    session(study, other, all);
    EXPECT_TRUE(open(code).empty()) << "one answer is enough for all";
}

TEST_F(OpenHolds, WhatTheProgramAnsweredForAVirtualParticipantHoldsAPersonAllTheSame) {
    RecordProperty("hazard", "H11");
    auto settings = someStudy();
    settings.sessionsMax = 20;
    auto study = make(settings);
    const auto model = enrolled(study, 1), another = enrolled(study, 2);
    const auto person = study.enrol({}).value();
    session(study, model, {});
    ASSERT_TRUE(study.adverseEvent(study.sessions().front().id, {.what = "burn", .serious = true}));
    const auto open = [&](const std::string& of) { return openHolds(study, study.find(of).value()); };
    ASSERT_EQ(open(person.code).size(), 1U);
    session(study, model, {Row{row::kHold, {{"name", open(model).front().name}, {"by", "simulated"}}}});
    EXPECT_TRUE(open(another).empty());
    EXPECT_EQ(open(person.code).size(), 1U) << "no operator has answered";
}

TEST_F(OpenHolds, ARecordThatIsGoneOrDoesNotOpenHoldsTheNextSession) {
    RecordProperty("hazard", "H11");
    auto settings = someStudy();
    settings.sessionsMax = 20;
    auto study = make(settings);
    const auto code = enrolled(study, 1), other = enrolled(study, 2);
    const Row pain{row::kRating, {{"name", "rough-high pain"}, {"asked", "pain"}, {"value", 9}}};
    const auto open = [&](const std::string& of) { return openHolds(study, study.find(of).value()); };
    for (const bool gone : {false, true}) {
        time.now += std::chrono::hours(24);
        // Killed before the ledger knew the end; then the file was damaged, and the session ended as stopped.
        const auto begun = study.beginSession(someRequest(code)).value();
        VirtualClock clock;
        {
            auto writer = SessionWriter::create(begun.path, {}, clock, begun.seal).value();
            EXPECT_TRUE(writer->event(clock.now(), pain.kind, pain.body));
            EXPECT_TRUE(writer->close());
        }
        if (gone)
            std::filesystem::remove(begun.path);
        else
            std::ofstream(begun.path, std::ios::binary | std::ios::trunc) << "no record";
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, ""));
        ASSERT_EQ(open(code).size(), 1U) << gone;
        EXPECT_THAT(open(code).front().said, testing::HasSubstr("is gone or does not open"));
        EXPECT_TRUE(open(other).empty());
        session(study, code, {Row{row::kHold, {{"name", open(code).front().name}, {"by", "KL"}}}});
        EXPECT_TRUE(open(code).empty()) << "one answer is enough";
    }
}

}  // namespace
}  // namespace tacto::test
