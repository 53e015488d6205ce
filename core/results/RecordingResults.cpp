// Results of runs that judge nothing: what was delivered; and of sessions with a participant, which have pages of their
// own.
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

ResultTraits recording(ResultKind kind, std::string_view name, Columns delivered) {
    Columns columns{number("Duration", "duration_s", "s")};
    columns.insert(columns.end(), delivered.begin(), delivered.end());
    columns.push_back(number("Trains skipped", "trains_skipped"));
    columns.push_back(number("Samples lost", "samples_lost"));
    columns.push_back(number("Gaps in the recording", "gaps"));
    return {.kind = kind,
            .name = name,
            .decisionRule = "A recording: nothing is judged.",
            .tables = {facts("Totals", "", std::move(columns))}};
}

}  // namespace

ResultTraits live() {
    return recording(ResultKind::Live, "live",
                     {number("Trains delivered", "trains_delivered"), number("Trains refused", "trains_refused")});
}

ResultTraits massager() {
    return recording(ResultKind::Massager, "massager", {number("Bursts delivered", "bursts_delivered")});
}

ResultTraits pilotThresholds() {
    return {.kind = ResultKind::PilotThresholds, .name = "pilot-thresholds", .ofStudy = true};
}

ResultTraits pilotIdentification() {
    return {.kind = ResultKind::PilotIdentification, .name = "pilot-identification", .ofStudy = true};
}

}  // namespace tacto::describe
