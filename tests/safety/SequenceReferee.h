// SequenceReferee.h - chooses the random trains of a sequence and judges what was delivered (see GateSequences.h).
//
// The referee has its own number for every limit and takes exposure from IndependentBody; it never asks the gate
// whether something was allowed.
//
// Thread-safety: the test's own thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/Clock.h"
#include "core/base/Statistics.h"
#include "core/safety/SourceTraits.h"
#include "tests/safety/Dice.h"
#include "tests/safety/GateSequences.h"
#include "tests/safety/IndependentBody.h"

namespace tacto::test {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr std::size_t kKinds = static_cast<std::size_t>(Near::Count);
inline constexpr double kSlack = 1 + 2e-6;  // error of the referee's quadrature

/// What is allowed now, from the referee's own rules.
struct Allowed {
    double area = kNaN;                              // cm²
    double peakI = kInf, charge = kInf, net = kInf;  // ceilings, SI units
    double energy = kInf, rms1 = kInf, dc = kInf;
    bool person = false;
    double step = 0, discomfort = kInf;  // A
    double low = 0, high = kInf;         // Ω, for a person
};

/// The linear error of a device that does not deliver exactly what it is told.
struct Flaw {
    double gain = 1, offset = 0;
    [[nodiscard]] double outOf(double told) const { return told == 0 ? 0 : std::max(0.0, gain * told + offset); }
    [[nodiscard]] bool none() const { return gain == 1 && offset == 0; }
};
struct Miscalibration {
    Flaw amplitude, width, gap, rate;  // V or mA, µs and Hz
    [[nodiscard]] bool none() const { return amplitude.none() && width.none() && gap.none() && rate.none(); }
    [[nodiscard]] PulseTrain outOf(PulseTrain train) const {
        if (isCurrent(train.amplitude)) {
            train.amplitude = Milliamps(amplitude.outOf(siValue(train.amplitude) * 1e3));
        } else {
            train.amplitude = Volts(amplitude.outOf(siValue(train.amplitude)));
        }
        train.phaseWidth = Micros(width.outOf(train.phaseWidth.count()));
        train.interPhaseGap = Micros(gap.outOf(train.interPhaseGap.count()));
        train.rate = Hertz(rate.outOf(train.rate.value()));
        return train;
    }
};

class SequenceReferee {
public:
    SequenceReferee(VirtualClock& clock, Dice& dice, SequenceCount& total, bool traced)
        : clock_(clock), dice_(dice), total_(total), traced_(traced) {}

protected:
    /// Appends what was violated to the trace: of a long text, the end is visible.
    void violation(const std::string& what) {
        if (total_.violation.empty()) total_.violation = trace_ + what;
    }
    template <class Text>
    void note(Text text) {
        if (traced_) trace_ += text() + "\n";
    }
    [[nodiscard]] double now() const { return toSeconds(clock_.now()); }
    void wait(double seconds) { clock_.advanceTo(clock_.now() + toInstant(seconds)); }

    PulseTrain randomTrain() {
        PulseTrain train;
        const double shape = dice_.unit();
        train.shape = shape < 0.6   ? PulseShape::SymmetricBiphasic
                      : shape < 0.8 ? PulseShape::Monophasic
                                    : PulseShape::AsymmetricBiphasic;
        train.polarity = dice_.chance(0.5) ? Polarity::Positive : Polarity::Negative;
        train.phaseWidth = Micros(std::round(dice_.decade(20, source_.widthMax.count())));
        train.interPhaseGap = Micros(dice_.chance(0.3) ? 0 : std::round(dice_.between(0, 200)));
        train.rechargeRatio = std::round(dice_.between(2, 10));
        train.pulses = dice_.chance(0.5) ? 1 : 1 + dice_.pick(12);
        const double period = train.pulseDuration().count() * dice_.decade(1, 100);
        train.rate = Hertz(1 / period);
        train.amplitude = source_.drive == Drive::Current ? Amplitude(Milliamps(1)) : Amplitude(Volts(1));
        return train;
    }

    void setAmplitude(PulseTrain& train, double si) {
        const bool current = source_.drive == Drive::Current;
        double own = (current ? si * 1e3 : si) / known_.amplitude.gain;
        if (source_.amplitudeStep > 0) own = std::floor(own / source_.amplitudeStep) * source_.amplitudeStep;
        own = std::max(own, 0.0);
        train.amplitude = current ? Amplitude(Milliamps(own)) : Amplitude(Volts(own));
    }

