// IndependentBody.h - a second opinion on exposure, for judging the gate: what a delivered train really does to a load.
//
// Written from science.md alone. It shares no arithmetic with core/electrode or core/safety: currents are stepped from
// event to event, integrals are Gauss-Legendre sums, and windows slide over the record of what was delivered.
//
// Thread-safety: the test's own thread.
#pragma once

#include <vector>

#include "core/encoding/PulseTrain.h"

namespace tacto::test {

/// Rs + (Rp parallel C); C = 0 is a plain resistor Rs. SI units.
struct Body {
    double rs = 1000;
    double rp = 0;
    double c = 0;
    [[nodiscard]] Body times(double factor) const { return {rs * factor, rp * factor, c / factor}; }
};

/// The source between phases and at its end of range.
struct Drain {
    bool highImpedance = false;
    double compliance = 1e9;  ///< compliance of a current source
};

/// What flowed during one stretch.
struct Stretch {
    double start = 0;
    double length = 0;
    double i2 = 0;      ///< A²s
    double energy = 0;  ///< J
    double charge = 0;  ///< C
    double pulse = 0;   ///< start of the pulse that it belongs to
};

struct PulseFacts {
    double peakV = 0, peakI = 0, phaseCharge = 0, netCharge = 0, energy = 0;
};

class IndependentBody {
public:
    /// A capacitor that follows upon another keeps its voltage, which is the worse; a resistor holds none.
    void fit(const Body& body) {
        body_ = body;
        if (body.c <= 0) vc_ = 0;
    }
    [[nodiscard]] const Body& body() const { return body_; }
    /// Delivers a train at `start` seconds; facts are the largest of any of its pulses.
    PulseFacts deliver(const PulseTrain& train, const Drain& drain, double start);
    /// The most of i² in any window of `window` s that reaches into the newest train.
    [[nodiscard]] double worstI2(double window) const { return worst(window, &Stretch::i2); }
    /// The worst for energy, part of which a charged capacitor gives back. Looks at windows that begin or end where the
    /// power begins, ends or turns.
    [[nodiscard]] double worstEnergy(double window) const;
    /// The net energy of everything that is kept.
    [[nodiscard]] double netEnergy() const;
    /// The most that the capacitor ever held, J.
    [[nodiscard]] double mostStored() const { return mostStored_; }
    /// |sum of charge| of the pulses begun in the 5 s before the newest, that one included.
    [[nodiscard]] double charge5s() const;
    void forget() {
        record_.clear();
        power_.clear();
        vc_ = 0;
    }
    /// |V / I| at the end of the leading phase, from rest.
    [[nodiscard]] double magnitude(const PulseTrain& train) const;

private:
    enum class Mode { Voltage, Current, Floating };
    /// v·i = steady + fading·exp(-t / tau) during one stretch.
    struct Power {
        double start = 0, length = 0, steady = 0, fading = 0, tau = 0;
        [[nodiscard]] double until(double t) const;  // ∫ over its first t
    };
    struct Flow {
        double i2 = 0, energy = 0, charge = 0, peakV = 0, peakI = 0, endV = 0, endI = 0;
    };
    Flow stretch(Mode mode, double level, double length, double compliance);
    Flow linear(Mode mode, double level, double length);
    [[nodiscard]] double worst(double window, double Stretch::*what) const;

    Body body_;
    double vc_ = 0;
    double lastRest_ = -1;  // since when nobody has touched the capacitor
    bool lastFloating_ = false;
    double newest_ = 0;  // Start of the newest train
    std::vector<Stretch> record_;
    std::vector<Power> power_;  // the power where it is not 0, in time order
    double at_ = 0;             // the position of linear()
    double mostStored_ = 0;
};

}  // namespace tacto::test
