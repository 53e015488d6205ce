#include "drivers/simulated/FilteredTrace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tacto::sim {

double FilteredTrace::Piece::at(double t_s, double filter_s) const noexcept {
    const double t = t_s - start_s;
    const double own = tau_s > 0 ? c * std::exp(-t / tau_s) : 0;
    return a + b * t + own + k * std::exp(-t / filter_s);
}

FilteredTrace::FilteredTrace(const std::deque<PlayedPulse>& pulses, Channel channel, double bandwidth_hz, double from_s,
                             double to_s)
    : filter_s_(1 / (2 * std::numbers::pi * bandwidth_hz)) {
    // The newest pulse before the window is needed for its tail; older pulses are not.
    auto first = std::partition_point(pulses.begin(), pulses.end(), [&](const auto& p) { return p.onset_s < from_s; });
    if (first != pulses.begin()) --first;
    const double begin = first == pulses.end() ? from_s : std::min(from_s, first->onset_s);
    append(begin - 1, begin, {}, 0);
    for (auto pulse = first; pulse != pulses.end() && pulse->onset_s < to_s; ++pulse) {
        const auto next = std::next(pulse);
        const double until = next == pulses.end() ? std::numeric_limits<double>::max() : next->onset_s;
        for (std::size_t i = 0; i < pulse->pieces.size(); ++i) {
            const auto& piece = pulse->pieces[i];
            const double start = pulse->onset_s + piece.start_s;
            const bool last = i + 1 == pulse->pieces.size();
            const double end = last ? until : std::min(until, start + piece.duration_s);
            if (end <= start) continue;
            append(start, end, channel == Channel::Voltage ? piece.v : piece.i, piece.tau_s);
        }
    }
}

void FilteredTrace::append(double start_s, double end_s, const ExpCurve& curve, double tau_s) {
    Piece piece{start_s, end_s, curve.a - curve.b * filter_s_, curve.b, 0, tau_s, 0};
    if (tau_s > 0 && curve.c != 0) {
        // Equal time constants would need a term t·exp(-t/T); a difference of 1/1000 avoids it, at an error far below
        // any bandwidth error.
        const double difference = tau_s - filter_s_;
        const double safe = std::abs(difference) < 1e-3 * filter_s_ ? 1e-3 * filter_s_ : difference;
        piece.c = curve.c * tau_s / safe;
    }
    piece.k = state_ - piece.a - piece.c;
    state_ = end_s > start_s + 1e3 ? 0 : piece.at(end_s, filter_s_);
    pieces_.push_back(piece);
}

double FilteredTrace::at(double t_s) const noexcept {
    auto piece = std::partition_point(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return p.end_s <= t_s; });
    if (piece == pieces_.end() || t_s < piece->start_s) return 0;
    return piece->at(t_s, filter_s_);
}

std::optional<double> FilteredTrace::risesThrough(double level, double after_s) const noexcept {
    const auto excess = [&](const Piece& piece, double t) { return std::abs(piece.at(t, filter_s_)) - level; };
    bool below = false;  // a signal that is above at first must fall before it can rise
    for (const auto& piece : pieces_) {
        if (piece.end_s <= after_s) continue;
        const double from = std::max(after_s, piece.start_s);
        // Looks at the times where an exponential bends the piece, and at even steps over the rest of it.
        constexpr double kBends[] = {0.25, 0.5, 1, 2, 4, 8};
        double points[24];
        std::size_t count = 0;
        points[count++] = from;
        const double span = std::min(piece.end_s - piece.start_s, 1.0);
        for (const double bend : kBends) {
            points[count++] = piece.start_s + bend * filter_s_;
            if (piece.tau_s > 0) points[count++] = piece.start_s + bend * piece.tau_s;
        }
        for (int i = 1; i <= 8; ++i) points[count++] = piece.start_s + span * i / 8;
        std::sort(points, points + count);
        double before = from;
        for (std::size_t i = 0; i < count; ++i) {
            const double t = points[i];
            if (t < from || t > piece.end_s) continue;
            if (excess(piece, t) < 0) {
                below = true;
                before = t;
                continue;
            }
            if (!below) continue;
            double low = before, high = t;
            while (high - low > 1e-12 && high - low > 4e-16 * high) {
                const double middle = 0.5 * (low + high);
                if (middle <= low || middle >= high) break;
                (excess(piece, middle) < 0 ? low : high) = middle;
            }
            return high;
        }
    }
    return std::nullopt;
}

void FilteredTrace::sample(double start_s, double step_s, std::vector<double>& out) const noexcept {
    std::fill(out.begin(), out.end(), 0.0);
    std::size_t k = 0;
    for (const auto& piece : pieces_) {
        // Sample k belongs to the piece that contains its time; the limits are computed once per piece, not per sample.
        const auto indexAfter = [&](double t) {
            const double position = std::ceil((t - start_s) / step_s);
            return position <= 0 ? std::size_t{0}
                                 : static_cast<std::size_t>(std::min(position, static_cast<double>(out.size())));
        };
        k = std::max(k, indexAfter(piece.start_s));
        const std::size_t end = indexAfter(piece.end_s);
        if (k >= end) continue;
        const double t = start_s + static_cast<double>(k) * step_s - piece.start_s;
        double own = piece.tau_s > 0 ? piece.c * std::exp(-t / piece.tau_s) : 0;
        double filter = piece.k * std::exp(-t / filter_s_);
        const double ownStep = piece.tau_s > 0 ? std::exp(-step_s / piece.tau_s) : 0;
        const double filterStep = std::exp(-step_s / filter_s_);
        double line = piece.a + piece.b * t;
        const double lineStep = piece.b * step_s;
        constexpr double kGone = 1e-12;  // volts or amperes, too small to be seen; avoids slow denormal numbers
        for (; k < end && (std::abs(own) > kGone || std::abs(filter) > kGone); ++k) {
            out[k] = line + own + filter;
            line += lineStep;
            own *= ownStep;
            filter *= filterStep;
        }
        for (; k < end; ++k) {
            out[k] = line;
            line += lineStep;
        }
    }
}

}  // namespace tacto::sim
