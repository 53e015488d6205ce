// Kills a writer at random moments: a child process writes until SIGKILL, and the parent knows which rows the child was
// told are safe.
#include <map>
#include <random>
#include <signal.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include "core/session/SessionIndex.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using test::ScratchDir;

/// Writes until killed. Reports each acknowledgement on `pipe`: "e 3" for the third event, likewise for trials and
/// verdicts, and "s 12.34" for the time stamp of the last sample that append() took.
[[noreturn]] void writeForEver(const std::filesystem::path& path, int pipe) {
    test::HandClock clock;
    const auto say = [&](char what, double number) {
        char line[40];
        const int size = std::snprintf(line, sizeof line, "%c %.3f\n", what, number);
        if (write(pipe, line, static_cast<std::size_t>(size)) != size) _exit(1);
    };
    auto made = SessionWriter::create(path, test::someAbout(), clock);
    if (!made) _exit(2);
    auto& writer = **made;
    const auto stream = writer.addStream(SessionStream{"acceleration", "acceleration", "m/s2", {"x", "y"}, 1000});
    if (!stream) _exit(3);
    say('c', 0);
    for (int step = 0;; ++step) {
        clock.advance(std::chrono::milliseconds(20));
        const double t = toSeconds(clock.now());
        if (!writer.append(*stream, test::ramp(t, 1000, 20, 2))) _exit(4);
        say('s', t);
        if (!writer.command(clock.now(), "train", {{"n", step}})) _exit(5);
        if (step % 7 == 0 && writer.event(clock.now(), "step", {{"n", step / 7}})) say('e', step / 7 + 1);
        if (step % 11 == 0 && writer.trial(clock.now(), "c", {{"n", step / 11}})) say('t', step / 11 + 1);
        if (step % 29 == 0 && writer.verdict(clock.now(), "s", "pass", {}, {})) say('v', step / 29 + 1);
    }
}

struct Killed {
    std::map<char, double> acknowledged;  // the last number reported for each letter
};

/// Lets a child write at least `lines` acknowledgements, then kills it.
Killed killAfter(const std::filesystem::path& path, int lines) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        writeForEver(path, ends[1]);
    }
    close(ends[1]);
    Killed killed;
    FILE* said = fdopen(ends[0], "r");
    char line[64];
    int count = 0;
    while (std::fgets(line, sizeof line, said) != nullptr) {
        if (++count == lines) {
            EXPECT_TRUE(openElsewhere(path)) << "while another program records";
            EXPECT_EQ(kill(child, SIGKILL), 0);
        }
        killed.acknowledged[line[0]] = std::strtod(line + 2, nullptr);
    }
    std::fclose(said);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself with " << WEXITSTATUS(status);
    EXPECT_GE(count, lines);
    EXPECT_FALSE(openElsewhere(path)) << "what a crash left is not going on";
    return killed;
}

#ifdef TACTOSCOPE_SANITIZED
constexpr int kRounds = 6;
#else
constexpr int kRounds = 15;
#endif

