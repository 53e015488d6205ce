#include "core/measure/PhaseFinder.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

// A record may hold 10 V and 40 V pulses: a phase is found well below half of the largest and then judged by its own
// plateau. Ringing stays below this, noise below the multiple of its standard deviation.
constexpr double kThreshold = 0.15;
constexpr double kThresholdInNoise = 6;
constexpr double kRelease = 0.6;  // of the threshold: hysteresis
constexpr double kPlateauFrom = 0.3;
constexpr double kPlateauTo = 0.9;

/// One phase's samples seen from the baseline, leading edge up.
class PhaseView {
public:
    PhaseView(const std::vector<float>& samples, double baseline, int sign)
        : samples_(samples), baseline_(baseline), sign_(sign) {}
    [[nodiscard]] double operator[](std::size_t i) const {
        return (static_cast<double>(samples_[i]) - baseline_) * sign_;
    }
    [[nodiscard]] std::size_t size() const { return samples_.size(); }

    /// Where the line between samples i - 1 and i passes `level`.
    [[nodiscard]] double crossing(std::size_t i, double level) const {
        const double before = (*this)[i - 1];
        const double after = (*this)[i];
        if (before == after) return static_cast<double>(i);
        return static_cast<double>(i) - 1 + std::clamp((level - before) / (after - before), 0.0, 1.0);
    }
    /// First passage upwards at or after `from`, at or before `to`; NaN if none.
    [[nodiscard]] double firstRise(std::size_t from, std::size_t to, double level) const {
        for (std::size_t i = from; i <= to && i < size(); ++i) {
            if (this->operator[](i) >= level) return i == 0 ? kNotMeasured : crossing(i, level);
        }
        return kNotMeasured;
    }
    /// Last passage downwards: searches from `from` back to `to`.
    [[nodiscard]] double lastFall(std::size_t from, std::size_t to, double level) const {
        for (std::size_t i = std::min(from, size() - 1) + 1; i-- > to;) {
            if ((*this)[i] >= level) return i + 1 >= size() ? kNotMeasured : crossing(i + 1, level);
        }
        return kNotMeasured;
    }
    /// Going back from `from`: where the leading edge left `level`.
    [[nodiscard]] double edgeStart(std::size_t from, double level) const {
        for (std::size_t i = from; i > 0; --i) {
            if ((*this)[i - 1] <= level) return crossing(i, level);
        }
        return kNotMeasured;
    }
    /// Going on from `from`: where the trailing edge reached `level`.
    [[nodiscard]] double edgeEnd(std::size_t from, double level) const {
        for (std::size_t i = from; i < size(); ++i) {
            if ((*this)[i] <= level) return i == 0 ? kNotMeasured : crossing(i, level);
        }
        return kNotMeasured;
    }
    [[nodiscard]] double at(double position) const {
        const auto i = static_cast<std::size_t>(position);
        if (i + 1 >= size()) return (*this)[size() - 1];
        const double share = position - static_cast<double>(i);
        return (*this)[i] * (1 - share) + (*this)[i + 1] * share;
    }
    /// ∫ of the straight lines between samples, in level times samples.
    [[nodiscard]] double integral(double from, double to) const {
        if (!(to > from)) return 0;
        double sum = 0;
        double x = from;
        double y = at(from);
        for (auto i = static_cast<std::size_t>(from) + 1; static_cast<double>(i) < to; ++i) {
            const double next = (*this)[i];
            sum += 0.5 * (y + next) * (static_cast<double>(i) - x);
            x = static_cast<double>(i);
            y = next;
        }
        return sum + 0.5 * (y + at(to)) * (to - x);
    }

private:
    const std::vector<float>& samples_;
    double baseline_;
    double sign_;
};

/// Positions in samples; the plateau unsigned.
struct PhaseEdges {
    double onset = kNotMeasured;
    double end = kNotMeasured;
    double plateau = kNotMeasured;
    double slope = 0;  // of the plateau, per sample
};

