// A session that was begun and not completed: what happens to it before the next session; and the virtual participant
// in the settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

#include "app/run/EncodingTurn.h"
#include "app/run/PilotRows.h"
#include "app/run/UnfinishedSession.h"
#include "app/run/VirtualPerson.h"
#include "core/base/Random.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionWriter.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kProtocol = "pilot-thresholds";

class UnfinishedSessionTest : public testing::Test {
protected:
    void SetUp() override {
        auto made = Study::createRehearsal(scratch_.path() / "study", settings_);
        ASSERT_TRUE(made) << made.error().message;
        study_.emplace(std::move(*made));
        Participant participant;
        participant.virtualSeed = 7;
        const auto enrolled = study_->enrol(participant).value();
        ASSERT_TRUE(study_->consent(enrolled.code, {"rehearsal", study_->today(), "AL"}));
        who_ = study_->find("virtual:7").value();
        request_.code = who_.code;
        request_.script = {kProtocol, std::string(64, 'a')};
        request_.encoding = "standard";
        request_.codeConfirmed = request_.devicesSimulated = true;
        request_.exclusions = nothingExcludes();
    }
    Result<UnfinishedSession> choose(const std::string& wanted, const std::string& protocol = kProtocol) {
        return UnfinishedSession::choose(*study_, who_, {wanted, protocol, false});
    }

    ScratchDir scratch_;
    StudySettings settings_;
    std::optional<Study> study_;
    Participant who_;
    SessionRequest request_;
    std::vector<std::string> remarks_;
};

TEST_F(UnfinishedSessionTest, AnswersLieInOneWayForAParticipantAndInEachWayEquallyOftenInTheStudy) {
    RecordProperty("hazard", "H12");
    // People and virtual participants are enrolled in random order: each kind gets each arrangement equally often.
    Random random(20, "enrolments");
    std::map<bool, std::map<std::vector<std::string>, int>> waysOf;
    std::map<bool, int> enrolled{{false, 0}, {true, 1}};
    ++waysOf[true][answersOf(*study_, who_)];
    for (std::uint64_t i = 0; i < 40; ++i) {
        Participant one;
        if (random.below(3) == 0) one.virtualSeed = 100 + i;
        const auto who = study_->enrol(one).value();
        const auto answers = answersOf(*study_, who);
        EXPECT_EQ(answers, answersOf(*study_, who));
        ASSERT_EQ(answers.size(), 4U);
        // Conditions that differ in one feature are side by side or above each other, never diagonal.
        const auto differ = [](const std::string& a, const std::string& b) {
            return int(a.starts_with("rough") != b.starts_with("rough")) +
                   int(a.ends_with("high") != b.ends_with("high"));
        };
        EXPECT_EQ(differ(answers[0], answers[1]), 1);
        EXPECT_EQ(differ(answers[0], answers[2]), 1);
        EXPECT_EQ(differ(answers[1], answers[3]), 1);
        EXPECT_EQ(differ(answers[0], answers[3]), 2);
        auto& ways = waysOf[who.isVirtual()];
        ++ways[answers];
        const int n = ++enrolled[who.isVirtual()];
        if (random.below(5) == 0) {  // the arrangement is still counted for this participant
            EXPECT_TRUE(study_->withdraw(who.code));
        }
        if (n % 8 != 0) continue;
        EXPECT_EQ(ways.size(), 8U);
        for (const auto& [each, times] : ways) EXPECT_EQ(times, n / 8);
    }
    EXPECT_GT(enrolled[false], 8);
}

TEST_F(UnfinishedSessionTest, AnswersLieAsInTheParticipantsEarlierSessionsWhateverWouldBeDrawnNow) {
    RecordProperty("hazard", "H12");
    const auto begun = study_->beginSession(request_).value();
    VirtualClock clock;
    auto writer = SessionWriter::create(begun.path, {}, clock, begun.seal).value();
    ASSERT_TRUE(writer->event(clock.now(), row::kPlan, {{"name", "plan"}, {"answers", "d,c,b,a"}}));
    ASSERT_TRUE(writer->close());
    EXPECT_THAT(answersOf(*study_, who_), ElementsAre("d", "c", "b", "a"));
}

TEST_F(UnfinishedSessionTest, WhereThereIsNoneASessionBegins) {
    const auto none = choose("").value();
    EXPECT_FALSE(none.continued());
    EXPECT_TRUE(none.sameProcedure("0123456789abcdef"));
    EXPECT_EQ(none.begin(*study_, request_, remarks_).value().session.number, 1);
    EXPECT_THAT(remarks_, IsEmpty());
}

