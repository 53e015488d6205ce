// A disk that fills up: the limit on a file's size makes write() fail just so.
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/report/WholeFile.h"
#include "tests/report/Samples.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

constexpr int kRefused = 10;
constexpr int kWritten = 11;

/// Writes in a process of its own, whose files may have `limit` bytes; `reason` gets what was said.
int writeWithin(rlim_t limit, const std::filesystem::path& path, const QByteArray& content, std::string& reason) {
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit most{limit, limit};
        ::setrlimit(RLIMIT_FSIZE, &most);
        const auto written = writeWholeFile(QString::fromStdString(path.string()), content);
        const std::string said = written ? "" : written.error().message;
        const bool told = ::write(pipe[1], said.data(), said.size()) == static_cast<ssize_t>(said.size());
        ::_exit(!told ? 1 : written ? kWritten : kRefused);
    }
    ::close(pipe[1]);
    std::array<char, 512> said{};
    const auto length = ::read(pipe[0], said.data(), said.size());
    ::close(pipe[0]);
    reason.assign(said.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(WholeFile, LeavesTheEarlierFileWhereTheDiskTakesOnlyAPart) {
    RecordProperty("hazard", "H8");
    const ScratchDir scratch;
    for (const qsizetype size : {100, 5000, 16384, 100'000}) {
        const auto path = scratch.write("r.csv", "the earlier file");
        for (const rlim_t limit : {rlim_t(0), rlim_t(1), rlim_t(size - 1)}) {
            std::string reason;
            EXPECT_EQ(writeWithin(limit, path, QByteArray(size, 'x'), reason), kRefused) << size << " in " << limit;
            EXPECT_EQ(reason, "File too large");
            EXPECT_EQ(contentOfFile(path), "the earlier file");
            EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()),
                                    std::filesystem::directory_iterator()),
                      1)
                << "nothing is left beside it";
        }
        std::string reason;
        EXPECT_EQ(writeWithin(rlim_t(size), path, QByteArray(size, 'x'), reason), kWritten) << reason;
        EXPECT_EQ(contentOfFile(path), QByteArray(size, 'x'));
    }
}

TEST(WholeFile, SaysWhyTheFileCannotBeMade) {
    const ScratchDir scratch;
    const auto path = scratch.path() / "nowhere" / "r.csv";
    const auto written = writeWholeFile(QString::fromStdString(path.string()), "text");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::Io);
    EXPECT_EQ(written.error().message, "No such file or directory");
}

}  // namespace
}  // namespace tacto::test
