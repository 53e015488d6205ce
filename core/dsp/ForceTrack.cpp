#include "core/dsp/ForceTrack.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto {

namespace {
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Stamps are decimal numbers in binary: 0.4 - 0.3 is a little more than 0.1.
constexpr double kStampRounding = 1e-9;
constexpr double kKept_s = 4;  // more than any frame waits

std::size_t roomFor(double rate_hz) { return static_cast<std::size_t>(2 * kKept_s * rate_hz) + 256; }
}  // namespace

ForceTrack::ForceTrack(double rate_hz) : samples_(2, roomFor(rate_hz)), firstContact_(kNever) {}

void ForceTrack::clear() noexcept {
    samples_.clear();
    contact_ = false;
    firstContact_ = kNever;
    normaliseCursor_ = readCursor_ = stale_ = invalid_ = outOfOrder_ = 0;
}

double ForceTrack::newest_s() const noexcept { return samples_.end() == 0 ? -kNever : samples_.t(samples_.end() - 1); }

void ForceTrack::push(double t_s, double force_n) noexcept {
    if (!std::isfinite(t_s) || !std::isfinite(force_n)) {
        ++invalid_;
        return;
    }
    if (!(t_s > newest_s())) {
        ++outOfOrder_;
        return;
    }
    if (samples_.end() > 0 && t_s - newest_s() > kStale_s + kStampRounding) {
        ++stale_;
        contact_ = false;  // lost in the silence: it must start again
    }
    contact_ = contact_ ? !(force_n < kContactEnd_n) : force_n >= kContactStart_n;
    if (contact_ && firstContact_ == kNever) firstContact_ = t_s;
    const double row[2] = {force_n, contact_ ? 1.0 : 0.0};
    samples_.push(t_s, row);
    // What was dropped for want of room is no place for a cursor.
    normaliseCursor_ = std::max(normaliseCursor_, samples_.begin());
    readCursor_ = std::max(readCursor_, samples_.begin());
}

void ForceTrack::advance(std::size_t& cursor, double t_s) const noexcept {
    while (hasNext(cursor) && samples_.t(cursor + 1) <= t_s) ++cursor;
}

void ForceTrack::normalise(std::span<const double> stamps, std::span<double* const> axes, double start_s) noexcept {
    std::size_t i = 0;
    while (i < stamps.size()) {
        double force = 0;
        double slope = 0;
        double from = 0;
        double until = kNever;  // the run of samples that one straight line serves
        if (!samples_.empty()) {
            advance(normaliseCursor_, stamps[i]);
            from = samples_.t(normaliseCursor_);
            force = samples_.values(normaliseCursor_)[0];
            if (stamps[i] < from) {
                if (from - start_s > kLongestBridge_s) force = 0;
                until = from;
            } else if (hasNext(normaliseCursor_)) {
                until = samples_.t(normaliseCursor_ + 1);
                if (until - from <= kLongestBridge_s) {
                    slope = (samples_.values(normaliseCursor_ + 1)[0] - force) / (until - from);
                }
            }
        }
        std::size_t end = i + 1;
        while (end < stamps.size() && stamps[end] < until) ++end;
        for (; i < end; ++i) {
            const double divisor = std::max(slope * (stamps[i] - from) + force, kSmallestDivisor_n);
            const double factor = 1 / divisor;
            for (auto* axis : axes) axis[i] *= factor;
        }
    }
}

ForceTrack::Reading ForceTrack::at(double t_s) noexcept {
    if (samples_.empty()) return {kNan, false, false};
    advance(readCursor_, t_s);
    const double from = samples_.t(readCursor_);
    double force = samples_.values(readCursor_)[0];
    if (t_s < from) return {force, false, false};
    if (hasNext(readCursor_)) {
        const double until = samples_.t(readCursor_ + 1);
        if (until - from <= kLongestBridge_s) {
            force += (samples_.values(readCursor_ + 1)[0] - force) / (until - from) * (t_s - from);
        }
    }
    const bool fresh = t_s - from <= kStale_s + kStampRounding;
    return {force, fresh && samples_.values(readCursor_)[1] > 0, fresh};
}

void ForceTrack::release(double t_s) noexcept {
    std::size_t keep = std::min(normaliseCursor_, readCursor_);
    while (keep > samples_.begin() && samples_.t(keep) > t_s) --keep;
    samples_.release(keep);
}

std::size_t ForceTrack::staleStretches(double end_s) const noexcept {
    return stale_ + (samples_.end() > 0 && end_s - newest_s() > kStale_s + kStampRounding ? 1 : 0);
}

}  // namespace tacto
