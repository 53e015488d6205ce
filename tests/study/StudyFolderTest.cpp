// A study's folder reveals no person and no result outside the seals, and damage is found.
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/seal/SealedText.h"
#include "core/session/Ledger.h"
#include "core/study/StudyKeys.h"
#include "core/study/StudyVerify.h"
#include "tests/session/SessionSupport.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

class StudyFolder : public test::StudyDesk {
protected:
    /// Whether another process is refused; `besides` must hold there too.
    [[nodiscard]] bool refusedInAnotherProgram(const std::function<bool()>& besides) const {
        const pid_t child = ::fork();
        if (child == 0) {
            const auto second = open();
            const bool refused = !second && second.error().code == ErrorCode::Io &&
                                 second.error().message.find("is open in test_study (process") != std::string::npos;
            ::_exit(refused && besides() ? 0 : 1);
        }
        int status = -1;
        return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }
    [[nodiscard]] std::filesystem::path keyFile() const {
        for (const auto& entry : std::filesystem::directory_iterator(scratch.path() / "home" / "keys"))
            if (entry.path().extension() == ".json") return entry.path();
        return {};
    }
    static void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }
    static std::string textOf(const std::filesystem::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void flip(const std::filesystem::path& path, std::size_t at) {
        auto bytes = textOf(path);
        ASSERT_LT(at, bytes.size());
        bytes[at] = static_cast<char>(bytes[at] ^ 1);
        write(path, bytes);
    }
};

TEST_F(StudyFolder, TellsNeitherWhoNorWhatWhileASessionRunsAndAfterIt) {
    RecordProperty("hazard", "H11");
    std::string code;
    std::vector<std::string> words{test::kPassphraseText, "rough-high", "smooth-low",
                                   "too-strong",          "Kl-taker",   "3412.5",
                                   "873000000",           "talked of",  "P-7K3D"};
    auto study = make();
    Participant participant;
    participant.virtualSeed = 914'667'201;
    participant.handedness = "ambidextrous";
    participant.code = "P-7K3D";
    code = study.enrol(participant)->code;
    ASSERT_TRUE(study.consent(code, {"2", std::chrono::year(2026) / 11 / 19, "Kl-taker"}));
    words.insert(words.end(), {"914667201", "ambidextrous", "2026-11-19"});
    const auto begun = study.beginSession(test::someRequest(code)).value();
    record(begun, [&] {
        auto journal = begun.path;
        ASSERT_TRUE(std::filesystem::exists(journal += "-wal"));
        std::filesystem::copy(folder(), scratch.path() / "crashed", std::filesystem::copy_options::recursive);
    });
    ASSERT_TRUE(study.exported("/media/stick", "bids"));
    words.push_back("/media/stick");
    for (const auto& below : {folder(), scratch.path() / "crashed"}) {
        const auto all = everythingBelow(below);
        EXPECT_NE(all.find("Four conditions"), std::string::npos);  // shows that the search finds what is there
        EXPECT_NE(all.find("trial-begin"), std::string::npos);
        for (const auto& word : words) EXPECT_EQ(all.find(word), std::string::npos) << word;
    }
    // The bytes of the keys do not appear either, in binary or as text.
    const auto passphrase = test::somePassphrase();
    const auto keys =
        test::accepted(StudyKeys::open(keyFile(), study.settings().id, &passphrase, PassphraseCost::least()));
    const auto all = everythingBelow(scratch.path());
    for (const auto* key : {&keys.study(), &keys.entries().at(0).key}) {
        const auto bytes = key->bytes();
        EXPECT_EQ(all.find(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())), std::string::npos);
        EXPECT_EQ(all.find(base64Text(bytes)), std::string::npos);
    }
}

using WithStudyFolder = test::WithPerson<StudyFolder>;

