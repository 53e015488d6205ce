// RunBench.h - a simulated bench to run scripts on, with or without a session file; or one that looks like a
// laboratory's own.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "app/scripting/ProtocolLibrary.h"
#include "app/scripting/ScriptRun.h"
#include "core/bench/Bench.h"
#include "core/session/SessionWriter.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/scripting/Technician.h"
#include "tests/support/Support.h"

namespace tacto::test {

/// A script as text, named so that its errors can be recognised: "/lab/probe.js".
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
                      bool looksReal = false, const KnownLines& calibration = {}) {
        if (virtualTime) {
            clock_ = std::make_shared<VirtualClock>();
        } else {
            clock_ = std::make_shared<SteadyClock>();
        }
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        std::vector<DeviceUri> uris = {DeviceUri::parse(device).value()};
        if (device != "sim:") uris.push_back(DeviceUri::parse("sim:").value());
        BenchConfig config;
        config.devices = registry.open(uris, needed, OpenContext{*clock_, seed, "1 kohm"}).value();
        if (looksReal) technician_ = lookReal(config.devices);
        config.clock = clock_;
        config.calibration = calibration;
        config.limits = loadLimitSets(sourceDir() / "resources" / "limits").value();
        if (recorded) {
            SessionAbout about;
            about.protocol = "probe";
            about.seed = seed;
            about.simulated = true;
            writer_ = SessionWriter::create(folder_.path() / "run.tacto", about, *clock_).value();
            config.session = writer_.get();
        }
        bench_ = Bench::create(std::move(config)).value();
        seed_ = seed;
    }

    [[nodiscard]] RunRequest request(std::string script) { return request(probe(std::move(script))); }
    [[nodiscard]] RunRequest request(ProtocolSource source) {
        RunRequest out;
        out.script = std::move(source);
        out.bench = bench_.get();
        out.asked = bench_->stops().mark();
        out.session = writer_.get();
        out.seed = seed_;
        out.operatorDesk = technician_.get();
        return out;
    }
    /// A shipped protocol, with what --set would give.
    [[nodiscard]] RunRequest shipped(const std::string& protocol, const std::map<std::string, std::string>& settings) {
        auto source = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find(protocol).value();
        auto declaration = readDeclaration(source).value();
        auto applied = applySettings(declaration, settings).value();
        auto out = request(std::move(source));
        out.declaration = std::move(declaration);
        out.parameters = std::move(applied.parameters);
        out.operatorGave = std::move(applied.given);
        return out;
    }
    [[nodiscard]] ScriptOutcome run(std::string script) { return runProtocol(request(std::move(script))).value(); }

    [[nodiscard]] Bench& bench() { return *bench_; }
    [[nodiscard]] SessionWriter& writer() { return *writer_; }
    [[nodiscard]] bool outputOff() const {
        const auto state = bench_->telemetry().state;
        return state != InterlockState::Armed && state != InterlockState::Delivering &&
               state != InterlockState::Checking;
    }
    /// Of a bench that looks real.
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

/// The least that a script needs, with `body` as run's body from line 2 on.
[[nodiscard]] inline std::string withRun(const std::string& body) {
    return "protocol({ title: \"Probe\" }); function run(p) {\n" + body + "\n}\n";
}

}  // namespace tacto::test
