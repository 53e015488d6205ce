// PilotDesk.h - sessions of rehearsals by the built program: undisturbed, killed and resumed.
//
// Thread-safety: the test's own thread.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tests/cli/Shape.h"

namespace tacto::test {

/// One block of the test.
[[nodiscard]] Words shortSession();

class PilotDesk {
public:
    explicit PilotDesk(Words devices = {"sim:"}) : devices_(std::move(devices)) {}
    /// `run PROTOCOL --device sim: --out STUDY --json` with more words.
    [[nodiscard]] Ran run(const std::string& protocol, const Words& more, const std::string& study = "study") const;
    /// The same, killed when it makes something durable for the `sync`-th time. The code is -9 when it was.
    [[nodiscard]] int runKilled(long sync, const std::string& protocol, const Words& more,
                                const std::string& study = "study") const;
    /// The same on a disk that is full once a file has `bytes`. The exit code; stderr goes to `said`.
    [[nodiscard]] int runOnFullDisk(unsigned long bytes, std::string& said, const std::string& protocol,
                                    const Words& more, const std::string& study = "study") const;
    [[nodiscard]] const Desk& desk() const noexcept { return desk_; }

private:
    [[nodiscard]] int execute(const Words& environment, Words all, unsigned long largestFile,
                              const std::string& errors) const;
    [[nodiscard]] Words words(const std::string& protocol, const Words& more, const std::string& study) const;
    const Words devices_;
    const Desk desk_;
};

/// Plan and answers of a session's results, without what only says how often it was begun.
[[nodiscard]] std::string planAndAnswers(const nlohmann::json& value);

}  // namespace tacto::test