TEST_F(WithStudyFolder, TheKeyFileIsItsOwnersAloneAndSealed) {
    RecordProperty("hazard", "H11");
    struct stat about {};
    ASSERT_EQ(::stat(keyFile().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777, 0600U);
    const auto text = textOf(keyFile());
    EXPECT_EQ(text.find(code), std::string::npos);
    EXPECT_EQ(text.find("limit"), std::string::npos);  // the key file does not set the cost of a guess
}

// When keys are written again, the file behind a link would keep its bytes: a withdrawal would destroy nothing.
TEST_F(StudyFolder, AKeyFileThatIsALinkIsRefused) {
    RecordProperty("hazard", "H11");
    {
        auto study = make();
        enrolled(study);
    }
    const auto place = keyFile(), elsewhere = scratch.path() / "stick.json";
    std::filesystem::rename(place, elsewhere);
    std::filesystem::create_symlink(elsewhere, place);
    const auto before = everythingBelow(scratch.path());
    for (const auto access : {Study::Access::Change, Study::Access::Read}) {
        EXPECT_THAT(open(access), test::refused(ErrorCode::NotFound, "is a link to " + elsewhere.string()));
    }
    EXPECT_EQ(everythingBelow(scratch.path()), before);
    std::filesystem::remove(place);
    std::filesystem::rename(elsewhere, place);
    EXPECT_TRUE(open());
}

TEST_F(StudyFolder, AKeyFileThatOthersMayReadOrAFolderThatTheyMayWriteIsRefused) {
    RecordProperty("hazard", "H11");
    const auto before = ::umask(0);
    {
        auto study = make();
        enrolled(study);
    }
    ::umask(before);
    const auto keys = around().keyFolder;
    for (const auto& entry : std::filesystem::directory_iterator(keys)) {
        struct stat about {};
        ASSERT_EQ(::stat(entry.path().c_str(), &about), 0);
        EXPECT_EQ(about.st_mode & 07777, 0600U) << entry.path() << " as it was written";
    }
    const auto bytes = everythingBelow(scratch.path());
    for (unsigned others = 0; others <= 077; ++others) {
        SCOPED_TRACE(others);
        for (const auto access : {Study::Access::Change, Study::Access::Read}) {
            ASSERT_EQ(::chmod(keyFile().c_str(), 0600 | others), 0);
            const auto study = open(access);
            EXPECT_EQ(study.has_value(), others == 0);
            if (!study) {
                EXPECT_EQ(study.error().code, ErrorCode::NotFound);
                EXPECT_NE(study.error().message.find("the key file "), std::string::npos) << study.error().message;
            }
        }
        ASSERT_EQ(::chmod(keyFile().c_str(), 0600), 0);
        ASSERT_EQ(::chmod(keys.c_str(), 0700 | others), 0);
        const auto study = open();
        EXPECT_EQ(study.has_value(), (others & 022U) == 0);
        if (!study) {
            EXPECT_NE(study.error().message.find("the key folder "), std::string::npos);
        }
        ASSERT_EQ(::chmod(keys.c_str(), 0700), 0);
    }
    EXPECT_TRUE(openWithoutKey()) << "nothing of it is read";
    EXPECT_EQ(everythingBelow(scratch.path()), bytes);
}

TEST_F(StudyFolder, AKeyFileOfAnEarlierVersionIsReadAndSaysHowFarTheLedgerGoesFromThenOn) {
    RecordProperty("hazard", "H8");
    std::string code, id;
    {
        auto study = make();
        code = enrolled(study);
        id = study.settings().id;
    }
    // A file of version 1: without the 80 bytes about the ledger's end, and bound to another word.
    auto json = nlohmann::json::parse(textOf(keyFile()));
    ASSERT_EQ(json["version"], 2);
    const auto salt = bytesOfBase64(json["salt"].get<std::string>()).value();
    const auto lock = test::somePassphrase().keyFor(salt, PassphraseCost::least()).value();
    const auto sealed = bytesOfBase64(json["sealed"].get<std::string>()).value();
    const auto content = openSecret(lock, id + "\nkeys with end", kTextBlock, sealed).value();
    const auto bytes = content.bytes();
    const std::span<const std::byte> parts[] = {bytes.first(kKeyBytes), bytes.subspan(kKeyBytes + 80)};
    json["version"] = 1;
    json["sealed"] = base64Text(sealBytes(lock, id + "\nkeys", kTextBlock, parts));
    write(keyFile(), json.dump());
    const auto passphrase = test::somePassphrase();
    const auto endInKeys = [&] {
        return StudyKeys::open(keyFile(), id, &passphrase, PassphraseCost::least())->ledgerEnd().row;
    };
    EXPECT_EQ(endInKeys(), 0);
    {
        const auto study = test::accepted(open());
        EXPECT_TRUE(study.find(code));
    }
    EXPECT_EQ(endInKeys(), 4);
    json["version"] = 2;  // what was sealed as version 1 does not open as version 2
    write(keyFile(), json.dump());
    EXPECT_FALSE(open());
}

TEST_F(WithStudyFolder, TheKeyFileOfBeforeAWithdrawalIsOverwritten) {
    RecordProperty("hazard", "H11");
    const auto before = textOf(keyFile()), kept = (scratch.path() / "still has a name").string();
    ASSERT_NE(before.find("sealed"), std::string::npos);
    std::filesystem::create_hard_link(keyFile(), kept);
    ASSERT_TRUE(study.withdraw(code));
    EXPECT_EQ(textOf(kept), std::string(before.size(), '\0'));
    EXPECT_NE(textOf(keyFile()), before);
}

TEST_F(StudyFolder, KeysInsideItAreRefused) {
    RecordProperty("hazard", "H11");
    auto inside = around();
    inside.keyFolder = folder() / "keys";
    EXPECT_THAT(Study::create(folder(), test::someStudy(), test::somePassphrase(), inside),
                test::refusedSaying("lies inside the study folder"));
    EXPECT_FALSE(std::filesystem::exists(folder()));
    auto made = make();
    EXPECT_EQ(made.exported(folder() / "export", "bids").error().code, ErrorCode::InvalidArgument);
}

TEST_F(StudyFolder, WhereExportsLieIsKnownWithTheKeyAlone) {
    RecordProperty("hazard", "H11");
    {
        auto study = make();
        EXPECT_TRUE(study.exports().empty());
        ASSERT_TRUE(study.exported("/media/stick", "bids"));
        ASSERT_TRUE(study.exported("/media/other", "bids"));
    }
    const auto opened = test::accepted(open());
    const auto all = opened.exports();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].place, "/media/stick");
    EXPECT_EQ(all[1].what, "bids");
    const auto sealed = test::accepted(openWithoutKey());
    EXPECT_TRUE(sealed.exports().empty());
}

