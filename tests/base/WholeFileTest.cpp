// A disk that fills up, simulated by the limit on file sizes, which makes write() fail in the same way.
#include <array>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/Random.h"
#include "core/base/WholeFile.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

constexpr int kRefused = 10;
constexpr int kWritten = 11;

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::ptrdiff_t filesIn(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

/// Writes in its own process, with files of at most `limit` bytes; `reason` gets the error message.
int writeWithin(rlim_t limit, const std::filesystem::path& path, const std::string& content, std::string& reason) {
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit most{limit, limit};
        ::setrlimit(RLIMIT_FSIZE, &most);
        const auto written = writeWholeFile(path, content);
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
    for (const std::size_t size : {100U, 5000U, 16384U, 100000U}) {
        const auto path = scratch.write("r.csv", "the earlier file");
        for (const rlim_t limit : {rlim_t(0), rlim_t(1), rlim_t(size - 1)}) {
            std::string reason;
            EXPECT_EQ(writeWithin(limit, path, std::string(size, 'x'), reason), kRefused) << size << " in " << limit;
            EXPECT_EQ(reason, "File too large");
            EXPECT_EQ(contentOf(path), "the earlier file");
            EXPECT_EQ(filesIn(scratch.path()), 1) << "nothing is left beside it";
        }
        std::string reason;
        EXPECT_EQ(writeWithin(rlim_t(size), path, std::string(size, 'x'), reason), kWritten) << reason;
        EXPECT_EQ(contentOf(path), std::string(size, 'x'));
    }
}

TEST(WholeFile, EveryNameThatTheFileSystemAllowsIsWritten) {
    const ScratchDir scratch;
    Random random(20261129, "file names");
    for (std::size_t length = 1; length <= 255; ++length) {
        // File names may be any bytes, in UTF-8 or not.
        std::string name;
        while (name.size() < length) {
            const char byte = static_cast<char>(1 + random.below(255));
            if (byte != '/') name += byte;
        }
        if (name == "." || name == "..") name = "x";
        const auto path = scratch.path() / name;
        for (const char* content : {"first", "second"}) {
            const auto written = writeWholeFile(path, content);
            ASSERT_TRUE(written) << length << ": " << written.error().message;
            EXPECT_EQ(contentOf(path), content);
        }
        EXPECT_EQ(filesIn(scratch.path()), 1) << "nothing is left beside it";
        fs::remove(path);
    }
    const auto tooLong = writeWholeFile(scratch.path() / std::string(256, 'x'), "text");
    ASSERT_FALSE(tooLong);
    EXPECT_EQ(tooLong.error().message, "File name too long");
    EXPECT_EQ(filesIn(scratch.path()), 0);
}

TEST(WholeFile, SaysWhyTheFileCannotBeMade) {
    const ScratchDir scratch;
    scratch.write("file", "text");
    fs::create_directory(scratch.path() / "folder");
    fs::create_symlink("loop", scratch.path() / "loop");
    const std::pair<const char*, const char*> refused[] = {{"nowhere/r.csv", "No such file or directory"},
                                                           {"file/r.csv", "Not a directory"},
                                                           {"folder", "Is a directory"},
                                                           {"loop", "Too many levels of symbolic links"}};
    for (const auto& [name, reason] : refused) {
        const auto written = writeWholeFile(scratch.path() / name, "text");
        ASSERT_FALSE(written) << name;
        EXPECT_EQ(written.error().code, ErrorCode::Io);
        EXPECT_EQ(written.error().message, reason) << name;
        EXPECT_EQ(namedAs(name, written).error().message, std::string(name) + " could not be written: " + reason);
    }
    EXPECT_EQ(filesIn(scratch.path()), 3);
    EXPECT_EQ(writeWholeFile("/dev/full", "text").error().message, "No space left on device");
    EXPECT_TRUE(writeWholeFile("/dev/null", "text"));
}

TEST(WholeFile, AnErrorThatIsNotTheFilesStaysAsItIs) {
    const auto other = namedAs("a.csv", fail(ErrorCode::InvalidArgument, "no samples"));
    EXPECT_EQ(other.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(other.error().message, "no samples");
    const ScratchDir scratch;
    const auto path = scratch.write("a.csv", "the earlier file");
    EXPECT_FALSE(replaceWholeFile(path, [](const fs::path&) { return fail(ErrorCode::Stopped, "stopped"); }));
    EXPECT_EQ(contentOf(path), "the earlier file");
    EXPECT_EQ(filesIn(scratch.path()), 1);
}

TEST(WholeFile, KeepsLinksAndPermissions) {
    const ScratchDir scratch;
    const auto path = scratch.write("a.csv", "the earlier file");
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    const auto link = scratch.path() / "link.csv", dangling = scratch.path() / "dangling.csv";
    fs::create_symlink("a.csv", link);
    fs::create_symlink(scratch.path() / "new.csv", dangling);
    ASSERT_TRUE(writeWholeFile(link, "through the link"));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(contentOf(path), "through the link");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    ASSERT_TRUE(writeWholeFile(dangling, "new"));
    EXPECT_TRUE(fs::is_symlink(dangling));
    EXPECT_EQ(contentOf(scratch.path() / "new.csv"), "new");
    EXPECT_EQ(filesIn(scratch.path()), 4);
}

TEST(WholeFile, WritesIntoAPipe) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    ASSERT_TRUE(writeWholeFile(fmt::format("/proc/self/fd/{}", pipe[1]), "text"));
    std::array<char, 16> got{};
    EXPECT_EQ(::read(pipe[0], got.data(), got.size()), 4);
    EXPECT_EQ(std::string_view(got.data(), 4), "text");
    ::close(pipe[0]);
    ::close(pipe[1]);
}

TEST(WholeFile, WhatAKilledProcessLeftIsRemovedAndNothingElse) {
    const ScratchDir scratch;
    const auto path = scratch.write("a.csv", "text");
    const pid_t child = ::fork();
    if (child == 0) {
        static_cast<void>(replaceWholeFile(path, [](const fs::path&) -> Result<void> { std::_Exit(0); }));
        std::_Exit(1);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    scratch.write(fmt::format(".tactoscope-{}-1", child + 1), "another's");
    EXPECT_EQ(filesIn(scratch.path()), 3);
    removeDraftsOf(child, path);
    EXPECT_EQ(filesIn(scratch.path()), 2);
    EXPECT_EQ(contentOf(path), "text");
}

}  // namespace
}  // namespace tacto::test
