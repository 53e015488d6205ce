// FilteredTrace.h - the signal of one channel after a first-order low-pass, in closed form: the circuit's exact pieces
// as an oscilloscope's input stage passes them.
//
// A piece a + b·t + c·exp(-t/τ) after a low-pass of time constant T has the same form plus k·exp(-t/T), where the state
// at its start gives k. The tails continue before, between and after the pulses.
//
// Thread-safety: constant after construction.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "drivers/simulated/SimulatedCircuit.h"

namespace tacto::sim {

class FilteredTrace {
public:
    enum class Channel { Voltage, Current };
    /// Computes the signal of `pulses` over [from_s, to_s].
    FilteredTrace(const std::deque<PlayedPulse>& pulses, Channel channel, double bandwidth_hz, double from_s,
                  double to_s);

    /// Returns the exact signal at `t_s`.
    [[nodiscard]] double at(double t_s) const noexcept;
    /// Returns the first time after `after_s` at which |signal| rises through `level` > 0.
    [[nodiscard]] std::optional<double> risesThrough(double level, double after_s) const noexcept;
    /// Sets `out[k]` to the signal at start + k · step. Costs two multiplications per sample.
    void sample(double start_s, double step_s, std::vector<double>& out) const noexcept;

private:
    struct Piece {
        double start_s, end_s;
        double a, b, c, tau_s;  ///< c is the factor of exp(-t / tau_s), and 0 if tau_s is 0
        double k;               ///< factor of exp(-t / T)
        [[nodiscard]] double at(double t_s, double filter_s) const noexcept;
    };
    void append(double start_s, double end_s, const ExpCurve& curve, double tau_s);

    const double filter_s_;
    double state_ = 0;
    std::vector<Piece> pieces_;
};

}  // namespace tacto::sim
