// A full disk, and a session that grows for hours.
#include <bit>
#include <random>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/session/SessionRecorder.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using test::ScratchDir;

/// As long as this exists, no file of this process can grow beyond `bytes`; a program sees this as a full disk.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) {
        signal(SIGXFSZ, SIG_IGN);
        EXPECT_EQ(getrlimit(RLIMIT_FSIZE, &before_), 0);
        const rlimit now{bytes, before_.rlim_max};
        EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &now), 0);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        signal(SIGXFSZ, SIG_DFL);
    }

private:
    rlimit before_{};
};

/// A session with one stream that is being written.
struct Recording {
    ScratchDir dir;
    std::filesystem::path path = dir.path() / "s.tacto";
    test::HandClock clock;
    std::unique_ptr<SessionWriter> writer = SessionWriter::create(path, test::someAbout(), clock).value();
    int stream = writer->addStream(SessionStream{"a", "", "", {"x", "y", "z"}, 4000}).value();
};

TEST(SessionFailure, AFullDiskIsSaidOnceAndForAllAndWhatWasCommittedStays) {
    RecordProperty("hazard", "H8");
    Recording recording;
    auto& [dir, path, clock, writer, stream] = recording;
    ASSERT_TRUE(writer->trial(clock.now(), "before", {}));
    int trials = 1;
    {
        const FullDisk full(300'000);
        Result<void> result;
        for (int i = 0; i < 200 && result; ++i) {
            clock.advance(std::chrono::milliseconds(250));
            result = writer->append(stream, test::ramp(i * 0.25, 4000, 1000, 3));
            if (result && i % 8 == 0 && writer->trial(clock.now(), "during", {})) ++trials;
        }
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::Io);
        EXPECT_NE(result.error().message.find(path.string()), std::string::npos) << result.error().message;
        EXPECT_NE(result.error().message.find("recording has ended"), std::string::npos);
    }
    ASSERT_TRUE(writer->failed());
    EXPECT_EQ(writer->trial(clock.now(), "after", {}).error().message, writer->failed()->message)
        << "room again, but a hole in the record is not papered over";
    EXPECT_FALSE(writer->close());
    writer.reset();
    const auto report = verifySession(path).value();
    EXPECT_EQ(report.status, SessionStatus::Intact) << report.problems[0];
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.trials, static_cast<std::uint64_t>(trials));
}

TEST(SessionFailure, APathThatCannotBeOpenedIsRefusedWithTheReason) {
    const ScratchDir dir;
    const test::HandClock clock;
    const auto refusal = [&](const std::filesystem::path& path) {
        const auto made = SessionWriter::create(path, test::someAbout(), clock);
        return made ? std::string("made") : made.error().message;
    };
    const auto name = [](std::size_t bytes) { return std::string(bytes - 6, 's') + ".tacto"; };
    // The journal's name is four bytes longer.
    EXPECT_EQ(refusal(dir.path() / name(251)), "made");
    for (const std::size_t bytes : {252U, 255U, 256U}) {
        const auto path = dir.path() / name(bytes);
        EXPECT_EQ(refusal(path), fmt::format("session {} cannot be made: File name too long", path.string()));
    }
    EXPECT_EQ(
        refusal(dir.path() / "none" / "s.tacto"),
        fmt::format("session {} cannot be made: No such file or directory", (dir.path() / "none/s.tacto").string()));
    auto folder = dir.path();
    while (folder.native().size() < 430) folder /= std::string(20, 'd');
    std::filesystem::create_directories(folder);
    for (std::size_t bytes = 490; bytes < 530; ++bytes) {
        const auto path = folder / name(bytes - folder.native().size() - 1);
        const auto said = refusal(path);
        EXPECT_EQ(said == "made", bytes <= 504) << said;
        if (bytes > 504) {
            EXPECT_NE(said.find(fmt::format("its path has {} bytes; at most 504", bytes)), said.npos) << said;
        }
        if (said == "made") {
            EXPECT_TRUE(SessionReader::open(path));
        }
    }
}

TEST(SessionFailure, AFileThatIsRemovedMeanwhileEndsTheRecording) {
    RecordProperty("hazard", "H8");
    Recording recording;
    auto& [dir, path, clock, writer, stream] = recording;
    std::filesystem::remove(path);
    Result<void> result;
    for (int i = 0; i < 40 && result; ++i) {
        clock.advance(std::chrono::milliseconds(250));
        result = writer->append(stream, test::ramp(i * 0.25, 4000, 1000, 3));
    }
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Io);
    EXPECT_NE(result.error().message.find("moved or removed"), std::string::npos) << result.error().message;
}

TEST(SessionFailure, TheRecorderShowsAFullDiskToTheControlLoop) {
    const ScratchDir dir;
    SteadyClock clock;
    auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    const int stream = writer->addStream(SessionStream{"a", "", "", {"x"}, 4000}).value();
    SessionRecorder recorder(*writer, {});
    {
        const FullDisk full(400'000);
        auto block = test::ramp(0, 4000, 50'000, 1);
        std::mt19937_64 random(1);  // so that packing saves nothing
        for (auto& value : block.values) value = std::bit_cast<double>(random());
        for (int i = 0; i < 4; ++i) recorder.samples(stream, 1, block);
        EXPECT_FALSE(recorder.drain());
    }
    EXPECT_TRUE(recorder.failed());
    ASSERT_TRUE(recorder.error());
    EXPECT_EQ(recorder.error()->code, ErrorCode::Io);
}

#ifndef TACTOSCOPE_SANITIZED  // sanitizers do not return freed memory
TEST(SessionFailure, MemoryStaysFlatFromOneToTenHours) {
    const auto residentPages = [] {
        long total = 0;
        long resident = 0;
        std::ifstream("/proc/self/statm") >> total >> resident;
        return resident;
    };
    const ScratchDir dir;
    VirtualClock clock;
    auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    const int stream = writer->addStream(SessionStream{"a", "", "", {"x"}, 100}).value();
    long afterOneHour = 0;
    for (int second = 0; second < 36'000; ++second) {
        clock.advanceTo(std::chrono::seconds(second));
        ASSERT_TRUE(writer->append(stream, test::ramp(second, 100, 100, 1)));
        ASSERT_TRUE(writer->command(clock.now(), "train", {{"amplitude_v", 12.5}}));
        if (second == 3600) afterOneHour = residentPages();
    }
    EXPECT_LT(static_cast<double>(residentPages()), 1.05 * static_cast<double>(afterOneHour));
}
#endif

}  // namespace
}  // namespace tacto
