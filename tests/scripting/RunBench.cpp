#include "tests/scripting/RunBench.h"

#include <gtest/gtest.h>

#include "core/devices/Registry.h"
#include "drivers/simulated/SimulatedDriver.h"

namespace tacto::test {

RunBench::RunBench(bool virtualTime, std::string device, std::uint64_t seed, bool recorded, std::set<Role> needed,
                   bool looksReal, const KnownLines& calibration) {
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
    config.limits = limitSets();
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

RunRequest RunBench::request(ProtocolSource source) {
    RunRequest out;
    out.script = std::move(source);
    out.bench = bench_.get();
    out.asked = bench_->stops().mark();
    out.session = writer_.get();
    out.seed = seed_;
    out.operatorDesk = technician_.get();
    return out;
}

RunRequest RunBench::shipped(const std::string& protocol, const std::map<std::string, std::string>& settings) {
    auto source = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find(protocol).value();
    auto declaration = readDeclaration(source).value();
    auto applied = applySettings(declaration, settings).value();
    auto out = request(std::move(source));
    out.declaration = std::move(declaration);
    out.parameters = std::move(applied.parameters);
    out.operatorGave = std::move(applied.given);
    return out;
}

ScriptOutcome RunBench::stoppedAt(int trial, const std::string& protocol,
                                  const std::map<std::string, std::string>& settings) {
    auto request = shipped(protocol, settings);
    int trials = 0;
    // Called on the script's own thread, at the same moment in every run: the bench's next call reports the stop.
    request.onTrial = [&](const nlohmann::json&) {
        if (++trials == trial) bench_->stop("the test");
    };
    auto outcome = runProtocol(std::move(request)).value();
    EXPECT_TRUE(outcome.error && outcome.error->code == ErrorCode::Stopped);
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
    EXPECT_TRUE(outputOff());
    return outcome;
}

bool RunBench::outputOff() const {
    const auto state = bench_->telemetry().state;
    return state != InterlockState::Armed && state != InterlockState::Delivering && state != InterlockState::Checking;
}

}  // namespace tacto::test
