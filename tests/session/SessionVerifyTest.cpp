#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <thread>

#include "core/session/Database.h"
#include "core/session/Digest.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using test::ScratchDir;

class SessionVerify : public testing::Test {
protected:
    void SetUp() override {
        RecordProperty("hazard", "H8");
        test::writeSession(path_);
    }
    [[nodiscard]] VerifyReport verify() const { return verifySession(path_).value(); }
    [[nodiscard]] static std::string all(const VerifyReport& report) {
        std::string text;
        for (const auto& problem : report.problems) text += problem + "\n";
        return text;
    }
    ScratchDir dir_;
    std::filesystem::path path_ = dir_.path() / "s.tacto";
};

TEST_F(SessionVerify, FindsAClosedSessionIntactAndCountsIt) {
    const auto before = test::bytesOf(path_);
    const auto report = verify();
    EXPECT_EQ(report.status, SessionStatus::Intact) << all(report);
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.recovered);
    EXPECT_TRUE(report.notes.empty());
    EXPECT_EQ(report.events, 1U);
    EXPECT_EQ(report.trials, 3U);
    EXPECT_EQ(report.captures, 3U);
    EXPECT_EQ(report.verdicts, 1U);
    EXPECT_EQ(report.samples, 3060U);
    EXPECT_EQ(report.head.size(), 64U);
    EXPECT_EQ(report.head, SessionReader::open(path_)->chainHead());
    EXPECT_EQ(test::bytesOf(path_), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir_.path()), {}), 1) << "nothing is left beside it";
}

TEST_F(SessionVerify, TheWriterKnowsTheHeadThatVerifyFinds) {
    VirtualClock clock;
    const auto path = dir_.path() / "t.tacto";
    auto writer = SessionWriter::create(path, {}, clock).value();
    ASSERT_TRUE(writer->event(clock.now(), "armed", {}));
    ASSERT_TRUE(writer->close());
    EXPECT_EQ(writer->chainHead(), verifySession(path)->head);
}

// SQLite itself is the oracle: if any program would read other rows than were written, verify must report damage.
TEST_F(SessionVerify, AsksWhetherToStopWhileTheDatabaseChecksItself) {
    const auto path = dir_.path() / "t.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    for (int i = 0; i < 3000; ++i) ASSERT_TRUE(writer->event(clock.now(), "armed", {{"number", i}}));
    ASSERT_TRUE(writer->close());
    std::atomic<std::uint64_t> asked = 0;
    const auto report = verifySession(path, [&] { return ++asked == 0; });
    ASSERT_TRUE(report);
    EXPECT_EQ(report->status, SessionStatus::Intact);
    const auto beside = asked - report->rows;  // those of each row
    EXPECT_GT(asked, report->rows + 10);
    for (const std::uint64_t stop : {std::uint64_t{1}, beside / 2, beside, asked.load()}) {
        asked = 0;
        const auto done = verifySession(path, [&] { return ++asked >= stop; });
        ASSERT_FALSE(done) << stop;
        EXPECT_EQ(done.error().code, ErrorCode::Stopped);
        EXPECT_EQ(asked, stop) << "nothing is checked after the stop";
    }
}

// To check all pages of a table is one instruction of SQLite's machine, in which SQLite asks nothing.
TEST_F(SessionVerify, AsksOnAnotherThreadWhileSQLiteAsksNothing) {
    const auto path = dir_.path() / "pages";
    auto database = Database::open(path, 0x6 /* SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE */).value();
    ASSERT_TRUE(database.execute("PRAGMA page_size = 512; PRAGMA journal_mode = OFF; CREATE TABLE blobs (bytes BLOB)"));
    const auto here = std::this_thread::get_id();
    for (int doubled = 0; doubled < 12; ++doubled) {
        const auto rows = doubled == 0 ? std::string("VALUES (zeroblob(1000000))") : "SELECT bytes FROM blobs";
        ASSERT_TRUE(database.execute("INSERT INTO blobs " + rows));
        auto check = database.prepare("PRAGMA integrity_check").value();
        const std::function<bool()> stopped = [&] { return std::this_thread::get_id() != here; };
        const auto asked = database.interruptedBy(stopped);
        if (const auto done = check.step(); !done) {
            EXPECT_EQ(done.error().code, ErrorCode::Stopped);
            return;
        }
        EXPECT_EQ(check.text(0), "ok");
    }
    FAIL() << "2 GB are checked within a tenth of a second";
}

