#include "core/measure/PhaseShape.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tacto {

namespace {

constexpr double kPlateauFrom = 0.3;
constexpr double kPlateauTo = 0.9;
// An edge is what lies between a quarter and three quarters of the plateau about its 50 % point.
constexpr double kEdgeFoot = 0.25;
constexpr double kEdgeTop = 0.75;

/// One phase's samples seen from the baseline, leading edge up.
class PhaseSamples {
public:
    PhaseSamples(const FoundPhase& phase, double baseline)
        : samples_(phase.view->samples), baseline_(baseline), sign_(phase.sign) {}
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
            if ((*this)[i] >= level) return i == 0 ? kNotMeasured : crossing(i, level);
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
    /// Passages up less passages down through half of `plateau`, on the edge whose first sample at or above it is `i`.
    [[nodiscard]] double risesAt(std::size_t i, std::size_t to, double plateau) const {
        const double half = 0.5 * plateau;
        if ((*this)[i - 1] >= half) return crossing(i, half);
        std::size_t first = i;
        const std::size_t earliest = i - std::min(i, to - std::min(to, i) + 1);
        while (first > earliest && (*this)[first - 1] > kEdgeFoot * plateau) --first;
        std::size_t last = i;
        while (last < to && last + 1 < size() && (*this)[last] < kEdgeTop * plateau) ++last;
        double position = crossing(i, half);
        first = std::max<std::size_t>(first, 1);
        // Not a whole edge: the first passage must do.
        if ((*this)[first - 1] >= half || (*this)[last] < half) return position;
        for (std::size_t k = first; k <= last; ++k) {
            if (k == i || ((*this)[k - 1] >= half) == ((*this)[k] >= half)) continue;
            position += ((*this)[k] >= half ? 1 : -1) * crossing(k, half);
        }
        return position;
    }
    /// The same of a trailing edge whose last sample at or above half is `i`, back to `to` at most.
    [[nodiscard]] double fallsAt(std::size_t i, std::size_t to, double plateau) const {
        const double half = 0.5 * plateau;
        if ((*this)[i + 1] >= half) return crossing(i + 1, half);
        std::size_t last = i + 1;
        const std::size_t latest = std::min(size() - 1, i + 1 + (i - std::min(i, to)) + 1);
        while (last < latest && (*this)[last] > kEdgeFoot * plateau) ++last;
        std::size_t first = i;
        while (first > to && (*this)[first] < kEdgeTop * plateau) --first;
        double position = crossing(i + 1, half);
        if ((*this)[first] < half || (*this)[last] >= half) return position;
        for (std::size_t k = first + 1; k <= last; ++k) {
            if (k == i + 1 || ((*this)[k - 1] >= half) == ((*this)[k] >= half)) continue;
            position += ((*this)[k] >= half ? -1 : 1) * crossing(k, half);
        }
        return position;
    }
    [[nodiscard]] double onset(std::size_t from, std::size_t to, double plateau) const {
        for (std::size_t i = from; i <= to && i < size(); ++i) {
            if ((*this)[i] >= 0.5 * plateau) return i == 0 ? kNotMeasured : risesAt(i, to, plateau);
        }
        return kNotMeasured;
    }
    [[nodiscard]] double end(std::size_t from, std::size_t to, double plateau) const {
        for (std::size_t i = std::min(from, size() - 1) + 1; i-- > to;) {
            if ((*this)[i] >= 0.5 * plateau) return i + 1 >= size() ? kNotMeasured : fallsAt(i, to, plateau);
        }
        return kNotMeasured;
    }
    /// Of the samples first to last, both included: the baseline and the sign are put in once.
    [[nodiscard]] double sum(std::size_t first, std::size_t last) const {
        double sums[2] = {0, 0};
        std::size_t i = first;
        for (; i + 1 <= last; i += 2) {
            sums[0] += static_cast<double>(samples_[i]);
            sums[1] += static_cast<double>(samples_[i + 1]);
        }
        if (i == last) sums[0] += static_cast<double>(samples_[i]);
        return sign_ * (sums[0] + sums[1] - static_cast<double>(last - first + 1) * baseline_);
    }
    /// Largest of the samples first to last, both included.
    [[nodiscard]] double largest(std::size_t first, std::size_t last) const {
        const auto sign = static_cast<float>(sign_);
        float most = sign * samples_[first];
        for (std::size_t i = first; i <= last; ++i) {
            const float x = sign * samples_[i];
            most = x > most ? x : most;
        }
        return static_cast<double>(most) - sign_ * baseline_;
    }
    [[nodiscard]] double at(double position) const {
        const auto i = static_cast<std::size_t>(position);
        if (i + 1 >= size()) return (*this)[size() - 1];
        const double share = position - static_cast<double>(i);
        return (*this)[i] * (1 - share) + (*this)[i + 1] * share;
    }

private:
    std::span<const float> samples_;
    double baseline_;
    double sign_;
};

/// The samples from 30 to 90 % of the width; at least one.
struct PlateauRange {
    std::size_t first;
    std::size_t last;

