// FakeStimulator.h - a stimulator that behaves as a test says, and counts the calls.
//
// Thread-safety: as a Stimulator. Atomic members may be used from any thread; set all others while no call is running.
// The hooks run in the thread that calls the device.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "core/bench/ControlLoop.h"
#include "core/devices/Stimulator.h"

namespace tacto::test {

class FakeStimulator final : public Stimulator {
public:
    explicit FakeStimulator(const Clock& clock) : clock_(clock) {
        traits_.drive = Drive::Voltage;
        traits_.amplitudeMax = 60;
        traits_.compliance = Volts(60);
        traits_.widthStep = Micros(1);
    }

    const DeviceIdentity& identity() const noexcept override { return identity_; }
    const SourceTraits& traits() const noexcept override { return traits_; }
    Result<void> deliver(ApprovedTrain&& train) override {
        const ApprovedTrain taken = std::move(train);
        if (onDeliver) onDeliver();
        if (deliverFails) return fail(ErrorCode::Device, "the fake refuses to deliver");
        ++delivered;
        lastAmplitude = siValue(taken.train().amplitude);
        on = true;
        return {};
    }
    Result<StimulatorStatus> status() override {
        while (statusBlocks) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (statusFails) return fail(ErrorCode::Timeout, "the fake does not answer");
        StimulatorStatus answer;
        answer.at = clock_.now();
        answer.delivering = clock_.now() < stillOnUntil;
        if (answer.delivering && saysWhenItEnds) answer.trainEnd = stillOnUntil;
        answer.electrode = electrode;
        answer.impedance = impedance;
        answer.amplitude = measured;
        answer.trainsDelivered = static_cast<std::uint64_t>(delivered.load());
        on = answer.delivering;
        return answer;
    }
    Result<void> keepAlive() override {
        ++keptAlive;
        return {};
    }
    void forceOff() noexcept override {
        ++offs;
        on = false;
        if (onOff) onOff();
    }

    SourceTraits traits_;
    std::function<void()> onDeliver;
    std::function<void()> onOff;
    bool deliverFails = false;
    bool statusFails = false;
    Instant stillOnUntil{0};  ///< a train lasts until then
    bool saysWhenItEnds = true;
    std::atomic<bool> statusBlocks{false};
    ElectrodeState electrode = ElectrodeState::Ok;
    Ohms impedance{1000};
    std::optional<double> measured;  ///< amplitude that the device reads back
    std::atomic<int> delivered{0};
    std::atomic<int> offs{0};
    std::atomic<int> keptAlive{0};
    std::atomic<bool> on{false};
    double lastAmplitude = 0;

private:
    const Clock& clock_;
    DeviceIdentity identity_{"fake:", Role::Stimulator, "Fake stimulator", "F1", "1", true};
};

/// Returns one limit set with very high limits, so that bench tests meet the gate's own rules, not a standard's.
[[nodiscard]] inline LimitSet generousLimits() {
    LimitSet set;
    set.id = "test";
    set.title = "Generous";
    LimitRow row;
    row.quantity = Quantity::RmsCurrent5s;
    row.max = 1000;
    row.source = "test";
    set.rows.push_back(row);
    return set;
}

/// Returns a bench setup around `source` with a declared resistor.
[[nodiscard]] inline GateSetup benchSetup(const SourceTraits& source, Ohms load = Ohms(1000)) {
    GateSetup setup;
    setup.source = source;
    setup.load = LoadRange::declared(Load::resistor(load));
    setup.limits = {generousLimits()};
    return setup;
}

/// Starts arming `loop` on a declared kiloohm; it is armed after its next steps.
inline void armFake(ControlLoop& loop, Interlock& interlock, const FakeStimulator& device, const Clock& clock,
                    StopMark asked = {}) {
    if (interlock.state() == InterlockState::Disconnected && !interlock.connect()) return;
    loop.attend(Instant::max());
    const auto ticket = interlock.requestArming(clock.now()).value();
    if (!interlock.confirmArming(ticket, clock.now())) return;
    ArmCommand command;
    command.setup = benchSetup(device.traits());
    command.evidence.limitsLoaded = true;
    command.evidence.deviceIdentified = true;
    command.evidence.operatorConfirmed = true;
    command.evidence.impedanceLow = Ohms(800);
    command.evidence.impedanceHigh = Ohms(1200);
    command.evidence.readsBack = device.traits().readsBack;
    command.evidence.declaredLoadConfirmed = !device.traits().readsBack;
    command.asked = asked;
    loop.arm(std::move(command));
}

}  // namespace tacto::test
