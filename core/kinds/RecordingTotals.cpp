#include "core/kinds/RecordingTotals.h"

#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

using namespace describe;

ResultRecord<RecordingTotals> describeTotals(ResultKind kind) {
    using T = RecordingTotals;
    ResultRecord<T> all;
    all.kept("verdict", [](const T&) { return nlohmann::json(); });
    all.shown(number("Duration", "duration_s", "s"), &T::duration_s);
    if (kind == ResultKind::Massager) {
        all.shown(number("Bursts delivered", "bursts_delivered"), &T::delivered);
    } else {
        all.shown(number("Trains delivered", "trains_delivered"), &T::delivered);
        all.shown(number("Trains refused", "trains_refused"), &T::refused);
    }
    all.shown(number("Trains skipped", "trains_skipped"), &T::skipped);
    all.shown(number("Samples lost", "samples_lost"), &T::samplesLost);
    all.shown(number("Gaps in the recording", "gaps"), &T::gaps);
    all.facts("Totals");
    return all;
}

}  // namespace

nlohmann::json toJson(const RecordingTotals& totals, ResultKind kind) { return describeTotals(kind).write(totals); }

ResultTraits recordingKind(ResultKind kind) {
    const auto totals = describeTotals(kind);
    return {.kind = kind,
            .name = kind == ResultKind::Massager ? "massager" : "live",
            .decisionRule = "A recording: nothing is judged.",
            .members = totals.keys(),
            .tables = totals.tables()};
}

}  // namespace tacto
