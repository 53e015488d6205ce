// Finger.h - a simulated fingertip that slides, presses, trembles and lifts: its position and skin motion per tick.
//
// Motion: force and speed follow their targets as a hand does (force critically damped, speed first order), with
// physiological tremor at 8 to 12 Hz. Skin: a damped second-order resonance, driven by the relief under the contact
// patch (as base motion) and by friction flicker (as a force), plus the slow 1/f-like variation of friction that
// dominates on smooth surfaces. Contact accelerations grow with the square root of force.
//
// The state changes only in step(), once per tick. The motion therefore depends on the tick's index and on when
// present() was called, never on how the ticks were requested.
//
// Thread-safety: any thread may call present(); one caller uses everything else.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "drivers/simulated/FastNoise.h"
#include "drivers/simulated/Surface.h"

namespace tacto::sim {

/// Standard acceleration of gravity, m/s² (3rd CGPM, 1901).
inline constexpr double kGravity = 9.80665;

struct FingerSettings {
    std::string material = "P120";
    MillimetresPerSecond speed{50};
    Newtons force{1.5};
    Seconds stroke{4};     ///< contact time of one stroke, before the finger lifts
    Seconds lift{1};       ///< time in the air between strokes; 0 = never lifts
    double tremor = 1;     ///< 1 = physiological, 0 = a robot
    Hertz resonance{250};  ///< the skin's resonance
    double damping = 0.3;
    Millimetres gratingPeriod{0};  ///< 0 = the material's own period
    Micrometres gratingDepth{0};
    double tickRate_hz = 4000;
    std::uint64_t seed = 1;
};

class Finger {
public:
    static constexpr std::size_t kTaxels = 8;
    /// The finger rests in the air for this time after `opened`, so that baselines can be taken.
    static constexpr Seconds kFirstContact{0.5};
    /// Time to change the material: lift, move over, and touch down.
    static constexpr Seconds kChange{0.25};

    /// The first tick is at `opened`. `settings.material` must be a known material.
    Finger(const FingerSettings& settings, Instant opened);

    /// Does what SurfacePresenter::present() requires, called at `now`, and ends the strokes of the settings. Targets
    /// change for ticks after `now`. An unknown material or impossible value is refused and changes nothing.
    [[nodiscard]] Result<void> present(std::string_view material, MillimetresPerSecond speed, Newtons force,
                                       Instant now);

    /// Moves to the next tick.
    void step() noexcept;

    [[nodiscard]] std::int64_t tick() const noexcept { return tick_; }
    [[nodiscard]] double time_s() const noexcept { return time_; }
    /// x along the path, y across, z normal, m/s², gravity on z included.
    [[nodiscard]] const std::array<double, 3>& acceleration() const noexcept { return acceleration_; }
    [[nodiscard]] double force_N() const noexcept { return contactForce_; }
    [[nodiscard]] double speed_m_s() const noexcept { return speed_; }
    /// Pressure on each taxel in Pa, without the sensor's own offset and noise.
    void pressures(std::array<double, kTaxels>& into) const noexcept;

private:
    struct Target {
        double from_s;           ///< the target applies to ticks after this time
        const Surface* surface;  ///< null: the surface stays the same
        double speed_m_s;
        double force_N;
    };
    /// Narrow-band noise of variance 1: two poles at `frequency_hz`.
    struct Resonator {
        double a1 = 0, a2 = 0, gain = 0, y1 = 0, y2 = 0;
        void tune(double frequency_hz, double bandwidth_hz, double rate_hz) noexcept;
        double next(double white) noexcept;
    };
    /// Noise of variance 1 below a corner frequency: three real poles.
    struct Wander {
        double keep = 0, gain = 0, y1 = 0, y2 = 0, y3 = 0;
        void tune(double corner_hz, double rate_hz) noexcept;
        double next(double white) noexcept;
    };

    const Surface* surfaceOf(std::string_view material);
    void follow() noexcept;
    void planStroke(double after_s);
    void moveHand() noexcept;
    void feel() noexcept;

    const FingerSettings settings_;
    const double opened_;  // Constant after construction
    const double dt_;
    std::map<std::string, std::unique_ptr<Surface>, std::less<>> surfaces_;  // guarded by mutex_, entries never go
    std::mutex mutex_;
    std::deque<Target> targets_;      // guarded by mutex_
    std::atomic<double> nextTarget_;  // time after which follow() must run
    bool presented_ = false;          // guarded by mutex_
    std::string presentedMaterial_;   // guarded by mutex_
    double landed_ = 0;               // guarded by mutex_: when the presented contact begins

    std::int64_t tick_ = 0;
    double time_;
    const Surface* surface_ = nullptr;
    double targetSpeed_ = 0, targetForce_ = 0;
    double speed_ = 0, force_ = 0, forceRate_ = 0, contactForce_ = 0, position_ = 0;
    FastNoise noise_;
    Resonator tremor_;
    std::array<Wander, 3> drag_;
    double skinA1_ = 0, skinA2_ = 0, heightGain_ = 0, flickerGain_ = 0;
    double z1_ = 0, z2_ = 0, f1_ = 0, f2_ = 0, s1_ = 0, s2_ = 0;
    double flickerScale_ = 0;
    std::array<double, 3> acceleration_{};
};

}  // namespace tacto::sim
