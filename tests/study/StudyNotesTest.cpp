// What a study notes beside its sessions: particulars, people not enrolled, devices, deviations, serious events; who is
// accepted, and when the next session is possible.
#include <ctime>
#include <random>
#include <regex>

#include "core/base/JsonText.h"
#include "core/study/StudyFiles.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using Desk = test::StudyDesk;

/// A note of that kind with a text in each field, drawn by `random`.
StudyNote drawnNote(const StudyLogKind& kind, std::mt19937& random) {
    StudyNote note{kind.key, {}, {}};
    for (const auto& field : kind.fields) {
        if (!field.needed && random() % 3 == 0) continue;
        auto& text = note.said[field.key];
        if (random() % 4 == 0)
            text = "unknown";
        else if (field.is == StudyLogField::Is::Words)
            text = field.words[random() % field.words.size()];
        else
            text = field.is == StudyLogField::Is::Date ? "2026-11-20"
                                                       : fmt::format("zqmarked {:x}, ünd\n\"mehr\"", random());
    }
    if (note.said.empty()) note.said[kind.fields.front().key] = "zqmarked";
    return note;
}

TEST_F(Desk, EveryKindOfNoteIsKeptAndNothingOfItIsReadableWithoutTheKey) {
    RecordProperty("hazard", "H11");
    std::mt19937 random(18);
    std::vector<StudyNote> said;
    {
        auto study = make();
        for (int i = 0; i < 30; ++i) {
            const auto& kinds = studyLogKinds();
            said.push_back(drawnNote(kinds[random() % kinds.size()], random));
            ASSERT_TRUE(study.note(said.back()));
        }
    }
    EXPECT_EQ(everythingBelow(folder()).find("zqmarked"), std::string::npos);
    EXPECT_TRUE(test::accepted(openWithoutKey()).notes().empty());
    const auto study = test::accepted(open());
    ASSERT_EQ(study.notes().size(), said.size());
    StudyNote last;
    for (std::size_t i = 0; i < said.size(); ++i) {
        EXPECT_EQ(study.notes()[i].kind, said[i].kind);
        EXPECT_EQ(study.notes()[i].said, said[i].said);
        if (said[i].kind == kParticulars)
            for (const auto& [key, text] : said[i].said) last.said[key] = text;
    }
    EXPECT_EQ(particularsOf(study.notes()).said, last.said) << "what was noted last counts";
    EXPECT_EQ(particularsOf({}).text("objectives"), "unknown");
}

TEST_F(Desk, ANoteThatCannotBeMeantIsRefusedWithItsField) {
    auto study = make();
    const auto refusedWith = [&](StudyNote note, std::string_view part) {
        EXPECT_THAT(study.note(note), test::refused(ErrorCode::InvalidArgument, part));
    };
    refusedWith({"diary", {}, {{"what", "x"}}}, "one of particulars, assessed");
    refusedWith({"deviation", {}, {}}, "what of deviation is missing");
    refusedWith({"deviation", {}, {{"what", "x"}, {"name", "y"}}}, "\"name\" is no field of deviation");
    refusedWith({"deviation", {}, {{"what", "x"}, {"day", "yesterday"}}}, "day is \"yesterday\"");
    refusedWith({"deviation", {}, {{"what", "x"}, {"day", "2026-11-24"}}}, "no later than today, 2026-11-23");
    EXPECT_EQ(study.adverseEvent({}, {.what = "x", .onset = "2026-11-24"}).error().code, ErrorCode::InvalidArgument);
    refusedWith({"assessed", {}, {{"reason", "too old"}}}, "did not meet the criteria");
    refusedWith({"particulars", {}, {{"objectives", ""}}}, "the note says nothing");
    refusedWith({"particulars", {}, {{"objectives", std::string(2001, 'x')}}}, "has 2001 bytes");
    EXPECT_TRUE(study.notes().empty());
}

