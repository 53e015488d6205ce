// SimulatedSensor.h - the sensors on the simulated fingertip: accelerometer, taxels and force sensor, with noise,
// quantisation, clipping, lost packets and faults.
//
// Every sample depends only on the seed, its index and the calls to present(), not on how often the sensor is read.
//
// Thread-safety: as TactileSensor.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/TactileSensor.h"
#include "drivers/simulated/FastNoise.h"
#include "drivers/simulated/FaultSchedule.h"
#include "drivers/simulated/Finger.h"
#include "drivers/simulated/World.h"

namespace tacto::sim {

struct SensorSettings {
    double rate_hz = 4000;     ///< rate of acceleration
    double slowRate_hz = 200;  ///< rate of taxels and force; must divide rate_hz
    int bits = 16;
    double range_g = 16;        ///< range in g, ±
    double noise_m_s2 = 0.026;  ///< r.m.s. at 4 kHz (60 µg/√Hz), white
    double taxelNoise_Pa = 5;
    double taxelStep_Pa = 1;
    double forceNoise_N = 0.002;
    double forceStep_N = 0.001;
    double taxelGain = 1;  ///< readings of the taxels and the force sensor for 1 Pa and 1 N: a wrong scale
    double forceGain = 1;
    bool taxelsInCounts = false;  ///< true: taxels deliver counts and do not claim Pa
    double dropouts = 0;          ///< share of 10 ms packets that are lost
    bool onMotor = false;         ///< true: fastened to the world's motor instead of a fingertip
    FaultSchedule faults;
    std::uint64_t seed = 1;
};

class SimulatedSensor final : public TactileSensor, public WorldMember {
public:
    SimulatedSensor(DeviceIdentity identity, std::shared_ptr<World> world, std::shared_ptr<Finger> finger,
                    const SensorSettings& settings);

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return streams_; }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override;
    [[nodiscard]] const std::shared_ptr<World>& world() const noexcept override { return world_; }

    /// Returns the finger's ticks per acceleration sample, for a rate below 4 kHz.
    [[nodiscard]] static int ticksPerSample(double rate_hz) noexcept;
    static constexpr Seconds kPacket{0.01};
    static constexpr Seconds kLateness{0.2};  ///< delay of data during the fault "late"

private:
    void sampleFast(SampleBlock& block);
    [[nodiscard]] std::array<double, 3> felt();
    [[nodiscard]] std::array<double, 3> shaken();
    void sampleSlow(SampleBlock& taxels, SampleBlock& force);
    void noteFaults(Instant now);
    [[nodiscard]] bool packetLost(double t_s) const noexcept;

    const DeviceIdentity identity_;
    const std::shared_ptr<World> world_;
    const std::shared_ptr<Finger> finger_;
    const SensorSettings settings_;
    const int ticksPerSample_;
    const std::int64_t samplesPerSlow_;
    const double opened_s_;
    const double lsb_;
    std::array<StreamInfo, 3> streams_;
    FastNoise fastNoise_, slowNoise_;
    std::array<double, Finger::kTaxels> offsets_{};
    std::int64_t sample_ = 0;  // index of the next acceleration sample
    std::shared_ptr<const Motor> motor_;
    double motorTurn_ = 0;  // angle of the motor's mass at sample_
    std::array<double, 3> lastAcceleration_{};
    std::array<double, Finger::kTaxels> lastPressures_{};
    double lastForce_ = 0;
    // The faults that are active at the sampled tick:
    bool silent_ = false, stuck_ = false, nan_ = false;
    double drifting_s_ = 0;
};

}  // namespace tacto::sim