TEST_F(StudyFolder, ASecondProgramIsRefusedByName) {
    RecordProperty("hazard", "H12");
    auto study = make();
    EXPECT_TRUE(refusedInAnotherProgram([&] { return openWithoutKey().has_value(); }));
}

TEST_F(StudyFolder, ASecondProgramIsRefusedAlsoWhenTheLockFileWasRemoved) {
    RecordProperty("hazard", "H12");
    auto study = make();
    ASSERT_TRUE(std::filesystem::remove(folder() / "study.lock"));
    EXPECT_TRUE(refusedInAnotherProgram([&] { return !std::filesystem::exists(folder() / "study.lock"); }));
}

TEST_F(StudyFolder, ALedgerThatWasCutShortOrIsAnOlderCopyBeginsNoSession) {
    RecordProperty("hazard", "H12");
    std::string code;
    {
        auto study = make();
        code = study.enrol({}).value().code;
        ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    }
    auto request = test::someRequest(code);
    request.devicesSimulated = false;
    const auto older = scratch.path() / "older", whole = scratch.path() / "whole", ledger = folder() / "ledger.tacto";
    std::filesystem::copy_file(ledger, older);
    auto elsewhere = around();  // a computer that knows no newer ledger
    elsewhere.keyFolder = scratch.path() / "elsewhere";
    std::filesystem::copy(around().keyFolder, elsewhere.keyFolder);
    {
        auto study = test::accepted(open());
        auto yes = request;
        yes.exclusions.front().yes = true;
        ASSERT_TRUE(study.noteExclusions(yes));
        EXPECT_NE(study.mayBegin(request).error().message.find("answered yes"), std::string::npos);
    }
    std::filesystem::copy_file(ledger, whole);
    const auto expectRefused = [&](const char* what) {
        SCOPED_TRACE(what);
        const auto study = open();
        ASSERT_TRUE(study) << "what is there can be read: " << study.error().message;
        const auto may = study->mayBegin(request);
        ASSERT_FALSE(may);
        EXPECT_EQ(may.error().code, kGateRefused);
        EXPECT_NE(may.error().message.find("row 5 of the study's ledger is not the one"), std::string::npos)
            << may.error().message;
    };
    std::filesystem::copy_file(older, ledger, std::filesystem::copy_options::overwrite_existing);
    expectRefused("an older copy");
    std::filesystem::copy_file(whole, ledger, std::filesystem::copy_options::overwrite_existing);
    test::forge(ledger, "DELETE FROM entries WHERE seq=(SELECT max(seq) FROM entries)");
    expectRefused("cut short");
    {
        std::filesystem::copy_file(older, ledger, std::filesystem::copy_options::overwrite_existing);
        const auto study = open();
        ASSERT_TRUE(study);
        const auto looked = test::accepted(Study::open(folder(), nullptr, Study::Access::Read, around()));
        EXPECT_FALSE(looked.stillApproved()) << "also for what a window shows";
    }
    for (const char* of : {"as many rows, the last another", "a row more, the one before another"}) {
        {
            const auto words = test::somePassphrase();
            auto study = test::accepted(Study::open(folder(), &words, Study::Access::Change, elsewhere));
            ASSERT_TRUE(study.exported("/media/stick", "bids"));
        }
        expectRefused(of);
    }
    std::filesystem::copy_file(whole, ledger, std::filesystem::copy_options::overwrite_existing);
    time.now += std::chrono::hours(24);
    EXPECT_TRUE(open()->mayBegin(request)) << "as it was";
}