TEST_F(SessionVerify, FindsAnyFlippedByteThatChangesARow) {
    const auto good = test::bytesOf(path_);
    const auto rows = test::everythingIn(path_);
    std::mt19937 random(20'261'120);
    int changed = 0;
    int unseen = 0;
    for (int i = 0; i < 400; ++i) {
        auto bytes = good;
        const auto at = random() % bytes.size();
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        test::writeBytes(path_, bytes);
        const bool differs = test::everythingIn(path_) != rows;
        const auto report = verify();
        if (differs) {
            ++changed;
            EXPECT_NE(report.status, SessionStatus::Intact) << "byte " << at;
            EXPECT_FALSE(report.problems.empty());
        } else {
            ++unseen;
        }
    }
    EXPECT_GT(changed, 100) << "the test must hit rows to mean anything";
    std::cout << changed << " flips changed rows, " << unseen << " hit unused space\n";
}

TEST_F(SessionVerify, NamesTheAlteredRow) {
    test::forge(path_,
                "UPDATE entries SET body=replace(body, '39.9', '40.1') WHERE kind='trial' AND name='smooth-low'");
    const auto report = verify();
    EXPECT_EQ(report.status, SessionStatus::Damaged);
    ASSERT_EQ(report.problems.size(), 1U) << all(report);
    EXPECT_NE(report.problems[0].find("trial smooth-low"), std::string::npos);
}

TEST_F(SessionVerify, FindsEachWayOfTampering) {
    const auto good = test::bytesOf(path_);
    const std::pair<const char*, const char*> cases[] = {
        {"DELETE FROM entries WHERE kind='event'", "is missing"},
        {"DELETE FROM entries WHERE kind='end'; DELETE FROM entries WHERE seq=3", "is missing"},
        {"UPDATE entries SET t_ns=t_ns+1 WHERE kind='verdict'", "was altered"},
        {"UPDATE entries SET name='pass2' WHERE kind='verdict'", "was altered"},
        {"UPDATE entries SET prev=zeroblob(32) WHERE kind='verdict'", "does not continue the hash chain"},
        {"UPDATE entries SET body=replace(body, 'SIM-1', 'SIM-2') WHERE seq=1", "was altered"},
        {"UPDATE chunks SET data=zeroblob(length(data)) WHERE idx=1", "CRC-32"},
        {"UPDATE chunks SET data=zeroblob(length(data)) WHERE idx=1", "their hash is wrong"},
        {"UPDATE chunks SET idx=idx+100 WHERE stream=1", "is filed under"},
        {"DELETE FROM chunks WHERE idx=1", "are missing"},
        {"INSERT INTO chunks VALUES(9999, 1, 9999, NULL, x'00')", "belong to no row"},
        {"UPDATE captures SET data=zeroblob(length(data))", "capture"},
        {"DELETE FROM captures", "are missing"},
        {"INSERT INTO captures VALUES(9999, x'00')", "belong to no row"},
        {"INSERT INTO entries VALUES(9999,'event',0,'x','{}',NULL,zeroblob(32),zeroblob(32))", "after the end mark"},
        {"DROP VIEW trials", "not those of a session"},
        {"CREATE TRIGGER sneaky AFTER INSERT ON entries BEGIN SELECT 1; END", "not those of a session"},
        {"DELETE FROM entries", "no rows"},
    };
    for (const auto& [sql, sentence] : cases) {
        test::writeBytes(path_, good);
        test::forge(path_, sql);
        const auto report = verify();
        EXPECT_EQ(report.status, SessionStatus::Damaged) << sql;
        EXPECT_NE(all(report).find(sentence), std::string::npos) << sql << "\n" << all(report);
    }
}

class DamagedSession : public SessionVerify {
protected:
    /// The samples of each stream by name, and how often a name is there.
    [[nodiscard]] static std::map<std::string, SampleBlock> samplesOf(const SessionReader& reader) {
        std::map<std::string, SampleBlock> all;
        const auto streams = reader.streams().value();
        for (const auto& info : streams)
            EXPECT_TRUE(all.emplace(info.stream.name, reader.samples(info.id).value()).second) << info.stream.name;
        return all;
    }
};

