#include <memory>
#include <thread>

#include "core/session/SessionRecorder.h"
#include "tests/session/SessionSupport.h"
#include "tests/support/Allocations.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using test::ScratchDir;

TEST(SessionRecorder, WritesWhatTheLoopPushedFromItsOwnThread) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    SteadyClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    const int acceleration = writer->addStream(SessionStream{"a", "", "", {"x", "y", "z"}, 4000}).value();
    const int wide = writer->addStream(SessionStream{"w", "", "", std::vector<std::string>(63, "c"), 200}).value();
    const int frames = writer->addStream(SessionStream{"f", "", "", {"R", "P"}, 0}).value();
    {
        SessionRecorder recorder(*writer, {.ownThread = true, .ringRecords = 4096});
        for (int step = 0; step < 50; ++step) {
            recorder.samples(acceleration, 3, test::ramp(step * 0.01, 4000, 40, 3));
            recorder.samples(wide, 63, test::ramp(step * 0.01, 200, 2, 63));
            const double frame[] = {step / 50.0, std::nan("")};
            recorder.frame(frames, step * 0.01, frame);
            recorder.command(toInstant(step * 0.01), "train", {{"amplitude_v", 12.5}, {"z_ohm", std::nan("")}}, "µ");
        }
        recorder.event(toInstant(1.0), "stop", {{"by", 3}}, "operator");
        ASSERT_TRUE(recorder.drain());
        const auto live = SessionReader::open(path);
        EXPECT_EQ(live->events()->size(), 1U) << "drained means committed";
        EXPECT_EQ(live->samples(acceleration)->samples(), 2000U);
        EXPECT_EQ(recorder.dropped(), 0U);
        EXPECT_FALSE(recorder.failed());
    }
    ASSERT_TRUE(writer->close());
    const auto reader = SessionReader::open(path);
    const auto samples = reader->samples(acceleration).value();
    ASSERT_EQ(samples.samples(), 2000U);
    const auto expected = test::ramp(0.49, 4000, 40, 3);
    EXPECT_EQ(samples.values[1960 * 3 + 7], expected.values[7]);
    EXPECT_NEAR(samples.t_s[1960 + 39], expected.t_s[39], 1e-9);
    EXPECT_EQ(reader->samples(wide)->samples(), 100U);
    EXPECT_EQ(reader->samples(frames)->values[20], 0.2);
    const auto commands = reader->commands().value();
    ASSERT_EQ(commands.size(), 50U);
    EXPECT_EQ(commands[7].body, (nlohmann::json{{"amplitude_v", 12.5}, {"z_ohm", nullptr}, {"text", "µ"}}));
    EXPECT_EQ(reader->events().value()[0].body, (nlohmann::json{{"by", 3}, {"text", "operator"}}));
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
}

TEST(SessionRecorder, OnAVirtualClockTheSameCallsGiveTheSameSession) {
    const ScratchDir dir;
    const auto run = [&](const char* name) {
        VirtualClock clock;
        auto writer = SessionWriter::create(dir.path() / name, test::someAbout(), clock).value();
        const int stream = writer->addStream(SessionStream{"a", "", "", {"x"}, 1000}).value();
        SessionRecorder recorder(*writer, {.ownThread = false});
        for (int step = 0; step < 500; ++step) {
            clock.advanceTo(toInstant(step * 0.01));
            recorder.samples(stream, 1, test::ramp(step * 0.01, 1000, 10, 1));
            if (step % 50 == 0) recorder.event(clock.now(), "train", {{"step", static_cast<double>(step)}});
        }
        EXPECT_TRUE(recorder.drain());
        EXPECT_TRUE(writer->close());
        return SessionReader::open(dir.path() / name)->reproducibleText().value();
    };
    const auto one = run("one.tacto");
    EXPECT_EQ(one, run("two.tacto"));
    EXPECT_NE(one.find("chunk"), std::string::npos);
}

TEST(SessionRecorder, NeverAllocatesInTheControlLoop) {
    if (!test::countsAllocations()) GTEST_SKIP() << test::kNotCounted;
    const ScratchDir dir;
    SteadyClock clock;
    auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    const int stream = writer->addStream(SessionStream{"a", "", "", {"x", "y", "z"}, 4000}).value();
    SessionRecorder recorder(*writer, {.ownThread = true, .ringRecords = 512});
    const auto block = test::ramp(0, 4000, 64, 3);
    const double frame[] = {1, 2, 3};
    const auto before = test::allocationsOfThisThread();
    for (int step = 0; step < 1000; ++step) {
        recorder.samples(stream, 3, block);
        recorder.frame(stream, 1.0, frame);
        recorder.command(Instant(step), "train", {{"a", 1}, {"b", 2}}, "text");
        recorder.event(Instant(step), "tick", {{"a", 1}});
    }
    EXPECT_EQ(test::allocationsOfThisThread(), before);
    const auto probe = std::make_unique<int>(1);
    EXPECT_EQ(test::allocationsOfThisThread(), before + 1) << "the counter counts";
}

