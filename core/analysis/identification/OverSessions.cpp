#include "core/analysis/identification/OverSessions.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/identification/LogisticTrend.h"
#include "core/analysis/statistics/Binomial.h"

namespace tacto {

namespace {

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

/// The first session of which `known` holds; null for none.
template <class Known>
const SessionFigures* firstOf(const std::vector<SessionFigures>& sessions, Known known) {
    const auto found = std::ranges::find_if(sessions, known);
    return found == sessions.end() ? nullptr : &*found;
}

/// A figure divided by that of the first session that has it.
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
    if (n == 0 || !(accuracy > 0 && accuracy < 1)) return kNaN;  // all alike: the spread is not known
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

}  // namespace tacto