TEST_F(Desk, ASeriousEventHoldsTheStudyUntilItIsReleasedByName) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto first = enrolled(study, 1), second = enrolled(study, 2);
    const auto begun = test::accepted(study.beginSession(test::someRequest(first)));
    ASSERT_TRUE(study.adverseEvent({}, {.what = "fell on the way home", .onset = "2026-11-22", .ended = "2026-11-23"}));
    EXPECT_TRUE(study.stillApproved()) << "it was not serious";
    ASSERT_TRUE(
        study.adverseEvent(begun.session.id, {.what = "burn", .serious = true, .expected = Expectedness::Unexpected}));
    for (const auto& held : {study.stillApproved(), study.mayBegin(test::someRequest(second))})
        EXPECT_THAT(held, test::refused(kGateRefused, "adverse event 2 was serious and holds the study"));
    EXPECT_FALSE(study.continueSession(begun.session.id, test::someRequest(first)));
    EXPECT_EQ(study.release(1, "KL", "").error().code, kGateRefused);
    EXPECT_EQ(study.release(3, "KL", "").error().code, ErrorCode::NotFound);
    EXPECT_EQ(study.release(2, " ", "").error().code, ErrorCode::InvalidArgument);
    EXPECT_FALSE(study.stillApproved());
    ASSERT_TRUE(study.release(2, "K. Lang", "the electrode was dry"));
    EXPECT_FALSE(study.release(2, "K. Lang", "")) << "once";
    { const auto closed = std::move(study); }
    auto again = test::accepted(open());
    EXPECT_TRUE(again.stillApproved());
    const auto events = again.adverseEvents().value();
    EXPECT_EQ(events[0].first, "");
    EXPECT_EQ(events[0].second.ended, "2026-11-23");
    EXPECT_EQ(events[1].second.releasedBy, "K. Lang");
    EXPECT_EQ(events[1].second.expected, Expectedness::Unexpected);
    EXPECT_TRUE(again.beginSession(test::someRequest(second)));
    EXPECT_EQ(again.adverseEvent({}, {.what = "x", .onset = "2026-11-22", .ended = "2026-11-21"}).error().code,
              ErrorCode::InvalidArgument);
}

TEST_F(Desk, WhyAPersonLeftIsKeptAndGoneWithTheirKey) {
    RecordProperty("hazard", "H11");
    auto study = make();
    const auto code = enrolled(study);
    ASSERT_TRUE(study.leave(code, "zqmarked moved away"));
    EXPECT_EQ(everythingBelow(folder()).find("zqmarked"), std::string::npos);
    EXPECT_EQ(study.find(code)->leftBecause, "zqmarked moved away");
    ASSERT_TRUE(study.withdraw(code));
    EXPECT_EQ(study.participants().front().leftBecause, "");
}

TEST_F(Desk, AnAgeBelowTheApprovalsIsNotEnrolled) {
    RecordProperty("hazard", "H12");
    auto settings = test::someStudy();
    settings.participantsMax = 500;
    for (const int least : {1, 18, 65}) {
        settings.ageMin = least;
        std::filesystem::remove_all(folder());
        auto study = make(settings);
        for (int age = 1; age <= 120; age += 17) {
            Participant person;
            person.age = std::to_string(age);
            EXPECT_EQ(study.enrol(person).has_value(), age >= least) << age;
        }
        EXPECT_TRUE(study.enrol({})) << "an age is stated only where it is asked for";
    }
}

TEST_F(Desk, TheLaboratorysOwnQuestionsAreAskedToo) {
    RecordProperty("hazard", "H12");
    auto settings = test::someStudy();
    ASSERT_TRUE(setStudyField(settings, "exclusions", "Do you wear a watch, today?; Are you cold?;"));
    ASSERT_EQ(settings.exclusions.size(), 2U);
    auto study = make(settings);
    auto request = test::someRequest(enrolled(study));
    EXPECT_THAT(study.mayBegin(request), test::refused(kGateRefused, "2 of the 12 questions"));
    request.exclusions = nothingExcludes(settings);
    EXPECT_TRUE(study.mayBegin(request));
    request.exclusions.back().yes = true;
    EXPECT_THAT(study.mayBegin(request), test::refused(kGateRefused, "no session today"));
    EXPECT_EQ(exclusionItems(settings).back(), (ExclusionItem{"own-2", "Are you cold?"}));
}

