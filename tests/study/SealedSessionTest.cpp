// A session with sealed rows: what it shows, what its key opens, and that changes are found without the key.
#include <sqlite3.h>

#include "core/session/Origin.h"
#include "core/session/SessionIndex.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionSignature.h"
#include "core/session/SessionVerify.h"
#include "core/study/StudyKeys.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

class SealedSession : public test::StudyDesk {
protected:
    void SetUp() override {
        path = scratch.path() / "0123456789abcdef.tacto";
        master = Secret::random(32);
        BegunSession begun;
        begun.session.code = "P-7K3D";
        begun.path = path;
        begun.seal = seal();
        head = record(begun);
    }
    [[nodiscard]] std::shared_ptr<const RowSeal> seal(std::string file = "0123456789abcdef") const {
        return std::make_shared<SessionSeal>("study", std::move(file), Secret(master.bytes()));
    }
    std::filesystem::path path;
    Secret master;
    std::string head;
};

TEST_F(SealedSession, GivesEverythingBackToItsKey) {
    RecordProperty("hazard", "H8");
    const auto reader = test::accepted(SessionReader::open(path, seal()));
    EXPECT_TRUE(reader.sealed());
    EXPECT_FALSE(reader.locked());
    EXPECT_EQ(reader.about().seed, 4711U);
    EXPECT_EQ(reader.about().parameters["participant"], "P-7K3D");
    const auto events = reader.events().value();
    ASSERT_EQ(events.size(), 9U);
    EXPECT_EQ(events[2].name, "answer");
    EXPECT_EQ(events[2].at, toInstant(1.25) + std::chrono::milliseconds(873));
    EXPECT_EQ(events[4].body["response"], "none");
    EXPECT_EQ(events[8].name, "level-too-strong");
    EXPECT_EQ(reader.commands()->front().name, "delivered");
    EXPECT_EQ(reader.trials()->front().condition, "rough-high");
    EXPECT_EQ(reader.measurements()->front().body["ohm"], 3412.5);
    EXPECT_EQ(reader.verdicts()->front().subject, "rough-high");
    EXPECT_EQ(reader.labels()->note, "talked of rough-high");
    const auto streams = test::accepted(reader.streams());
    EXPECT_EQ(streams.front().samples, 6U);
    EXPECT_EQ(reader.samples(1)->values, std::vector<double>(6, 4.5));
    EXPECT_DOUBLE_EQ(reader.samples(1)->t_s[1], 1.7);
    const auto captures = reader.captures().value();
    ASSERT_EQ(captures.size(), 1U);
    EXPECT_EQ(captures[0].trial, 1);
    EXPECT_EQ(reader.capture(captures[0].seq)->channels[0].samples, std::vector<float>(2000, 12.5F));
}

TEST_F(SealedSession, ShowsWithoutAKeyWhatAReviewerNeedsAndSaysThatTheRestIsSealed) {
    RecordProperty("hazard", "H11");
    const auto reader = test::accepted(SessionReader::open(path));
    EXPECT_TRUE(reader.locked());
    EXPECT_EQ(reader.about().devices.front().serial, "SIM-1");
    EXPECT_EQ(reader.about().seed, 0U);
    EXPECT_EQ(reader.about().parameters["sealed"], true);
    const auto events = reader.events().value();
    ASSERT_EQ(events.size(), 9U);
    for (const auto& event : events) {
        EXPECT_TRUE(event.sealed);
        EXPECT_EQ(event.body["sealed"], true);
        EXPECT_EQ(event.at.count() % 1'000'000'000, 0);
    }
    EXPECT_EQ(events[2].name, "answer");
    EXPECT_EQ(events[7].name, "refused");
    EXPECT_EQ(events[7].body["text"], "… mA is above the discomfort limit of … mA");
    EXPECT_EQ(events[8].name, "sealed");  // "too strong" is an answer, so it is sealed
    EXPECT_EQ(reader.commands()->front().name, "sealed");
    EXPECT_EQ(reader.trials()->front().condition, "sealed");
    EXPECT_EQ(reader.trials()->front().number, 1);
    EXPECT_EQ(reader.verdicts()->front().verdict, "sealed");
    EXPECT_TRUE(reader.captures()->front().sealed);
    EXPECT_EQ(reader.labels()->note, "sealed");
    for (const auto& code :
         {reader.streams().error().code, reader.samples(1).error().code,
          reader.capture(reader.captures()->front().seq).error().code, reader.reproducibleText().error().code})
        EXPECT_EQ(code, ErrorCode::Unsupported);
    EXPECT_EQ(summarise(path)->verdict, "sealed");
    EXPECT_EQ(deliveredIn(reader).error().code, ErrorCode::Unsupported);  // an error, not an empty result
}

TEST_F(SealedSession, ShowsTheLengthOfARowOrChunkToABlockAlone) {
    RecordProperty("hazard", "H11");
    const auto row = [&](std::size_t size) { return seal()->sealText(1, "event", std::string(size, 'x')).size(); };
    EXPECT_EQ(row(4), row(10)) << "\"none\" is as long as \"rough-high\"";
    EXPECT_EQ(row(0), row(255));
    EXPECT_LT(row(255), row(256));
    const auto chunk = [&](std::size_t size) {
        const std::vector<std::byte> bytes(size);
        const std::span<const std::byte> parts[] = {bytes};
        return seal()->sealBytes(1, "chunk", parts).size();
    };
    EXPECT_EQ(chunk(1), chunk(4095));
    EXPECT_LT(chunk(4095), chunk(4096));
}

TEST_F(SealedSession, OpensWithItsOwnKeyInItsOwnFileOnly) {
    RecordProperty("hazard", "H11");
    EXPECT_EQ(SessionReader::open(path, seal("fedcba9876543210")).error().code, ErrorCode::ParseError);
    const auto other = std::make_shared<SessionSeal>("study", "0123456789abcdef", Secret::random(32));
    EXPECT_EQ(SessionReader::open(path, other).error().code, ErrorCode::ParseError);
}

TEST_F(SealedSession, IsVerifiedWithoutAKey) {
    RecordProperty("hazard", "H8");
    const auto report = test::accepted(verifySession(path));
    EXPECT_EQ(report.status, SessionStatus::Intact) << (report.problems.empty() ? "" : report.problems.front());
    EXPECT_EQ(report.head, head);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.trials, 1U);
}

