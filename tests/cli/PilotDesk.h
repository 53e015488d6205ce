// PilotDesk.h - runs rehearsal sessions with the built program: undisturbed, killed and resumed.
//
// Thread-safety: the test's own thread.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/cli/Shape.h"

namespace tacto::test {

/// Returns settings for a session with one block of the test.
[[nodiscard]] Words shortSession();

/// A disturbance of the program that runs a session.
struct Disturbance {
    long killAtSync = 0;            ///< kills the program at its n-th write that must reach the disk; 0: never
    unsigned long largestFile = 0;  ///< in bytes: the disk is full once a file is this large; 0: never
    std::chrono::seconds clock{0};  ///< how far ahead the wall clock is
    long clockFromSync = 0;         ///< `clock` applies from the n-th such write on; 0: from the beginning
};

/// A row as anyone with the keys can write it.
struct WrittenRow {
    const char* kind;
    nlohmann::json body;
};

class PilotDesk {
public:
    explicit PilotDesk(Words devices = {"sim:"}) : devices_(std::move(devices)) {}
    /// Runs `run PROTOCOL --device sim: --out STUDY --json` with more words.
    [[nodiscard]] Ran run(const std::string& protocol, const Words& more, const std::string& study = "study") const;
    /// Runs the protocol with a disturbance. The exit code is -9 if the program was killed.
    [[nodiscard]] Ran runDisturbed(const Disturbance& by, const std::string& protocol, const Words& more,
                                   const std::string& study = "study") const;
    /// Returns the exit code of a run that is killed at its `sync`-th durable row.
    [[nodiscard]] int runKilled(long sync, const std::string& protocol, const Words& more,
                                const std::string& study = "study") const;
    /// Makes a rehearsal in which virtual:7 has an unfinished session with these rows, begun at `begun`.
    void writeUnfinished(const std::string& study, const std::string& protocol, const std::vector<WrittenRow>& rows,
                         std::chrono::sys_seconds begun) const;
    [[nodiscard]] const Desk& desk() const noexcept { return desk_; }

private:
    [[nodiscard]] Words words(const std::string& protocol, const Words& more, const std::string& study) const;
    const Words devices_;
    const Desk desk_;
};

[[nodiscard]] Words operator+(Words words, const Words& more);

/// Returns plan and answers of a session's results, without what depends only on the number of restarts.
[[nodiscard]] std::string planAndAnswers(const nlohmann::json& value);

}  // namespace tacto::test
