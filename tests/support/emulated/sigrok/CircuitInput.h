// CircuitInput.h - connects the simulated circuit to the inputs of an emulated oscilloscope: channel 1 across the load,
// channel 2 across a low-side shunt, both limited to the instrument's bandwidth.
//
// Thread-safety: one caller; the circuit states its own rules.
#pragma once

#include "core/base/Clock.h"
#include "drivers/simulated/FilteredTrace.h"
#include "tests/support/emulated/sigrok/EmulatedRigol.h"

namespace tacto::sigrok_driver {

class CircuitInput final : public ScopeInput {
public:
    /// `circuit` and `clock` must outlive this object. The shunt is small against the load and not part of the circuit.
    CircuitInput(sim::SimulatedCircuit& circuit, const Clock& clock, Ohms shunt, Hertz bandwidth = Hertz(70e6))
        : circuit_(circuit), clock_(clock), shunt_(shunt), bandwidth_(bandwidth) {}

    [[nodiscard]] std::optional<double> passes(int channel, double level_V, bool upwards, double from_s,
                                               double to_s) override;
    void sample(int channel, double start_s, double step_s, std::vector<double>& out) override;

private:
    [[nodiscard]] double factor(int channel) const { return channel == 1 ? shunt_.value() : 1; }

    sim::SimulatedCircuit& circuit_;
    const Clock& clock_;
    const Ohms shunt_;
    const Hertz bandwidth_;
};

}  // namespace tacto::sigrok_driver