    /// Amplitudes that about reach each kind of limit, from one train of amplitude 1 at both ends of the load range.
    using Aims = std::array<double, kKinds>;
    Aims aimsOf(PulseTrain train, double interval) {
        const bool current = source_.drive == Drive::Current;
        setUnit(train);
        const double unit = current ? 1e-3 : 1;
        const double period = 1 / train.rate.value();
        const double count5 = std::min(std::ceil(5 / interval) * train.pulses, std::ceil(5 / period)) / train.pulses;
        const double count1 = std::min(std::ceil(1 / interval) * train.pulses, std::ceil(1 / period)) / train.pulses;
        // Two pulses are enough here: this only chooses amplitudes, it does not judge.
        const double more = train.pulses > 2 ? train.pulses / 2.0 : 1;
        train.pulses = std::min(train.pulses, 2);
        Aims aims;
        aims.fill(kInf);
        const auto aim = [&aims](Near kind, double amplitude) {
            double& least = aims[static_cast<std::size_t>(kind)];
            if (amplitude < least) least = amplitude;
        };
        const Drain drain{source_.gap == GapState::HighImpedance, 1e9};
        for (const double end : {0.8, 1.2}) {
            IndependentBody probe;
            probe.fit((allowed_.person ? Body{measured_, 0, 0} : nominal_).times(end));
            const PulseFacts one = probe.deliver(train, drain, 0);
            const double i2 = more * probe.worstI2(1e9), joule = more * probe.worstEnergy(1e9);
            const double charge = more * probe.charge5s();
            aim(Near::Rms5s, unit * 0.01 / std::sqrt(i2 * count5 / 5));
            aim(Near::PeakCurrent, unit * allowed_.peakI / one.peakI);
            aim(Near::Charge, unit * allowed_.charge / one.phaseCharge);
            aim(Near::Energy, unit * std::sqrt(allowed_.energy / one.energy));
            aim(Near::Rms1s, unit * allowed_.rms1 / std::sqrt(i2 * count1));
            if (!std::isnan(allowed_.area)) aim(Near::Power, unit * std::sqrt(0.25 * allowed_.area / (joule * count1)));
            if (one.netCharge > 1e-12) aim(Near::NetCharge, unit * allowed_.net / one.netCharge);
            if (charge > 1e-12) aim(Near::Dc, unit * allowed_.dc * 5 / (charge * count5));
        }
        IndependentBody into500;
        into500.fit({500, 0, 0});
        into500.deliver(train, drain, 0);
        aim(Near::Rms500, unit * 0.05 / std::sqrt(more * into500.worstI2(1e9) * count5 / 5));
        aim(Near::Command, current ? 40 / magnitude(train) : 40);
        if (allowed_.person) aim(Near::Level, std::min(allowed_.discomfort, accepted_ + allowed_.step));
        return aims;
    }
    static std::size_t tightest(const Aims& aims) {
        return static_cast<std::size_t>(std::min_element(aims.begin(), aims.end()) - aims.begin());
    }
    double aimed(const PulseTrain& train, double interval) {
        const Aims aims = aimsOf(train, interval);
        const double least = aims[tightest(aims)];
        return std::isfinite(least) ? least : 0.01;
    }
    void setUnit(PulseTrain& train) {
        train.amplitude = source_.drive == Drive::Current ? Amplitude(Milliamps(1)) : Amplitude(Volts(1));
    }
    double magnitude(const PulseTrain& train) {
        IndependentBody probe;
        probe.fit(allowed_.person ? Body{measured_, 0, 0} : nominal_.times(readAs_));
        return probe.magnitude(train);
    }

    /// Looks for a train for which one kind of limit is the tightest, so that rarer kinds are tried too.
    void search(Near kind, PulseTrain& train, double& interval) {
        for (int tries = 0; tries < 6; ++tries) {
            train = randomTrain();
            fills_ = false;
            const bool slow = kind == Near::Rms5s || kind == Near::Rms500 || kind == Near::Dc;
            const bool windowed = slow || kind == Near::Rms1s || kind == Near::Power;
            if (windowed && dice_.chance(0.5)) {  // one train longer than the window
                if (kind == Near::Rms500) {       // only a source that hardly pauses reaches this limit
                    train.shape = PulseShape::SymmetricBiphasic;
                    train.interPhaseGap = Micros(0);
                    train.phaseWidth = Micros(std::round(dice_.between(20'000, 100'000)));
                }
                const double period = train.pulseDuration().count() * dice_.decade(1, kind == Near::Rms500 ? 1.3 : 3);
                train.rate = Hertz(1 / period);
                const double window = slow ? 5 : 1;
                const double pulses = (slow ? 5.2 : 1.1) / period;
                if (pulses < 200) train.pulses = std::max(1, static_cast<int>(pulses));
                // If the periods exactly fill the window, a bound that counts whole pulses has no room to hide an
                // error.
                const double whole = std::floor(window / period);
                fills_ = whole >= 1 && pulses < 200 && dice_.chance(0.3);
                if (fills_) {
                    train.rate = Hertz(whole / window / (1 + dice_.decade(1e-8, 1e-3)) / device_.rate.gain);
                    train.pulses = static_cast<int>(whole) + 1 + dice_.pick(3);
                }
            }
            const double shortest = train.duration().count();
            interval = std::max(
                shortest, windowed ? dice_.decade(slow ? 0.4 : 0.09, slow ? 5 : 1) : shortest * dice_.decade(1, 300));
            if (tightest(aimsOf(train, interval)) == static_cast<std::size_t>(kind)) return;
        }
    }