void fitPlateau(const PhaseView& view, double onset, double end, PhaseEdges& edges) {
    const double width = end - onset;
    const auto first = static_cast<std::size_t>(std::ceil(std::max(0.0, onset + kPlateauFrom * width)));
    const auto last = std::min(view.size() - 1, static_cast<std::size_t>(std::max(0.0, onset + kPlateauTo * width)));
    if (first > last) {
        edges.plateau = view[std::min(view.size() - 1, first)];
        edges.slope = 0;
        return;
    }
    double n = 0, sum = 0, moment = 0, squares = 0;
    const double centre = 0.5 * (static_cast<double>(first) + static_cast<double>(last));
    for (std::size_t i = first; i <= last; ++i) {
        const double x = static_cast<double>(i) - centre;
        n += 1;
        sum += view[i];
        moment += x * view[i];
        squares += x * x;
    }
    edges.plateau = sum / n;
    edges.slope = squares > 0 ? moment / squares : 0;
}

PhaseEdges edgesOf(const PhaseView& view, const FoundPhase& phase) {
    PhaseEdges edges;
    const std::size_t before = phase.begin == 0 ? 0 : phase.begin - 1;
    fitPlateau(view, static_cast<double>(phase.begin), static_cast<double>(phase.end), edges);
    // Twice: the second time the plateau is taken between the 50 % points that the first time found.
    for (int pass = 0; pass < 2; ++pass) {
        edges.onset = view.firstRise(before, phase.end, 0.5 * edges.plateau);
        edges.end = view.lastFall(phase.end, phase.begin, 0.5 * edges.plateau);
        if (!(edges.end > edges.onset)) break;
        fitPlateau(view, edges.onset, edges.end, edges);
    }
    return edges;
}

void measurePhase(const PhaseView& view, const Capture& capture, FoundPhase& phase, PhaseEdges& edges) {
    edges = edgesOf(view, phase);
    auto& m = phase.measured;
    const double step = 1.0 / capture.rate_hz;
    m.plateau = phase.sign * edges.plateau;
    m.onset_s = capture.start_s + edges.onset * step;
    m.end_s = capture.start_s + edges.end * step;
    m.width_s = (edges.end - edges.onset) * step;
    m.samples = edges.end > edges.onset ? static_cast<std::size_t>(std::lround(edges.end - edges.onset)) : 0;
    if (m.samples == 0) return;

    const auto onsetSample = static_cast<std::size_t>(std::ceil(edges.onset));
    const auto endSample = static_cast<std::size_t>(std::floor(edges.end));
    m.rise_s = (view.firstRise(onsetSample, endSample, 0.9 * edges.plateau) -
                view.edgeStart(onsetSample, 0.1 * edges.plateau)) *
               step;
    m.fall_s =
        (view.edgeEnd(endSample, 0.1 * edges.plateau) - view.lastFall(endSample, onsetSample, 0.9 * edges.plateau)) *
        step;
    double largest = edges.plateau;
    for (std::size_t i = onsetSample; i <= endSample; ++i) largest = std::max(largest, view[i]);
    m.overshoot = largest / edges.plateau - 1;
    m.droop = -edges.slope * (edges.end - edges.onset) / edges.plateau;
}

/// Charge over the phase with its edges: as far as two and a half edge times beyond the 50 % points, at most to the
/// middle of the gap towards a neighbour.
void integrate(const std::vector<float>& samples, const Capture& capture, const StateLevels& levels,
               std::vector<FoundPhase>& phases, const std::vector<PhaseEdges>& edges) {
    for (std::size_t k = 0; k < phases.size(); ++k) {
        auto& m = phases[k].measured;
        if (m.samples == 0) continue;
        const double slowest = std::max({m.rise_s, m.fall_s, 0.0}) * capture.rate_hz;
        const double reach = (std::isfinite(slowest) ? 2.5 * slowest : 0) + 1;
        double from = std::max(0.0, edges[k].onset - reach);
        double to = std::min(static_cast<double>(samples.size() - 1), edges[k].end + reach);
        const auto endOf = [&](std::size_t j) {
            return std::isfinite(edges[j].end) ? edges[j].end : static_cast<double>(phases[j].end);
        };
        const auto onsetOf = [&](std::size_t j) {
            return std::isfinite(edges[j].onset) ? edges[j].onset : static_cast<double>(phases[j].begin);
        };
        if (k > 0) from = std::max(from, 0.5 * (endOf(k - 1) + edges[k].onset));
        if (k + 1 < phases.size()) to = std::min(to, 0.5 * (edges[k].end + onsetOf(k + 1)));
        const PhaseView view(samples, levels.baseline, phases[k].sign);
        m.charge = phases[k].sign * view.integral(from, to) / capture.rate_hz;
    }
}

