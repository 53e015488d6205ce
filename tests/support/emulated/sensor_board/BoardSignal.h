// BoardSignal.h - what an emulated board's sensors feel.
//
// Thread-safety: none; one owner.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "drivers/simulated/Finger.h"

namespace tacto::sensorboard {

/// Moved in steps of one acceleration sample; read at any step.
class BoardSignal {
public:
    static constexpr std::size_t kTaxels = 8;
    virtual ~BoardSignal() = default;
    virtual void step() = 0;
    /// x, y, z in m/s².
    [[nodiscard]] virtual std::array<double, 3> acceleration() const = 0;
    [[nodiscard]] virtual std::array<double, kTaxels> pressures_Pa() const = 0;
    [[nodiscard]] virtual double force_N() const = 0;
};

/// The simulated finger, one tick of it to a step.
class FingerSignal final : public BoardSignal {
public:
    /// `settings.tickRate_hz` is the board's acceleration rate.
    FingerSignal(const sim::FingerSettings& settings, Instant opened) : finger_(settings, opened) {}

    void step() override { finger_.step(); }
    std::array<double, 3> acceleration() const override { return finger_.acceleration(); }
    std::array<double, kTaxels> pressures_Pa() const override;
    double force_N() const override { return finger_.force_N(); }
    /// The finger on which to present surfaces; present() may be called on any thread.
    [[nodiscard]] sim::Finger& finger() noexcept { return finger_; }

private:
    sim::Finger finger_;
};

/// Counts its steps: a sample's values tell its number, and any that is missing shows. x counts single steps and y
/// thousands of them, taxel i and force the same with i added; all in LSB of `step` of their unit.
class CountingSignal final : public BoardSignal {
public:
    static constexpr std::int64_t kModulo = 1000;
    void step() override { ++steps_; }
    std::array<double, 3> acceleration() const override;
    std::array<double, kTaxels> pressures_Pa() const override;
    double force_N() const override;

    static constexpr double kAcceleration = 0.0048828125;  ///< m/s² a count, as the emulated board's LSB
    static constexpr double kPressure = 2;                 ///< Pa
    static constexpr double kForce = 0.0005;               ///< N

private:
    std::int64_t steps_ = 0;
};

}  // namespace tacto::sensorboard
