// A host for SuspendTest: a whole bench on the steady clock, which signals stop and continue. For each train that it
// writes to its device it prints a line with the time of CLOCK_MONOTONIC in nanoseconds.
//
//   suspend_host sim | massager | pulsepal (emulated in this process) | /dev/pts/3 (a ScienceMode stimulator behind it)
//
// Commands on stdin, one per line: "go" arms and drives by hand, and prints "on" or "refused ..."; "state" prints the
// interlock's state and the reason for it.
#include <cstdio>
#include <ctime>
#include <iostream>
#include <string>
#include <unistd.h>

#include "core/bench/Bench.h"
#include "core/devices/Registry.h"
#include "drivers/pulsepal/PulsePalDriver.h"
#include "drivers/sciencemode/ScienceModeDriver.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/drivers/pulsepal/PulsePalLine.h"
#include "tests/support/PassingStimulator.h"

namespace tacto {
namespace {

/// Prints in one write, so that no line is split or waits in a buffer.
void say(const std::string& line) {
    const auto text = line + "\n";
    if (write(STDOUT_FILENO, text.data(), text.size()) < 0) std::_Exit(3);
}

void sayTrain() {
    std::timespec at{};
    clock_gettime(CLOCK_MONOTONIC, &at);
    say(fmt::format("train {}", at.tv_sec * 1'000'000'000L + at.tv_nsec));
}

class ToldStimulator final : public test::PassingStimulator {
public:
    using PassingStimulator::PassingStimulator;
    Result<void> deliver(ApprovedTrain&& train) override {
        sayTrain();
        return PassingStimulator::deliver(std::move(train));
    }
};

class ToldMassager final : public Massager {
public:
    explicit ToldMassager(std::unique_ptr<Massager> inner) : inner_(std::move(inner)) {}
    const DeviceIdentity& identity() const noexcept override { return inner_->identity(); }
    Result<void> vibrate(ApprovedBurst&& burst) override {
        sayTrain();
        return inner_->vibrate(std::move(burst));
    }
    double step() const noexcept override { return inner_->step(); }
    void forceOff() noexcept override { inner_->forceOff(); }

private:
    const std::unique_ptr<Massager> inner_;
};

Result<void> go(Bench& bench) {
    if (auto reset = bench.resetFault(); !reset) return reset;
    if (auto begun = bench.begin(bench.stops().mark()); !begun) return begun;
    const Load load = Load::resistor(Ohms(1000));
    if (auto armed = bench.arm({"1 kohm", true, true, bench.armingText(load)}); !armed) return armed;
    const auto before = bench.telemetry().trainsDelivered;
    if (auto driven = bench.drive(DriveSource::Manual, 1, 1); !driven) return driven;
    while (bench.telemetry().trainsDelivered == before) {
        if (auto waited = bench.wait(Seconds(0.002)); !waited) return waited;
    }
    return {};
}

int run(const std::string& which) {
    const auto clock = std::make_shared<SteadyClock>();
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    drivers.push_back(makeScienceModeDriver(nullptr));
    const auto ports = std::make_shared<test::PulsePalPorts>();
    ports->plugged.emplace_back(TransportPort{"PP1", "1-1", ""}, std::make_shared<test::PulsePalLine>(*clock, nullptr));
    drivers.push_back(makePulsePalDriver(ports));
    Registry registry(std::move(drivers));
    const bool terminal = which.starts_with("/");
    const Role role = which == "massager" ? Role::Massager : Role::Stimulator;
    const bool pulsePal = which == "pulsepal";
    const DeviceUri uri = terminal ? DeviceUri{"sciencemode", "", {{"tty", which}}}
                                   : DeviceUri::parse(pulsePal ? "pulsepal:" : "sim:").value();
    auto devices = registry.open({&uri, 1}, {role}, OpenContext{*clock});
    if (!devices) {
        std::cerr << devices.error().message << std::endl;
        return 1;
    }
    if (devices->stimulator) devices->stimulator = std::make_unique<ToldStimulator>(std::move(devices->stimulator));
    if (devices->massager) devices->massager = std::make_unique<ToldMassager>(std::move(devices->massager));
    BenchConfig config;
    config.devices = std::move(*devices);
    config.clock = clock;
    config.limits = {test::generousLimits()};
    // 200 ms of pulses every 500 ms: many stops then come in the middle of a train.
    config.profile.encoding.train.pulses = 20;
    config.profile.encoding.train.rate = Hertz(100);
    if (pulsePal) {
        config.profile.encoding.amplitudeMin = Volts(2);
        config.profile.encoding.amplitudeMax = Volts(8);
    }
    auto bench = Bench::create(std::move(config));
    if (!bench) {
        std::cerr << bench.error().message << std::endl;
        return 1;
    }
    for (std::string command; std::getline(std::cin, command);) {
        if (command == "go") {
            const auto gone = go(**bench);
            say(gone ? "on" : "refused " + gone.error().message);
        } else {
            const auto seen = (*bench)->telemetry();
            say(fmt::format("state {} {}", nameOf(seen.state), seen.reason.view()));
        }
    }
    return 0;
}

}  // namespace
}  // namespace tacto

int main(int argumentCount, char** arguments) { return argumentCount == 2 ? tacto::run(arguments[1]) : 2; }
