#include "core/analysis/transitions/TransitionsJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"
#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

using namespace describe;

ResultRecord<LatencyGroup> describeLatencyGroup() {
    using G = LatencyGroup;
    ResultRecord<G> all;
    all.shown(verdict(), &G::verdict);
    all.shown(text("Step", "name"), &G::name);
    all.shown(number("n", "n"), [](const G& group) { return group.latency_s.n; });
    all.shown(number("Latency, mean and s.d.", "latency_s", "s"), &G::latency_s);
    all.shown(number("Largest", "latency_s.max", "s"));
    all.shown(number("Designed, mean and s.d.", "designed_latency_s", "s"), &G::designed_s);
    all.kept("difference_s", &G::difference_s);
    all.shown(spread("Off, most", "off_s", "s"), [](const G& group) {
        return std::max(std::abs(group.difference_s.min), std::abs(group.difference_s.max));
    });
    all.kept("trains", &G::trains);
    all.shown(number("Trains", "trains.max"));
    all.kept("designed_trains", &G::designedTrains);
    all.shown(number("Designed", "designed_trains.max"));
    all.shown(number("Not measured", "not_measured"), [](const G& group) { return group.steps - group.latency_s.n; });
    return all;
}

ResultRecord<ChangeGroup> describeChangeGroup() {
    using G = ChangeGroup;
    const auto statistics = [](std::vector<double> G::*member) {
        return [member](const G& group) { return statisticsOf(group.*member); };
    };
    ResultRecord<G> all;
    all.shown(verdict(), &G::verdict);
    all.shown(text("Change", "name"), &G::name);
    all.shown(number("n", "n"), &G::changes);
    all.kept("trains_captured", &G::captured);
    all.shown(jnd("Amplitude (JND)", "amplitude_jnd"), [](const G& group) { return group.amplitude.jnd; });
    all.kept("amplitude_u_jnd", [](const G& group) { return group.amplitude.uncertainty; });
    all.shown(jnd("Interval (JND)", "interval_jnd"), [](const G& group) { return group.interval.jnd; });
    all.kept("interval_u_jnd", [](const G& group) { return group.interval.uncertainty; });
    all.kept("completes", &G::completes);
    all.kept("complete_s", statistics(&G::complete_s));
    all.shown(number("Complete, median", "complete_s.median", "s"));
    all.shown(number("Largest", "complete_s.max", "s"));
    all.kept("fastest_complete_s", statistics(&G::fastest_s));
    all.shown(number("Fastest possible", "fastest_complete_s.min", "s"));
    all.kept("trains", statistics(&G::trains));
    all.shown(number("Trains", "trains.max"));
    all.kept("fewest_trains", statistics(&G::fewest));
    all.shown(number("Fewest possible", "fewest_trains.max"));
    all.shown(number("Late", "late"), &G::late);
    all.kept("out_of_reach", &G::outOfReach);
    return all;
}

ResultRecord<LatencyJudgement> describeLatency() {
    using J = LatencyJudgement;
    ResultRecord<J> all;
    all.shown(number("Latency's tolerance, ±", "tolerance_s", "s"), &J::tolerance_s);
    all.rows("Latency from a step to the first train that carries it, beside the design", "groups", &J::groups,
             describeLatencyGroup())
        .note =
        "Design: the pending train is pulled forward to max(now, last onset + new interval), and carries the newest "
        "amplitude. Steps fall on moments spread over the interval. Off: the largest difference between a step and its "
        "design. Trains: how many a change takes until it is complete.";
    all.judged();
    return all;
}

ResultRecord<ChangeJudgement> describeChanges() {
    using J = ChangeJudgement;
    ResultRecord<J> all;
    all.shown(jnd("Wanted for a train, at most (JND)", "wanted_jnd"), in(&J::limits, &ChangeLimits::perTrain_jnd));
    all.shown(number("Complete within", "complete_limit_s", "s"), in(&J::limits, &ChangeLimits::complete_s));
    all.kept("seconds_alone", in(&J::limits, &ChangeLimits::secondsAlone));
    all.rows("Changes as captured: largest step per train, and time until complete", "groups", &J::groups,
             describeChangeGroup())
        .note =
        "Complete: from the change to the train that reaches the new state. Fastest and fewest: the least that steps "
        "of the size wanted allow.";
    all.kept("notes", &J::notes);
    all.judged();
    return all;
}

constexpr Word<ChangeKind> kChangeKinds[] = {{"step", ChangeKind::Step}, {"movement", ChangeKind::Movement}};
constexpr std::size_t kMaxTrains = 100'000;

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
    return all;
}

/// The fields common to steps and movements.
RecordFields<CapturedChange> changeFields() {
    using C = CapturedChange;
    RecordFields<C> all;
    all.add("name", &C::name, textOrNullKind()).leftOutIfEmpty = true;  // empty in rows from the bench
    all.word("type", &C::kind, kChangeKinds);
    all.list("onsets", &C::trains, trainFields().kind(), 0, kMaxTrains);
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

ResultRecord<TransitionsFound> describeFound() {
    using F = TransitionsFound;
    const auto changes = describeChanges();
    const auto latency = describeLatency();
    const auto& computed = computedTransitionsRecord();
    const auto add = [](ResultRecord<F>& all, const std::string& place, const auto& part) {
        for (auto& column : under(place, part.columns())) all.shown(std::move(column));
    };
    ResultRecord<F> all;
    all.kept("transitions", &F::computed);
    all.kept("steps", &F::steps);
    all.kept("jumps", &F::jumps);
    all.kept("movements", &F::movements);
    all.kept("changes", &F::changes, changes);
    all.kept("latency", &F::latency, latency);
    add(all, "changes", changes);
    add(all, "latency", latency);
    add(all, "transitions", computed);
    all.facts("Changes", Else::InTheTerminal);
    all.table(under("changes", changes.tables().front()));
    all.table(under("latency", latency.tables().front()));
    all.table(under("transitions", computed.tables().front()));
    all.kept("notes", [](const F& found) { return found.changes ? found.changes->notes : std::vector<std::string>(); });
    all.table(sentences("Notes", "notes", Else::InBoth));
    all.judged();
    return all;
}

}  // namespace

nlohmann::json toJson(const CapturedChange& change) { return fieldsOf(change.kind).write(change); }

nlohmann::json toJson(const TransitionsFound& found) { return builtOnce<describeFound>().write(found); }

ResultTraits transitionsKind() {
    return {.kind = ResultKind::Transitions,
            .name = "transitions",
            .decisionRule =
                "No step from one captured train to the next may exceed the just-noticeable differences wanted, "
                "uncertainty included; a change must be complete in the time wanted or, where steps of that size "
                "cannot, in the fewest trains that they take (choice); no latency may differ from its design by more "
                "than the tolerance.",
            .members = builtOnce<describeFound>().keys(),
            .tables = withBasis(builtOnce<describeFound>().tables())};
}

}  // namespace tacto
