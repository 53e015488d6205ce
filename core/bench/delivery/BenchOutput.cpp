#include "core/bench/delivery/BenchOutput.h"

#include <utility>

namespace tacto {

namespace {

SourceTraits traitsOf(const DeviceSet& devices) {
    if (devices.stimulator) return devices.stimulator->traits();
    SourceTraits none;
    none.amplitudeMax = 1000;
    none.compliance = Volts(1000);
    return none;
}

}  // namespace

BenchOutput::BenchOutput(const DeviceSet& devices) : devices_(devices), source_(traitsOf(devices)) {}

void BenchOutput::open(SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock, std::function<void()> wake) {
    if (devices_.stimulator) {
        stimulator_ =
            std::make_unique<StimulatorSession>(*devices_.stimulator, gate, heartbeat, clock, std::move(wake));
    } else if (devices_.massager) {
        massager_ = std::make_unique<MassagerSession>(*devices_.massager, gate, heartbeat, clock, std::move(wake));
    }
}

void BenchOutput::off() noexcept {
    if (stimulator_) stimulator_->forceOff();
    if (massager_)
        massager_->forceOff();
    else if (devices_.massager)
        devices_.massager->forceOff();
}

bool BenchOutput::busy() const noexcept {
    return (stimulator_ && !stimulator_->idle()) || (massager_ && !massager_->idle());
}

Instant BenchOutput::serve(Instant now) noexcept {
    return stimulator_ ? stimulator_->serve(now) : massager_->serve(now);
}

const Device* BenchOutput::device() const noexcept {
    if (devices_.stimulator) return devices_.stimulator.get();
    return devices_.massager.get();
}

bool BenchOutput::isReal() const noexcept {
    const Device* output = device();
    return output != nullptr && !output->identity().simulated;
}

}  // namespace tacto