TEST_F(StudyFolder, ASessionThatTheLedgerDoesNotKnowBeginsNoOther) {
    RecordProperty("hazard", "H12");
    std::string code;
    const auto ledger = folder() / "ledger.tacto", older = scratch.path() / "older";
    {
        auto study = make();
        code = enrolled(study);
    }
    std::filesystem::copy_file(ledger, older);
    const auto olderKeys = scratch.path() / "keys of before";
    std::filesystem::copy(around().keyFolder, olderKeys);
    {
        auto study = test::accepted(open());
        const auto begun = study.beginSession(test::someRequest(code)).value();
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    }
    // An older ledger on a computer that never wrote a newer one.
    std::filesystem::copy_file(older, ledger, std::filesystem::copy_options::overwrite_existing);
    const auto keys = around().keyFolder;
    std::filesystem::remove_all(keys);
    std::filesystem::copy(olderKeys, keys);
    const auto study = test::accepted(open());
    EXPECT_THAT(study.mayBegin(test::someRequest(code)), test::refused(kGateRefused, "is not in the ledger"));
}

TEST_F(StudyFolder, RowsThatCannotFollowInALedgerAreFound) {
    RecordProperty("hazard", "H10");
    std::string first, second, participant;
    {
        auto study = make();
        const auto begun = study.beginSession(test::someRequest(enrolled(study, 1))).value();
        first = begun.session.id;
        ASSERT_TRUE(study.endSession(first, StudySessionState::Complete, record(begun)));
        second = study.beginSession(test::someRequest(enrolled(study, 2)))->session.id;
        participant = begun.session.participant;
    }
    const auto ledger = folder() / "ledger.tacto", whole = scratch.path() / "whole";
    std::filesystem::copy_file(ledger, whole);
    const auto of = [&](const std::string& session, nlohmann::json more) {
        more["session"] = session;
        more["participant"] = participant;
        return more;
    };
    const std::tuple<const char*, nlohmann::json, const char*> rows[] = {
        {"session-part", of(second, {{"file", "../../../etc/passwd"}}), "16 hexadecimal digits"},
        {"session-part", of(second, {{"file", ""}}), "16 hexadecimal digits"},
        {"session-part", of(first, {{"file", std::string(16, 'a')}}), "a session that has ended"},
        {"session-ended", of(first, {{"state", "unfinished"}, {"file", first}}), "a session that has ended"},
        {"session-ended", of(second, {{"state", "blessed"}, {"file", second}}), "a state that this program"},
        {"session-ended", of("none", {{"state", "stopped"}}), "an unknown session"},
        {"session-begun", of(second, {{"file", second}}), "a session that is there already"},
        {"left", {{"participant", "none"}}, "an unknown participant"},
        {"blessed", of(second, {}), "nothing that this program knows"},
        {"consent", nlohmann::json::array({participant}), "an unknown participant"},
    };
    for (const auto& [name, body, says] : rows) {
        SCOPED_TRACE(fmt::format("{} {}", name, body.dump()));
        std::filesystem::copy_file(whole, ledger, std::filesystem::copy_options::overwrite_existing);
        ASSERT_TRUE(Ledger::open(ledger)->append(time.now, name, body));
        EXPECT_THAT(open(), test::refused(ErrorCode::ParseError, says));
        EXPECT_EQ(verifyStudy(folder())->status, SessionStatus::Damaged);
    }
    std::filesystem::copy_file(whole, ledger, std::filesystem::copy_options::overwrite_existing);
    ASSERT_TRUE(
        Ledger::open(ledger)->append(time.now, "session-ended", of(second, {{"state", "stopped"}, {"opened", "no"}})));
    EXPECT_TRUE(open()) << "a word of another type is none";
}

