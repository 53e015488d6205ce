// IndependentBody.h - an independent calculation of exposure that judges the gate: what a train really does to a load.
//
// Written from science.md alone. Shares no arithmetic with core/electrode or core/safety: currents are computed from
// event to event, integrals are Gauss-Legendre sums, and windows slide over the record of deliveries.
//
// Thread-safety: the test's own thread.
#pragma once

#include <vector>

#include "core/encoding/PulseTrain.h"

namespace tacto::test {

/// Rs + (Rp parallel to C); C = 0 means a plain resistor Rs. SI units.
struct Body {
    double rs = 1000;
    double rp = 0;
    double c = 0;
    [[nodiscard]] Body times(double factor) const { return {rs * factor, rp * factor, c / factor}; }
};

/// The source's behaviour between phases and at the end of its range.
struct Drain {
    bool highImpedance = false;
    double compliance = 1e9;  ///< largest voltage of a current source
};

/// The flow during one stretch of time.
struct Stretch {
    double start = 0;
    double length = 0;
    double i2 = 0;      ///< A²s
    double energy = 0;  ///< J
    double charge = 0;  ///< C
    double pulse = 0;   ///< start of the pulse to which the stretch belongs
};

struct PulseFacts {
    double peakV = 0, peakI = 0, phaseCharge = 0, netCharge = 0, energy = 0;
};

class IndependentBody {
public:
    /// Connects a body. A capacitor keeps the previous one's voltage, which is the worse case; a resistor holds none.
    void fit(const Body& body) {
        body_ = body;
        if (body.c <= 0) vc_ = 0;
    }
    [[nodiscard]] const Body& body() const { return body_; }
    /// Delivers a train at `start` seconds; returns the largest values of any of its pulses.
    PulseFacts deliver(const PulseTrain& train, const Drain& drain, double start);
    /// Returns the largest integral of i² over any window of `window` s that includes part of the newest train.
    [[nodiscard]] double worstI2(double window) const { return worst(window, &Stretch::i2); }
    /// Returns the largest energy over such windows; a charged capacitor gives part of it back. Only tries windows that
    /// begin or end where the power begins, ends or turns.
    [[nodiscard]] double worstEnergy(double window) const;
    /// Returns the net energy of everything in the record.
    [[nodiscard]] double netEnergy() const;
    /// Returns the largest energy ever stored in the capacitor, in J.
    [[nodiscard]] double mostStored() const { return mostStored_; }
    /// Returns |sum of charge| of the pulses begun in the 5 s before the newest pulse, including the newest.
    [[nodiscard]] double charge5s() const;
    void forget() {
        record_.clear();
        power_.clear();
        vc_ = 0;
    }
    /// Returns |V / I| at the end of the leading phase, from rest.
    [[nodiscard]] double magnitude(const PulseTrain& train) const;

private:
    enum class Mode { Voltage, Current, Floating };
    /// v·i = steady + fading·exp(-t / tau) during one stretch.
    struct Power {
        double start = 0, length = 0, steady = 0, fading = 0, tau = 0;
        [[nodiscard]] double until(double t) const;  // integral over the first t seconds
    };
    struct Flow {
        double i2 = 0, energy = 0, charge = 0, peakV = 0, peakI = 0, endV = 0, endI = 0;
    };
    Flow stretch(Mode mode, double level, double length, double compliance);
    Flow linear(Mode mode, double level, double length);
    [[nodiscard]] double worst(double window, double Stretch::*what) const;

    Body body_;
    double vc_ = 0;
    double lastRest_ = -1;  // time since which the capacitor was left alone
    bool lastFloating_ = false;
    double newest_ = 0;  // start of the newest train
    std::vector<Stretch> record_;
    std::vector<Power> power_;  // the power while not 0, in time order
    double at_ = 0;             // present time of linear()
    double mostStored_ = 0;
};

}  // namespace tacto::test
