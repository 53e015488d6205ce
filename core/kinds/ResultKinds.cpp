#include "core/kinds/ResultKinds.h"

#include <algorithm>

#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/drift/Drift.h"
#include "core/analysis/load_safety/LoadSafetyJson.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/transitions/TransitionsJson.h"
#include "core/analysis/variation/VariationJson.h"
#include "core/pilot/PilotResults.h"
#include "core/results/Describe.h"

namespace tacto {

namespace {

using namespace describe;

// Kinds with results that only a protocol assembles.

ResultTraits encodingComparison() {
    return {.kind = ResultKind::EncodingComparison,
            .name = "encoding-comparison",
            .decisionRule = "A comparison: the encodings are set side by side, and none is judged.",
            .tables = withBasis(
                {facts("Comparison", "", {text("Compared with", "default"), jnd("Asymmetry (JND)", "asymmetry_jnd")},
                       Else::InTheTerminal),
                 rows("Encodings: smallest distances in just-noticeable differences", "encodings",
                      {text("Encoding", "name"), jnd("Amplitude (JND)", "smallest_amplitude_jnd"),
                       jnd("Interval (JND)", "smallest_interval_jnd"), jnd("Smallest pair (JND)", "smallest_pair_jnd"),
                       jnd("Neighbours, smallest (JND)", "neighbours.min_jnd"),
                       jnd("A train, at most (JND)", "gradual_jnd"), as(As::Share, "Recognised", "accuracy"),
                       as(As::Verdict, "Separable", "separable")}),
                 rows("Conditions as measured, and how far they moved against the default", "conditions",
                      {text("Encoding", "encoding"), text("Condition", "name"),
                       number("Amplitude, mean and s.d.", "amplitude_v", "V"),
                       number("Interval, mean and s.d.", "interval_s", "s"),
                       jnd("Amplitude moved (JND)", "amplitude_jnd"), jnd("Interval moved (JND)", "interval_jnd")},
                      Else::InTheTerminal),
                 rows("Distances beside those of the default", "differences",
                      {text("Encoding", "encoding"), jnd("Smallest pair (JND)", "pair_jnd"),
                       jnd("Neighbours, smallest (JND)", "neighbours_min_jnd"),
                       jnd("Neighbours, mean (JND)", "neighbours_mean_jnd"),
                       jnd("A train, at most (JND)", "per_train_jnd")},
                      Else::InTheTerminal)})};
}

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

ResultTraits live() {
    return recording(ResultKind::Live, "live",
                     {number("Trains delivered", "trains_delivered"), number("Trains refused", "trains_refused")});
}

ResultTraits massager() {
    return recording(ResultKind::Massager, "massager", {number("Bursts delivered", "bursts_delivered")});
}

}  // namespace

const ResultTraits& resultTraits(std::string_view name) {
    static const ResultTraits kOther;
    static const std::vector<ResultTraits> kKinds{separabilityKind(),
                                                  driftKind(),
                                                  encodingComparison(),
                                                  transitionsKind(),
                                                  variationKind(),
                                                  loadSafetyKind(),
                                                  stimulatorCalibrationKind(),
                                                  sensorCalibrationKind(),
                                                  live(),
                                                  massager(),
                                                  pilotThresholdsKind(),
                                                  pilotIdentificationKind()};
    const auto found = std::ranges::find(kKinds, name, &ResultTraits::name);
    return found == kKinds.end() ? kOther : *found;
}

nlohmann::json shownInReports(const nlohmann::json& results) {
    const auto& kind = memberAt(results, "kind");
    if (!kind.is_string()) return {};
    auto tables = resultTraits(kind.get_ref<const std::string&>()).tables;
    std::erase_if(tables, [](const ResultTable& table) { return !isInReport(table.shown); });
    if (tables.empty()) return {};
    auto shown = shownIn(tables, results);
    for (const char* key : {"kind", "partial"}) {
        if (const auto& said = memberAt(results, key); !said.is_null()) shown[key] = said;
    }
    return shown;
}

}  // namespace tacto
