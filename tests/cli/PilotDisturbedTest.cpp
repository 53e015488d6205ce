// Disturbances of a session other than being killed: the disk is full, the clock is moved, a part of the record is
// missing or belongs to another session. The session is refused, or continues as if nothing had happened.
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Clock.h"
#include "core/study/StudyBook.h"
#include "tests/cli/PilotDesk.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr const char* kSession = "pilot-identification";
const Words kResume{"--set", "unfinished=resume"};
constexpr long kAmongItsRows = 200;

class DisturbedSession : public testing::Test {
protected:
    /// Expects a refusal with this exit code and text, and an unchanged study.
    void expectUnchanged(const Disturbance& by, int code, const char* says, const std::string& study) {
        SCOPED_TRACE(says);
        const auto before = desk.desk().files(study);
        const auto ran = desk.runDisturbed(by, kSession, shortSession() + kResume, study);
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_THAT(ran.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        expectSame(before, desk.desk().files(study));
    }
    /// All files except the index that SQLite keeps next to a log.
    using Files = std::map<std::string, std::string>;
    static void expectSame(const Files& before, const Files& after) {
        for (const auto& [name, bytes] : before) {
            if (name.ends_with("-shm")) continue;
            ASSERT_TRUE(after.contains(name)) << name << " is gone";
            EXPECT_TRUE(after.at(name) == bytes) << name << " was changed";
        }
        EXPECT_EQ(after.size(), before.size()) << "and there are others";
    }
    /// A killed program leaves logs; the next program that opens the study includes them, whatever else it does.
    void takeIn(const std::string& study) const {
        const auto asked = desk.run(kSession, shortSession(), study);
        EXPECT_EQ(asked.code, 3) << asked.err;
        EXPECT_THAT(asked.err, HasSubstr("is unfinished"));
    }
    void copy(const std::string& from, const std::string& to) const {
        fs::copy(desk.desk().at(from), desk.desk().at(to), fs::copy_options::recursive);
    }
    [[nodiscard]] std::string undisturbed() const {
        const auto ran = desk.run(kSession, shortSession(), "whole");
        EXPECT_EQ(ran.code, 0) << ran.err;
        return planAndAnswers(jsonOf(ran));
    }
    [[nodiscard]] Json shown(const std::string& study) const {
        return jsonOf(desk.desk().run({"study", "show", desk.desk().at(study), "--json"}));
    }

    const PilotDesk desk;
};

TEST_F(DisturbedSession, OnADiskThatIsFullAtAnyTimeItEndsAndGoesOnOnceThereIsRoom) {
    RecordProperty("hazard", "H8");
    const auto expected = undisturbed();
    const unsigned long step = trials<unsigned long>({.local = 90'000, .ci = 12'000, .campaign = 4'096});
    for (unsigned long bytes = 4'096; bytes < 400'000; bytes += step) {
        SCOPED_TRACE(bytes);
        const auto study = "full at " + std::to_string(bytes);
        const auto full = desk.runDisturbed({.largestFile = bytes}, kSession, shortSession(), study);
        if (full.code == 0) break;  // the session needs no larger file
        EXPECT_EQ(full.code, 3) << full.err;
        EXPECT_THAT(full.err, HasSubstr("tactoscope-cli: "));
        EXPECT_TRUE(full.out.empty() || !jsonOf(full)["results"].contains("confusion")) << "no result";
        const auto ran = desk.run(kSession, shortSession() + kResume, study);
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(planAndAnswers(jsonOf(ran)), expected);
        EXPECT_EQ(desk.desk().run({"verify", desk.desk().at(study)}).code, 0);
    }
}

TEST_F(DisturbedSession, WithAClockThatWasMovedBetweenItsPartsItIsRefusedOrGoesOnUnchanged) {
    RecordProperty("hazard", "H8");
    const auto expected = undisturbed();
    const auto now = [] { return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()); };
    const auto made = utcDay(now());
    ASSERT_EQ(desk.runKilled(kAmongItsRows, kSession, shortSession()), -9);
    takeIn("study");
    expectUnchanged({.clock = 3h}, 4, "it can go on within 2 h", "study");
    expectUnchanged({.clock = 24h * 365}, 4, "it can go on within 2 h", "study");
    expectUnchanged({.clock = -1h}, 4, "set the clock", "study");
    expectUnchanged({.clock = -6min}, 4, "and the ledger's last row is of", "study");
    copy("study", "earlier");
    for (const auto& [study, clock] :
         {std::pair<const char*, std::chrono::seconds>{"study", 50min}, {"earlier", -4min}}) {
        if (utcDay(now() + clock) < made) {  // just after midnight: a rehearsal's approval begins on that day
            expectUnchanged({.clock = clock}, 4, "sessions can begin from that day on", study);
            continue;
        }
        const auto ran = desk.runDisturbed({.clock = clock}, kSession, shortSession() + kResume, study);
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(planAndAnswers(jsonOf(ran)), expected);
        EXPECT_EQ(desk.desk().run({"verify", desk.desk().at(study)}).code, 0);
    }
}

TEST_F(DisturbedSession, WithAClockBehindItsLastAnswerItIsRefused) {
    RecordProperty("hazard", "H8");
    // The session continued for half an hour for which the ledger has no row.
    const auto then = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()) + 30min;
    ASSERT_NO_FATAL_FAILURE(
        desk.writeUnfinished("study", kSession, {{"trial-begin", {{"name", "ascending 1"}}}}, then));
    expectUnchanged({}, 4, "and what was last presented or answered is of", "study");
}

TEST_F(DisturbedSession, GoingOnAndOffAgainExtendsNothing) {
    RecordProperty("hazard", "H12");
    constexpr long kBeforeAnythingIsPresented = 12;
    ASSERT_EQ(desk.runKilled(kAmongItsRows, kSession, shortSession()), -9);
    takeIn("study");
    const auto again = desk.runDisturbed({.killAtSync = kBeforeAnythingIsPresented, .clock = 90min}, kSession,
                                         shortSession() + kResume);
    ASSERT_EQ(again.code, -9) << again.err;
    EXPECT_EQ(desk.runDisturbed({.clock = 90min}, kSession, shortSession()).code, 3) << "it is taken in";
    expectUnchanged({.clock = 150min}, 4, "it can go on within 2 h", "study");
}

TEST_F(DisturbedSession, WithAClockThatIsMovedWhileItRunsNoFurtherBlockBegins) {
    RecordProperty("hazard", "H12");
    const Words twoBlocks{"--set", "participant=virtual:7", "--set", "blocks=2"};
    for (const auto& [study, clock, says] :
         {std::tuple<const char*, std::chrono::seconds, const char*>{"later", 61min, "so no further block begins"},
          {"earlier", -10min, "set the clock"}}) {
        SCOPED_TRACE(study);
        // The clock is moved during the thresholds: the first block must notice that too.
        const auto before = desk.runDisturbed({.clock = clock, .clockFromSync = 60}, kSession, twoBlocks,
                                              std::string(study) + " at once");
        EXPECT_EQ(before.code, 4) << before.err;
        EXPECT_THAT(before.err, HasSubstr(says));
        const auto at = std::string(study) + " at once";
        auto sessions = shown(at)["sessions"];
        ASSERT_EQ(sessions.size(), 1U);
        EXPECT_EQ(sessions[0]["state"], "stopped");
        const auto code = sessions[0]["code"].get<std::string>();
        const auto listed = jsonOf(desk.desk().run({"study", "trials", desk.desk().at(at), code, "--json"}));
        for (const auto& trial : listed["trials"]) EXPECT_NE(trial["phase"], "test") << trial.dump();
        EXPECT_TRUE(listed["open"].empty());
    }
}

TEST_F(DisturbedSession, WithAPartThatWasCutShortExchangedOrTakenAwayItIsRefused) {
    RecordProperty("hazard", "H8");
    static_cast<void>(undisturbed());
    ASSERT_EQ(desk.runKilled(kAmongItsRows, kSession, shortSession()), -9);
    const auto parts = desk.desk().named("study/sessions", ".tacto");
    ASSERT_EQ(parts.size(), 1U);
    const auto first = fs::path(parts[0]).filename();
    ASSERT_EQ(desk.runKilled(40, kSession, shortSession() + kResume), -9);
    takeIn("study");
    const auto others = desk.desk().named("whole/sessions", ".tacto");
    ASSERT_EQ(others.size(), 1U);
    const auto another = fs::path(desk.desk().at("whole")) / "sessions" / fs::path(others[0]).filename();
    const std::pair<const char*, std::function<void(const fs::path&)>> hands[] = {
        {"cut short", [](const fs::path& part) { fs::resize_file(part, fs::file_size(part) / 2); }},
        {"emptied", [](const fs::path& part) { fs::resize_file(part, 0); }},
        {"exchanged",
         [&](const fs::path& part) { fs::copy_file(another, part, fs::copy_options::overwrite_existing); }},
        {"taken away", [](const fs::path& part) { fs::remove(part); }},
        {"a link",
         [](const fs::path& part) {
             fs::rename(part, part.string() + ".elsewhere"), fs::create_symlink("nowhere", part);
         }},
    };
    for (const auto& [what, hand] : hands) {
        SCOPED_TRACE(what);
        copy("study", what);
        const auto part = fs::path(desk.desk().at(what)) / "sessions" / first;
        for (const char* beside : {"-wal", "-shm"}) fs::remove(part.string() + beside);
        hand(part);
        const auto before = desk.desk().files(what);
        const auto ran = desk.run(kSession, shortSession() + kResume, what);
        EXPECT_TRUE(ran.code == 4 || ran.code == 3) << ran.code << ran.err;
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        expectSame(before, desk.desk().files(what));
        EXPECT_EQ(desk.desk().run({"verify", desk.desk().at(what)}).code, 1);
    }
    EXPECT_EQ(desk.run(kSession, shortSession() + kResume).code, 0) << "as it was it goes on";
}

}  // namespace
}  // namespace tacto::test
