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

/// What an operator may type, right and wrong.
std::function<Result<void>(Study&)> drawnChange(const std::string& code, const std::string& session,
                                                std::mt19937& random) {
    const auto oneOf = [&random](std::initializer_list<const char*> all) {
        return std::string(*(all.begin() + std::ptrdiff_t(random() % all.size())));
    };
    switch (random() % 8) {
        case 0: {
            Participant who;
            who.age = oneOf({"", "34", "34.5", "17", "0", "121"});
            who.sex = oneOf({"", "female", "woman"});
            who.code = oneOf({"", "", "P-7K3D", "P-AAAA", code.c_str()});
            if (random() % 3 == 0) who.virtualSeed = random() % 3;
            return [who](Study& study) -> Result<void> {
                const auto made = study.enrol(who);
                return made ? Result<void>() : failure(made);
            };
        }
        case 1: {
            const Consent consent{
                oneOf({"2", "1", ""}),
                parseDate(oneOf({"2026-11-20", "2026-11-24", "2020-01-01", "never"})).value_or(CalibrationDate()),
                oneOf({"KL", ""})};
            return [=](Study& study) { return study.consent(code, consent); };
        }
        case 2: {
            const auto& kinds = studyLogKinds();
            auto note = drawnNote(kinds[random() % kinds.size()], random);
            const auto at = std::next(note.said.begin(), std::ptrdiff_t(random() % note.said.size()));
            if (random() % 2 == 0) at->second = oneOf({"", "yesterday", "2026-12-01", "unknown"});
            return [note](Study& study) { return study.note(note); };
        }
        case 3: {
            const AdverseEvent event{.what = oneOf({"fell", ""}),
                                     .severity = int(random() % 6),
                                     .relation = int(random() % 7),
                                     .onset = oneOf({"", "2026-11-20", "2026-11-25", "soon"}),
                                     .ended = oneOf({"", "2026-11-19", "2026-11-21"})};
            const auto of = oneOf({"", session.c_str(), "ffff"});
            return [=](Study& study) { return study.adverseEvent(of, event); };
        }
        case 4:
            return [said = NextDay{.erythema = int(random() % 6), .oedema = int(random() % 3)}, session](Study& study) {
                return study.nextDay(session, said);
            };
        case 5: {
            const auto reference = oneOf({"EC-2026-17", "", "A1", "A2", "A3"});
            const int most = int(random() % 8), blocks = int(random() % 25);
            return [=](Study& study) {
                auto settings = study.settings();
                settings.participantsMax = most;
                settings.blocks = blocks;
                return study.amend(settings, reference);
            };
        }
        case 6:
            return [n = random() % 3, by = oneOf({"", "KL"})](Study& study) { return study.release(n, by, "so"); };
        default:
            return [code, n = std::size_t(random() % 5000)](Study& study) {
                return study.leave(code, std::string(n, 'x'));
            };
    }
}

TEST_F(Desk, WhatIsTriedIsJudgedAsItWouldBeAndNothingIsWritten) {
    RecordProperty("hazard", "H11");
    std::mt19937 random(4);
    std::size_t accepted = 0, refused = 0;
    for (int round = 0; round < 12; ++round) {
        std::filesystem::remove_all(folder());
        auto study = make();
        const auto code = enrolled(study);
        const auto begun = test::accepted(study.beginSession(test::someRequest(code)));
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, ""));
        if (random() % 2 == 0) ASSERT_TRUE(study.adverseEvent({}, {.what = "fell", .serious = true}));
        for (int i = 0; i < 12; ++i) {
            const auto change = drawnChange(code, begun.session.id, random);
            const auto before = everythingBelow(folder()) + everythingBelow(scratch.path() / "home");
            const auto tried = study.would(change);
            EXPECT_EQ(everythingBelow(folder()) + everythingBelow(scratch.path() / "home"), before);
            const auto done = change(study);
            ASSERT_EQ(tried.has_value(), done.has_value()) << (done ? tried : done).error().message;
            if (!done) EXPECT_EQ(tried.error().message, done.error().message);
            ++(done ? accepted : refused);
        }
        // What destroys keys is tried no otherwise.
        EXPECT_TRUE(study.would([&](Study& into) { return into.withdraw(code); }));
        EXPECT_TRUE(study.find(code)) << "the key is still there";
        EXPECT_TRUE(test::accepted(open(Study::Access::Read)).find(code));
    }
    EXPECT_GT(std::min(accepted, refused), 20U);
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