/// With a declared range: at or beyond its last step. Without: samples that repeat the record's extreme exactly all
/// along a plateau, in a record that otherwise never stays still.
bool isClipped(const CaptureChannel& channel, const FoundPhase& phase, float lowest, float highest, bool restless) {
    const auto first = channel.samples.begin() + static_cast<std::ptrdiff_t>(phase.begin);
    const auto last = channel.samples.begin() + static_cast<std::ptrdiff_t>(phase.end);
    if (channel.high > channel.low) {
        const double margin = 1.001 * channel.lsb;
        return std::any_of(first, last, [&](float x) {
            const auto value = static_cast<double>(x);
            return value >= channel.high - margin || value <= channel.low + margin;
        });
    }
    if (!restless || phase.end - phase.begin < 10) return false;
    const float extreme = phase.sign > 0 ? highest : lowest;
    return 2 * std::count(first, last, extreme) > last - first;
}

/// True when neighbouring samples differ nearly always, so that a stretch of equal ones is no accident.
bool isRestless(const std::vector<float>& samples) {
    std::size_t moves = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) moves += samples[i] != samples[i - 1] ? 1 : 0;
    return static_cast<double>(moves) > 0.6 * static_cast<double>(samples.size());
}

/// Single samples beyond the threshold are noise where real phases are much larger.
void dropGlitches(std::vector<FoundPhase>& phases) {
    double largest[2] = {0, 0};
    for (const auto& phase : phases) {
        double& side = largest[phase.sign > 0 ? 1 : 0];
        side = std::max(side, phase.area);
    }
    std::erase_if(phases, [&](const FoundPhase& phase) {
        return phase.end - phase.begin < 3 && phase.area < 0.05 * largest[phase.sign > 0 ? 1 : 0];
    });
}

}  // namespace

std::vector<FoundPhase> findPhases(const Capture& capture, const CaptureChannel& channel, const StateLevels& levels) {
    const auto& samples = channel.samples;
    const std::size_t n = samples.size();
    const auto threshold = [&](double state) {
        const double distance = std::abs(state - levels.baseline);
        return std::min(0.5 * distance, std::max(kThreshold * distance, kThresholdInNoise * levels.noise));
    };
    constexpr float kNever = std::numeric_limits<float>::infinity();
    const bool up = levels.high > levels.baseline;
    const bool down = levels.low < levels.baseline;
    const float above = up ? static_cast<float>(levels.baseline + threshold(levels.high)) : kNever;
    const float below = down ? static_cast<float>(levels.baseline - threshold(levels.low)) : -kNever;
    const auto aboveRelease = static_cast<float>(levels.baseline + kRelease * (up ? threshold(levels.high) : 0));
    const auto belowRelease = static_cast<float>(levels.baseline - kRelease * (down ? threshold(levels.low) : 0));

    std::vector<FoundPhase> phases;
    for (std::size_t i = 0; i < n;) {
        const int sign = samples[i] > above ? 1 : samples[i] < below ? -1 : 0;
        if (sign == 0) {
            ++i;
            continue;
        }
        FoundPhase phase;
        phase.begin = i;
        phase.sign = sign;
        // A missing sample does not end a phase; it makes it incomplete.
        while (i < n && !(sign > 0 ? samples[i] < aboveRelease : samples[i] > belowRelease)) {
            if (std::isnan(samples[i])) {
                phase.incomplete = true;
            } else {
                phase.area += std::abs(static_cast<double>(samples[i]) - levels.baseline);
            }
            ++i;
        }
        phase.end = i;
        phase.truncated = phase.begin == 0 || phase.end == n;
        const bool missingBefore = phase.begin > 0 && std::isnan(samples[phase.begin - 1]);
        phase.incomplete = phase.incomplete || missingBefore;
        phases.push_back(phase);
    }
    dropGlitches(phases);

    const bool rangeKnown = channel.high > channel.low;
    const bool restless = !rangeKnown && !phases.empty() && isRestless(samples);
    float lowest = 0;
    float highest = 0;
    if (restless) {
        for (const float x : samples) {
            lowest = std::min(lowest, x);
            highest = std::max(highest, x);
        }
    }
    std::vector<PhaseEdges> edges(phases.size());
    for (std::size_t k = 0; k < phases.size(); ++k) {
        phases[k].clipped = isClipped(channel, phases[k], lowest, highest, restless);
        measurePhase(PhaseView(samples, levels.baseline, phases[k].sign), capture, phases[k], edges[k]);
    }
    integrate(samples, capture, levels, phases, edges);
    return phases;
}

}  // namespace tacto
