// LoadSafetyRig.h - runs the shipped load-safety protocol on a simulated bench with the devices of given URIs.
//
// Thread-safety: the test's own thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/bench/Bench.h"
#include "core/devices/Registry.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionWriter.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {

class LoadSafetyRig {
public:
    explicit LoadSafetyRig(const std::vector<std::string>& uris, std::uint64_t seed = 1, bool recorded = false,
                           const KnownLines& calibration = {})
        : clock_(std::make_shared<VirtualClock>()), seed_(seed) {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        std::vector<DeviceUri> parsed;
        for (const auto& uri : uris) parsed.push_back(DeviceUri::parse(uri).value());
        parsed.push_back(DeviceUri::parse("sim:").value());
        BenchConfig config;
        config.devices =
            registry.open(parsed, {Role::Stimulator, Role::Oscilloscope}, OpenContext{*clock_, seed, "1 kohm"}).value();
        config.clock = clock_;
        config.limits = limitSets();
        config.calibration = calibration;
        if (recorded) {
            SessionAbout about;
            about.protocol = "load-safety";
            about.seed = seed;
            about.simulated = true;
            writer_ = SessionWriter::create(folder_.path() / "run.tacto", about, *clock_).value();
            config.session = writer_.get();
        }
        bench_ = Bench::create(std::move(config)).value();
    }

    [[nodiscard]] RunRequest request(const std::map<std::string, std::string>& settings) {
        const ProtocolLibrary library(sourceDir() / "resources" / "protocols", {});
        RunRequest out;
        out.script = library.find("load-safety").value();
        auto applied = applySettings(readDeclaration(out.script).value(), settings).value();
        out.parameters = std::move(applied.parameters);
        out.operatorGave = std::move(applied.given);
        out.bench = bench_.get();
        out.asked = bench_->stops().mark();
        out.session = writer_.get();
        out.seed = seed_;
        return out;
    }
    [[nodiscard]] ScriptOutcome run(const std::map<std::string, std::string>& settings = {{"area", "3"},
                                                                                          {"steps", "2"}}) {
        return runProtocol(request(settings)).value();
    }

    [[nodiscard]] Bench& bench() { return *bench_; }
    [[nodiscard]] double now_s() const { return toSeconds(clock_->now()); }
    [[nodiscard]] bool outputOff() const {
        const auto state = bench_->telemetry().state;
        return state == InterlockState::Disarmed || state == InterlockState::Faulted;
    }
    /// Closes bench and session; returns the session's report items.
    [[nodiscard]] std::vector<nlohmann::json> reportItems() {
        bench_.reset();
        if (!writer_->close()) return {};
        std::vector<nlohmann::json> out;
        const auto rows = SessionReader::open(folder_.path() / "run.tacto").value().reportItems().value();
        for (const auto& row : rows) out.push_back(row.body);
        return out;
    }

private:
    ScratchDir folder_;
    std::shared_ptr<VirtualClock> clock_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<Bench> bench_;
    std::uint64_t seed_;
};

/// Returns the entry of a load in a run's results.
[[nodiscard]] inline nlohmann::json loadOf(const nlohmann::json& results, std::string_view name) {
    for (const auto& load : results.at("loads")) {
        if (load.at("name") == name) return load;
    }
    return {};
}

}  // namespace tacto::test
