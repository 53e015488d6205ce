#include "tests/safety/IndependentBody.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tacto::test {

namespace {
// Gauss-Legendre, five points: Abramowitz and Stegun, Handbook of Mathematical Functions, table 25.4.
constexpr std::array<double, 5> kNode{0.0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                      0.9061798459386640};
constexpr std::array<double, 5> kWeight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                        0.2369268850561891};

/// Integrates f over [0, length], with panels that grow with the distance from the transient at 0.
template <class F>
void integrate(double length, double tau, F&& f) {
    double from = 0;
    double step = tau > 0 ? tau / 2 : length;
    while (from < length) {
        const double to = std::min(length, from + step);
        const double half = (to - from) / 2;
        for (std::size_t k = 0; k < kNode.size(); ++k) f(from + half * (1 + kNode[k]), half * kWeight[k]);
        from = to;
        if (from > 2 * tau) step *= 2;
    }
}
}  // namespace

IndependentBody::Flow IndependentBody::linear(Mode mode, double level, double length) {
    Flow flow;
    const auto [rs, rp, c] = body_;
    if (length <= 0) return flow;
    const double begin = at_;
    at_ += length;
    if (c <= 0) {
        const double i = mode == Mode::Voltage ? level / rs : mode == Mode::Current ? level : 0;
        flow.i2 = i * i * length;
        flow.charge = i * length;
        flow.energy = i * i * rs * length;
        flow.peakI = std::abs(i);
        flow.peakV = std::abs(i * rs);
        flow.endI = i;
        flow.endV = i * rs;
        if (i != 0) power_.push_back({begin, length, i * i * rs, 0, 1});
        return flow;
    }
    // C dVc/dt = i - Vc/Rp. A voltage source gives i = (V - Vc)/Rs, a current source a fixed i; i = 0 if floating.
    const double conductance = 1 / rp + (mode == Mode::Voltage ? 1 / rs : 0);
    const double drive = mode == Mode::Voltage ? level / rs : mode == Mode::Current ? level : 0;
    const double tau = c / conductance;
    const double goal = drive / conductance;
    const double start = vc_;
    const auto capacitor = [&](double t) { return goal + (start - goal) * std::exp(-t / tau); };
    const auto current = [&](double t) {
        return mode == Mode::Voltage ? (level - capacitor(t)) / rs : mode == Mode::Current ? level : 0.0;
    };
    integrate(length, tau, [&](double t, double weight) {
        const double i = current(t);
        const double v = mode == Mode::Voltage ? level : i * rs + capacitor(t);
        flow.i2 += weight * i * i;
        flow.charge += weight * i;
        flow.energy += weight * v * i;
    });
    if (level != 0) {
        const double steady = mode == Mode::Voltage ? level * (level - goal) / rs : level * (level * rs + goal);
        const double fading = mode == Mode::Voltage ? level * (goal - start) / rs : level * (start - goal);
        power_.push_back({begin, length, steady, fading, tau});
    }
    const double i0 = current(0);
    flow.endI = current(length);
    flow.endV = mode == Mode::Voltage ? level : flow.endI * rs + capacitor(length);
    flow.peakI = std::max(std::abs(i0), std::abs(flow.endI));
    flow.peakV = std::max(std::abs(mode == Mode::Voltage ? level : i0 * rs + start), std::abs(flow.endV));
    vc_ = capacitor(length);
    mostStored_ = std::max({mostStored_, c * start * start / 2, c * vc_ * vc_ / 2});
    return flow;
}

IndependentBody::Flow IndependentBody::stretch(Mode mode, double level, double length, double compliance) {
    if (mode != Mode::Current || level == 0) return linear(mode, level, length);
    const double side = level > 0 ? 1 : -1;
    const auto [rs, rp, c] = body_;
    // Finds the time at which the voltage reaches compliance. The voltage only grows in the direction of `level`.
    double reach = length;
    if (c <= 0) {
        reach = std::abs(level) * rs > compliance ? 0 : length;
    } else {
        const double goal = side * level * rp;             // goal of Vc on this side
        const double at = compliance - side * level * rs;  // Vc at which compliance is reached
        const double now = side * vc_;
        if (now >= at) {
            reach = 0;
        } else if (goal > at) {
            reach = std::min(length, rp * c * std::log((goal - now) / (goal - at)));
        }
    }
    Flow flow = linear(Mode::Current, level, reach);
    if (reach < length) {
        const Flow held = linear(Mode::Voltage, side * compliance, length - reach);
        flow.i2 += held.i2;
        flow.charge += held.charge;
        flow.energy += held.energy;
        flow.peakI = std::max(flow.peakI, held.peakI);
        flow.peakV = std::max(flow.peakV, held.peakV);
        flow.endI = held.endI;
        flow.endV = held.endV;
    }
    return flow;
}

