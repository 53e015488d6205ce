// A ledger older than the newest that this computer knows accepts no change until someone goes back to it by name. The
// campaign (./dev campaign) cuts, reorders and rolls back 10 000 ledgers at every row.
#include <chrono>
#include <random>

#include "core/session/Ledger.h"
#include "core/study/LedgerEnd.h"
#include "core/study/StudyKeys.h"
#include "core/study/StudyVerify.h"
#include "tests/session/SessionSupport.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

/// A study with a person as participant, and copies of its earlier states.
class RolledBack : public test::StudyDesk {
protected:
    [[nodiscard]] fs::path keys() const { return around().keyFolder; }
    [[nodiscard]] fs::path noted() const { return keys() / (id_ + ".end"); }
    [[nodiscard]] fs::path keyFile() const { return keys() / (id_ + ".json"); }
    [[nodiscard]] SessionRequest request() const {
        auto asked = test::someRequest(code_);
        asked.devicesSimulated = false;
        return asked;
    }
    static void copyAll(const fs::path& from, const fs::path& to) {
        fs::remove_all(to);
        fs::copy(from, to, fs::copy_options::recursive);
    }
    void makeStudy() {
        auto study = make();
        id_ = study.settings().id;
        code_ = study.enrol({}).value().code;
        ASSERT_TRUE(study.consent(code_, {"2", study.today(), "KL"}));
    }
    /// Runs a whole session of the person.
    void runSession(Study& study) const {
        const auto begun = test::accepted(study.beginSession(request()));
        const auto head = record(begun);
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, head));
    }
    struct Write {
        const char* name;
        std::function<Result<void>(Study&)> run;
    };
    /// Returns all calls that append a row, with arguments that an intact study accepts.
    [[nodiscard]] std::vector<Write> writes(const Study& study) const {
        const auto drop = [](auto result) { return result ? Result<void>() : Result<void>(failure(result)); };
        const auto code = code_;
        std::string session, open;
        for (const auto& each : study.sessions())
            (each.state == StudySessionState::Unfinished ? open : session) = each.id;
        std::vector<Write> all{{"enrol", [=](Study& of) { return drop(of.enrol({})); }},
                               {"consent",
                                [=](Study& of) {
                                    return of.consent(code, {"2", of.today(), "KL"});
                                }},
                               {"leave", [=](Study& of) { return of.leave(code); }},
                               {"withdraw", [=](Study& of) { return of.withdraw(code); }},
                               {"amend", [](Study& of) { return of.amend(of.settings(), "EC-" + randomWord()); }},
                               {"exclude",
                                [this](Study& of) {
                                    auto yes = request();
                                    yes.exclusions.front().yes = true;
                                    return of.noteExclusions(yes);
                                }},
                               {"begin", [=, this](Study& of) { return drop(of.beginSession(request())); }},
                               {"note",
                                [](Study& of) {
                                    return of.note({"deviation", {}, {{"what", "a longer break"}}});
                                }},
                               {"export", [](Study& of) { return of.exported("/media/stick", "bids"); }}};
        if (!session.empty()) {
            all.push_back({"event", [=](Study& of) { return of.adverseEvent(session, {.what = "itching"}); }});
            all.push_back({"next day", [=](Study& of) { return of.nextDay(session, {}); }});
        }
        if (!open.empty()) {
            all.push_back({"continue", [=, this](Study& of) { return drop(of.continueSession(open, request())); }});
            all.push_back({"end", [=](Study& of) { return of.endSession(open, StudySessionState::Stopped, ""); }});
            all.push_back({"cancel", [=](Study& of) { return of.cancelSession(open); }});
        }
        return all;
    }
    static std::string randomWord() {
        static int count = 0;
        return std::to_string(++count);
    }
    /// Checks that each call is refused with `part` in its sentence, and changes neither the study nor its keys.
    void expectEachRefused(Study& study, std::string_view part) {
        for (const auto& write : writes(study)) {
            SCOPED_TRACE(write.name);
            const auto before = everythingBelow(folder()) + everythingBelow(keys());
            const auto done = write.run(study);
            ASSERT_FALSE(done);
            EXPECT_EQ(done.error().code, kGateRefused);
            EXPECT_NE(done.error().message.find(part), std::string::npos) << done.error().message;
            EXPECT_NE(done.error().message.find("study go-back"), std::string::npos) << done.error().message;
            EXPECT_EQ(everythingBelow(folder()) + everythingBelow(keys()), before);
        }
    }
    std::string id_, code_;
};

