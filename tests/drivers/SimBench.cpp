#include "tests/drivers/SimBench.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "drivers/simulated/SimulatedDriver.h"
#include "tests/support/BenchGate.h"
#include "tests/support/Refused.h"

namespace tacto::test {

SimBench::SimBench(std::string declaredLoad, std::uint64_t seed)
    : driver_(makeSimulatedDriver()), declaredLoad_(std::move(declaredLoad)), seed_(seed) {}

Result<void> SimBench::tryOpen(std::string_view text, const std::set<Role>& wanted) {
    const auto uri = DeviceUri::parse(text);
    if (!uri) return failure(uri);
    return driver_->open(*uri, wanted, OpenContext{clock, seed_, declaredLoad_}, devices);
}

void SimBench::open(std::string_view uri, const std::set<Role>& wanted) {
    std::string ideal(uri);
    const bool electric = uri.starts_with("sim:stimulator") || uri.starts_with("sim:oscilloscope");
    if (electric && uri.find("flaws=") == std::string_view::npos) {
        ideal += (uri.find('?') == std::string_view::npos ? "?" : "&") + std::string("flaws=none");
    }
    if (const auto opened = tryOpen(ideal, wanted); !opened) throw std::runtime_error(opened.error().message);
}

ApprovedTrain SimBench::approved(const PulseTrain& train) {
    if (!gate_) gate_ = benchGate(clock, devices.stimulator->traits());
    return approve(*gate_, clock, train);
}

void SimBench::deliver(const PulseTrain& train, Seconds after) {
    accepted(devices.stimulator->deliver(approved(train)));
    wait(after);
}

void SimBench::arm(const ScopeSettings& settings) {
    accepted(devices.oscilloscope->configure(settings));
    ASSERT_TRUE(devices.oscilloscope->arm().has_value());
}

Capture SimBench::capture() {
    auto found = accepted(devices.oscilloscope->poll());
    if (!found) throw std::runtime_error("no capture");
    return std::move(*found);
}

sim::SimulatedCircuit& SimBench::circuit() {
    return dynamic_cast<sim::WorldMember&>(*devices.stimulator).world()->circuit();
}

PulseTrain voltagePulse(double volts, double gap_us) {
    PulseTrain train;
    train.amplitude = Volts(volts);
    train.interPhaseGap = Micros(gap_us);
    return train;
}

PulseTrain currentPulse(double milliamps, double gap_us) {
    PulseTrain train = voltagePulse(0, gap_us);
    train.amplitude = Milliamps(milliamps);
    return train;
}

double peakOf(const CaptureChannel& channel) {
    double peak = 0;
    for (const float sample : channel.samples) peak = std::max(peak, std::abs(static_cast<double>(sample)));
    return peak;
}

}  // namespace tacto::test