    [[nodiscard]] bool sameKind(const PulseTrain& train) const {
        if (!seriesOf_) return false;
        PulseTrain other = *seriesOf_;
        other.amplitude = train.amplitude;
        return other == train;
    }

    void hold(Near kind, double value, double limit, bool strict, const char* what) {
        if (!std::isfinite(limit)) return;
        const double ratio = value / limit;
        if (!(ratio <= kSlack) || (strict && !(value < limit * kSlack))) {
            violation(fmt::format("{} is {} and the limit {}", what, value, limit));
        }
        if (ratio >= 0.95) {
            close_ = true;
            ++total_.near[static_cast<std::size_t>(kind)];
        }
    }

    /// Judges `train`, which came out when `told` was programmed; by the known errors `expected` should have come out.
    void referee(const PulseTrain& train, const PulseFacts& facts, double interval, const PulseTrain& told,
                 const PulseTrain& expected, bool isCheck) {
        const double amplitude = siValue(expected.amplitude);
        const bool current = source_.drive == Drive::Current;
        const PulseTrain& command = calibrated_ ? expected : told;
        const double asked = siValue(command.amplitude);
        const double lasts = (train.pulses - 1) / train.rate.value() + train.pulseDuration().count();
        if (source_.deadMan.count() <= 0 && lasts > 2 * kSlack) violation("over 2 s without a dead-man switch");
        hold(Near::Command, current ? asked * magnitude(command) : asked, 40, false, "the command in V");
        if (facts.peakV > 500) violation("more than 500 V");
        hold(Near::Rms5s, std::sqrt(body_.worstI2(5) / 5), 0.010, true, "RMS over 5 s in A");
        slowest_ = std::max(slowest_, interval);
        const double band = slowest_ >= 1 / 400.0 ? 0.05 : slowest_ >= 1 / 1500.0 ? 0.08 : 0.1;
        hold(Near::Rms500, std::sqrt(at500_.worstI2(5) / 5), band, false, "RMS over 5 s into 500 ohm in A");
        if (at500_.charge5s() / 5 > 0.08 * kSlack) violation("more than 80 mA d.c. into 500 ohm");
        if (!std::isnan(allowed_.area)) hold(Near::Power, body_.worstEnergy(1) / allowed_.area, 0.25, true, "W/cm2");
        hold(Near::PeakCurrent, facts.peakI, allowed_.peakI, false, "peak current in A");
        hold(Near::Charge, facts.phaseCharge, allowed_.charge, false, "charge per phase in C");
        hold(Near::NetCharge, facts.netCharge, allowed_.net, false, "net charge in C");
        hold(Near::Energy, facts.energy, allowed_.energy, false, "energy per pulse in J");
        hold(Near::Rms1s, std::sqrt(body_.worstI2(1)), allowed_.rms1, false, "RMS over 1 s in A");
        hold(Near::Dc, body_.charge5s() / 5, allowed_.dc, false, "mean current over 5 s in A");
        if (!allowed_.person) return;
        if (train.shape == PulseShape::Monophasic || !current)
            violation("a person had a monophasic pulse or a voltage");
        if (!isCheck && !(now() - measuredAt_ <= 5.1))
            violation("a person was stimulated on an old or wrong impedance");
        const double accepted = !sameKind(train) ? 0 : ascending_ ? seriesLast_ : accepted_;
        const double ceiling = isCheck ? allowed_.discomfort : std::min(allowed_.discomfort, accepted + allowed_.step);
        hold(Near::Level, amplitude, ceiling, false, "a person's level in A");
    }

    VirtualClock& clock_;
    Dice& dice_;
    SequenceCount& total_;
    const bool traced_;
    SourceTraits source_;
    Body nominal_;
    Allowed allowed_;
    IndependentBody body_, at500_;  // the connected body, and a 500 Ω resistor for comparison
    Near theme_ = Near::Count;      // Near::Count: none
    Miscalibration known_;          // the device's known errors
    Miscalibration device_;         // the device's true errors
    bool calibrated_ = false;       // the known errors apply, and trains are programmed with them
    bool close_ = false;
    bool fills_ = false;      // the chosen train's periods fill a window
    double slowest_ = 0;      // Longest interval delivered, s
    double readAs_ = 1;       // a bench load's |Z| as told to the gate, divided by the declared |Z|
    double measured_ = 1000;  // A person's |Z| as told to the gate, Ω
    double measuredAt_ = -100;
    double accepted_ = 0;    // A
    double seriesLast_ = 0;  // A, in this ascending series
    bool ascending_ = false;
    std::optional<PulseTrain> seriesOf_;
    std::string trace_;
};

}  // namespace tacto::test
