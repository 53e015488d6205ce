// Summaries from a cache: fast enough for thousands of sessions, and always overruled by the session itself.
#include <chrono>
#include <gmock/gmock.h>

#include "core/session/Digest.h"
#include "core/session/SessionIndex.h"
#include "core/session/SessionLabels.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

class Index : public testing::Test {
protected:
    Index() { RecordProperty("hazard", "H9"); }
    fs::path session(const char* name, std::uint64_t seed = 1) {
        const auto path = dir.path() / name;
        test::writeSession(path, seed);
        age(path);
        return path;
    }
    /// Makes a session look as if it was written a while ago.
    static void age(const fs::path& path) {
        fs::last_write_time(path, fs::last_write_time(path) - std::chrono::seconds(10));
    }
    /// Lists the sessions and returns how many had to be read.
    int readsOf(const std::vector<fs::path>& paths) {
        int read = 0;
        listed = index.list(paths, [&](std::size_t) {
            ++read;
            return true;
        });
        return read;
    }
    test::ScratchDir dir;
    fs::path file = dir.path() / "cache" / "sessions.index";
    SessionIndex index{file};
    std::vector<ListedSession> listed;
};

TEST_F(Index, ReadsEachSessionOnce) {
    const auto a = session("a.tacto"), b = session("b.tacto", 2);
    EXPECT_EQ(readsOf({a, b}), 2);
    const auto first = listed;
    EXPECT_EQ(readsOf({a, b}), 0);
    ASSERT_EQ(listed.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(listed[i].path, first[i].path);
        EXPECT_EQ(listed[i].summary, first[i].summary);
        EXPECT_EQ(listed[i].summary, summarise(listed[i].path).value());
        EXPECT_EQ(listed[i].bytes, fs::file_size(listed[i].path));
    }
    EXPECT_EQ(listed[0].summary.verdict, "pass");
    EXPECT_NEAR(listed[0].summary.duration_s, 2.9, 0.2);
}

TEST_F(Index, ReadsAChangedSessionAgain) {
    const auto a = session("a.tacto"), b = session("b.tacto");
    EXPECT_EQ(readsOf({a, b}), 2);
    ASSERT_TRUE(saveLabels(a, {}, {"", "S-014", "", {}}));
    age(a);
    EXPECT_EQ(readsOf({a, b}), 1);
    EXPECT_EQ(listed[0].summary.labels.sample, "S-014");
    fs::last_write_time(b, fs::last_write_time(b) + std::chrono::milliseconds(1));
    EXPECT_EQ(readsOf({a, b}), 1) << "of the same size at another time";
}

TEST_F(Index, DoesNotKeepWhatWasChangedAMomentAgo) {
    const auto a = session("a.tacto");
    fs::last_write_time(a, fs::file_time_type::clock::now());
    EXPECT_EQ(readsOf({a}), 1);
    EXPECT_EQ(readsOf({a}), 1) << "it may change again within the same tick of the file system's clock";
}

TEST_F(Index, ThatIsMissingOrDamagedIsMadeAnew) {
    const auto a = session("a.tacto"), b = session("b.tacto");
    EXPECT_EQ(readsOf({a, b}), 2);
    const auto good = listed;
    fs::remove(file);
    EXPECT_EQ(readsOf({a, b}), 2);
    for (const auto* content : {"no database of any kind, and longer than a header of one hundred bytes, so that it is "
                                "looked at as a whole when it is opened",
                                ""}) {
        std::ofstream(file, std::ios::trunc) << content;
        EXPECT_EQ(readsOf({a, b}), 2);
        EXPECT_EQ(listed[0].summary, good[0].summary);
        EXPECT_EQ(readsOf({a, b}), 0) << "it is one again";
    }
    auto bytes = test::bytesOf(file);
    for (std::size_t i = 4096; i < bytes.size(); ++i) bytes[i] = '\x5a';  // damages all pages except the first
    test::writeBytes(file, bytes);
    EXPECT_EQ(readsOf({a, b}), 2);
    EXPECT_EQ(readsOf({a, b}), 0);
}

