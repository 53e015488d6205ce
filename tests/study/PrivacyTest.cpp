// Texts about a person, typed in any place that takes a text, are always sealed in the study's folder: in the ledger,
// in session files and in the logs next to them, while these are open and afterwards.
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

class Privacy : public test::StudyDesk {
protected:
    void expectNothingSaid(const char* when) const {
        const auto all = everythingBelow(scratch.path());
        EXPECT_GT(all.size(), 10'000U);
        for (const char* secret :
             {"Muster", "1987", "female", "ambidextrous", "faint", "Klara", "Lot of", "rough-high", "P-7K3D", "P7K3D"})
            EXPECT_EQ(all.find(secret), std::string::npos) << "\"" << secret << "\" is to be read " << when;
    }
};

TEST_F(Privacy, NoTextAboutAPersonIsToBeReadInAnyFile) {
    RecordProperty("hazard", "H11");
    auto study = make();
    Participant named;
    named.code = "P-7K3D";
    named.age = "57";
    named.sex = "female";
    named.handedness = "ambidextrous";
    const auto enrolledAs = study.enrol(named);
    ASSERT_TRUE(enrolledAs) << enrolledAs.error().message;
    ASSERT_TRUE(study.consent("P-7K3D", {"2", study.today(), "Klara Muster"}));
    expectNothingSaid("once enrolled");

    auto request = test::someRequest("P-7K3D");
    request.devicesSimulated = false;
    const auto begun = test::accepted(study.beginSession(request));
    VirtualClock clock;
    SessionAbout about;
    about.protocol = "pilot-identification";
    about.parameters = {{"participant", "P-7K3D"}, {"note", "Ms Muster, born 1987"}};
    about.mode = "person";
    about.wallStart = "2026-11-23T12:00:00Z";
    auto writer = test::accepted(SessionWriter::create(begun.path, about, clock, begun.seal));
    auto& session = *writer;
    for (const char* kind : {"note", kOperatorMarkEvent, "adverse-event", "rating", "side-effect", "operator-stop",
                             "gate", "skin", "session-end", "of a kind that is not known"}) {
        ASSERT_TRUE(session.event(clock.now(), kind,
                                  {{"text", "Ms Muster was faint"}, {"why", "born 1987"}, {"said", "Lot of Klara"}}));
    }
    ASSERT_TRUE(session.log(clock.now(), "info", "Ms Muster, born 1987"));
    ASSERT_TRUE(session.trial(clock.now(), "rough-high", {{"note", "Ms Muster"}}));
    ASSERT_TRUE(session.reportItem(clock.now(), {{"kind", "notes"}, {"note", "Ms Muster"}}));
    ASSERT_TRUE(session.verdict(clock.now(), "rough-high", "none", {"Ms Muster"}, {}));
    ASSERT_TRUE(session.measurement(clock.now(), "impedance of Ms Muster", {{"ohm", 3412.5}}));
    ASSERT_TRUE(session.flush());
    expectNothingSaid("while the session is open");
    ASSERT_TRUE(session.close());
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, session.chainHead()));
    ASSERT_TRUE(
        study.adverseEvent(begun.session.id, {.what = "Ms Muster was faint", .action = "Klara sat beside her"}));
    ASSERT_TRUE(study.exported(scratch.path() / "exports" / "Muster 1987", "bids"));
    ASSERT_TRUE(study.leave("P-7K3D"));
    expectNothingSaid("afterwards");

    const auto rows = test::accepted(study.events(study.sessions()[0]));
    EXPECT_EQ(rows.front().body["text"], "Ms Muster was faint") << "with the key it is read";
}

}  // namespace
}  // namespace tacto