TEST_F(RolledBack, AnOlderCopyTakesNoChangeWhileTheTrueStudyGoesOn) {
    RecordProperty("hazard", "H11");
    makeStudy();
    const auto old = scratch.path() / "old", newest = scratch.path() / "newest";
    copyAll(folder(), old);
    {
        auto study = test::accepted(open());
        runSession(study);
    }
    copyAll(folder(), newest);
    copyAll(old, folder());
    {
        auto study = open();
        ASSERT_TRUE(study) << "it can be read: " << study.error().message;
        EXPECT_EQ(study->participants().size(), 1U);
        expectEachRefused(*study, "is not the one that was written on this computer");
    }
    copyAll(newest, folder());
    time.now += std::chrono::hours(21);
    auto study = test::accepted(open());
    EXPECT_TRUE(study.mayBegin(request())) << "the true one goes on";
}

TEST_F(RolledBack, ANoteThatIsLostIsFoundByTheKeyFileAndBySessions) {
    RecordProperty("hazard", "H8");
    makeStudy();
    const auto older = scratch.path() / "ledger of before", olderKeys = scratch.path() / "keys of before";
    fs::copy_file(folder() / "ledger.tacto", older);
    copyAll(keys(), olderKeys);
    {
        auto study = test::accepted(open());
        const auto begun = study.beginSession(request()).value();
        VirtualClock clock;
        auto writer = SessionWriter::create(begun.path, {}, clock, begun.seal).value();
        ASSERT_TRUE(writer->event(clock.now(), kLedgerEvent, {{"row", begun.ledgerRow}, {"head", begun.ledgerHead}}));
        ASSERT_TRUE(writer->close());
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, writer->chainHead()));
        ASSERT_TRUE(study.exported("/media/stick", "bids"));
    }
    const auto whole = scratch.path() / "whole";
    fs::copy_file(folder() / "ledger.tacto", whole);
    ASSERT_TRUE(fs::remove(noted()));
    {  // only the note is lost: it is written again
        ASSERT_TRUE(open()->exported("/media/stick", "bids"));
        EXPECT_TRUE(fs::exists(noted()));
        fs::remove(noted());
        fs::copy_file(whole, folder() / "ledger.tacto", fs::copy_options::overwrite_existing);
    }
    {
        auto study = test::accepted(open());
        expectEachRefused(study, "is not the one that the key file notes");
    }
    // The key file is an older copy too; the sessions' records show how far the ledger went.
    fs::remove(noted());
    fs::copy_file(olderKeys / keyFile().filename(), keyFile(), fs::copy_options::overwrite_existing);
    fs::copy_file(older, folder() / "ledger.tacto", fs::copy_options::overwrite_existing);
    {
        auto study = test::accepted(open());
        expectEachRefused(study, "is not in the ledger");
    }
    // A ledger that contains the session, but differs before it, is refused too.
    fs::copy_file(whole, folder() / "ledger.tacto", fs::copy_options::overwrite_existing);
    auto forged = test::everythingIn(folder() / "ledger.tacto");
    test::forge(folder() / "ledger.tacto", "UPDATE entries SET hash=randomblob(32) WHERE name='session-begun'");
    EXPECT_FALSE(open()) << "its chain does not hold";
}

