#include "core/dsp/ForceTrack.h"

#include <algorithm>
#include <cmath>

#include "core/base/Statistics.h"

namespace tacto {

namespace {
constexpr double kForceKept_s = 4;  // longer than any frame waits

std::size_t roomFor(double rate_hz) { return static_cast<std::size_t>(2 * kForceKept_s * rate_hz) + 256; }
}  // namespace

ForceTrack::ForceTrack(double rate_hz, double most)
    : samples_(2, roomFor(rate_hz)), firstContact_(kInfinity_s), mostPlausible_(most) {}

void ForceTrack::clear() noexcept {
    samples_.clear();
    contact_ = false;
    firstContact_ = kInfinity_s;
    normaliseCursor_ = readCursor_ = stale_ = invalid_ = beyond_ = outOfOrder_ = 0;
    least_ = kInfinity_s;
    most_ = -kInfinity_s;
}

void ForceTrack::push(double t_s, double force_n) noexcept {
    if (!std::isfinite(t_s) || std::isnan(force_n)) {
        ++invalid_;
        return;
    }
    if (!(std::abs(force_n) <= mostPlausible_)) {
        ++beyond_;
        return;
    }
    if (!(t_s > newest_s())) {
        ++outOfOrder_;
        return;
    }
    if (samples_.end() > 0 && t_s - newest_s() > kStale_s + kStampRounding_s) {
        ++stale_;
        contact_ = false;  // contact ends in the silence and must start again
    }
    contact_ = contact_ ? !(force_n < kContactEnd_n) : force_n >= kContactStart_n;
    if (contact_ && firstContact_ == kInfinity_s) firstContact_ = t_s;
    least_ = std::min(least_, force_n);
    most_ = std::max(most_, force_n);
    const double row[2] = {force_n, contact_ ? 1.0 : 0.0};
    samples_.push(t_s, row);
    // A cursor must not point to samples that were dropped for lack of room.
    normaliseCursor_ = std::max(normaliseCursor_, samples_.begin());
    readCursor_ = std::max(readCursor_, samples_.begin());
}

void ForceTrack::advance(std::size_t& cursor, double t_s) const noexcept {
    while (hasNext(cursor) && samples_.t(cursor + 1) <= t_s) ++cursor;
}

double ForceTrack::Line::divisor(double t_s) const noexcept {
    // At the sample's own stamp the next sample says nothing, so that it makes no difference whether it is known.
    const double since = t_s - from;
    return std::max((since > kStampRounding_s ? slope * since : 0) + force, kSmallestDivisor_n);
}

ForceTrack::Line ForceTrack::lineAt(std::size_t& cursor, double t_s, double start_s) const noexcept {
    Line line{0, 0, 0, kInfinity_s};
    if (samples_.empty()) return line;
    advance(cursor, t_s);
    line.from = samples_.t(cursor);
    line.force = samples_.values(cursor)[0];
    if (t_s < line.from) {
        if (line.from - start_s > kLongestBridge_s) line.force = 0;
        line.until = line.from;
    } else if (hasNext(cursor)) {
        line.until = samples_.t(cursor + 1);
        const double step = line.until - line.from;
        if (step <= kLongestBridge_s) line.slope = (samples_.values(cursor + 1)[0] - line.force) / step;
    }
    return line;
}

void ForceTrack::normalise(std::span<const double> stamps, std::span<double* const> axes, double start_s) noexcept {
    std::size_t i = 0;
    while (i < stamps.size()) {
        const Line line = lineAt(normaliseCursor_, stamps[i], start_s);
        std::size_t end = i + 1;
        while (end < stamps.size() && stamps[end] < line.until) ++end;
        // Four at a time, so that the divisions do not wait for each other.
        for (; i + 4 <= end; i += 4) {
            double factors[4];
            for (std::size_t j = 0; j < 4; ++j) factors[j] = 1 / line.divisor(stamps[i + j]);
            for (auto* axis : axes) {
                for (std::size_t j = 0; j < 4; ++j) axis[i + j] *= factors[j];
            }
        }
        for (; i < end; ++i) {
            const double factor = 1 / line.divisor(stamps[i]);
            for (auto* axis : axes) axis[i] *= factor;
        }
    }
}

void ForceTrack::divisors(std::span<const double> stamps, std::span<double> out, double start_s) const noexcept {
    std::size_t cursor = samples_.begin();
    for (std::size_t i = 0; i < stamps.size(); ++i) out[i] = lineAt(cursor, stamps[i], start_s).divisor(stamps[i]);
}

bool ForceTrack::unsteady(double begin_s, double end_s, double start_s) const noexcept {
    constexpr double kSteady = 2;
    // A straight line has its extremes at its ends.
    std::size_t cursor = samples_.begin();
    double smallest = lineAt(cursor, begin_s, start_s).divisor(begin_s);
    double largest = smallest;
    const auto see = [&](double divisor) {
        smallest = std::min(smallest, divisor);
        largest = std::max(largest, divisor);
    };
    for (std::size_t i = cursor; i < samples_.end() && samples_.t(i) <= end_s; ++i) {
        if (samples_.t(i) >= begin_s) see(std::max(samples_.values(i)[0], kSmallestDivisor_n));
    }
    see(lineAt(cursor, end_s, start_s).divisor(end_s));
    return largest > kSteady * smallest;
}

ForceTrack::Reading ForceTrack::at(double t_s) noexcept {
    if (samples_.empty()) return {kNaN, false, false};
    advance(readCursor_, t_s);
    const double from = samples_.t(readCursor_);
    double force = samples_.values(readCursor_)[0];
    if (t_s < from) return {force, false, false};
    if (hasNext(readCursor_) && t_s - from > kStampRounding_s) {
        const double until = samples_.t(readCursor_ + 1);
        if (until - from <= kLongestBridge_s) {
            force += (samples_.values(readCursor_ + 1)[0] - force) / (until - from) * (t_s - from);
        }
    }
    const bool fresh = t_s - from <= kStale_s + kStampRounding_s;
    return {force, fresh && samples_.values(readCursor_)[1] > 0, fresh};
}

void ForceTrack::release(double t_s) noexcept {
    std::size_t keep = std::min(normaliseCursor_, readCursor_);
    while (keep > samples_.begin() && samples_.t(keep) > t_s) --keep;
    samples_.release(keep);
}

std::size_t ForceTrack::staleStretches(double end_s) const noexcept {
    return stale_ + (samples_.end() > 0 && end_s - newest_s() > kStale_s + kStampRounding_s ? 1 : 0);
}

}  // namespace tacto
