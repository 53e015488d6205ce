// MassagerWatch.h - notices a massager that runs when it should rest, if an accelerometer feels it (hazard H2).
//
// The accelerometer may be fastened to the massager, or slide on something else. The motion is the massager's if it
// begins with a burst after quiet, and continues after bursts with constant strength: a motor's motion does, a sliding
// finger's does not.
//
// Thread-safety: none; the control loop owns it. Does not allocate.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/Stream.h"
#include "core/base/Units.h"

namespace tacto {

class MassagerWatch {
public:
    /// The longest time that a motor takes to run down.
    static constexpr Seconds kRunDown{0.25};

    /// Notes that a burst is put out from `begin` to `end`.
    void burst(Instant begin, Instant end) noexcept;
    /// Takes the newest samples of an acceleration stream with `axes` channels.
    void feed(const SampleBlock& block, std::size_t axes) noexcept;
    /// Returns the strength (m/s², root mean square of all axes) at which the massager keeps running; 0 while it rests.
    [[nodiscard]] double goesOnAt() const noexcept { return found_; }
    /// Starts the search anew: the motion is explained, or has another cause.
    void forget() noexcept;

private:
    /// Sums of powers of one axis, relative to its first sample.
    struct Axis {
        double first = 0;
        std::array<double, 4> sums{};
        void add(double value, bool begins) noexcept;
        /// Returns the second and fourth moment about the mean of `n` samples.
        [[nodiscard]] std::pair<double, double> moments(double n) const noexcept;
    };
    struct Window {
        double begin_s = 0;
        std::size_t samples = 0;
        std::array<Axis, 3> axes{};
    };
    void close(const Window& window) noexcept;
    void take(double begin_s, double strength, double kurtosis) noexcept;

    Window now_;
    double begin_s_ = std::numeric_limits<double>::infinity();  // beginning of the newest burst
    double end_s_ = -std::numeric_limits<double>::infinity();
    double floor_ = std::numeric_limits<double>::infinity();     // the lowest strength so far
    double quiet_s_ = -std::numeric_limits<double>::infinity();  // the last quiet window during a rest
    bool follows_ = false;                                       // a burst began after quiet, without quiet since then
    int tries_ = 0;                                              // how many groups of windows were examined since then
    std::size_t count_ = 0;                                      // windows during rests that were not quiet
    std::size_t pairs_ = 0;                                      // number of directly consecutive windows
    double last_s_ = -1, last_ = 0;                              // the newest of these windows
    double fall_ = 0;                                            // sum of the falls from each window to the next
    double sum_ = 0, squares_ = 0;                               // sums of the windows' strengths and of their squares
    double kurtosis_ = 0;                                        // sum of the windows' kurtosis
    double found_ = 0;
};

}  // namespace tacto