TEST(SessionCrash, Kill9AtAnyMomentLosesNoAcknowledgedRowAndAtMostASecondOfSamples) {
    RecordProperty("hazard", "H8");
    std::mt19937 random(8);
    for (int round = 0; round < kRounds; ++round) {
        const ScratchDir dir;
        const auto path = dir.path() / "s.tacto";
        const int lines = 1 + static_cast<int>(random() % 900);
        SCOPED_TRACE("killed after " + std::to_string(lines) + " lines");
        auto said = killAfter(path, lines).acknowledged;
        const auto before = test::bytesOf(path);
        const auto journal = test::bytesOf(path.string() + "-wal");

        const auto report = verifySession(path).value();
        EXPECT_EQ(report.status, SessionStatus::Intact) << (report.problems.empty() ? "" : report.problems[0]);
        EXPECT_FALSE(report.closed);
        ASSERT_FALSE(report.notes.empty());
        EXPECT_NE(report.notes[0].find("ended without closing"), std::string::npos);
        EXPECT_GE(report.events, static_cast<std::uint64_t>(said['e']));
        EXPECT_GE(report.trials, static_cast<std::uint64_t>(said['t']));
        EXPECT_GE(report.verdicts, static_cast<std::uint64_t>(said['v']));
        EXPECT_EQ(test::bytesOf(path), before) << "verify changed the file";
        EXPECT_EQ(test::bytesOf(path.string() + "-wal"), journal) << "verify changed the journal";

        const auto reader = SessionReader::open(path);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_FALSE(reader->closed());
        EXPECT_EQ(reader->about().devices, test::someAbout().devices);
        const auto events = reader->events().value();
        for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].body["n"], i);
        const auto trials = reader->trials().value();
        for (std::size_t i = 0; i < trials.size(); ++i) EXPECT_EQ(trials[i].measured["n"], i);
        if (said['s'] > 1.0) {
            const auto samples = reader->samples(1).value();
            ASSERT_GT(samples.samples(), 0U);
            EXPECT_GE(samples.t_s.back(), said['s'] - 1.0);
            EXPECT_NEAR(samples.t_s.front(), 0.02, 1e-9);
        }
    }
}

TEST(SessionCrash, AFreshSessionThatIsKilledIsASessionToo) {
    RecordProperty("hazard", "H8");
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    killAfter(path, 1);
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
}

/// A session of some length that was killed, with its journal.
class SessionJournal : public testing::Test {
protected:
    void SetUp() override {
        RecordProperty("hazard", "H8");
        killAfter(path_, 400);
        whole_ = verifySession(path_).value();
        ASSERT_TRUE(whole_.recovered);
        ASSERT_EQ(whole_.notes.size(), 2U);
        EXPECT_NE(whole_.notes[1].find("recovered from the journal"), std::string::npos);
    }
    ScratchDir dir_;
    std::filesystem::path path_ = dir_.path() / "s.tacto";
    std::filesystem::path wal_ = dir_.path() / "s.tacto-wal";
    VerifyReport whole_;
};

TEST_F(SessionJournal, IsReadWithoutItsIndexFromAPrivateCopy) {
    std::filesystem::remove(dir_.path() / "s.tacto-shm");
    const auto report = verifySession(path_).value();
    EXPECT_EQ(report.status, SessionStatus::Intact);
    EXPECT_EQ(report.head, whole_.head);
    EXPECT_TRUE(report.recovered);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir_.path()), {}), 2) << "nothing new beside it";
}

TEST_F(SessionJournal, DamagedInTheMiddleIsFoundAlthoughSqliteSeesAnEarlierEnd) {
    const auto good = test::bytesOf(wal_);
    std::mt19937 random(5);
    for (int i = 0; i < 20; ++i) {
        auto bytes = good;
        const auto at = random() % (bytes.size() / 2);
        bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
        test::writeBytes(wal_, bytes);
        std::filesystem::remove(dir_.path() / "s.tacto-shm");
        const auto report = verifySession(path_).value();
        EXPECT_EQ(report.status, SessionStatus::Damaged) << "byte " << at;
    }
}

TEST_F(SessionJournal, TornInItsLastTransactionIsWhatACrashLeaves) {
    auto bytes = test::bytesOf(wal_);
    auto rows = whole_.rows;
    // An unfinished transaction may follow the last one; cutting it loses no row.
    for (int cuts = 0; cuts < 4 && rows == whole_.rows; ++cuts) {
        bytes.erase(bytes.end() - 5000, bytes.end());
        test::writeBytes(wal_, bytes);
        std::filesystem::remove(dir_.path() / "s.tacto-shm");
        const auto report = verifySession(path_).value();
        EXPECT_EQ(report.status, SessionStatus::Intact) << report.problems[0];
        rows = report.rows;
    }
    EXPECT_LT(rows, whole_.rows);
}

}  // namespace
}  // namespace tacto
