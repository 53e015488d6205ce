// MassagerWatch.h - notices a massager that runs when it should rest, where an accelerometer feels it (hazard H2).
//
// An accelerometer may be fastened to the massager, or slide on something else. It feels the massager if the motion
// begins with a burst after quiet, and continues after bursts with a constant strength, as a motor's does and a sliding
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
    /// How long a motor may take to run down.
    static constexpr Seconds kRunDown{0.25};

    /// A burst is put out from `begin` to `end`.
    void burst(Instant begin, Instant end) noexcept;
    /// The newest samples of an acceleration, of `axes` channels.
    void feed(const SampleBlock& block, std::size_t axes) noexcept;
    /// The strength in m/s² with which the massager keeps running, root mean square of all axes; 0 while it rests.
    [[nodiscard]] double goesOnAt() const noexcept { return found_; }
    /// The motion is explained, or has another cause: looks for it anew.
    void forget() noexcept;

private:
    /// Power sums of one axis about its first sample.
    struct Axis {
        double first = 0;
        std::array<double, 4> sums{};
        void add(double value, bool begins) noexcept;
        /// The second and the fourth moment about the mean, of `n` samples.
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
    double begin_s_ = std::numeric_limits<double>::infinity();  // the newest burst's beginning
    double end_s_ = -std::numeric_limits<double>::infinity();
    double floor_ = std::numeric_limits<double>::infinity();     // the least strength so far
    double quiet_s_ = -std::numeric_limits<double>::infinity();  // the last quiet window at rest
    bool follows_ = false;                                       // a burst began after quiet, and none was since
    int tries_ = 0;                                              // seconds of rest since then that were looked at
    std::size_t count_ = 0;                                      // windows of rest that were not quiet
    std::size_t pairs_ = 0;                                      // bursts that follow each other
    double last_s_ = -1, last_ = 0;                              // the newest of them
    double fall_ = 0;                                            // the falls from one to the next, summed
    double sum_ = 0, squares_ = 0;                               // the sum of their strengths, and of the squares
    double kurtosis_ = 0;                                        // sum of theirs
    double found_ = 0;
};

}  // namespace tacto