    PlateauRange(const PhaseSamples& samples, double onset, double end) {
        const double width = end - onset;
        first = static_cast<std::size_t>(std::ceil(std::max(0.0, onset + kPlateauFrom * width)));
        last = std::min(samples.size() - 1, static_cast<std::size_t>(std::max(0.0, onset + kPlateauTo * width)));
        if (first > last) first = last = std::min(samples.size() - 1, first);
    }
};

double levelOf(const PhaseSamples& samples, const PlateauRange& range) {
    return samples.sum(range.first, range.last) / static_cast<double>(range.last - range.first + 1);
}

/// Per sample.
double slopeOf(const PhaseSamples& samples, const PlateauRange& range) {
    double position = 0.5 * (static_cast<double>(range.first) - static_cast<double>(range.last));
    double moment = 0;
    for (std::size_t i = range.first; i <= range.last; ++i, position += 1) moment += position * samples[i];
    const double n = static_cast<double>(range.last - range.first + 1);
    const double squares = n * (n * n - 1) / 12;  // of the positions about their middle
    return squares > 0 ? moment / squares : 0;
}

}  // namespace

void measureShape(FoundPhase& phase, double baseline) {
    const PhaseSamples samples(phase, baseline);
    const std::size_t before = phase.begin == 0 ? 0 : phase.begin - 1;
    PlateauRange range(samples, static_cast<double>(phase.begin), static_cast<double>(phase.end));
    double plateau = levelOf(samples, range);
    // Twice: the second time the plateau is taken between the 50 % points that the first time found.
    for (int pass = 0; pass < 2; ++pass) {
        phase.onset = samples.onset(before, phase.end, plateau);
        phase.end50 = samples.end(phase.end, phase.begin, plateau);
        if (!(phase.end50 > phase.onset)) break;
        range = PlateauRange(samples, phase.onset, phase.end50);
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

    const auto onsetSample = static_cast<std::size_t>(std::ceil(std::max(0.0, phase.onset)));
    const auto endSample = std::min(samples.size() - 1, static_cast<std::size_t>(std::floor(phase.end50)));
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
    const auto first = static_cast<std::size_t>(from) + 1;
    const auto last = static_cast<std::size_t>(to);  // the last sample at or before `to`
    if (last < first) return 0.5 * (samples.at(from) + samples.at(to)) * (to - from);
    // Trapezoids: whole samples but for half of the first and the last, and the pieces outside them.
    double sum = samples.sum(first, last);
    sum -= 0.5 * (samples[first] + samples[last]);
    sum += 0.5 * (samples.at(from) + samples[first]) * (static_cast<double>(first) - from);
    sum += 0.5 * (samples[last] + samples.at(to)) * (to - static_cast<double>(last));
    return sum;
}

}  // namespace tacto