TEST_F(RolledBack, GoingBackSaysWhatIsLostIsConfirmedByItsWordAndStaysForEver) {
    RecordProperty("hazard", "H11");
    makeStudy();
    const auto old = scratch.path() / "old", newest = scratch.path() / "newest";
    copyAll(folder(), old);
    std::string second, lostFile;
    {
        auto study = test::accepted(open());
        EXPECT_EQ(study.lossOfGoingBack().error().code, kGateRefused) << "it is the newest";
        second = study.enrol({}).value().code;
        runSession(study);
        lostFile = study.sessions().front().id + ".tacto";
        ASSERT_TRUE(study.leave(code_));
    }
    copyAll(folder(), newest);
    fs::copy_file(old / "ledger.tacto", folder() / "ledger.tacto", fs::copy_options::overwrite_existing);
    {
        auto study = test::accepted(open());
        const auto loss = test::accepted(study.lossOfGoingBack());
        EXPECT_EQ(loss.word(), "lose-4-rows");
        EXPECT_EQ(loss.rows, (std::vector<std::string>{"enrolled", "session-begun", "session-ended", "left"}));
        EXPECT_EQ(loss.enrolled, std::vector<std::string>{second});
        EXPECT_EQ(loss.files, std::vector<std::string>{lostFile});
        EXPECT_NE(loss.sentence().find("4 rows (1 enrolled, 1 left, 1 session-begun, 1 session-ended)"),
                  std::string::npos)
            << loss.sentence();
        const auto before = everythingBelow(folder()) + everythingBelow(keys());
        for (const char* word : {"", "lose-3-rows", "lose-rows", "yes"})
            EXPECT_EQ(study.goBack(word).error().code, ErrorCode::InvalidArgument) << word;
        EXPECT_EQ(everythingBelow(folder()) + everythingBelow(keys()), before);
        ASSERT_TRUE(study.goBack("lose-4-rows"));
        EXPECT_THAT(study.mayBegin(request()), test::refusedSaying("the ledger went back"))
            << "a session may have been minutes ago";
        EXPECT_TRUE(study.exported("/media/stick", "bids")) << "it is changed again";
    }
    {
        const auto study = test::accepted(openWithoutKey());
        ASSERT_EQ(study.goingsBack().size(), 1U);
        EXPECT_EQ(study.goingsBack().front().lost, 4);
        EXPECT_EQ(study.goingsBack().front().files, std::vector<std::string>{lostFile});
        const auto report = test::accepted(verifyStudy(folder()));
        EXPECT_EQ(testing::PrintToString(report.problems), "{}");
        EXPECT_NE(testing::PrintToString(report.notes).find("went back"), std::string::npos);
    }
    time.now += std::chrono::hours(20);
    EXPECT_TRUE(open()->mayBegin(request()));
    copyAll(newest, folder());
    auto study = test::accepted(open());
    expectEachRefused(study, "is not the one that was written on this computer");
}

TEST_F(RolledBack, CopiesOfAStudyAreNotChangedAtOnce) {
    RecordProperty("hazard", "H8");
    makeStudy();
    copyAll(folder(), scratch.path() / "old");
    const auto study = open();
    ASSERT_TRUE(study) << study.error().message;
    const auto words = test::somePassphrase();
    EXPECT_THAT(Study::open(scratch.path() / "old", &words, Study::Access::Change, around()),
                test::refusedSaying("a copy of the study"));
    EXPECT_TRUE(Study::open(scratch.path() / "old", &words, Study::Access::Read, around()));
}