PulseFacts IndependentBody::deliver(const PulseTrain& train, const Drain& drain, double start) {
    const bool current = std::holds_alternative<Milliamps>(train.amplitude);
    const double size =
        current ? std::get<Milliamps>(train.amplitude).value() / 1000 : std::get<Volts>(train.amplitude).value();
    const double level = train.polarity == Polarity::Positive ? size : -size;
    const double width = train.phaseWidth.count() * 1e-6;
    const double ratio = train.shape == PulseShape::AsymmetricBiphasic ? train.rechargeRatio : 1;
    const bool biphasic = train.shape != PulseShape::Monophasic;
    const double gap = biphasic ? train.interPhaseGap.count() * 1e-6 : 0;
    const double period = 1 / train.rate.value();
    const Mode drive = current ? Mode::Current : Mode::Voltage;
    const Mode idle = drain.highImpedance ? Mode::Floating : Mode::Voltage;

    // The source has been idle since the last train; current since then belongs to that train and was counted there.
    if (lastRest_ >= 0 && start > lastRest_)
        linear(lastFloating_ ? Mode::Floating : Mode::Voltage, 0, start - lastRest_);

    newest_ = start;
    at_ = start;
    PulseFacts facts;
    for (int k = 0; k < train.pulses; ++k) {
        double t = start + k * period;
        double net = 0, energy = 0;
        const auto put = [&](const Flow& flow, double length) {
            record_.push_back({t, length, flow.i2, flow.energy, flow.charge, start + k * period});
            t += length;
            net += flow.charge;
            energy += flow.energy;
            facts.peakI = std::max(facts.peakI, flow.peakI);
            facts.peakV = std::max(facts.peakV, flow.peakV);
        };
        const Flow leading = stretch(drive, level, width, drain.compliance);
        put(leading, width);
        facts.phaseCharge = std::max(facts.phaseCharge, std::abs(leading.charge));
        if (biphasic) {
            if (gap > 0) put(linear(idle, 0, gap), gap);
            const Flow second = stretch(drive, -level / ratio, width * ratio, drain.compliance);
            put(second, width * ratio);
            facts.phaseCharge = std::max(facts.phaseCharge, std::abs(second.charge));
        }
        const double rest = std::max(0.0, start + (k + 1) * period - t);
        put(linear(idle, 0, rest), rest);
        facts.netCharge = std::max(facts.netCharge, std::abs(net));
        facts.energy = std::max(facts.energy, energy);
    }
    lastRest_ = start + train.pulses * period;
    lastFloating_ = drain.highImpedance;
    return facts;
}

double IndependentBody::worst(double window, double Stretch::*what) const {
    // The record is in time order. The window's start moves over every stretch; `sum` holds the stretches fully inside.
    double worst = 0;
    double sum = 0;
    std::size_t next = 0;
    for (std::size_t first = 0; first < record_.size(); ++first) {
        const double end = record_[first].start + window;
        while (next < record_.size() && record_[next].start + record_[next].length <= end) sum += record_[next++].*what;
        double partial = 0;
        if (next < record_.size() && next >= first && record_[next].start < end) {
            partial = record_[next].*what * (end - record_[next].start) / record_[next].length;
        }
        if (end > newest_) worst = std::max(worst, sum + partial);
        if (next == record_.size()) break;  // later starts cover less
        if (next > first) {
            sum -= record_[first].*what;
        } else {
            next = first + 1;
        }
    }
    return worst;
}

double IndependentBody::Power::until(double t) const {
    const double passed = std::clamp(t, 0.0, length);
    return steady * passed + fading * tau * -std::expm1(-passed / tau);
}

double IndependentBody::worstEnergy(double window) const {
    std::vector<double> before{0};  // energy of all pieces before each piece
    for (const auto& piece : power_) before.push_back(before.back() + piece.until(piece.length));
    const auto until = [&](double time) {
        const auto after = std::upper_bound(power_.begin(), power_.end(), time,
                                            [](double t, const Power& piece) { return t < piece.start; });
        if (after == power_.begin()) return 0.0;
        const auto k = static_cast<std::size_t>(after - power_.begin()) - 1;
        return before[k] + power_[k].until(time - power_[k].start);
    };
    // Tries windows with one end where the power begins, ends or turns. Windows in between may hold slightly more.
    double worst = 0;
    const auto look = [&](double edge) {
        if (edge + window > newest_) worst = std::max(worst, until(edge + window) - until(edge));
        if (edge > newest_) worst = std::max(worst, until(edge) - until(edge - window));
    };
    for (const auto& piece : power_) {
        look(piece.start);
        look(piece.start + piece.length);
        const double turn = piece.fading == 0 ? -1 : piece.tau * std::log(-piece.fading / piece.steady);
        if (turn > 0 && turn < piece.length) look(piece.start + turn);
    }
    return worst;
}

double IndependentBody::netEnergy() const {
    double sum = 0;
    for (const auto& s : record_) sum += s.energy;
    return sum;
}

double IndependentBody::charge5s() const {
    double sum = 0;
    const double last = record_.empty() ? 0 : record_.back().pulse;
    for (const Stretch& s : record_) {
        if (s.pulse > last - 5) sum += s.charge;
    }
    return std::abs(sum);
}

double IndependentBody::magnitude(const PulseTrain& train) const {
    IndependentBody fresh;
    fresh.fit(body_);
    const bool current = std::holds_alternative<Milliamps>(train.amplitude);
    const Flow flow =
        fresh.linear(current ? Mode::Current : Mode::Voltage, current ? 0.001 : 1, train.phaseWidth.count() * 1e-6);
    return std::abs(flow.endV / flow.endI);
}

}  // namespace tacto::test
