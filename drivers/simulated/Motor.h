// Motor.h - a vibration motor with an eccentric mass, which takes time to spin up and run down. A sensor fastened to
// the motor measures its vibration.
//
// The speed follows the command as a critically damped second-order system, in closed form between commands. The
// vibration's amplitude is proportional to the square of the speed, its frequency to the speed.
//
// Thread-safety: one caller of start(); any thread may call at() and cut(); cut() is lock-free.
#pragma once

#include <deque>
#include <mutex>

#include "core/base/Units.h"
#include "drivers/simulated/CutTime.h"

namespace tacto::sim {

struct MotorSettings {
    Seconds spinUp{0.03};  ///< time constant
    Hertz topFrequency{180};
    double topAcceleration_m_s2 = 15;  ///< amplitude at full speed
};

class Motor {
public:
    struct Vibration {
        double amplitude_m_s2 = 0;
        double frequency_hz = 0;
    };

    explicit Motor(const MotorSettings& settings) : settings_(settings) {}

    /// Runs the motor at `command` (0 to 1) from `at` to `end`; replaces the command before.
    void start(Instant at, double command, Instant end);
    /// Ends the newest command at `now`.
    void cut(Instant now) noexcept { cut_.cut(now); }
    /// Returns the motion at `moment` within the last kRemembered commands; no motion before them.
    [[nodiscard]] Vibration at(Instant moment) const;

    static constexpr std::size_t kRemembered = 64;

private:
    struct Motion {
        double speed = 0;  ///< 1 = full
        double rate = 0;   ///< change of speed, 1/s
    };
    struct Command {
        Motion from;
        Instant at{0};
        double level = 0;
        Instant off{CutTime::kNever};
    };
    [[nodiscard]] Motion run(Motion from, double command, double seconds) const noexcept;
    [[nodiscard]] Motion motionIn(const Command& command, Instant off, Instant moment) const noexcept;

    const MotorSettings settings_;
    mutable std::mutex mutex_;
    std::deque<Command> commands_;  // guarded by mutex_; the newest at the back
    CutTime cut_;                   // the newest cut
};

}  // namespace tacto::sim
