// World.h - what the simulated devices of one bench share: clock, seed, the circuit between stimulator, load and
// oscilloscope, the reference source and the massager's motor. Lives as long as any of these devices. Also holds the
// classes that change the world from outside: loads, the reference source, surfaces under the finger.
//
// Thread-safety: any thread; the circuit and the motor state their own rules.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/Clock.h"
#include "core/devices/Oscilloscope.h"
#include "core/devices/TactileSensor.h"
#include "drivers/simulated/Finger.h"
#include "drivers/simulated/Motor.h"
#include "drivers/simulated/SimulatedCircuit.h"

namespace tacto::sim {

class World {
public:
    World(const Clock& clock, std::uint64_t seed) : clock_(clock), seed_(seed) {}

    [[nodiscard]] const Clock& clock() const noexcept { return clock_; }
    [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }
    [[nodiscard]] SimulatedCircuit& circuit() noexcept { return circuit_; }

    /// Returns the voltage of a reference source that replaces the load, in V; 0: none.
    [[nodiscard]] double reference() const noexcept { return reference_V_.load(std::memory_order_acquire); }
    void setReference(double volts) noexcept { reference_V_.store(volts, std::memory_order_release); }

    /// Returns the massager's motor, or null if there is no massager.
    [[nodiscard]] std::shared_ptr<Motor> motor() const {
        const std::scoped_lock lock(motorMutex_);
        return motor_;
    }
    void setMotor(std::shared_ptr<Motor> motor) {
        const std::scoped_lock lock(motorMutex_);
        motor_ = std::move(motor);
    }

private:
    const Clock& clock_;
    const std::uint64_t seed_;
    std::atomic<double> reference_V_{0};
    SimulatedCircuit circuit_;
    mutable std::mutex motorMutex_;
    std::shared_ptr<Motor> motor_;  // guarded by motorMutex_
};

/// Implemented by every simulated device, so that a device opened later finds the same world.
class WorldMember {
public:
    virtual ~WorldMember() = default;
    [[nodiscard]] virtual const std::shared_ptr<World>& world() const noexcept = 0;
};

/// Connects loads to the world's circuit.
class CircuitFitter final : public LoadFitter {
public:
    explicit CircuitFitter(std::shared_ptr<World> world) : world_(std::move(world)) {}
    [[nodiscard]] Result<void> fitLoad(std::string_view load) override;

private:
    const std::shared_ptr<World> world_;
};

/// Applies a known voltage to the oscilloscope.
class WorldReference final : public VoltageReference {
public:
    explicit WorldReference(std::shared_ptr<World> world) : world_(std::move(world)) {}
    [[nodiscard]] Result<void> applyVoltage(double volts) override;

private:
    const std::shared_ptr<World> world_;
};

/// Puts surfaces under a simulated finger.
class FingerPresenter final : public SurfacePresenter {
public:
    FingerPresenter(std::shared_ptr<World> world, std::shared_ptr<Finger> finger)
        : world_(std::move(world)), finger_(std::move(finger)) {}
    [[nodiscard]] Result<void> present(std::string_view material, MillimetresPerSecond speed, Newtons force) override {
        return finger_->present(material, speed, force, world_->clock().now());
    }

private:
    const std::shared_ptr<World> world_;
    const std::shared_ptr<Finger> finger_;
};

}  // namespace tacto::sim