TEST_F(DamagedSession, GivesSamplesUnderTheNameOfTheirStreamWhateverBecameOfAnother) {
    const auto good = test::bytesOf(path_);
    const std::string other = "roughness frames";
    const auto recorded = samplesOf(*SessionReader::open(path_)).at(other);
    std::vector<std::string> changes{"UPDATE entries SET body=replace(body, 'columns', 'colurns') WHERE seq=2"};
    const auto flip = [&](const char* column, int at) {
        const auto old = fmt::format("unicode(substr({},{},1))", column, at);
        changes.push_back(
            fmt::format("UPDATE entries SET {0}=substr({0},1,{1}-1)||char(({2}|1)-({2}&1))||substr({0},{1}+1) "
                        "WHERE seq=2 AND kind='stream'",
                        column, at, old));
    };
    for (int at = 1; at <= 6; ++at) flip("kind", at);
    for (int at = 1; at <= 60; at += 3) flip("body", at);
    for (const auto& change : changes) {
        test::writeBytes(path_, good);
        test::forge(path_, change);
        ASSERT_EQ(verify().status, SessionStatus::Damaged) << change;
        const auto reader = SessionReader::openDamaged(path_);
        ASSERT_TRUE(reader) << change;
        const auto read = samplesOf(*reader);
        ASSERT_TRUE(read.contains(other)) << change;
        EXPECT_TRUE(test::sameBits(read.at(other).t_s, recorded.t_s)) << change;
        EXPECT_TRUE(test::sameBits(read.at(other).values, recorded.values)) << change;
    }
}

TEST_F(DamagedSession, WithAbsurdRowNumbersIsReadToItsEnd) {
    RecordProperty("hazard", "H10");
    const auto row = [](std::int64_t seq, const char* kind, const std::string& body) {
        return fmt::format("INSERT INTO entries VALUES({},'{}',0,'late','{}',NULL,zeroblob(32),zeroblob(32));", seq,
                           kind, body);
    };
    const std::string torn(40'000, 'z');
    const auto far = std::int64_t{1} << 59, last = std::numeric_limits<std::int64_t>::max();
    test::forge(path_, row(far, "log", "{}") + row(far + 2, "event", torn) + row(far + 7, "event", "{}") +
                           row(last - 10, "event", "{}") + row(last, "event", torn));
    auto bytes = test::bytesOf(path_);
    const auto page = std::size_t{static_cast<unsigned char>(bytes.at(16))} << 8U;
    ASSERT_GE(page, 512U);
    int broken = 0;
    for (std::size_t at = 0; at + page <= bytes.size(); at += page) {  // pages that go on with the text of a row
        if (std::string_view(&bytes[at + 4], 200) != torn.substr(0, 200)) continue;
        std::fill_n(&bytes[at], 4, '\x7f');
        ++broken;
    }
    ASSERT_GT(broken, 2);
    test::writeBytes(path_, bytes);
    const auto reader = SessionReader::openDamaged(path_);
    ASSERT_TRUE(reader) << reader.error().message;
    std::vector<std::int64_t> events;
    const auto rows = reader->events().value();
    for (const auto& event : rows) events.push_back(event.seq);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events.back(), far + 7);
    EXPECT_EQ(samplesOf(*reader).size(), 2U);
}

