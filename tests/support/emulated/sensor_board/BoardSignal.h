// BoardSignal.h - the signals that an emulated board's sensors measure.
//
// Thread-safety: none; one owner.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "drivers/simulated/Finger.h"

namespace tacto::sensorboard {

/// Advances in steps of one acceleration sample; can be read at any step.
class BoardSignal {
public:
    static constexpr std::size_t kTaxels = 8;
    virtual ~BoardSignal() = default;
    virtual void step() = 0;
    /// Returns x, y, z in m/s².
    [[nodiscard]] virtual std::array<double, 3> acceleration() const = 0;
    [[nodiscard]] virtual std::array<double, kTaxels> pressures_Pa() const = 0;
    [[nodiscard]] virtual double force_N() const = 0;
};

/// The simulated finger; one step is one tick of the finger.
class FingerSignal final : public BoardSignal {
public:
    /// `settings.tickRate_hz` must be the board's acceleration rate.
    FingerSignal(const sim::FingerSettings& settings, Instant opened) : finger_(settings, opened) {}

    void step() override { finger_.step(); }
    std::array<double, 3> acceleration() const override { return finger_.acceleration(); }
    std::array<double, kTaxels> pressures_Pa() const override;
    double force_N() const override { return finger_.force_N(); }
    /// Returns the finger, on which surfaces can be presented; any thread may call present().
    [[nodiscard]] sim::Finger& finger() noexcept { return finger_; }

private:
    sim::Finger finger_;
};

/// Counts its steps, so that a sample's values give its number and missing samples show. x counts single steps, y
/// thousands; taxel i and force count single steps plus i; all in units of one LSB.
class CountingSignal final : public BoardSignal {
public:
    static constexpr std::int64_t kModulo = 1000;
    void step() override { ++steps_; }
    std::array<double, 3> acceleration() const override;
    std::array<double, kTaxels> pressures_Pa() const override;
    double force_N() const override;

    static constexpr double kAcceleration = 0.0048828125;  ///< m/s² per count, as the emulated board's LSB
    static constexpr double kPressure = 2;                 ///< Pa per count
    static constexpr double kForce = 0.0005;               ///< N per count

private:
    std::int64_t steps_ = 0;
};

}  // namespace tacto::sensorboard
