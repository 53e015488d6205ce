#include "core/analysis/identification/OverSessions.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/identification/LogisticTrend.h"
#include "core/analysis/statistics/Binomial.h"

namespace tacto {

namespace {

/// a/b of two positive estimates: distances of the logarithms to their ends, squared and added.
Estimate ratioOf(const Estimate& a, const Estimate& b) {
    if (!(a.value > 0) || !(b.value > 0)) return {};
    const double ratio = std::log(a.value / b.value);
    return {std::exp(ratio), std::exp(ratio - std::hypot(std::log(a.value / a.low), std::log(b.high / b.value))),
            std::exp(ratio + std::hypot(std::log(a.high / a.value), std::log(b.value / b.low)))};
}

Result<void> checkSessions(const std::vector<SessionFigures>& sessions) {
    double before = -std::numeric_limits<double>::infinity();
    for (const auto& session : sessions) {
        if (!std::isfinite(session.days) || !(session.days >= before)) {
            return fail(ErrorCode::InvalidArgument,
                        "session {} lies {} days after the first; sessions in their order were expected",
                        session.number, session.days);
        }
        if (session.hits > session.n) {
            return fail(ErrorCode::InvalidArgument, "session {} has {} right answers of {}; at most {} were expected",
                        session.number, session.hits, session.n, session.n);
        }
        before = session.days;
    }
    return {};
}

}  // namespace

double smallestChange(std::size_t n, double accuracy) noexcept {
    constexpr double kZ = 1.959963984540054;  // 97.5 % point of the normal distribution
    if (n == 0) return kNaN;
    return kZ * std::sqrt(2 * accuracy * (1 - accuracy) / static_cast<double>(n));
}

Result<OverSessions> compareSessions(std::vector<SessionFigures> sessions) {
    if (auto sane = checkSessions(sessions); !sane) return failure(sane);
    OverSessions out;
    std::vector<TrendPoint> points;
    std::size_t n = 0, hits = 0, least = 0;
    for (const auto& session : sessions) {
        points.push_back({session.days, session.n, session.hits});
        n += session.n;
        hits += session.hits;
        if (session.n > 0) least = least == 0 ? session.n : std::min(least, session.n);
        if (&session == &sessions.front()) continue;
        const auto& first = sessions.front();
        out.againstFirst.push_back({.number = session.number,
                                    .accuracy = newcombeDifference(session.hits, session.n, first.hits, first.n),
                                    .detection = ratioOf(session.detection_ma, first.detection_ma),
                                    .tooStrong = session.tooStrong / first.tooStrong,
                                    .impedance = session.impedance / first.impedance});
    }
    if (sessions.size() >= 3) out.trend = logisticSlope(points);
    if (sessions.size() >= 2 && n > 0) {
        out.smallestChange = smallestChange(least, static_cast<double>(hits) / static_cast<double>(n));
    }
    out.sessions = std::move(sessions);
    return out;
}

}  // namespace tacto