TEST_F(Index, OfAnotherVersionIsMadeAnew) {
    const auto a = session("a.tacto");
    EXPECT_EQ(readsOf({a}), 1);
    test::runSql(file, "PRAGMA user_version=99");
    EXPECT_EQ(readsOf({a}), 1);
    EXPECT_EQ(readsOf({a}), 0);
}

TEST_F(Index, ThatCannotBeKeptCostsTimeAndNothingElse) {
    const auto a = session("a.tacto");
    fs::create_directories(file);  // a folder takes the place of the index
    EXPECT_EQ(readsOf({a}), 1);
    EXPECT_EQ(readsOf({a}), 1);
    EXPECT_EQ(listed[0].summary.verdict, "pass");
}

TEST_F(Index, ARowThatWasAlteredIsReadFromTheSession) {
    const auto a = session("a.tacto");
    EXPECT_EQ(readsOf({a}), 1);
    test::runSql(file, "UPDATE summaries SET body=replace(body, '\"pass\"', '\"fail\"')");
    EXPECT_EQ(readsOf({a}), 1);
    EXPECT_EQ(listed[0].summary.verdict, "pass");
}

TEST_F(Index, ALieThatLooksRightIsCorrectedByTheSession) {
    const auto a = session("a.tacto");
    EXPECT_EQ(readsOf({a}), 1);
    // The forged row is valid in itself: only reading the session shows the truth.
    auto lie = listed[0].summary;
    lie.verdict = "fail";
    const auto body = toJsonText(lie);
    test::runSql(file, "UPDATE summaries SET body='" + body + "'");
    std::string stamp;
    {
        sqlite3* database = nullptr;
        sqlite3_stmt* row = nullptr;
        ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
        ASSERT_EQ(sqlite3_prepare_v2(database, "SELECT stamp FROM summaries", -1, &row, nullptr), SQLITE_OK);
        ASSERT_EQ(sqlite3_step(row), SQLITE_ROW);
        stamp = reinterpret_cast<const char*>(sqlite3_column_text(row, 0));
        sqlite3_finalize(row);
        sqlite3_close(database);
    }
    test::runSql(file, "UPDATE summaries SET checked='" + sha256Hex(a.string() + "\n" + stamp + "\n" + body) + "'");
    EXPECT_EQ(readsOf({a}), 0);
    EXPECT_EQ(listed[0].summary.verdict, "fail") << "the lie is told";
    EXPECT_EQ(index.read(a).summary.verdict, "pass") << "and does not stand against the session";
    EXPECT_EQ(readsOf({a}), 0);
    EXPECT_EQ(listed[0].summary.verdict, "pass") << "nor come again";
}

TEST_F(Index, ForgetsWhatIsGoneAndKeepsWhatACancelledListingRead) {
    const auto a = session("a.tacto"), b = session("b.tacto");
    listed = index.list({a, b}, [](std::size_t) { return false; });
    EXPECT_EQ(listed.size(), 1U);
    EXPECT_EQ(readsOf({a, b}), 1);
    fs::remove(a);
    EXPECT_EQ(readsOf({a, b}), 0);
    ASSERT_EQ(listed.size(), 1U);
    EXPECT_EQ(listed[0].path, b);
    const auto bytes = test::bytesOf(file);
    EXPECT_NE(std::string(bytes.begin(), bytes.end()).find(b.string()), std::string::npos);
    test::runSql(file, "VACUUM");
    const auto vacuumed = test::bytesOf(file);
    EXPECT_EQ(std::string(vacuumed.begin(), vacuumed.end()).find(a.string()), std::string::npos);
}

TEST_F(Index, ASessionThatCannotBeReadIsListedWithTheReasonEachTime) {
    const auto a = dir.write("notes.tacto", "no session of any kind");
    age(a);
    EXPECT_EQ(readsOf({a}), 1);
    EXPECT_NE(listed[0].problem, "");
    EXPECT_EQ(readsOf({a}), 1);
}

}  // namespace
}  // namespace tacto
