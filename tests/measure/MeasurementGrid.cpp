#include "tests/measure/MeasurementGrid.h"

#include <algorithm>
#include <fmt/format.h>

namespace tacto::test {

namespace {

constexpr double kLevel = 40;
constexpr double kGridWidth_s = 200e-6;
constexpr double kGridGap_s = 100e-6;
constexpr double kRechargeTimes = 10;

/// Returns the time from `from` to `to` at which the phase passes `level` upwards (or downwards), by bisection.
double passes(const SyntheticPhase& phase, const StepResponse& step, double level, double from, double to) {
    const double sign = phase.level > 0 ? 1 : -1;
    const bool rising = sign * valueAt(phase, step, from) < level;
    for (int k = 0; k < 80; ++k) {
        const double middle = 0.5 * (from + to);
        ((sign * valueAt(phase, step, middle) < level) == rising ? from : to) = middle;
    }
    return 0.5 * (from + to);
}

struct Record {
    Capture capture;
    std::vector<SyntheticPhase> phases;
};

Record recordAt(const GridPoint& point, unsigned seed) {
    Record record;
    SyntheticRecord r;
    r.rate_hz = point.perPhase / kGridWidth_s;
    r.seed = seed;
    Random random(seed, "grid");
    // The first edge may fall anywhere between two samples.
    const double firstOnset_s = 2 * kGridWidth_s + random.uniform() / r.rate_hz;
    record.phases = phasesOf(point, firstOnset_s);
    const auto& last = record.phases.back();
    // The silence is long enough for a pulse with its tail, and at least as long as between pulses.
    const double end_s =
        std::max(last.onset_s + last.width_s + 4 * kGridWidth_s, point.pulses * point.interval * kGridWidth_s);
    r.samples = static_cast<std::size_t>(end_s * r.rate_hz);
    const double level = point.shape == PulseShape::Logic ? 1 : kLevel;
    if (point.shape != PulseShape::Logic) {
        r.noise = level * std::pow(10, -point.snr_db / 20);
        r.offset = level * point.offset;
        r.slope_per_s = level * point.slope / end_s;
        r.hum = level * point.hum;
        r.hum_rad = 2 * std::numbers::pi * random.uniform();
        if (point.rangeShare > 0) {
            r.range = level / point.rangeShare;
            r.lsb = 2 * r.range / 256;
        }
    }
    if (r.lsb == 0) r.lsb = std::max(r.noise / 50, level * 1e-6);  // a resolution too fine to hide anything
    record.capture = recordOf(record.phases, r);
    if (point.shape == PulseShape::Logic) {
        record.capture.channels[0].unit = "";
        for (float& x : record.capture.channels[0].samples) x = x >= 0.5F ? 1.0F : 0.0F;
    }
    return record;
}

struct Errors {
    std::vector<double> amplitude, width, interval, gap, charge, imbalance;
};

void compare(const std::vector<PhaseTruth>& truths, bool biphasic, const PulseMeasurement& pulse, double rate_hz,
             Errors& errors) {
    const auto& truth = truths.front();
    errors.amplitude.push_back(pulse.leading.plateau / truth.plateau - 1);
    errors.width.push_back((pulse.leading.width_s - (truth.end_s - truth.onset_s)) * rate_hz);
    errors.charge.push_back(pulse.leading.charge / truth.charge - 1);
    if (!biphasic) return;
    const double q1 = truth.charge, q2 = truths.back().charge;
    errors.imbalance.push_back(pulse.imbalance - std::abs(q1 + q2) / std::max(std::abs(q1), std::abs(q2)));
    if (pulse.second) errors.gap.push_back((pulse.gap_s - (truths.back().onset_s - truth.end_s)) * rate_hz);
}

/// Counts readings that the stated uncertainty does not cover, in the units of Errors.
int beyond(const std::vector<double>& errors, std::size_t from, double stated) {
    return static_cast<int>(std::count_if(errors.begin() + static_cast<std::ptrdiff_t>(from), errors.end(),
                                          [&](double e) { return !(std::abs(e) <= kCoverage * stated); }));
}

void judge(const Record& record, bool biphasic, GridResult& result, Errors& errors) {
    const auto m = measureChannel(record.capture, 0);
    const double rate_hz = record.capture.rate_hz;
    const std::size_t perPulse = biphasic ? 2 : 1;
    std::vector<bool> claimed(m.pulses.size(), false);
    int missed = 0, invented = 0, halves = 0;
    const auto& u = m.uncertainty;
    const auto& truth = record.phases.front();
    const std::size_t before_n = errors.amplitude.size(), beforeGap_n = errors.gap.size();
    const PulseMeasurement* before = nullptr;
    double onsetBefore_s = 0;
    for (std::size_t k = 0; k < record.phases.size(); k += perPulse) {
        std::vector<PhaseTruth> truths;
        for (std::size_t j = 0; j < perPulse; ++j) truths.push_back(truthOf(record.phases[k + j]));
        const PulseMeasurement* found = nullptr;
        for (std::size_t j = 0; j < m.pulses.size(); ++j) {
            const bool here = std::abs(m.pulses[j].seenFrom_s - truths.front().onset_s) < 0.5 * kGridWidth_s;
            if (claimed[j] || !here) continue;
            claimed[j] = true;
            found = &m.pulses[j];
            break;
        }
        ++result.pulses;
        if (found == nullptr) {
            ++missed;
        } else if (!found->flags.measured()) {
            ++result.flagged;
            found = nullptr;
        } else {
            compare(truths, biphasic, *found, rate_hz, errors);
            halves += biphasic && !found->second ? 1 : 0;
            if (before != nullptr) {
                const double interval_s = found->onset_s() - before->onset_s();
                errors.interval.push_back((interval_s - (truths.front().onset_s - onsetBefore_s)) * rate_hz);
            }
        }
        before = found;
        onsetBefore_s = truths.front().onset_s;
    }
    for (std::size_t j = 0; j < m.pulses.size(); ++j) invented += claimed[j] || !m.pulses[j].flags.measured() ? 0 : 1;
    result.missed += missed;
    result.invented += invented;
    result.warned += m.warnings.empty() ? 0 : 1;
    const double level = std::abs(truth.level);
    result.beyondAmplitude += beyond(errors.amplitude, before_n, u.amplitude / level);
    result.beyondWidth += beyond(errors.width, before_n, u.width_s * rate_hz);
    result.beyondCharge += beyond(errors.charge, before_n, u.charge / (level * kGridWidth_s));
    result.beyondGap += beyond(errors.gap, beforeGap_n, u.gap_s * rate_hz);
    result.beyondImbalance += beyond(errors.imbalance, beforeGap_n, u.imbalance);
    result.silent += (missed > 0 || invented > 0 || halves > 0) && m.warnings.empty() ? 1 : 0;
    if (m.measuredPulses > 0) result.stated = m.uncertainty;
}

}  // namespace

std::vector<SyntheticPhase> phasesOf(const GridPoint& point, double firstOnset_s) {
    std::vector<SyntheticPhase> phases;
    for (int k = 0; k < point.pulses; ++k) {
        SyntheticPhase p;
        p.onset_s = firstOnset_s + k * point.interval * kGridWidth_s;
        p.width_s = kGridWidth_s;
        p.level = point.polarity * (point.shape == PulseShape::Logic ? 1 : kLevel);
        p.edge_s = point.shape == PulseShape::Logic ? 1e-9 : 2e-6;
        p.ringing = point.ringing;
        if (point.shape == PulseShape::Exponential) p.tau_s = kGridWidth_s / 10;
        phases.push_back(p);
        if (point.shape == PulseShape::Monophasic || point.shape == PulseShape::Logic) continue;
        SyntheticPhase second = p;
        second.onset_s = p.onset_s + kGridWidth_s + kGridGap_s;
        second.level = -p.level;
        if (point.shape == PulseShape::Recharge) {
            second.level /= kRechargeTimes;
            second.width_s *= kRechargeTimes;
        }
        phases.push_back(second);
    }
    return phases;
}

PhaseTruth truthOf(const SyntheticPhase& phase) {
    const StepResponse step(phase);
    PhaseTruth truth{std::abs(phase.level), phase.onset_s, phase.onset_s + phase.width_s, 0};
    const double middle = phase.onset_s + 0.5 * phase.width_s;
    for (int pass = 0; pass < 20; ++pass) {
        constexpr int kPoints = 2000;
        const double width = truth.end_s - truth.onset_s;
        double sum = 0;
        for (int k = 0; k < kPoints; ++k) {
            const double t = truth.onset_s + width * (0.3 + 0.6 * (k + 0.5) / kPoints);
            sum += std::abs(valueAt(phase, step, t));
        }
        truth.plateau = sum / kPoints;
        truth.onset_s = passes(phase, step, 0.5 * truth.plateau, phase.onset_s - step.before_s() - 1e-9, middle);
        // A ringing tail returns, but not to half, so the first passage is the edge.
        truth.end_s = passes(phase, step, 0.5 * truth.plateau, middle, phase.onset_s + 1.5 * phase.width_s);
    }
    truth.plateau = std::copysign(truth.plateau, phase.level);
    truth.charge = phase.level * phase.width_s;
    return truth;
}

GridResult measureGridPoint(const GridPoint& point, int seeds) {
    GridResult result;
    Errors errors;
    const bool biphasic = point.shape != PulseShape::Monophasic && point.shape != PulseShape::Logic;
    result.rate_hz = point.perPhase / kGridWidth_s;
    result.records = seeds;
    for (int seed = 1; seed <= seeds; ++seed) {
        judge(recordAt(point, static_cast<unsigned>(seed)), biphasic, result, errors);
    }
    result.amplitude = statisticsOf(errors.amplitude);
    result.width = statisticsOf(errors.width);
    result.interval = statisticsOf(errors.interval);
    result.gap = statisticsOf(errors.gap);
    result.charge = statisticsOf(errors.charge);
    result.imbalance = statisticsOf(errors.imbalance);
    return result;
}

std::string describe(const GridPoint& p) {
    static constexpr const char* kNames[] = {"monophasic", "symmetric", "recharge", "exponential", "logic"};
    auto text = fmt::format("{}, {:.0f}/phase", kNames[static_cast<int>(p.shape)], p.perPhase);
    if (p.shape != PulseShape::Logic) text += fmt::format(", {:.0f} dB", p.snr_db);
    if (p.rangeShare > 0) text += fmt::format(", 8 bits {:.0f} % of range", 100 * p.rangeShare);
    if (p.ringing > 0) text += fmt::format(", ringing {:.0f} %", 100 * p.ringing);
    if (p.slope != 0) text += fmt::format(", slope {:.0f} %", 100 * p.slope);
    if (p.hum > 0) text += fmt::format(", hum {:.0f} %", 100 * p.hum);
    if (p.offset != 0) text += fmt::format(", offset {:.0f} %", 100 * p.offset);
    if (p.interval != GridPoint{}.interval) text += fmt::format(", duty 1/{:.0f}", p.interval);
    if (p.polarity < 0) text += ", leading down";
    return text;
}

}  // namespace tacto::test