TEST_F(SealedSession, IsSignedWithoutAKeyAndShowsNoPlaceThatCouldNameAPerson) {
    RecordProperty("hazard", "H11");
    const auto own = scratch.path() / "0123456789abcdef.pdf", elsewhere = scratch.path() / "P-7K3D second.pdf";
    for (const auto& report : {own, elsewhere}) std::ofstream(report) << report;
    const auto before = test::accepted(SessionReader::open(path, seal())).reproducibleText().value();
    ASSERT_EQ(test::accepted(signReport(path, own, "A. Lind")).report, own.filename().string());
    EXPECT_EQ(test::accepted(signReport(path, elsewhere, "B. Ott")).report, "");
    auto verified = test::accepted(verifySession(path));
    EXPECT_EQ(verified.status, SessionStatus::Intact) << testing::PrintToString(verified.problems);
    EXPECT_EQ(verified.head, head);
    ASSERT_EQ(verified.signatures.size(), 2U);
    EXPECT_EQ(verified.signatures[0].state, SignedReport::Unchanged);
    EXPECT_EQ(verified.signatures[1].state, SignedReport::Missing);
    EXPECT_FALSE(reportChanged(verified));
    std::ofstream(own, std::ios::app) << "more";
    EXPECT_TRUE(reportChanged(test::accepted(verifySession(path))));
    std::ifstream file(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(bytes.find("P-7K3D"), std::string::npos);
    const auto reader = test::accepted(SessionReader::open(path, seal()));
    EXPECT_TRUE(reader.sealed());
    EXPECT_EQ(reader.reproducibleText().value(), before);
    EXPECT_EQ(saveLabels(path, {}, {"A. Weber", "", "", {}}).error().code, ErrorCode::Unsupported);
}

TEST_F(SealedSession, AFlippedBitIsFoundWithoutAKey) {
    RecordProperty("hazard", "H8");
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    int found = 0, looked = 0;
    const auto rows = SessionReader::open(path)->events()->size();
    ASSERT_GT(rows, 0U);
    // Looks for each stored seal by its bytes: its random nonce occurs nowhere else in the file.
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    std::vector<std::string> seals;
    for (const char* sql : {"SELECT CAST(substr(json_extract(body,'$.sealed'),30,40) AS BLOB) FROM entries WHERE "
                            "json_extract(body,'$.sealed') IS NOT NULL",
                            "SELECT substr(data,30,40) FROM chunks", "SELECT substr(data,30,40) FROM captures"}) {
        sqlite3_stmt* statement = nullptr;
        ASSERT_EQ(sqlite3_prepare_v2(database, sql, -1, &statement, nullptr), SQLITE_OK);
        while (sqlite3_step(statement) == SQLITE_ROW)
            seals.emplace_back(static_cast<const char*>(sqlite3_column_blob(statement, 0)), 40);
        sqlite3_finalize(statement);
    }
    sqlite3_close(database);
    ASSERT_GT(seals.size(), 15U);
    for (const auto& seal : seals) {
        const auto at = bytes.find(seal);
        if (at == std::string::npos) continue;  // the seal lies across two pages
        auto altered = bytes;
        altered[at + 7] = static_cast<char>(altered[at + 7] ^ 1);
        const auto copy = scratch.write("altered.tacto", altered);
        ++looked;
        const auto report = verifySession(copy);
        if (report && report->status == SessionStatus::Damaged) ++found;
    }
    EXPECT_GT(looked, 10);
    EXPECT_EQ(found, looked);
}

TEST_F(SealedSession, TheSameRowsGiveTheSameReproducibleTextThoughTheSealsDiffer) {
    BegunSession begun;
    begun.session.code = "P-7K3D";
    begun.path = scratch.path() / "again.tacto";
    begun.seal = seal("again");
    record(begun);
    const auto first = SessionReader::open(path, seal())->reproducibleText();
    const auto second = SessionReader::open(begun.path, begun.seal)->reproducibleText();
    ASSERT_TRUE(first && second);
    EXPECT_EQ(*first, *second);
    EXPECT_NE(first->find("rough-high"), std::string::npos);
    EXPECT_NE(everythingBelow(scratch.path()).size(), 0U);
}

}  // namespace
}  // namespace tacto
