// FilteredTrace.h - one channel's signal after a first-order low-pass, in closed form: what an oscilloscope's input
// stage makes of the circuit's exact pieces.
//
// A piece a + b·t + c·exp(-t/τ) through a bandwidth of time constant T is again of that kind plus k·exp(-t/T), with k
// fixed by the state at its start. Before, between and after the pulses the tails carry on.
//
// Thread-safety: const after building.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "drivers/simulated/SimulatedCircuit.h"

namespace tacto::sim {

class FilteredTrace {
public:
    enum class Channel { Voltage, Current };
    /// The signal of `pulses` over [from, to], seconds.
    FilteredTrace(const std::deque<PlayedPulse>& pulses, Channel channel, double bandwidth_hz, double from_s,
                  double to_s);

    /// The signal at `t_s`, exactly.
    [[nodiscard]] double at(double t_s) const noexcept;
    /// The first moment after `after_s` at which |signal| rises through `level` > 0.
    [[nodiscard]] std::optional<double> risesThrough(double level, double after_s) const noexcept;
    /// `out[k]` = the signal at start + k · step. Costs two multiplications a sample.
    void sample(double start_s, double step_s, std::vector<double>& out) const noexcept;

private:
    struct Piece {
        double start_s, end_s;
        double a, b, c, tau_s;  ///< c counts exp(-t / tau_s), 0 when tau_s is
        double k;               ///< counts exp(-t / T)
        [[nodiscard]] double at(double t_s, double filter_s) const noexcept;
    };
    void append(double start_s, double end_s, const ExpCurve& curve, double tau_s);

    const double filter_s_;
    double state_ = 0;
    std::vector<Piece> pieces_;
};

}  // namespace tacto::sim