/// Rows appended by a program that has the folder but not the key; the chain is computed again, so it is valid.
class ForgedRows : public RolledBack {
protected:
    [[nodiscard]] fs::path ledgerFile() const { return folder() / "ledger.tacto"; }
    void append(const char* name, const nlohmann::json& body) const {
        auto forged = test::accepted(Ledger::open(ledgerFile()));
        ASSERT_TRUE(forged.append(time.now, name, body));
    }
    [[nodiscard]] std::vector<SessionRow> rows() const { return SessionReader::open(ledgerFile())->events().value(); }
    /// Makes a study with one session that ended and one unfinished session.
    void makeWithSessions() {
        makeStudy();
        auto study = open().value();
        runSession(study);
        time.now += std::chrono::hours(30);
        unfinished_ = study.beginSession(request()).value().session;
        participant_ = study.participants().front().id;
    }
    /// Returns all rows that can be written without a key.
    [[nodiscard]] std::vector<std::pair<const char*, nlohmann::json>> forgeries() const {
        auto amended = rows().front().body;
        amended.erase("mac");
        amended["reference"] = amended["settings"]["approval"]["reference"] = "EC-9";
        amended["settings"]["approval"]["expires"] = "2040-01-01";
        return {{"withdrawn", {{"participant", participant_}, {"sessions", 1}, {"virtual", false}}},
                {"left", {{"participant", participant_}, {"sessions", 1}}},
                {"amendment", amended},
                {"session-ended",
                 {{"session", unfinished_.id},
                  {"participant", participant_},
                  {"state", "complete"},
                  {"file", unfinished_.id},
                  {"head", ""}}},
                {"session-part",
                 {{"session", unfinished_.id},
                  {"file", std::string(16, 'a')},
                  {"participant", participant_},
                  {"after", unfinished_.id},
                  {"head", ""}}},
                {"went-back", {{"row", 9}, {"lost", 1}, {"rows", {"left"}}, {"files", {"a.tacto"}}}}};
    }
    /// Makes a ledger from before rows had a "mac": the same rows, with notes of its end that match.
    void makeOld() {
        auto old = rows();
        const auto about = SessionReader::open(ledgerFile())->about();
        for (const char* part : {"", "-wal", "-shm"}) fs::remove(ledgerFile().string() + part);
        const auto seconds = [](Instant at) {
            return std::chrono::sys_seconds(std::chrono::floor<std::chrono::seconds>(at));
        };
        auto made = Ledger::create(ledgerFile(), about, seconds(old.front().at)).value();
        for (auto& row : old) {
            row.body.erase("mac");
            ASSERT_TRUE(made.append(seconds(row.at), row.name, row.body));
        }
        const LedgerEnd end{made.next() - 1, made.head(), time.now, {}};
        const auto words = test::somePassphrase();
        ASSERT_TRUE(StudyKeys::open(keyFile(), id_, &words, PassphraseCost::least())->noteEnd(end));
        noteLedgerEnd(noted(), end);
    }
    StudySession unfinished_;
    std::string participant_;
};

TEST_F(ForgedRows, AreTakenAsNothingAndDestroyNoKeyWhoeverRecomputesTheChain) {
    RecordProperty("hazard", "H11");
    for (const bool old : {false, true}) {
        fs::remove_all(folder());
        fs::remove_all(scratch.path() / "home");
        makeWithSessions();
        if (old) makeOld();
        if (HasFatalFailure()) return;
        const auto kept = scratch.path() / "kept", keptKeys = scratch.path() / "kept keys";
        copyAll(folder(), kept);
        copyAll(keys(), keptKeys);
        for (const auto& [name, body] : forgeries()) {
            SCOPED_TRACE(fmt::format("{}{}", name, old ? ", in a ledger of before" : ""));
            for (const bool withMac : {false, true}) {
                copyAll(kept, folder());
                auto written = body;
                if (withMac) written["mac"] = std::string(64, 'a');
                append(name, written);
                {
                    auto study = open();
                    if (withMac) {
                        ASSERT_FALSE(study);
                        EXPECT_NE(study.error().message.find("was not written with the study's key"), std::string::npos)
                            << study.error().message;
                    } else {
                        ASSERT_TRUE(study) << study.error().message;
                        expectEachRefused(*study, fmt::format("({}) of the study's ledger was not written with the "
                                                              "study's key",
                                                              name));
                    }
                }
                EXPECT_EQ(everythingBelow(keys()), everythingBelow(keptKeys)) << "no key was touched";
            }
        }
        copyAll(kept, folder());
        auto study = open();
        ASSERT_TRUE(study) << study.error().message;
        EXPECT_EQ(study->participants().front().code, code_) << "their records open as before";
        EXPECT_TRUE(study->exported("/media/stick", "bids"));
        EXPECT_TRUE(study->withdraw(code_)) << "and what the program writes itself is taken";
        study = tl::unexpected(Error{});
        study = open();
        ASSERT_TRUE(study) << study.error().message;
        EXPECT_TRUE(study->enrol({}));
    }
}

TEST_F(ForgedRows, ARowThatWasCopiedFromElsewhereInTheLedgerIsFound) {
    RecordProperty("hazard", "H11");
    makeWithSessions();
    const auto all = rows();
    const auto kept = scratch.path() / "kept";
    copyAll(folder(), kept);
    for (const auto& row : all) {
        if (!row.body.contains("mac")) continue;
        copyAll(kept, folder());
        append(row.name.c_str(), row.body);
        EXPECT_THAT(open(), test::refused(ErrorCode::ParseError)) << row.name;
    }
}

