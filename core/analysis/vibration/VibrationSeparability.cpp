#include "core/analysis/vibration/VibrationSeparability.h"

#include <algorithm>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/results/ResultRecord.h"

namespace tacto {

using nlohmann::json;

namespace {

constexpr const char* kNotMeasured =
    "Not measured: no accelerometer was read on the motor. What it did is not known, only what it was commanded to do.";

RecordFields<BurstFigures> burstFields() {
    using F = BurstFigures;
    RecordFields<F> all;
    all.number("bursts", &F::bursts);
    all.number("moved", &F::moved);
    all.number("missed", &F::missed);
    all.number("strength_m_s2", &F::strength_m_s2);
    all.number("strength_u_m_s2", &F::strengthUncertainty_m_s2);
    all.number("latency_s", &F::latency_s);
    all.number("rise_s", &F::rise_s);
    all.number("interval_s", &F::interval_s);
    all.number("interval_u_s", &F::intervalUncertainty_s);
    all.number("noise_m_s2", &F::noise_m_s2);
    return all;
}

bool wasRead(const VibrationTrial& trial) { return trial.measured.bursts > trial.measured.missed; }

VibrationCondition summarise(std::span<const VibrationTrial> trials, const std::string& name) {
    VibrationCondition out;
    out.name = name;
    std::vector<double> strength, latency, rise, interval;
    const auto keep = [](std::vector<double>& into, double value) {
        if (std::isfinite(value)) into.push_back(value);
    };
    for (const auto& trial : trials) {
        if (trial.condition != name) continue;
        ++out.presentations;
        out.intensity = trial.intensity;
        out.interval_s = trial.interval_s;
        out.bursts += trial.measured.bursts;
        out.moved += trial.measured.moved;
        out.missed += trial.measured.missed;
        keep(strength, trial.measured.strength_m_s2);
        keep(latency, trial.measured.latency_s);
        keep(rise, trial.measured.rise_s);
        keep(interval, trial.measured.interval_s);
    }
    out.strength_m_s2 = statisticsOf(strength);
    out.latency_s = statisticsOf(latency);
    out.rise_s = statisticsOf(rise);
    out.measuredInterval_s = statisticsOf(interval);
    return out;
}

}  // namespace

Result<VibrationSeparability> judgeVibration(std::span<const VibrationTrial> trials,
                                             const std::vector<std::string>& conditions) {
    std::vector<SeparabilityTrial> measured;
    for (const auto& trial : trials) {
        const auto& found = trial.measured;
        const bool moved = found.strength_m_s2 > 0 && std::isfinite(found.interval_s);
        measured.push_back({trial.condition, moved ? found.strength_m_s2 : kNaN, moved ? found.interval_s : kNaN,
                            found.strengthUncertainty_m_s2, found.intervalUncertainty_s, 0});
    }
    const auto judged = judgeSeparability(measured, {conditions});
    if (!judged) return failure(judged);
    VibrationSeparability out;
    for (const auto& name : conditions) out.conditions.push_back(summarise(trials, name));
    out.measured = std::ranges::any_of(trials, wasRead);
    if (!out.measured) {
        out.reasons = {kNotMeasured};
        return out;
    }
    out.pairs = judged->pairs;
    out.accuracy = judged->accuracy;
    out.verdict = judged->verdict;
    out.reasons = judged->reasons;
    for (const auto& condition : out.conditions) {
        const auto still = condition.bursts - condition.moved - condition.missed;
        if (still == 0) continue;
        out.verdict = Verdict::Fail;
        out.reasons.insert(out.reasons.begin(), fmt::format("The motor did not move in {} of {} bursts of {}.", still,
                                                            condition.bursts - condition.missed, condition.name));
    }
    return out;
}

namespace {

using namespace describe;

ResultRecord<VibrationCondition> describeCondition() {
    using C = VibrationCondition;
    ResultRecord<C> all;
    all.shown(as(As::Condition, "Condition", "name"), &C::name);
    all.shown(number("Strength", "intensity"), &C::intensity);
    all.kept("interval_s", &C::interval_s);
    all.kept("presentations", &C::presentations);
    all.kept("bursts", &C::bursts);
    all.shown(number("Acceleration, mean and s.d.", "strength_m_s2", "m/s2"), &C::strength_m_s2);
    all.kept("latency_s", &C::latency_s);
    all.kept("rise_s", &C::rise_s);
    all.shown(number("Interval, mean and s.d.", "measured_interval_s", "s"), &C::measuredInterval_s);
    all.shown(number("Moved", "moved"), &C::moved);
    all.shown(number("Missed", "missed"), &C::missed);
    return all;
}

ResultRecord<PairSummary> describePair() {
    using P = PairSummary;
    ResultRecord<P> all;
    all.kept("a", &P::a);
    all.kept("b", &P::b);
    all.kept("strength_jnd", &P::amplitudeJnd);
    all.kept("strength_jnd_low", in(&P::amplitudeJndBounds, &Bounds::low));
    all.kept("interval_jnd", &P::intervalJnd);
    all.kept("interval_jnd_low", in(&P::intervalJndBounds, &Bounds::low));
    return all;
}

ResultRecord<VibrationSeparability> describeVibration() {
    using V = VibrationSeparability;
    ResultRecord<V> all;
    all.rows("What the massager did", "conditions", &V::conditions, describeCondition());
    all.kept("pairs", &V::pairs, describePair());
    all.kept("accuracy", [](const V& found) { return found.measured ? std::optional(found.accuracy) : std::nullopt; });
    all.shown(as(As::YesNo, "What it did was measured", "measured"), &V::measured);
    all.shown(verdict(), [](const V& found) { return found.measured ? std::optional(found.verdict) : std::nullopt; });
    all.kept("reasons", &V::reasons);
    return all;
}

}  // namespace

json toJson(const VibrationSeparability& found) { return builtOnce<describeVibration>().write(found); }

std::vector<ResultTable> vibrationTables(const std::string& place) {
    const auto& all = builtOnce<describeVibration>();
    return {under(place, all.tables().front()), facts("The massager", place.c_str(), all.columns())};
}

json toJson(const BurstFigures& figures) { return builtOnce<burstFields>().write(figures); }

BurstFigures burstFiguresFrom(const json& said) {
    BurstFigures out;
    static_cast<void>(builtOnce<burstFields>().read(said, out, {.lenient = true}));  // unreadable members stay unknown
    return out;
}

}  // namespace tacto
