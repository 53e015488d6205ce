#include "core/measure/PulseAssembly.h"

#include <algorithm>
#include <cmath>

#include "core/base/LargeReserve.h"
#include "core/measure/PhaseShape.h"

namespace tacto {

namespace {

constexpr std::size_t kMinPhaseSamples = 10;
constexpr std::size_t kAmplePhaseSamples = 40;
constexpr double kRinging = 0.05;     // share of the area of the phase before: a larger one is a phase, not ringing
constexpr double kLower = 0.6;        // share of the height of the phase before: a higher one is a phase, however short
constexpr double kFragment = 0.5;     // share of a neighbour's area: a smaller, under-sampled phase is a piece of it
constexpr double kRingsFor = 0.5;     // share of the phase before, counted from its end
constexpr double kFlickersFor = 0.1;  // share of the phase after, before its start: noise on a slow leading edge
constexpr double kAcross = 0.15;      // share of the state: height of a phase on the side that has no state
constexpr double kAcrossInNoise = 4;
constexpr double kRings = 0.05;          // overshoot from which the tail belongs to the charge
constexpr double kOvershootInNoise = 6;  // times the noise: a smaller overshoot may be noise

/// Returns the plateau's height, or the mean of the phase if samples of the plateau are missing.
double heightOfPhase(const FoundPhase& phase) {
    const double plateau = std::abs(phase.measured.plateau);
    return std::isfinite(plateau) ? plateau : phase.area / (phase.to_s() - phase.from_s());
}

/// Returns whether `small` is lower and shorter than `large`, next to it, and has less than a twentieth of its area: it
/// is then ringing after an edge, or noise on a slow leading edge.
bool isSmallBeside(const FoundPhase& small, const FoundPhase& large) {
    return heightOfPhase(small) < kLower * heightOfPhase(large) && small.area < kRinging * large.area &&
           small.to_s() - small.from_s() < 0.5 * (large.to_s() - large.from_s());
}
bool ringsAfter(const FoundPhase& phase, const FoundPhase& before) {
    return isSmallBeside(phase, before) &&
           phase.from_s() - before.to_s() <= kRingsFor * (before.to_s() - before.from_s());
}
bool flickersBefore(const FoundPhase& phase, const FoundPhase& after) {
    return phase.sign == after.sign && isSmallBeside(phase, after) &&
           after.from_s() - phase.to_s() <= kFlickersFor * (after.to_s() - after.from_s());
}

/// Returns whether the phase is too close to an end of the record for a whole edge and one sample of silence.
bool reachesEnd(const FoundPhase& phase) {
    const double rate = 1.25 * phase.view->rate_hz;  // a whole edge lasts 1.25 times its middle 80 %
    const double last = static_cast<double>(phase.view->samples.size()) - 1;
    return phase.onset < 1 + phase.measured.rise_s * rate || phase.end50 > last - 1 - phase.measured.fall_s * rate;
}

/// Return the end and onset of a phase, from its samples if the edges could not be placed.
double endOf(const FoundPhase& phase) { return std::isfinite(phase.end50) ? phase.measured.end_s : phase.to_s(); }
double onsetOf(const FoundPhase& phase) { return std::isfinite(phase.onset) ? phase.measured.onset_s : phase.from_s(); }

/// Returns the time from the end of one phase to the start of the next, by samples if the edges could not be placed.
double gapBetween(const FoundPhase& a, const FoundPhase& b) {
    const double gap = b.measured.onset_s - a.measured.end_s;
    if (std::isfinite(gap)) return gap;
    const double unseen = b.hiddenBefore > 0 ? 0 : static_cast<double>(b.hiddenFor) / b.view->rate_hz;
    return b.from_s() - unseen - a.to_s();
}

void flagPhase(const FoundPhase& phase, PulseFlags& flags) {
    flags.clipped = flags.clipped || phase.clipped;
    flags.truncated = flags.truncated || phase.truncated;
    flags.incomplete = flags.incomplete || phase.incomplete;
    flags.underSampled = flags.underSampled || phase.measured.samples < kMinPhaseSamples;
    flags.coarse = flags.coarse || phase.measured.samples < kAmplePhaseSamples;
    flags.flatTop = flags.flatTop || phase.flatTop;
}

}  // namespace

PulseAssembly::PulseAssembly(const Capture& capture, const StateLevels& levels, double gapMax_s, std::size_t phases)
    : capture_(capture), levels_(levels), gapMax_s_(gapMax_s) {
    reserveLarge(pulses_, phases);
}

void PulseAssembly::add(const PhaseSpan& span) {
    auto& phase = at(kept_ + (hasNewest_ ? 1 : 0));
    measureShape(span, levels_.baseline, phase);
    phase.truncated = phase.truncated || reachesEnd(phase);
    if (hasNewest_) settleNewest(false);
    hasNewest_ = true;
}

std::vector<PulseMeasurement> PulseAssembly::finish() {
    if (hasNewest_) settleNewest(true);
    if (kept_ > 0) integrate(kept_ - 1);
    while (paired_ < kept_) pairNext();
    return std::move(pulses_);
}

/// Keeps or drops the newest phase, once the phase after it is in the window or it is the `last`.
void PulseAssembly::settleNewest(bool last) {
    const auto& phase = at(kept_);
    const bool rings = kept_ > 0 && ringsAfter(phase, at(kept_ - 1));
    if (rings || (!last && flickersBefore(phase, at(kept_ + 1)))) {
        if (!last) at(kept_) = at(kept_ + 1);
        return;
    }
    widest_s_ = std::max(widest_s_, phase.to_s() - phase.from_s());
    ++kept_;
    if (kept_ >= 2) integrate(kept_ - 2);
    while (paired_ + 2 < kept_) pairNext();
}

/// Integrates the charge of a phase with its edges: up to two and a half edge times beyond the 50 % points (half the
/// width if it rings), but not beyond the middle of the gap to a neighbour.
void PulseAssembly::integrate(std::size_t k) {
    auto& phase = at(k);
    auto& m = phase.measured;
    if (m.samples == 0) return;
    const auto& view = *phase.view;
    const double slowest = std::max({m.rise_s, m.fall_s, 0.0}) * view.rate_hz;
    double reach = (std::isfinite(slowest) ? 2.5 * slowest : 0) + 1;
    const double noise = levels_.noise / std::abs(m.plateau);
    if (m.overshoot > std::max(kRings, kOvershootInNoise * noise)) {
        reach = std::max(reach, 0.5 * (phase.end50 - phase.onset));
    }
    double from = std::max(0.0, phase.onset - reach);
    double to = std::min(static_cast<double>(view.samples.size() - 1), phase.end50 + reach);
    if (k > 0) from = std::max(from, view.positionOf(0.5 * (endOf(at(k - 1)) + m.onset_s)));
    if (k + 1 < kept_) to = std::min(to, view.positionOf(0.5 * (m.end_s + onsetOf(at(k + 1)))));
    m.charge = phase.sign * integralOf(phase, levels_.baseline, from, to) / view.rate_hz;
}

/// Returns the gap between two phases that may form one pulse; NaN if they cannot.
double PulseAssembly::gapTo(std::size_t k, std::size_t second) const {
    if (levels_.count != StateCount::Three || second >= kept_ || at(k).sign == at(second).sign) return kNotMeasured;
    const double gap = gapBetween(at(k), at(second));
    // An average of several samples cannot place an edge better than to its own length.
    const std::size_t mean = std::max(at(k).view->mean, at(second).view->mean);
    const double blur = mean > 1 ? static_cast<double>(mean) / capture_.rate_hz : 0;
    return gap <= gapMax_s_ + blur ? gap : kNotMeasured;
}

/// Returns whether a piece of either phase lies between the two: a spike in the gap, or ringing after a clipped phase.
bool PulseAssembly::isSplit(std::size_t k) const {
    if (k + 2 >= kept_ || at(k + 1).measured.samples >= kMinPhaseSamples) return false;
    const auto& whole = at(k + 1).sign == at(k).sign ? at(k) : at(k + 2);
    return at(k + 1).area < kFragment * whole.area && std::isfinite(gapTo(k, k + 2));
}

/// Returns whether the leading phase may be hidden in missing samples before this phase.
bool PulseAssembly::mayLackLeading(std::size_t k) const {
    const auto& phase = at(k);
    if (!(static_cast<double>(phase.hiddenBefore) <= gapMax_s_ * phase.view->rate_hz)) return false;
    if (levels_.count == StateCount::Three) return phase.sign > 0 ? !upLeads_ || downLeads_ : !downLeads_ || upLeads_;
    // The record shows only one side. This is a second phase if the samples go missing, or return, on the other side.
    const double height = std::abs((phase.sign > 0 ? levels_.high : levels_.low) - levels_.baseline);
    const double least = std::max(kAcross * height, kAcrossInNoise * levels_.noise);
    const auto liesThere = [&](std::size_t i) {
        return (levels_.baseline - static_cast<double>(phase.view->samples[i])) * phase.sign > least;
    };
    const std::size_t end = phase.begin - static_cast<std::size_t>(phase.hiddenBefore);
    const std::size_t first = end - static_cast<std::size_t>(phase.hiddenFor);
    return (first > 0 && liesThere(first - 1)) || liesThere(end);
}

/// Pairs the next phase. If it could belong to either neighbour, the clearly shorter gap decides, because a record may
/// begin between the phases of a pulse.
void PulseAssembly::pairNext() {
    const std::size_t k = paired_;
    if (isSplit(k)) {
        addPulse({&at(k), &at(k + 1), &at(k + 2)}, {});
        paired_ += 3;
        return;
    }
    const double gap = gapTo(k, k + 1);
    const double next = gapTo(k + 1, k + 2);
    const double step = 1.0 / capture_.rate_hz;
    PulseFlags flags;
    const bool lacksLeading = mayLackLeading(k);
    const bool alone = lacksLeading && upLeads_ != downLeads_;
    const bool pairs = std::isfinite(gap) && !alone && !(std::isfinite(next) && gap > 2 * next + step && k == 0);
    // If the leading side is unknown, the same holds for phases after missing samples.
    chainedToHidden_ = chainedToHidden_ || (lacksLeading && !alone && (!pairs || std::isfinite(next)));
    flags.incomplete = alone || chainedToHidden_;
    chainedToHidden_ = chainedToHidden_ && std::isfinite(pairs ? next : gap);
    // After a phase cut by the record's start, phases may follow so closely that each could belong to either neighbour.
    if (k == 0) chainedToCut_ = at(k).truncated;
    const bool chained = chainedToCut_;
    chainedToCut_ = chainedToCut_ && std::isfinite(pairs ? next : gap);
    if (pairs) {
        addPulse({&at(k), &at(k + 1)}, flags);
        paired_ += 2;
        return;
    }
    // The partner of this phase may lie beyond the record.
    const double end_s = capture_.start_s + static_cast<double>(capture_.samples()) / capture_.rate_hz;
    const bool cutBefore = k == 0 && at(k).from_s() - capture_.start_s <= gapMax_s_;
    const bool cutAfter = k + 1 == kept_ && end_s - at(k).to_s() <= gapMax_s_;
    const bool three = levels_.count == StateCount::Three;
    flags.truncated = three && (cutBefore || cutAfter || chained);
    flags.incomplete =
        flags.incomplete || (three && static_cast<double>(at(k).hiddenAfter) <= gapMax_s_ * at(k).view->rate_hz);
    addPulse({&at(k)}, flags);
    paired_ += 1;
}

/// `phases`: the leading phase, then the second if there is one, with a piece between them if there is one. A pulse
/// with a piece is under-sampled. `flags`: parts of the pulse that are not seen.
void PulseAssembly::addPulse(std::initializer_list<const FoundPhase*> phases, const PulseFlags& flags) {
    const FoundPhase& leading = **phases.begin();
    const FoundPhase* second = phases.size() > 1 ? *(phases.end() - 1) : nullptr;
    auto& pulse = pulses_.emplace_back();
    pulse.seenFrom_s = leading.from_s();
    pulse.seenTo_s = (second == nullptr ? leading : *second).to_s();
    pulse.flags = flags;
    for (const FoundPhase* phase : phases) flagPhase(*phase, pulse.flags);
    pulse.leading.samples = leading.measured.samples;
    if (!pulse.flags.measured()) return;

    pulse.leading = leading.measured;
    if (second != nullptr) {
        (leading.sign > 0 ? upLeads_ : downLeads_) = true;
        pulse.second = second->measured;
        pulse.gap_s = second->measured.onset_s - leading.measured.end_s;
    }
    if (levels_.count == StateCount::Three) {
        const double q1 = leading.measured.charge;
        const double q2 = second == nullptr ? 0 : second->measured.charge;
        pulse.imbalance = std::abs(q1 + q2) / std::max(std::abs(q1), std::abs(q2));
    }
}

}  // namespace tacto
