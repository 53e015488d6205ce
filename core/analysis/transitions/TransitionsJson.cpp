#include "core/analysis/transitions/TransitionsJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"

namespace tacto {

namespace {

nlohmann::json toJson(const LatencyGroup& group) {
    return {{"name", group.name},
            {"n", group.latency_s.n},
            {"not_measured", group.steps - group.latency_s.n},
            {"latency_s", toJson(group.latency_s)},
            {"designed_latency_s", toJson(group.designed_s)},
            {"difference_s", toJson(group.difference_s)},
            {"off_s", numberOrNull(std::max(std::abs(group.difference_s.min), std::abs(group.difference_s.max)))},
            {"trains", toJson(group.trains)},
            {"designed_trains", toJson(group.designedTrains)},
            {"verdict", nameOf(group.verdict)}};
}

nlohmann::json toJson(const ChangeGroup& group) {
    return {{"name", group.name},
            {"n", group.changes},
            {"trains_captured", group.captured},
            {"amplitude_jnd", numberOrNull(group.amplitude.jnd)},
            {"amplitude_u_jnd", numberOrNull(group.amplitude.uncertainty)},
            {"interval_jnd", numberOrNull(group.interval.jnd)},
            {"interval_u_jnd", numberOrNull(group.interval.uncertainty)},
            {"completes", group.completes},
            {"complete_s", toJson(statisticsOf(group.complete_s))},
            {"fastest_complete_s", toJson(statisticsOf(group.fastest_s))},
            {"trains", toJson(statisticsOf(group.trains))},
            {"fewest_trains", toJson(statisticsOf(group.fewest))},
            {"late", group.late},
            {"out_of_reach", group.outOfReach},
            {"verdict", nameOf(group.verdict)}};
}

template <class Group>
nlohmann::json rowsOf(const std::vector<Group>& groups) {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& group : groups) rows.push_back(toJson(group));
    return rows;
}

constexpr Word<ChangeKind> kChangeKinds[] = {{"step", ChangeKind::Step}, {"movement", ChangeKind::Movement}};
constexpr std::size_t kMaxTrains = 100'000;

/// The bench knows no name: the script adds it.
ValueKind<std::string> nameKind() {
    return codedKind<std::string>(
        "a text",
        [](const nlohmann::json& value) {
            return value.is_string() ? std::optional(value.get<std::string>()) : std::nullopt;
        },
        [](const std::string& name) { return name.empty() ? nlohmann::json() : nlohmann::json(name); });
}

RecordFields<CapturedTrain> trainFields() {
    using T = CapturedTrain;
    RecordFields<T> all;
    all.number("after_step_s", &T::after_s, {.unit = "s"});
    all.number("amplitude_v", &T::amplitude_v, {.unit = "V"});
    all.number("interval_s", &T::interval_s, {.unit = "s"});
    all.number("onset_u_s", &T::onsetUncertainty_s, {.unit = "s"});
    all.number("amplitude_u_v", &T::amplitudeUncertainty_v, {.unit = "V"});
    all.number("amplitude_jnd", &T::amplitude_jnd);
    all.number("interval_jnd", &T::interval_jnd);
    all.takeNullAsMissing();
    all.passOverUnknownKeys();
    return all;
}

/// What steps and movements have in common.
RecordFields<CapturedChange> changeFields() {
    using C = CapturedChange;
    RecordFields<C> all;
    auto& name = all.add("name", &C::name, nameKind());
    name.required = name.leftOutIfEmpty = true;
    all.word("type", &C::kind, kChangeKinds);
    all.list("onsets", &C::trains, trainFields().kind(), 0, kMaxTrains);
    all.takeNullAsMissing();
    all.passOverUnknownKeys();
    return all;
}

RecordFields<CapturedChange> movementFields() {
    auto all = changeFields();
    all.number("seconds", &CapturedChange::seconds, {.unit = "s"});
    return all;
}

RecordFields<CapturedChange> stepFields() {
    using C = CapturedChange;
    using S = StepCourse;
    auto all = changeFields();
    const auto seconds = [&all](std::string_view key, auto member) { all.number(key, member, {.unit = "s"}); };
    const auto volts = [&all](std::string_view key, auto member) { all.number(key, member, {.unit = "V"}); };
    seconds("step_s", &C::at_s);
    seconds("since_onset_s", &C::sinceOnset_s);
    seconds("latency_s", in(&C::measured, &S::latency_s));
    seconds("designed_latency_s", in(&C::designed, &S::latency_s));
    seconds("designed_latency_low_s", in(&C::designedFirst, &S::latency_s));
    seconds("designed_latency_high_s", in(&C::designedLast, &S::latency_s));
    all.number("trains", in(&C::measured, &S::trains));
    all.number("designed_trains", in(&C::designed, &S::trains));
    all.number("designed_trains_high", in(&C::designedLast, &S::trains));
    seconds("complete_s", in(&C::measured, &S::complete_s));
    seconds("designed_complete_s", in(&C::designed, &S::complete_s));
    seconds("fastest_complete_s", in(&C::fastest, &S::complete_s));
    all.number("fewest_trains", in(&C::fastest, &S::trains));
    volts("from_v", &C::from_v);
    volts("to_v", &C::to_v);
    seconds("from_s", &C::from_s);
    seconds("to_s", &C::to_s);
    all.list("before_v", &C::before_v, readingKind(), 0, kMaxTrains);
    all.list("captures", &C::captures, numberKind<std::int64_t>({}), 0, kMaxTrains);
    return all;
}

const RecordFields<CapturedChange>& fieldsOf(ChangeKind kind) {
    static const auto step = stepFields(), movement = movementFields();
    return kind == ChangeKind::Movement ? movement : step;
}

}  // namespace

Result<CapturedChange> capturedChangeFrom(const nlohmann::json& row) {
    const auto kind = valueFor(kChangeKinds, textOr(row, "type")).value_or(ChangeKind::Step);
    return fieldsOf(kind).read(row, {.path = "change"}).map_error(asInvalidArgument);
}

nlohmann::json toJson(const CapturedChange& change) { return fieldsOf(change.kind).write(change); }

nlohmann::json toJson(const LatencyJudgement& judgement) {
    return {{"tolerance_s", judgement.tolerance_s},
            {"groups", rowsOf(judgement.groups)},
            {"verdict", nameOf(judgement.verdict)},
            {"reasons", judgement.reasons}};
}

nlohmann::json toJson(const ChangeJudgement& judgement) {
    return {{"wanted_jnd", judgement.limits.perTrain_jnd},
            {"complete_limit_s", judgement.limits.complete_s},
            {"seconds_alone", judgement.limits.secondsAlone},
            {"groups", rowsOf(judgement.groups)},
            {"notes", judgement.notes},
            {"verdict", nameOf(judgement.verdict)},
            {"reasons", judgement.reasons}};
}

}  // namespace tacto