TEST_F(ForgedRows, AreTakenOverByTheirWordAlone) {
    RecordProperty("hazard", "H11");
    makeWithSessions();
    append("withdrawn", forgeries().front().second);
    {
        auto study = open();
        ASSERT_TRUE(study) << study.error().message;
        const auto loss = test::accepted(study->lossOfGoingBack());
        EXPECT_EQ(loss.word(), "take-1-rows");
        EXPECT_EQ(loss.unsealed, std::vector<std::string>{"withdrawn"});
        EXPECT_EQ(loss.withdrawn, 1);
        for (const char* part :
             {"Lost with it: nothing; taken over: 1 row not written with the study's key (1 withdrawn)",
              "the keys of 1 participants who withdrew by this ledger"})
            EXPECT_NE(loss.sentence().find(part), std::string::npos) << loss.sentence();
        EXPECT_EQ(study->goBack("lose-rows").error().code, ErrorCode::InvalidArgument);
        ASSERT_TRUE(study->goBack("take-1-rows"));
        EXPECT_TRUE(study->enrol({})) << "it is changed again";
    }
    const auto study = test::accepted(open());
    ASSERT_EQ(study.goingsBack().size(), 1U);
    EXPECT_NE(goingBackText(study.goingsBack().front()).find("taken over: 1 row"), std::string::npos);
    EXPECT_EQ(study.participants().front().state, ParticipantState::Withdrawn);
}

/// Returns the rows of a ledger as another program reads them; the test compares with these.
std::vector<std::string> rawRows(const fs::path& path) {
    sqlite3* database = nullptr;
    std::vector<std::string> all;
    EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    sqlite3_stmt* rows = nullptr;
    EXPECT_EQ(
        sqlite3_prepare_v2(database, "SELECT seq, t_ns, name, body FROM entries ORDER BY seq", -1, &rows, nullptr),
        SQLITE_OK);
    while (sqlite3_step(rows) == SQLITE_ROW) {
        std::string row;
        for (int c = 0; c < 4; ++c)
            row += reinterpret_cast<const char*>(sqlite3_column_text(rows, c)) + std::string("|");
        all.push_back(std::move(row));
    }
    sqlite3_finalize(rows);
    sqlite3_close(database);
    return all;
}

/// Whether `rows` begins with `newest`.
bool holds(const std::vector<std::string>& rows, const std::vector<std::string>& newest) {
    return rows.size() >= newest.size() && std::equal(newest.begin(), newest.end(), rows.begin());
}

class CutLedgers : public RolledBack {
protected:
    /// Writes rows of every kind; keeps a copy of the ledger and the keys after each row.
    void build(std::mt19937& random) {
        fs::remove_all(scratch.path() / "home");
        fs::remove_all(folder());
        copies_.clear();
        fs::remove_all(scratch.path() / "copies");
        fs::create_directories(scratch.path() / "copies");
        makeStudy();
        const auto keep = [&] {
            const auto place = scratch.path() / "copies" / std::to_string(copies_.size());
            fs::create_directory(place);
            fs::copy_file(folder() / "ledger.tacto", place / "ledger.tacto");
            fs::copy(keys(), place / "keys");
            copies_.push_back(place);
        };
        keep();
        const int rows = 3 + static_cast<int>(random() % 10);
        for (int i = 0; i < rows; ++i) {
            time.now += std::chrono::hours(random() % 30);
            {
                auto study = open().value();
                const auto all = writes(study);
                const auto& write = all[random() % all.size()];
                const std::string_view name = write.name;
                if (name == "leave" || name == "withdraw") continue;  // later calls for them would all be refused
                if (!write.run(study)) continue;
            }
            keep();
        }
        newest_ = rawRows(folder() / "ledger.tacto");
    }
    void breakLedger(std::mt19937& random) {
        const auto ledger = folder() / "ledger.tacto";
        const auto row = [&] { return std::to_string(1 + random() % newest_.size()); };
        switch (random() % 6) {
            case 0:
                test::forge(ledger, "DELETE FROM entries WHERE seq > " + row());
                break;
            case 1: {
                const auto one = row(), other = row();
                test::forge(ledger, "UPDATE entries SET seq=-1 WHERE seq=" + one + "; UPDATE entries SET seq=" + one +
                                        " WHERE seq=" + other + "; UPDATE entries SET seq=" + other + " WHERE seq=-1");
                break;
            }
            case 2:
                test::forge(ledger, "DELETE FROM entries WHERE seq=" + row());
                break;
            case 3:
                recompute(random);
                break;
            default: {
                const auto& older = copies_[random() % copies_.size()];
                fs::copy_file(older / "ledger.tacto", ledger, fs::copy_options::overwrite_existing);
            }
        }
    }

