// Reading a session takes no lock away from its writer.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/session/Database.h"
#include "core/session/Schema.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using test::ScratchDir;

/// Whether a process holds SQLite's shared lock on a file. Only another process can see this.
bool isLocked(const std::filesystem::path& path) {
    constexpr off_t kSharedFirst = 0x40000002, kSharedBytes = 510;  // sqlite3/src/os.h
    const auto child = ::fork();
    if (child == 0) {
        struct flock lock {};
        lock.l_type = F_WRLCK;
        lock.l_whence = SEEK_SET;
        lock.l_start = kSharedFirst;
        lock.l_len = kSharedBytes;
        const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
        ::_exit(file < 0 || ::fcntl(file, F_GETLK, &lock) != 0 ? 2 : lock.l_type == F_UNLCK ? 0 : 1);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) != 2);
    return WEXITSTATUS(status) == 1;
}

class SessionBeingWritten : public testing::Test {
protected:
    void SetUp() override {
        auto made = SessionWriter::create(path_, test::someAbout(), clock_);
        ASSERT_TRUE(made) << made.error().message;
        writer_ = std::move(*made);
        ASSERT_TRUE(writer_->event(clock_.now(), "armed", {{"n", 0}}));
        ASSERT_TRUE(isLocked(path_)) << "a writer holds it";
    }
    const ScratchDir dir_;
    const std::filesystem::path path_ = dir_.path() / "s.tacto";
    test::HandClock clock_;
    std::unique_ptr<SessionWriter> writer_;
};

TEST_F(SessionBeingWritten, KeepsItsLocksWhenACopyIsRead) {
    RecordProperty("hazard", "H8");
    std::filesystem::remove(path_.string() + "-shm");  // without an index of the journal, a copy is read
    const auto reader = SessionReader::open(path_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->events().value().size(), 1U);
    EXPECT_TRUE(isLocked(path_));
}

TEST_F(SessionBeingWritten, KeepsItsLocksWhenItsBytesAreRead) {
    RecordProperty("hazard", "H8");
    {
        const auto file = DatabaseFile::open(path_);
        ASSERT_TRUE(file) << file.error().message;
        std::string head(15, ' ');
        ASSERT_TRUE(file->read(0, std::as_writable_bytes(std::span(head))));
        EXPECT_EQ(head, "SQLite format 3");
        EXPECT_FALSE(file->read(file->size().value(), std::as_writable_bytes(std::span(head)))) << "behind its end";
    }
    EXPECT_TRUE(isLocked(path_));
    EXPECT_FALSE(DatabaseFile::open(dir_.path() / "none.tacto"));
}

TEST(Schema, CarriesItsIds) {
    auto database = Database::open(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE).value();
    ASSERT_TRUE(createSchema(database, kPackedVersion));
    EXPECT_EQ(database.number("PRAGMA application_id").value(), 0x54414354);
    EXPECT_EQ(database.number("PRAGMA user_version").value(), kPackedVersion);
}

}  // namespace
}  // namespace tacto