// A recomputed chain is valid in itself; its head differs from the head in the report and so reveals the forgery.
TEST_F(SessionVerify, ARecomputedChainIsFoundByItsHead) {
    const auto printed = verify().head;
    std::string updates = "UPDATE entries SET body=replace(body, '\"pass\"', '\"fail\"') WHERE kind='verdict';";
    test::forge(path_, updates);
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    sqlite3_stmt* rows = nullptr;
    ASSERT_EQ(sqlite3_prepare_v2(database, "SELECT seq, kind, t_ns, name, body, digest FROM entries ORDER BY seq", -1,
                                 &rows, nullptr),
              SQLITE_OK);
    const auto text = [&](int c) {
        const auto* data = static_cast<const char*>(sqlite3_column_blob(rows, c));
        return data == nullptr ? std::string()
                               : std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(rows, c)));
    };
    Digest previous{};
    std::string rechain;
    while (sqlite3_step(rows) == SQLITE_ROW) {
        const auto kind = text(1);
        const auto name = text(3);
        const auto body = text(4);
        Entry entry{sqlite3_column_int64(rows, 0), kind, sqlite3_column_int64(rows, 2), name, body, std::nullopt};
        if (const auto digest = text(5); !digest.empty()) {
            entry.digest.emplace();
            std::copy(digest.begin(), digest.end(), entry.digest->begin());
        }
        const auto hash = chainHash(previous, entry);
        rechain += "UPDATE entries SET prev=x'" + hexText(previous) + "', hash=x'" + hexText(hash) +
                   "' WHERE seq=" + std::to_string(entry.seq) + ";";
        previous = hash;
    }
    sqlite3_finalize(rows);
    sqlite3_close(database);
    test::forge(path_, rechain);
    const auto report = verify();
    EXPECT_EQ(report.status, SessionStatus::Intact) << all(report);
    EXPECT_NE(report.head, printed);
}

TEST_F(SessionVerify, FindsATruncatedFileWhereverItIsCut) {
    const auto good = test::bytesOf(path_);
    for (const std::size_t keep :
         {std::size_t{100}, std::size_t{4096}, std::size_t{16'384}, good.size() / 2, good.size() - 1}) {
        test::writeBytes(path_, {good.begin(), good.begin() + static_cast<std::ptrdiff_t>(keep)});
        const auto report = verify();
        EXPECT_EQ(report.status, SessionStatus::Damaged) << keep << " bytes";
    }
}

TEST_F(SessionVerify, TellsWhatIsNotASession) {
    const auto other = dir_.path() / "other.db";
    test::runSql(other, "CREATE TABLE entries(a); INSERT INTO entries VALUES(1)");
    const std::pair<std::filesystem::path, const char*> cases[] = {
        {dir_.write("text.tacto", "time,force\n0,1\n" + std::string(3000, 'x')), "not a database"},
        {dir_.write("short.tacto", "hello"), "not a"},
        {dir_.write("empty.tacto", ""), "empty"},
        {other, "another program"},
        {dir_.path(), "not a file"},
    };
    for (const auto& [path, sentence] : cases) {
        const auto report = verifySession(path);
        ASSERT_TRUE(report) << path << report.error().message;
        EXPECT_EQ(report->status, SessionStatus::NotASession) << path;
        ASSERT_EQ(report->problems.size(), 1U);
        EXPECT_NE(report->problems[0].find(sentence), std::string::npos) << report->problems[0];
        EXPECT_EQ(SessionReader::open(path).error().code, ErrorCode::Unsupported);
    }
    EXPECT_EQ(verifySession(dir_.path() / "none.tacto").error().code, ErrorCode::NotFound);
}

TEST_F(SessionVerify, RefusesASessionOfANewerProgramWithASentence) {
    test::runSql(path_, "PRAGMA user_version=5");
    const auto report = verify();
    EXPECT_EQ(report.status, SessionStatus::NotASession);
    EXPECT_NE(report.problems[0].find("session format 5, made by a newer Tactoscope"), std::string::npos);
    test::runSql(path_, "PRAGMA user_version=0");
    EXPECT_NE(verify().problems[0].find("no version of Tactoscope has written"), std::string::npos);
}

TEST_F(SessionVerify, FindsRowsThatAreNotSealedInAFileThatIsMarkedAsSealed) {
    RecordProperty("hazard", "H11");
    test::runSql(path_, "PRAGMA user_version=3");
    const auto report = verify();
    EXPECT_EQ(report.status, SessionStatus::Damaged);
    EXPECT_NE(report.problems[0].find("row 1 (about) is not sealed"), std::string::npos) << report.problems[0];
}

TEST_F(SessionVerify, OrdinarySqlCannotAlterASession) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    for (const char* sql : {"UPDATE entries SET name='x'", "DELETE FROM entries", "UPDATE chunks SET idx=7",
                            "DELETE FROM chunks", "UPDATE captures SET data=x'00'", "DELETE FROM captures"}) {
        EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_CONSTRAINT) << sql;
    }
    sqlite3_close(database);
    EXPECT_EQ(verify().status, SessionStatus::Intact);
}

}  // namespace
}  // namespace tacto
