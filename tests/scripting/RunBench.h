// RunBench.h - a simulated bench to run scripts on, with or without a session file; it can also look like a real
// laboratory bench.
//
// Thread-safety: the test's own thread; the bench has its own rules.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/bench/Bench.h"
#include "core/session/SessionWriter.h"
#include "tests/scripting/Technician.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {

/// Returns a script with a path that can be recognised in its errors: "/lab/probe.js".
[[nodiscard]] inline ProtocolSource probe(std::string body) {
    ProtocolSource source;
    source.name = "probe";
    source.path = "/lab/probe.js";
    source.text = std::move(body);
    return source;
}

class RunBench {
public:
    explicit RunBench(bool virtualTime = true, std::string device = "sim:", std::uint64_t seed = 1,
                      bool recorded = false,
                      std::set<Role> needed = {Role::Sensor, Role::Stimulator, Role::Oscilloscope},
                      bool looksReal = false, const KnownLines& calibration = {});

    [[nodiscard]] RunRequest request(std::string script) { return request(probe(std::move(script))); }
    [[nodiscard]] RunRequest request(ProtocolSource source);
    /// Returns a request for a shipped protocol with settings like those of --set.
    [[nodiscard]] RunRequest shipped(const std::string& protocol, const std::map<std::string, std::string>& settings);
    [[nodiscard]] ScriptOutcome run(std::string script) { return runProtocol(request(std::move(script))).value(); }

    /// Runs a shipped protocol that the operator stops at the n-th trial, and checks that the outputs are off.
    [[nodiscard]] ScriptOutcome stoppedAt(int trial, const std::string& protocol,
                                          const std::map<std::string, std::string>& settings);

    [[nodiscard]] Bench& bench() { return *bench_; }
    [[nodiscard]] SessionWriter& writer() { return *writer_; }
    [[nodiscard]] bool outputOff() const;
    /// The technician, if the bench looks real.
    [[nodiscard]] Technician& technician() { return *technician_; }
    [[nodiscard]] const ScratchDir& folder() const { return folder_; }
    void closeBench() { bench_.reset(); }

private:
    ScratchDir folder_;
    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Technician> technician_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<Bench> bench_;
    std::uint64_t seed_ = 1;
};

/// Returns the shortest valid script, with `body` inside run() from line 2 on.
[[nodiscard]] inline std::string withRun(const std::string& body) {
    return "protocol({ title: \"Probe\" }); function run(p) {\n" + body + "\n}\n";
}

}  // namespace tacto::test