TEST_F(Desk, AStudyOfBeforeOpensAndItsMissingFieldsAreUnknown) {
    RecordProperty("hazard", "H8");
    auto settings = test::someStudy();
    auto study = make(settings);
    EXPECT_FALSE(study.settings().ageMin);
    EXPECT_EQ(protocolHash(settings), study.settings().approval.protocolSha256);
    auto json = parseJson(studyText(study.settings()), "study.json").value();
    for (const char* later : {"age_min", "exclusions", "pain_ceiling", "license", "words"}) json.erase(later);
    const auto old = test::accepted(parseStudy(json.dump(), "study.json"));
    EXPECT_EQ(old, study.settings());
    EXPECT_TRUE(approvalGate(old, study.today()));
    settings.ageMin = 18;
    EXPECT_NE(protocolHash(settings), study.settings().approval.protocolSha256) << "a change needs an amendment";
    EXPECT_EQ(particularsOf(study.notes()).text("skin_preparation"), "unknown");
}

/// At the moment that a refusal names the session is possible, and a minute earlier it is not.
TEST_F(Desk, ARefusedSessionSaysWhenTheNextIsPossible) {
    RecordProperty("hazard", "H12");
    std::mt19937 random(20);
    static const std::regex named(R"(possible from (\d{4})-(\d\d)-(\d\d) (\d\d):(\d\d) UTC)");
    const auto start = time.now;
    for (int i = 0; i < 6; ++i) {
        std::filesystem::remove_all(scratch.path() / "study");
        time.now = start;
        auto settings = test::someStudy();
        settings.gapMin_h = 0.1 * static_cast<double>(random() % 400);
        auto study = make(settings);
        const auto code = study.enrol({})->code;
        ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
        auto request = test::someRequest(code);
        request.devicesSimulated = false;
        time.now += std::chrono::seconds(random() % 86'400);
        const auto begun = test::accepted(study.beginSession(request));
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, record(begun)));
        if (random() % 2 == 0) {
            auto yes = request;
            yes.exclusions.front().yes = true;
            ASSERT_TRUE(study.noteExclusions(yes));
        }
        time.now += std::chrono::seconds(random() % 7200);
        const auto refused = study.mayBegin(request);
        if (refused) continue;
        std::smatch found;
        const auto& message = refused.error().message;
        ASSERT_TRUE(std::regex_search(message, found, named)) << message;
        const auto part = [&](int at) { return std::stoi(found[static_cast<std::size_t>(at)]); };
        const std::chrono::sys_seconds next = std::chrono::sys_days(std::chrono::year(part(1)) / part(2) / part(3)) +
                                              std::chrono::hours(part(4)) + std::chrono::minutes(part(5));
        time.now = next - std::chrono::minutes(1);
        EXPECT_FALSE(study.mayBegin(request)) << message;
        time.now = next;
        EXPECT_TRUE(study.mayBegin(request)) << message;
    }
}

TEST_F(Desk, WhereTheApprovalExpiresBeforeTheNextSessionItSaysSo) {
    RecordProperty("hazard", "H11");
    auto settings = test::someStudy();
    settings.approval.expires = std::chrono::year(2026) / 11 / 23;
    auto study = make(settings);
    const auto code = enrolled(study);
    const auto begun = test::accepted(study.beginSession(test::someRequest(code)));
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, record(begun)));
    EXPECT_THAT(study.mayBegin(test::someRequest(code)),
                test::refused(kGateRefused, "approval EC-2026-17 expires on 2026-11-23: an amendment is needed"));
}

}  // namespace
}  // namespace tacto
