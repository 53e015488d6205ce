#include "core/analysis/sensor_calibration/SurfaceDistance.h"

#include <algorithm>
#include <cmath>

#include "core/base/Statistics.h"

namespace tacto {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double normalCdf(double x) noexcept { return std::erfc(-x / std::sqrt(2.0)) / 2; }

/// Finds the non-centrality for which P(T ≤ t) = p. P falls as the non-centrality rises.
double noncentralityAt(double t, double degreesOfFreedom, double p) noexcept {
    // Start far beyond both solutions: T has a spread of about √(1 + t²/2ν), and 2.5 % lie within a few times this.
    const double reach = 8 * std::sqrt(1 + t * t / (2 * degreesOfFreedom)) + 8;
    double low = t - reach, high = t + reach;
    const auto excess = [&](double noncentrality) { return noncentralT(t, degreesOfFreedom, noncentrality) - p; };
    // Halve the interval while the curve is flat, then use the faster false position (Illinois rule).
    for (int i = 0; i < 8; ++i) {
        const double middle = (low + high) / 2;
        (excess(middle) > 0 ? low : high) = middle;
    }
    double atLow = excess(low), atHigh = excess(high), guess = (low + high) / 2;
    int side = 0;
    for (int i = 0; i < 60 && atLow != atHigh; ++i) {
        guess = (low * atHigh - high * atLow) / (atHigh - atLow);
        const double at = excess(guess);
        if (std::abs(at) < 1e-11) break;
        const int now = at > 0 ? 1 : -1;
        (now > 0 ? low : high) = guess;
        (now > 0 ? atLow : atHigh) = at;
        if (now == side) (now > 0 ? atHigh : atLow) /= 2;
        side = now;
    }
    return guess;
}

Result<Statistics> readingsOf(std::span<const double> readings) {
    if (readings.size() < kMinSlides) {
        return invalid("distance of two surfaces: one surface has only {} slides; at least {} are needed",
                       readings.size(), kMinSlides);
    }
    for (const double reading : readings) {
        if (!std::isfinite(reading)) {
            return invalid("distance of two surfaces: a reading is {}; a finite one is expected", reading);
        }
    }
    return statisticsOf(readings);
}

}  // namespace

double noncentralT(double t, double degreesOfFreedom, double noncentrality) noexcept {
    if (!std::isfinite(t) || !std::isfinite(noncentrality) || !(degreesOfFreedom >= 1) ||
        !std::isfinite(degreesOfFreedom)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    // T = (Z + δ) / S with S = √(χ²/ν), so P(T ≤ t) = ∫ Φ(t s - δ) f(s) ds. f is the chi density scaled by √ν; its
    // constant cancels by dividing by the same sum. Simpson's rule suits this smooth integrand, except near the step of
    // Φ (width 1/t), which is integrated separately.
    const double nu = degreesOfFreedom;
    const double spread = 1 / std::sqrt(2 * nu);
    const double begin = std::max(0.0, 1 - 10 * spread), end = 1 + 10 * spread;
    const auto density = [nu](double s) {
        return s > 0 ? std::exp((nu - 1) * std::log(s) - nu * (s * s - 1) / 2) : (nu > 1 ? 0.0 : std::exp(nu / 2));
    };
    const auto integral = [&](double a, double b, const auto& f) {
        constexpr int kCells = 240;
        if (!(b > a)) return 0.0;
        const double step = (b - a) / kCells;
        double sum = f(a) + f(b);
        for (int i = 1; i < kCells; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(a + i * step);
        return sum * step / 3;
    };
    const auto inner = [&](double s) { return normalCdf(t * s - noncentrality) * density(s); };
    double below = begin, above = end;
    if (t != 0) {
        const double at = noncentrality / t, width = 9 / std::abs(t);
        below = std::clamp(at - width, begin, end);
        above = std::clamp(at + width, begin, end);
    }
    const double mass = integral(begin, end, density);
    const double sum = integral(begin, below, inner) + integral(below, above, inner) + integral(above, end, inner);
    return std::clamp(sum / mass, 0.0, 1.0);
}

bool SurfaceDistance::toldApart() const noexcept { return d.low >= kToldApart || d.high <= -kToldApart; }

Estimate SurfaceDistance::magnitude() const noexcept {
    if (d.value < 0) return {-d.value, -d.high, -d.low};
    return d;
}

Result<SurfaceDistance> surfaceDistance(std::span<const double> first, std::span<const double> second) {
    const auto a = readingsOf(first), b = readingsOf(second);
    if (!a) return failure(a);
    if (!b) return failure(b);
    SurfaceDistance out;
    out.n1 = first.size();
    out.n2 = second.size();
    const auto n1 = static_cast<double>(out.n1), n2 = static_cast<double>(out.n2);
    const double freedom = n1 + n2 - 2;
    out.difference = b->mean - a->mean;
    out.pooledSd = std::sqrt(((n1 - 1) * a->sd * a->sd + (n2 - 1) * b->sd * b->sd) / freedom);
    if (!(out.pooledSd > 0)) {
        const double d = out.difference == 0 ? 0 : std::copysign(kInfinity, out.difference);
        out.d = {d, d, d};
        return out;
    }
    const double scale = std::sqrt(n1 * n2 / (n1 + n2));
    const double d = out.difference / out.pooledSd, t = d * scale;
    out.d = {d, noncentralityAt(t, freedom, 0.975) / scale, noncentralityAt(t, freedom, 0.025) / scale};
    return out;
}

}  // namespace tacto
