#include "core/analysis/identification/OverSessions.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

Result<void> checkSessions(const std::vector<SessionFigures>& sessions) {
    double before = -std::numeric_limits<double>::infinity();
    for (const auto& session : sessions) {
        if (!std::isfinite(session.days) || !(session.days >= before)) {
            return invalid("session {} lies {} days after the first; sessions in their order were expected",
                           session.number, session.days);
        }
        if (session.hits > session.n) {
            return invalid("session {} has {} right answers of {}; at most {} were expected", session.number,
                           session.hits, session.n, session.n);
        }
        before = session.days;
    }
    return {};
}

/// Returns the first session for which `known` is true, or null.
template <class Known>
const SessionFigures* firstOf(const std::vector<SessionFigures>& sessions, Known known) {
    const auto found = std::ranges::find_if(sessions, known);
    return found == sessions.end() ? nullptr : &*found;
}

/// Divides a figure by its value in the first session that has it.
template <class Figure>
double ratioToFirst(const std::vector<SessionFigures>& sessions, const SessionFigures& session, Figure figure) {
    const auto* first = firstOf(sessions, [&](const auto& each) { return figure(each) > 0; });
    return first == nullptr || first == &session ? kNaN : figure(session) / figure(*first);
}

SessionChange changeOf(const std::vector<SessionFigures>& sessions, const SessionFigures& session) {
    SessionChange change;
    change.number = session.number;
    const auto* answered = firstOf(sessions, [](const auto& each) { return each.n > 0; });
    if (session.n > 0 && answered != &session)
        change.accuracy = newcombeDifference(session.hits, session.n, answered->hits, answered->n);
    const auto* detected = firstOf(sessions, [](const auto& each) { return each.detection.value > 0; });
    if (detected != nullptr && detected != &session) change.detection = ratioOf(session.detection, detected->detection);
    change.tooStrong = ratioToFirst(sessions, session, [](const auto& each) { return each.tooStrong; });
    change.high = ratioToFirst(sessions, session, [](const auto& each) { return each.high; });
    change.impedance = ratioToFirst(sessions, session, [](const auto& each) { return each.impedance.value(); });
    return change;
}

}  // namespace

Estimate ratioOf(const Estimate& a, const Estimate& b) noexcept {
    if (!(a.value > 0) || !(b.value > 0)) return {};
    const double ratio = std::log(a.value / b.value);
    return {std::exp(ratio), std::exp(ratio - std::hypot(std::log(a.value / a.low), std::log(b.high / b.value))),
            std::exp(ratio + std::hypot(std::log(a.high / a.value), std::log(b.value / b.low)))};
}

double smallestChange(std::size_t n, double accuracy) noexcept {
    constexpr double kZ = 1.959963984540054;                     // 97.5 % point of the normal distribution
    if (n == 0 || !(accuracy > 0 && accuracy < 1)) return kNaN;  // all answers are equal: unknown spread
    return kZ * std::sqrt(2 * accuracy * (1 - accuracy) / static_cast<double>(n));
}

Result<OverSessions> compareSessions(std::vector<SessionFigures> sessions) {
    if (auto sane = checkSessions(sessions); !sane) return failure(sane);
    OverSessions out;
    std::vector<LogisticPoint> points;
    std::size_t n = 0, hits = 0, least = 0;
    for (const auto& session : sessions) {
        if (session.n > 0) points.push_back({session.days, session.n, session.hits});
        n += session.n;
        hits += session.hits;
        if (session.n > 0) least = least == 0 ? session.n : std::min(least, session.n);
        if (&session != &sessions.front()) out.againstFirst.push_back(changeOf(sessions, session));
    }
    if (points.size() >= 3) out.trend = logisticSlope(points);
    if (points.size() >= 2) {
        out.smallestChange = smallestChange(least, static_cast<double>(hits) / static_cast<double>(n));
    }
    out.sessions = std::move(sessions);
    return out;
}

namespace {

constexpr double kDeviance95 = 3.841458820694124;  // 95 % point of χ² with one degree of freedom
/// Steepest slope tried, in units of the whole range of x. At steeper slopes every answer lies on the flat ends.
constexpr double kSteepest = 200;
constexpr int kHalvings = 200;

/// Logistic model over x from 0 to 1. The intercept is always the best one for the given slope.
class SlopeProfile {
public:
    explicit SlopeProfile(std::vector<LogisticPoint> points) : points_(std::move(points)) {
        for (const auto& point : points_) right_ += static_cast<double>(point.hits);
    }