TEST_F(WithStudyFolder, ASessionThatIsALinkIsNotOneThatWasNeverMade) {
    RecordProperty("hazard", "H8");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    for (const auto& target : {begun.path.filename(), std::filesystem::path("/nowhere/session.tacto")}) {
        std::filesystem::remove(begun.path);
        std::filesystem::create_symlink(target, begun.path);
        EXPECT_THAT(study.events(begun.session), test::refused(ErrorCode::Io)) << target;
        EXPECT_FALSE(study.continueSession(begun.session.id, test::someRequest(code)));
        const auto report = test::accepted(verifyStudy(folder()));
        EXPECT_EQ(report.status, SessionStatus::Damaged);
    }
    std::filesystem::remove(begun.path);
    EXPECT_TRUE(study.events(begun.session)) << "killed before it was made";
}

TEST_F(StudyFolder, ANewerProgramsStudyIsNotOpened) {
    static_cast<void>(make());
    auto text = textOf(folder() / "study.json");
    const auto at = text.find("\"version\": 1");
    ASSERT_NE(at, std::string::npos);
    write(folder() / "study.json", text.replace(at, 12, "\"version\": 2"));
    const auto before = everythingBelow(folder());
    EXPECT_THAT(open(), test::refused(ErrorCode::Unsupported, "made by a newer Tactoscope"));
    EXPECT_EQ(verifyStudy(folder()).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(everythingBelow(folder()), before);
}

TEST_F(StudyFolder, SettingsThatWereChangedOutsideAreFound) {
    RecordProperty("hazard", "H8");
    static_cast<void>(make());
    auto text = textOf(folder() / "study.json");
    const auto at = text.find("2027-10-31");
    ASSERT_NE(at, std::string::npos);
    write(folder() / "study.json", text.replace(at, 4, "2099"));
    EXPECT_THAT(open(), test::refused(ErrorCode::ParseError));
    EXPECT_EQ(verifyStudy(folder())->status, SessionStatus::Damaged);
}

TEST_F(StudyFolder, ADamagedLedgerIsFound) {
    RecordProperty("hazard", "H8");
    {
        auto study = make();
        enrolled(study);
    }
    EXPECT_EQ(verifyStudy(folder())->status, SessionStatus::Intact);
    const auto at = textOf(folder() / "ledger.tacto").find("\"sealed\":\"");
    ASSERT_NE(at, std::string::npos);
    flip(folder() / "ledger.tacto", at + 40);
    EXPECT_THAT(open(), test::refused(ErrorCode::ParseError, "the ledger of the study in"));
    EXPECT_EQ(verifyStudy(folder())->status, SessionStatus::Damaged);
}

TEST_F(WithStudyFolder, IsVerifiedWithoutAKeyBeforeAndAfterAWithdrawal) {
    RecordProperty("hazard", "H8");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    const auto problemsOf = [&] {
        const auto report = verifyStudy(folder());
        return report ? testing::PrintToString(report->problems) : report.error().message;
    };
    EXPECT_EQ(problemsOf(), "{}");
    ASSERT_TRUE(study.withdraw(code));
    EXPECT_EQ(problemsOf(), "{}");
    EXPECT_EQ(verifyStudy(folder())->sessions.size(), 1U);
    write(folder() / "sessions" / "ffffffffffffffff.tacto", "x");
    EXPECT_NE(problemsOf().find("is not in the ledger"), std::string::npos);
    std::filesystem::remove(folder() / "sessions" / "ffffffffffffffff.tacto");
    std::filesystem::remove(begun.path);
    EXPECT_NE(problemsOf().find("is missing"), std::string::npos);
}

TEST_F(StudyFolder, ANewStudyTakesNoFolderThatHoldsSomething) {
    std::filesystem::create_directory(folder());
    write(folder() / "notes.txt", "mine");
    EXPECT_EQ(Study::create(folder(), test::someStudy(), test::somePassphrase(), around()).error().code,
              ErrorCode::Unsupported);
    EXPECT_EQ(textOf(folder() / "notes.txt"), "mine");
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "home"));
}

}  // namespace
}  // namespace tacto
