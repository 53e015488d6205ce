#include "core/measure/PhaseShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>

namespace tacto {

namespace {

constexpr double kPlateauFrom = 0.3;
constexpr double kPlateauTo = 0.9;
// An edge is the part of the signal between 25 % and 75 % of the plateau, around its 50 % point.
constexpr double kEdgeFoot = 0.25;
constexpr double kEdgeTop = 0.75;

/// Position of a sample. Signed, because the processor converts signed integers to double and back in one step.
using Index = std::ptrdiff_t;

/// Returns the first sample at or after a position, which must not be negative.
Index atOrAfter(double position) {
    const auto before = static_cast<Index>(position);
    return before + (static_cast<double>(before) < position ? 1 : 0);
}

/// The samples of one phase, measured from the baseline, with the leading edge upwards.
class PhaseSamples {
public:
    PhaseSamples(const FoundPhase& phase, double baseline)
        : samples_(phase.view->samples), baseline_(baseline), sign_(phase.sign) {}
    [[nodiscard]] double operator[](Index i) const { return (static_cast<double>(recorded(i)) - baseline_) * sign_; }
    [[nodiscard]] Index size() const { return std::ssize(samples_); }

    /// Returns the position at which the line from sample i - 1 to sample i passes `level`.
    [[nodiscard]] double crossing(Index i, double level) const {
        const double before = (*this)[i - 1];
        const double after = (*this)[i];
        if (before == after) return static_cast<double>(i);
        return static_cast<double>(i) - 1 + std::clamp((level - before) / (after - before), 0.0, 1.0);
    }
    /// Returns the first upward passage from `from` up to and including `to`; NaN if there is none.
    [[nodiscard]] double firstRise(Index from, Index to, double level) const {
        for (Index i = from; i <= to && i < size(); ++i) {
            if ((*this)[i] >= level) return i == 0 ? kNotMeasured : crossing(i, level);
        }
        return kNotMeasured;
    }
    /// Returns the last downward passage, searching from `from` back to `to`.
    [[nodiscard]] double lastFall(Index from, Index to, double level) const {
        for (Index i = std::min(from, size() - 1) + 1; i-- > to;) {
            if ((*this)[i] >= level) return i + 1 >= size() ? kNotMeasured : crossing(i + 1, level);
        }
        return kNotMeasured;
    }
    /// Searches back from `from` for the position at which the leading edge left `level`.
    [[nodiscard]] double edgeStart(Index from, double level) const {
        for (Index i = from; i > 0; --i) {
            if ((*this)[i - 1] <= level) return crossing(i, level);
        }
        return kNotMeasured;
    }
    /// Searches forward from `from` for the position at which the trailing edge reached `level`.
    [[nodiscard]] double edgeEnd(Index from, double level) const {
        for (Index i = from; i < size(); ++i) {
            if ((*this)[i] <= level) return i == 0 ? kNotMeasured : crossing(i, level);
        }
        return kNotMeasured;
    }
    /// Places the edge at its 50 % point: upward passages less downward ones. `i`: its first sample at or above half.
    [[nodiscard]] double risesAt(Index i, Index to, double plateau) const {
        const double half = 0.5 * plateau;
        if ((*this)[i - 1] >= half) return crossing(i, half);
        Index first = i;
        const Index earliest = i - std::min(i, to - std::min(to, i) + 1);
        while (first > earliest && (*this)[first - 1] > kEdgeFoot * plateau) --first;
        Index last = i;
        while (last < to && last + 1 < size() && (*this)[last] < kEdgeTop * plateau) ++last;
        double position = crossing(i, half);
        first = std::max<Index>(first, 1);
        // The edge is incomplete, so the first passage is used.
        if ((*this)[first - 1] >= half || (*this)[last] < half) return position;
        for (Index k = first; k <= last; ++k) {
            if (k == i || ((*this)[k - 1] >= half) == ((*this)[k] >= half)) continue;
            position += ((*this)[k] >= half ? 1 : -1) * crossing(k, half);
        }
        return position;
    }
    /// Does the same for a trailing edge whose last sample at or above half is `i`, going back no further than `to`.
    [[nodiscard]] double fallsAt(Index i, Index to, double plateau) const {
        const double half = 0.5 * plateau;
        if ((*this)[i + 1] >= half) return crossing(i + 1, half);
        Index last = i + 1;
        const Index latest = std::min(size() - 1, i + 1 + (i - std::min(i, to)) + 1);
        while (last < latest && (*this)[last] > kEdgeFoot * plateau) ++last;
        Index first = i;
        while (first > to && (*this)[first] < kEdgeTop * plateau) --first;
        double position = crossing(i + 1, half);
        if ((*this)[first] < half || (*this)[last] >= half) return position;
        for (Index k = first + 1; k <= last; ++k) {
            if (k == i + 1 || ((*this)[k - 1] >= half) == ((*this)[k] >= half)) continue;
            position += ((*this)[k] >= half ? -1 : 1) * crossing(k, half);
        }
        return position;
    }
    [[nodiscard]] double onset(Index from, Index to, double plateau) const {
        for (Index i = from; i <= to && i < size(); ++i) {
            if ((*this)[i] >= 0.5 * plateau) return i == 0 ? kNotMeasured : risesAt(i, to, plateau);
        }
        return kNotMeasured;
    }
    [[nodiscard]] double end(Index from, Index to, double plateau) const {
        for (Index i = std::min(from, size() - 1) + 1; i-- > to;) {
            if ((*this)[i] >= 0.5 * plateau) return i + 1 >= size() ? kNotMeasured : fallsAt(i, to, plateau);
        }
        return kNotMeasured;
    }
    /// Returns the sum of samples first to last, both included. Baseline and sign are applied once at the end.
    [[nodiscard]] double sum(Index first, Index last) const {
        double sums[2] = {0, 0};
        Index i = first;
        for (; i + 1 <= last; i += 2) {
            sums[0] += static_cast<double>(recorded(i));
            sums[1] += static_cast<double>(recorded(i + 1));
        }
        if (i == last) sums[0] += static_cast<double>(recorded(i));
        return sign_ * (sums[0] + sums[1] - static_cast<double>(last - first + 1) * baseline_);
    }
    /// Returns the largest of samples first to last, both included. In lanes, so that no comparison waits for the last.
    [[nodiscard]] double largest(Index first, Index last) const {
        const auto sign = static_cast<float>(sign_);
        std::array<float, 4> most;
        most.fill(sign * recorded(first));
        const auto take = [&](Index i, float& lane) {
            const float x = sign * recorded(i);
            lane = x > lane ? x : lane;
        };
        Index i = first;
        while (i + 3 <= last) {
            for (float& lane : most) take(i++, lane);
        }
        while (i <= last) take(i++, most[0]);
        for (const float lane : most) most[0] = lane > most[0] ? lane : most[0];
        return static_cast<double>(most[0]) - sign_ * baseline_;
    }
    [[nodiscard]] double at(double position) const {
        const auto i = static_cast<Index>(position);
        if (i + 1 >= size()) return (*this)[size() - 1];
        const double share = position - static_cast<double>(i);
        return (*this)[i] * (1 - share) + (*this)[i + 1] * share;
    }

private:
    [[nodiscard]] float recorded(Index i) const { return samples_[static_cast<std::size_t>(i)]; }