    [[nodiscard]] double logLikelihood(double slope) const {
        const double intercept = interceptFor(slope);
        double sum = 0;
        for (const auto& point : points_) {
            const double z = intercept + slope * point.x;
            const double hits = static_cast<double>(point.hits), misses = static_cast<double>(point.n) - hits;
            sum -= hits * softPlus(-z) + misses * softPlus(z);
        }
        return sum;
    }
    /// Derivative of the profile likelihood; it falls as the slope rises.
    [[nodiscard]] double score(double slope) const {
        const double intercept = interceptFor(slope);
        double sum = 0;
        for (const auto& point : points_) {
            sum += point.x * (static_cast<double>(point.hits) -
                              static_cast<double>(point.n) * probability(intercept + slope * point.x));
        }
        return sum;
    }

private:
    [[nodiscard]] static double softPlus(double z) { return std::max(z, 0.0) + std::log1p(std::exp(-std::abs(z))); }
    [[nodiscard]] static double probability(double z) { return 1 / (1 + std::exp(-z)); }

    /// Finds the intercept at which the expected number of right answers equals the actual number, by bisection.
    [[nodiscard]] double interceptFor(double slope) const {
        double low = -60 - std::abs(slope), high = 60 + std::abs(slope);
        for (int i = 0; i < kHalvings && high - low > 1e-14 * (1 + std::abs(low)); ++i) {
            const double middle = low + (high - low) / 2;
            double expected = 0;
            for (const auto& point : points_) {
                expected += static_cast<double>(point.n) * probability(middle + slope * point.x);
            }
            (expected < right_ ? low : high) = middle;
        }
        return low + (high - low) / 2;
    }

    std::vector<LogisticPoint> points_;
    double right_ = 0;
};

/// Finds by bisection where `above` changes from true at `inside` to false at `outside`.
template <class Above>
double turnOf(double inside, double outside, Above&& above) {
    for (int i = 0; i < kHalvings && std::abs(outside - inside) > 1e-13 * (1 + std::abs(inside)); ++i) {
        const double middle = inside + (outside - inside) / 2;
        (above(middle) ? inside : outside) = middle;
    }
    return inside + (outside - inside) / 2;
}

}  // namespace

Estimate logisticSlope(std::span<const LogisticPoint> points) {
    std::vector<LogisticPoint> used;
    double least = 0, most = 0;
    std::size_t n = 0, hits = 0;
    for (const auto& point : points) {
        if (point.n == 0) continue;
        least = used.empty() ? point.x : std::min(least, point.x);
        most = used.empty() ? point.x : std::max(most, point.x);
        n += point.n;
        hits += point.hits;
        used.push_back(point);
    }
    const double range = most - least;
    if (!(range > 0) || hits == 0 || hits >= n) return {};
    for (auto& point : used) point.x = (point.x - least) / range;

    const SlopeProfile profile(std::move(used));
    constexpr double kOpen = std::numeric_limits<double>::infinity();
    const double found = turnOf(-kSteepest, kSteepest, [&](double b) { return profile.score(b) > 0; });
    // If a slope separates the answers perfectly, steeper slopes are equally good apart from rounding.
    constexpr double kAsGood = 1e-9;
    const double asGood = profile.logLikelihood(found) - kAsGood;
    const bool openAbove = profile.logLikelihood(kSteepest) >= asGood;
    const bool openBelow = profile.logLikelihood(-kSteepest) >= asGood;
    const double best = openAbove ? kSteepest : openBelow ? -kSteepest : found;
    const double needed = profile.logLikelihood(best) - kDeviance95 / 2;
    const auto plausible = [&](double slope) { return profile.logLikelihood(slope) >= needed; };
    const auto end = [&](double far) {
        if (plausible(far)) return std::copysign(kOpen, far);
        return turnOf(best, far, plausible) / range;
    };
    const double value = openAbove ? kOpen : openBelow ? -kOpen : best / range;
    return {value, end(-kSteepest), end(kSteepest)};
}

std::map<std::string, std::size_t> preferences(std::span<const EncodingPreference> people) {
    std::map<std::string, std::size_t> out;
    for (const auto& person : people) {
        for (const auto& encoding : person.had) out.try_emplace(encoding, 0);
        if (!person.preferred.empty()) ++out[person.preferred];
    }
    return out;
}

std::size_t williamsRows(std::size_t encodings) noexcept {
    if (encodings < 2) return 1;
    return encodings % 2 == 0 ? encodings : 2 * encodings;
}

std::vector<std::size_t> williamsOrder(std::size_t encodings, std::size_t enrolled) {
    if (encodings == 0) return {};
    const std::size_t row = enrolled % williamsRows(encodings);
    std::vector<std::size_t> order;
    // 0, 1, n - 1, 2, n - 2, ... plus the row's number; odd designs add the same rows in reverse.
    for (std::size_t i = 0; i < encodings; ++i) {
        const std::size_t step = i % 2 == 1 ? (i + 1) / 2 : (encodings - i / 2) % encodings;
        order.push_back((step + row) % encodings);
    }
    if (row >= encodings) order = {order.rbegin(), order.rend()};
    return order;
}

}  // namespace tacto