TEST(SessionRecorder, SaysInTheSessionWhatItLost) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    SteadyClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    const int stream = writer->addStream(SessionStream{"a", "", "", {"x"}, 0}).value();
    std::uint64_t dropped = 0;
    {
        SessionRecorder recorder(*writer, {.ownThread = true, .ringRecords = 4});
        const double value[] = {1};
        // Much faster than any disk: the ring with room for four overflows.
        for (int i = 0; i < 100'000 && recorder.dropped() < 100; ++i) recorder.frame(stream, i * 1e-3, value);
        EXPECT_TRUE(recorder.drain());
        dropped = recorder.dropped();
    }
    ASSERT_TRUE(writer->close());
    ASSERT_GE(dropped, 100U);
    std::uint64_t told = 0;
    const auto events = SessionReader::open(path)->events().value();
    for (const auto& event : events) {
        EXPECT_EQ(event.name, "records lost");
        told += event.body["records"].get<std::uint64_t>();
    }
    EXPECT_EQ(told, dropped);
}

TEST(SessionRecorder, RefusesAStreamTooWideForItsRecordsAndSaysSo) {
    const ScratchDir dir;
    SteadyClock clock;
    auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    SessionRecorder recorder(*writer, {.ownThread = true, .ringRecords = 16});
    recorder.samples(1, 64, test::ramp(0, 1, 1, 64));
    EXPECT_TRUE(recorder.failed());
    ASSERT_TRUE(recorder.error());
    EXPECT_NE(recorder.error()->message.find("64 columns"), std::string::npos);
    EXPECT_FALSE(recorder.drain());
}

TEST(SessionRecorder, CutsLongTextAtACharacter) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    VirtualClock clock;
    {
        auto writer = SessionWriter::create(path, {}, clock).value();
        SessionRecorder recorder(*writer, {.ownThread = false});
        recorder.event(clock.now(), "fault", {}, std::string(199, 'a') + "µµ");
    }
    EXPECT_EQ(SessionReader::open(path)->events().value()[0].body["text"], std::string(199, 'a'));
}

TEST(SessionRecorder, IdleSamplesAreCommittedByTheRecordersOwnClock) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    test::HandClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    const int stream = writer->addStream(SessionStream{"a", "", "", {"x"}, 0}).value();
    SessionRecorder recorder(*writer, {.ownThread = true, .ringRecords = 16});
    const double value[] = {1};
    recorder.frame(stream, 0.5, value);
    clock.advance(std::chrono::seconds(1));  // nothing is recorded from now on
    const SteadyClock wall;
    std::uint64_t samples = 0;
    while (samples == 0 && wall.now() < std::chrono::seconds(20)) samples = verifySession(path)->samples;
    EXPECT_EQ(samples, 1U);
}

/// Locks the session as another program would: the writer's disk stalls until busy_timeout (2 s) is over.
class StalledDisk {
public:
    explicit StalledDisk(const std::filesystem::path& path) {
        EXPECT_EQ(sqlite3_open(path.c_str(), &database_), SQLITE_OK);
        EXPECT_EQ(sqlite3_exec(database_, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    }
    ~StalledDisk() {
        sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
        sqlite3_close(database_);
    }

private:
    sqlite3* database_ = nullptr;
};

TEST(SessionRecorder, AMarkWaitsForNoDiskAndHoldsUpNeitherLoopNorStop) {
    RecordProperty("hazard", "H2");
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    SteadyClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    {
        SessionRecorder recorder(*writer, {.ownThread = true, .ringRecords = 1024});
        recorder.event(clock.now(), "before", {});
        ASSERT_TRUE(recorder.drain());
        {
            const StalledDisk stalled(path);
            recorder.event(clock.now(), "waits for the disk", {});
            while (recorder.standsStillFor() < std::chrono::milliseconds(5)) std::this_thread::yield();
            const auto began = clock.now();
            for (int i = 0; i < 100; ++i) {
                recorder.mark(Instant(i), "table bumped");
                recorder.event(clock.now(), "of the loop", {});
                EXPECT_FALSE(recorder.failed());
            }
            EXPECT_GT(recorder.standsStillFor(), std::chrono::nanoseconds(0)) << "the disk still stood";
            EXPECT_IN_TIME(clock.now() - began < std::chrono::milliseconds(100));
        }
        ASSERT_TRUE(recorder.drain());
    }
    ASSERT_TRUE(writer->close());
    int marks = 0;
    const auto events = SessionReader::open(path)->events().value();
    for (const auto& event : events) {
        if (event.name != kOperatorMarkEvent) continue;
        EXPECT_EQ(event.at, Instant(marks++)) << "the moment is the one given";
        EXPECT_EQ(event.body, (nlohmann::json{{"text", "table bumped"}}));
    }
    EXPECT_EQ(marks, 100);
}

TEST(SessionRecorder, WithoutAThreadMarksAreWrittenByTheCallerThatTurnsTheBench) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    {
        SessionRecorder recorder(*writer, {.ownThread = false});
        recorder.mark(Instant(1), "first");
        recorder.writeMarks();
        EXPECT_EQ(SessionReader::open(path)->events()->size(), 1U);
        recorder.mark(Instant(2), "at the end");
    }
    EXPECT_EQ(SessionReader::open(path)->events()->size(), 2U);
}

}  // namespace
}  // namespace tacto
