// PilotDesk.h - sessions of rehearsals by the built program: undisturbed, killed and resumed.
//
// Thread-safety: the test's own thread.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/cli/Shape.h"

namespace tacto::test {

/// One block of the test.
[[nodiscard]] Words shortSession();

/// The disturbance of a session's program.
struct Disturbance {
    long killAtSync = 0;            ///< it is killed when it makes something durable for the n-th time; 0: never
    unsigned long largestFile = 0;  ///< bytes: the disk is full once a file has them; 0: it never is
    std::chrono::seconds clock{0};  ///< how far ahead the clock on the wall is
    long clockFromSync = 0;         ///< the n-th time from which this holds; 0: from its beginning
};

/// A row as someone with the keys can write it.
struct WrittenRow {
    const char* kind;
    nlohmann::json body;
};

class PilotDesk {
public:
    explicit PilotDesk(Words devices = {"sim:"}) : devices_(std::move(devices)) {}
    /// `run PROTOCOL --device sim: --out STUDY --json` with more words.
    [[nodiscard]] Ran run(const std::string& protocol, const Words& more, const std::string& study = "study") const;
    /// Runs it disturbed. The code is -9 where it was killed.
    [[nodiscard]] Ran runDisturbed(const Disturbance& by, const std::string& protocol, const Words& more,
                                   const std::string& study = "study") const;
    /// The code of one that is killed at its `sync`-th durable row.
    [[nodiscard]] int runKilled(long sync, const std::string& protocol, const Words& more,
                                const std::string& study = "study") const;
    /// A rehearsal in which virtual:7 has an unfinished session of these rows, begun then.
    void writeUnfinished(const std::string& study, const std::string& protocol, const std::vector<WrittenRow>& rows,
                         std::chrono::sys_seconds begun) const;
    [[nodiscard]] const Desk& desk() const noexcept { return desk_; }

private:
    [[nodiscard]] Words words(const std::string& protocol, const Words& more, const std::string& study) const;
    const Words devices_;
    const Desk desk_;
};

[[nodiscard]] Words operator+(Words words, const Words& more);

/// Plan and answers of a session's results, without what only says how often it was begun.
[[nodiscard]] std::string planAndAnswers(const nlohmann::json& value);

}  // namespace tacto::test
