// WrittenSessions.h - realistic sessions, written into the sessions folder and removed afterwards.
//
// Thread-safety: the test's own thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "app/run/RunFiles.h"
#include "core/base/Clock.h"
#include "core/session/SessionWriter.h"

namespace tacto::test {

struct WrittenSession {
    std::string name;
    std::string protocol = "separability";
    std::string verdict = "pass";
    double amplitude_v = 39.8;  ///< of the condition rough-high
    std::string wallStart = "2026-11-20T10:02:05Z";
    bool simulated = true;
};

class WrittenSessions {
public:
    WrittenSessions() : folder_(userSessionsFolder()) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~WrittenSessions() { std::filesystem::remove_all(folder_); }
    WrittenSessions(const WrittenSessions&) = delete;
    WrittenSessions& operator=(const WrittenSessions&) = delete;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

    /// Writes 25 trials of each condition, a mark, a refusal and a run's own records; closed, and ten seconds old.
    std::filesystem::path write(const WrittenSession& wanted) const {
        const auto path = folder_ / (wanted.name + ".tacto");
        VirtualClock clock;
        SessionAbout about;
        about.programVersion = "1.5.0";
        about.protocol = wanted.protocol;
        about.parameters = {
            {"repeats", 25}, {"rate", "1M"}, {"keep", true}, {"grid", {{"rows", 3}, {"steps_v", {5, 10}}}}};
        about.seed = 7;
        about.devices = {{"sim:stimulator", "stimulator", "simulated stimulator", "SIM-1", "1", wanted.simulated}};
        about.profileJson = R"({"encoding": {"A_max_v": 40}})";
        about.simulated = wanted.simulated;
        about.mode = "bench load";
        about.wallStart = wanted.wallStart;
        auto made = SessionWriter::create(path, about, clock);
        EXPECT_TRUE(made) << made.error().message;
        auto& session = **made;
        const auto pass = [&](double seconds) { clock.advanceTo(clock.now() + toInstant(seconds)); };
        EXPECT_TRUE(session.reportItem(
            clock.now(),
            {{"kind", "about"},
             {"parameters",
              {{{"name", "repeats"}, {"label", "Repeats per condition"}, {"value", 25}, {"unit", ""}},
               {{"name", "rate"}, {"label", "Sample rate"}, {"value", "1M"}, {"unit", ""}, {"shown", "1 MS/s"}}}}}));
        EXPECT_TRUE(session.event(clock.now(), "interlock", {{"text", "armed"}}));
        const std::pair<const char*, std::pair<double, double>> conditions[] = {
            {"smooth-low", {10, 2}},
            {"smooth-high", {10, 0.5}},
            {"rough-low", {40, 2}},
            {"rough-high", {wanted.amplitude_v, 0.5}}};
        for (int trial = 0; wanted.protocol == "separability" && trial < 100; ++trial) {
            pass(1);
            const auto& [condition, features] = conditions[trial % 4];
            const double noise = 0.02 * (trial / 4 % 5 - 2);  // with mean 0
            EXPECT_TRUE(session.trial(clock.now(), condition,
                                      {{"amplitude_v", features.first + noise}, {"interval_s", features.second}}));
        }
        EXPECT_TRUE(session.event(toInstant(12.3), kOperatorMarkEvent, {{"text", "table bumped"}}));
        EXPECT_TRUE(session.event(clock.now(), "refused", {{"text", "RMS current, 5 s, would be 11.2 mA of 10 mA"}}));
        EXPECT_TRUE(session.event(clock.now(), "settings",
                                  {{"changed", {"encoding.A_max_v"}}, {"profile", {{"encoding", {{"A_max_v", 40}}}}}}));
        EXPECT_TRUE(session.event(clock.now(), "device report", {{"lost_packets", 3}, {"text", "packets were lost"}}));
        EXPECT_TRUE(
            session.reportItem(clock.now(), {{"kind", "notes"}, {"operator", "A. Weber"}, {"sample", "S-014"}}));
        EXPECT_TRUE(session.log(clock.now(), "info", "100 trials done"));
        if (!wanted.verdict.empty()) {
            EXPECT_TRUE(session.verdict(clock.now(), "separability", wanted.verdict, {"98 of 100 told apart"},
                                        {{"accuracy", wanted.verdict == "pass" ? 0.98 : 0.71}}));
        }
        EXPECT_TRUE(session.close());
        age(path);
        return path;
    }
    /// Makes a session look as if it was last changed ten seconds ago.
    static void age(const std::filesystem::path& path) {
        std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) - std::chrono::seconds(10));
    }

private:
    const std::filesystem::path folder_;
};

}  // namespace tacto::test