    std::span<const float> samples_;
    double baseline_;
    double sign_;
};

/// The samples from 30 to 90 % of the width, at least one.
struct PlateauRange {
    Index first;
    Index last;

    PlateauRange(const PhaseSamples& samples, double onset, double end) {
        const double width = end - onset;
        first = atOrAfter(std::max(0.0, onset + kPlateauFrom * width));
        last = std::min(samples.size() - 1, static_cast<Index>(std::max(0.0, onset + kPlateauTo * width)));
        if (first > last) first = last = std::min(samples.size() - 1, first);
    }
    friend bool operator==(const PlateauRange&, const PlateauRange&) = default;
};

double levelOf(const PhaseSamples& samples, const PlateauRange& range) {
    return samples.sum(range.first, range.last) / static_cast<double>(range.last - range.first + 1);
}

/// Returns the slope per sample.
double slopeOf(const PhaseSamples& samples, const PlateauRange& range) {
    double position = 0.5 * (static_cast<double>(range.first) - static_cast<double>(range.last));
    double moment = 0;
    for (Index i = range.first; i <= range.last; ++i, position += 1) moment += position * samples[i];
    const double n = static_cast<double>(range.last - range.first + 1);
    const double squares = n * (n * n - 1) / 12;  // sum of the squared positions, from their middle
    return squares > 0 ? moment / squares : 0;
}

}  // namespace

void measureShape(const PhaseSpan& span, double baseline, FoundPhase& phase) {
    static_cast<PhaseSpan&>(phase) = span;
    phase.measured = {};
    const PhaseSamples samples(phase, baseline);
    const auto begin = static_cast<Index>(phase.begin);
    const auto end = static_cast<Index>(phase.end);
    const Index before = std::max<Index>(begin - 1, 0);
    PlateauRange range(samples, static_cast<double>(begin), static_cast<double>(end));
    double plateau = levelOf(samples, range);
    // The second pass takes the plateau between the 50 % points that the first pass found.
    for (int pass = 0; pass < 2; ++pass) {
        phase.onset = samples.onset(before, end, plateau);
        phase.end50 = samples.end(end, begin, plateau);
        if (!(phase.end50 > phase.onset)) break;
        const PlateauRange between(samples, phase.onset, phase.end50);
        if (between == range) break;  // the plateau would not change any more
        range = between;
        plateau = levelOf(samples, range);
    }
    auto& m = phase.measured;
    const auto& view = *phase.view;
    const double step = 1.0 / view.rate_hz;
    const double width = phase.end50 - phase.onset;
    m.plateau = phase.sign * plateau;
    m.onset_s = view.timeOf(phase.onset);
    m.end_s = view.timeOf(phase.end50);
    m.width_s = width * step;
    m.samples = width > 0 ? static_cast<std::size_t>(std::lround(width)) : 0;
    if (m.samples == 0) return;

    const auto onsetSample = atOrAfter(std::max(0.0, phase.onset));
    const auto endSample = std::min(samples.size() - 1, static_cast<Index>(phase.end50));
    m.rise_s =
        (samples.firstRise(onsetSample, endSample, 0.9 * plateau) - samples.edgeStart(onsetSample, 0.1 * plateau)) *
        step;
    m.fall_s =
        (samples.edgeEnd(endSample, 0.1 * plateau) - samples.lastFall(endSample, onsetSample, 0.9 * plateau)) * step;
    const double largest = onsetSample <= endSample ? samples.largest(onsetSample, endSample) : plateau;
    m.overshoot = std::max(largest, plateau) / plateau - 1;
    m.droop = -slopeOf(samples, range) * width / plateau;
}

double integralOf(const FoundPhase& phase, double baseline, double from, double to) {
    if (!(to > from)) return 0;
    const PhaseSamples samples(phase, baseline);
    const auto first = static_cast<Index>(from) + 1;
    const auto last = static_cast<Index>(to);  // last sample at or before `to`
    if (last < first) return 0.5 * (samples.at(from) + samples.at(to)) * (to - from);
    // Trapezoid rule: whole samples less half of the first and the last, plus the pieces outside them.
    double sum = samples.sum(first, last);
    sum -= 0.5 * (samples[first] + samples[last]);
    sum += 0.5 * (samples.at(from) + samples[first]) * (static_cast<double>(first) - from);
    sum += 0.5 * (samples[last] + samples.at(to)) * (to - static_cast<double>(last));
    return sum;
}

}  // namespace tacto