TEST_F(UnfinishedSessionTest, ItGoesOnOnlyWhereThatIsWantedAndWithItsOwnProtocol) {
    const auto first = study_->beginSession(request_).value();
    EXPECT_EQ(choose("").error().code, ErrorCode::NotFound);
    EXPECT_THAT(choose("resume", "pilot-identification").error().message, HasSubstr("it goes on with that protocol"));
    const auto goesOn = choose("resume").value();
    ASSERT_TRUE(goesOn.continued());
    const auto part = goesOn.begin(*study_, request_, remarks_).value();
    EXPECT_EQ(part.session.id, first.session.id);
    EXPECT_EQ(part.session.parts.size(), 2U);
}

TEST_F(UnfinishedSessionTest, ItEndsOnceEveryGateLetsAnotherBegin) {
    RecordProperty("hazard", "H8");
    const auto first = study_->beginSession(request_).value();
    const auto ends = choose("end").value();
    request_.codeConfirmed = false;
    EXPECT_EQ(ends.begin(*study_, request_, remarks_).error().code, kGateRefused);
    EXPECT_EQ(study_->session(first.session.id).value().state, StudySessionState::Unfinished);
    EXPECT_THAT(remarks_, IsEmpty());
    request_.codeConfirmed = true;
    EXPECT_EQ(ends.begin(*study_, request_, remarks_).value().session.number, 2);
    EXPECT_EQ(study_->session(first.session.id).value().state, StudySessionState::Stopped);
    EXPECT_THAT(remarks_, ElementsAre("Session 1 of " + who_.code + " was ended as stopped."));
}

TEST_F(UnfinishedSessionTest, WhatWasPresentedLastIsTimedFromWhenTheWallClockWasRead) {
    RecordProperty("hazard", "H8");
    const auto begun = study_->beginSession(request_).value();
    const SteadyClock clock;
    SessionAbout about;
    about.wallStart = "2099-01-01T10:00:00Z";
    about.wallStartAt = std::chrono::seconds(10);  // opening the devices takes a while
    auto writer = SessionWriter::create(begun.path, about, clock, begun.seal).value();
    ASSERT_TRUE(writer->event(std::chrono::seconds(12), row::kAnswer, {{"name", "test 1"}}));
    ASSERT_TRUE(writer->close());
    using namespace std::chrono;
    EXPECT_EQ(pilotRows(*study_, begun.session).value().answeredAt,
              sys_days{year(2099) / 1 / 1} + hours(10) + seconds(2));
}

class EncodingTurnTest : public UnfinishedSessionTest {
protected:
    EncodingTurnTest() { settings_.encodings = {"standard", "swapped"}; }
};

TEST_F(EncodingTurnTest, TheSecondPersonHasTheEncodingsInAnotherOrder) {
    EXPECT_EQ(encodingTurn(*study_, who_, std::nullopt).encoding, "standard");
    for (std::uint64_t i = 0; i < 12; ++i) {
        Participant model;
        model.virtualSeed = 100 + i;
        // The orders stay balanced among people even if virtual participants are enrolled between them.
        EXPECT_EQ(encodingTurn(*study_, study_->enrol({}).value(), std::nullopt).encoding,
                  i % 2 == 0 ? "standard" : "swapped");
        EXPECT_EQ(encodingTurn(*study_, study_->enrol(model).value(), std::nullopt).encoding,
                  i % 2 == 0 ? "swapped" : "standard");
    }
}

TEST_F(EncodingTurnTest, ASessionThatGoesOnKeepsItsEncoding) {
    StudySession begun;
    begun.encoding = "swapped";
    EXPECT_EQ(encodingTurn(*study_, who_, begun).encoding, "swapped");
}

TEST(VirtualPerson, IsNamedByAWholeNumber) {
    EXPECT_EQ(virtualSeed("virtual:7").value(), 7U);
    EXPECT_EQ(virtualSeed("P-7K3D").value(), std::nullopt);
    for (const auto* wrong : {"virtual:", "virtual:-1", "virtual:7a", "virtual:18446744073709551616"})
        EXPECT_EQ(virtualSeed(wrong).error().code, ErrorCode::NotFound) << wrong;
}

TEST(VirtualPerson, AnswersNoToEachItemButTheOneNamed) {
    const auto key = std::string(exclusionItems().front().key);
    EXPECT_TRUE(exclusionGate(virtualAnswers(nlohmann::json::object()).value()));
    EXPECT_FALSE(exclusionGate(virtualAnswers({{"exclusions", key}}).value()));
    EXPECT_THAT(virtualAnswers({{"exclusions", "left-handed"}}).error().message, HasSubstr(key));
}

}  // namespace
}  // namespace tacto::test