    /// Rewrites the ledger with a valid chain and the same rows, but leaves one out or exchanges two.
    void recompute(std::mt19937& random) const {
        const auto ledger = folder() / "ledger.tacto";
        auto reader = SessionReader::open(ledger);
        ASSERT_TRUE(reader) << reader.error().message;
        auto rows = reader->events().value();
        const auto about = reader->about();
        reader = tl::unexpected(Error{});
        const auto at = random() % rows.size(), other = random() % rows.size();
        if (random() % 2 == 0)
            rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(at));
        else
            std::swap(rows[at], rows[other]);
        for (const char* part : {"", "-wal", "-shm"}) fs::remove(ledger.string() + part);
        const auto seconds = [](Instant when) {
            return std::chrono::sys_seconds(std::chrono::floor<std::chrono::seconds>(when));
        };
        auto made = test::accepted(Ledger::create(ledger, about, seconds(rows.front().at)));
        for (const auto& row : rows) EXPECT_TRUE(made.append(seconds(row.at), row.name, row.body));
    }

    std::vector<fs::path> copies_;
    std::vector<std::string> newest_;
};

TEST_F(CutLedgers, TakeNoRowUnlessTheyHoldEveryRowThatIsKnown) {
    RecordProperty("hazard", "H11");
    const int count = test::trials<int>({.local = 120, .ci = 1000, .campaign = 10'000});
    constexpr int kPerStudy = 40;
    std::mt19937 random(4711);
    int unreadable = 0, refused = 0, accepted = 0;
    for (int i = 0; i < count; ++i) {
        if (i % kPerStudy == 0) build(random);
        if (HasFatalFailure()) return;
        SCOPED_TRACE(fmt::format("ledger {}", i));
        const auto now = time.now;
        copyAll(folder(), scratch.path() / "kept");
        copyAll(keys(), scratch.path() / "kept keys");
        breakLedger(random);
        const bool noteLost = random() % 3 == 0;
        if (noteLost) fs::remove(noted());
        const auto rows = rawRows(folder() / "ledger.tacto");
        const bool isNewest = holds(rows, newest_);
        const auto before = everythingBelow(folder() / "sessions");
        auto study = open();
        if (!study) {
            ++unreadable;
            EXPECT_FALSE(isNewest) << study.error().message;
        } else {
            const auto all = writes(*study);
            for (int tries = 0; tries < 3; ++tries) {
                const auto& write = all[random() % all.size()];
                const auto done = write.run(*study);
                const auto after = rawRows(folder() / "ledger.tacto");
                if (!isNewest) {
                    EXPECT_FALSE(done) << write.name;
                    EXPECT_EQ(after, rows) << write.name;
                    EXPECT_EQ(everythingBelow(folder() / "sessions"), before);
                }
                done ? ++accepted : ++refused;
                EXPECT_EQ(done.has_value(), after.size() > rows.size()) << write.name;
                if (done) break;
            }
        }
        study = tl::unexpected(Error{});
        copyAll(scratch.path() / "kept", folder());
        copyAll(scratch.path() / "kept keys", keys());
        time.now = now;
    }
    EXPECT_GT(unreadable, count / 8);
    EXPECT_GT(refused, count / 8);
    EXPECT_GT(accepted, 0) << "some were the newest, and took a row";
}

}  // namespace
}  // namespace tacto
