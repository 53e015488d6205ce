// SessionSupport.h - shared by the session tests: a clock set by hand, a complete SessionAbout, changes by SQL.
//
// Thread-safety: only the test's thread.
#pragma once

#include <atomic>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sqlite3.h>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/session/SessionWriter.h"
#include "tests/support/Support.h"

namespace tacto::test {

/// A clock that claims to be steady but moves only when told, so that tests need no real time.
class HandClock final : public Clock {
public:
    [[nodiscard]] Instant now() const noexcept override { return Instant(now_.load()); }
    [[nodiscard]] bool isVirtual() const noexcept override { return false; }
    void advance(Instant by) noexcept { now_ += by.count(); }

private:
    std::atomic<Instant::rep> now_{0};
};

inline SessionAbout someAbout() {
    SessionAbout about;
    about.programVersion = "0.1.0";
    about.protocol = "separability";
    about.protocolSha256 = std::string(64, 'a');
    about.parameters = {{"repeats", 25}, {"load", 1000.5}};
    about.seed = 18'446'744'073'709'551'615U;
    about.devices = {{"sim:stimulator?mode=current", "stimulator", "Simulated stimulator", "SIM-1", "1.0", true}};
    about.profileJson = R"({"A_max": 40})";
    about.limitSets = {{"paper", std::string(64, 'b')}};
    about.simulated = true;
    about.mode = "bench load";
    about.wallStart = "2026-11-20T14:03:05Z";
    about.wallStartAt = Instant(12'345);
    return about;
}

inline SampleBlock ramp(double t0, double rate, std::size_t samples, std::size_t columns) {
    SampleBlock block;
    for (std::size_t i = 0; i < samples; ++i) {
        block.t_s.push_back(t0 + static_cast<double>(i) / rate);
        for (std::size_t c = 0; c < columns; ++c) block.values.push_back(t0 + static_cast<double>(i * columns + c));
    }
    return block;
}

inline bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline std::vector<char> bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeBytes(const std::filesystem::path& path, const std::vector<char>& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Returns every value of every row and table, with its type, as another program reads them, or an error mark.
inline std::string everythingIn(const std::filesystem::path& path) {
    sqlite3* database = nullptr;
    std::string all;
    const std::string uri = "file:" + path.string() + "?immutable=1";
    if (sqlite3_open_v2(uri.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr) != SQLITE_OK)
        all = "!";
    for (const char* sql : {"SELECT * FROM entries ORDER BY seq", "SELECT * FROM chunks ORDER BY seq",
                            "SELECT * FROM captures ORDER BY seq", "SELECT * FROM sqlite_schema ORDER BY name"}) {
        sqlite3_stmt* rows = nullptr;
        int code = sqlite3_prepare_v2(database, sql, -1, &rows, nullptr);
        while (code == SQLITE_OK || code == SQLITE_ROW) {
            code = sqlite3_step(rows);
            if (code != SQLITE_ROW) break;
            for (int c = 0; c < sqlite3_column_count(rows); ++c) {
                all += std::to_string(sqlite3_column_type(rows, c)) + ":";
                const auto* data = static_cast<const char*>(sqlite3_column_blob(rows, c));
                if (data != nullptr) all.append(data, static_cast<std::size_t>(sqlite3_column_bytes(rows, c)));
                all += "|";
            }
        }
        if (code != SQLITE_DONE) all += "!";
        sqlite3_finalize(rows);
    }
    sqlite3_close(database);
    return all;
}

inline void runSql(const std::filesystem::path& path, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    char* message = nullptr;
    ASSERT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &message), SQLITE_OK) << message << "\n" << sql;
    sqlite3_close(database);
}

/// Runs `sql` without the append-only triggers and restores them, like a careful forger: the schema shows nothing.
inline void forge(const std::filesystem::path& path, const std::string& sql) {
    std::string drop;
    std::string restore;
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    sqlite3_stmt* rows = nullptr;
    ASSERT_EQ(
        sqlite3_prepare_v2(database, "SELECT name, sql FROM sqlite_schema WHERE type='trigger'", -1, &rows, nullptr),
        SQLITE_OK);
    while (sqlite3_step(rows) == SQLITE_ROW) {
        drop += std::string("DROP TRIGGER ") + reinterpret_cast<const char*>(sqlite3_column_text(rows, 0)) + ";";
        restore += std::string(reinterpret_cast<const char*>(sqlite3_column_text(rows, 1))) + ";";
    }
    sqlite3_finalize(rows);
    sqlite3_close(database);
    ASSERT_FALSE(drop.empty());
    runSql(path, drop + sql + ";" + restore);
}

/// Writes a closed session with a few rows of every kind.
inline void writeSession(const std::filesystem::path& path, std::uint64_t seed = 1) {
    VirtualClock clock;
    auto about = someAbout();
    about.seed = seed;
    auto writer = SessionWriter::create(path, about, clock);
    ASSERT_TRUE(writer) << writer.error().message;
    auto& session = **writer;
    const auto acceleration =
        session.addStream(SessionStream{"fingertip accelerometer", "acceleration", "m/s2", {"x", "y", "z"}, 1000});
    const auto frames = session.addStream(SessionStream{"roughness frames", "frames", "", {"R", "P"}, 0});
    ASSERT_TRUE(acceleration && frames);
    ASSERT_TRUE(session.event(clock.now(), "armed", {{"load", "1 kohm"}}));
    for (int second = 0; second < 3; ++second) {
        for (int part = 0; part < 10; ++part) {
            const double t = second + part / 10.0;
            clock.advanceTo(toInstant(t));
            ASSERT_TRUE(session.append(*acceleration, ramp(t, 1000, 100, 3)));
            SampleBlock frame;
            frame.t_s = {t, t + 0.03 * (part % 3)};
            frame.values = {0.5, 0.25, std::nan(""), 1};
            ASSERT_TRUE(session.append(*frames, frame));
            ASSERT_TRUE(session.command(clock.now(), "train", {{"amplitude_v", 10 + part}, {"pulses", 1}}));
        }
        const auto trial = session.trial(clock.now(), second % 2 == 0 ? "rough-high" : "smooth-low",
                                         {{"amplitude_v", 39.9}, {"interval_s", 0.5}});
        ASSERT_TRUE(trial);
        Capture capture;
        capture.rate_hz = 1e6;
        capture.start_s = second;
        capture.trigger_s = second == 2 ? std::nan("") : second + 0.001;
        capture.simulated = true;
        capture.channels = {{"voltage", "V", {}, -50, 50, 0.4, 0.01, 0.2},
                            {"current", "A", {}, -0.2, 0.2, 0.001, 0, 0}};
        for (int i = 0; i < 2000; ++i) {
            capture.channels[0].samples.push_back(static_cast<float>(i % 300 < 20 ? 40.0 + 0.4 * (i % 2) : 0.0));
            capture.channels[1].samples.push_back(static_cast<float>(i % 300 < 20 ? 0.04 : -0.0));
        }
        ASSERT_TRUE(session.capture(clock.now(), capture, *trial));
    }
    ASSERT_TRUE(session.measurement(clock.now(), "impedance", {{"ohm", 1001.5}}));
    ASSERT_TRUE(session.reportItem(clock.now(), {{"kind", "text"}, {"text", "Four conditions"}}));
    ASSERT_TRUE(session.reportItem(clock.now(), {{"kind", "table"}, {"title", "Pairs"}, {"columns", {"a", "b"}}}));
    ASSERT_TRUE(session.log(clock.now(), "info", "all \"done\"\nwith µ"));
    ASSERT_TRUE(session.verdict(clock.now(), "separability", "pass", {"every pair apart"}, {{"accuracy", 1.0}}));
    ASSERT_TRUE(session.close());
}

}  // namespace tacto::test
