#include "core/kinds/ResultKinds.h"

#include <algorithm>

#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/drift/Drift.h"
#include "core/analysis/encodings/ComparedEncodings.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/load_safety/LoadSafetyJson.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/transitions/TransitionsJson.h"
#include "core/analysis/variation/VariationJson.h"
#include "core/kinds/RecordingTotals.h"
#include "core/kinds/SessionComparison.h"
#include "core/pilot/PilotResults.h"

namespace tacto {

const ResultTraits& resultTraits(std::string_view name) {
    static const ResultTraits kOther;
    static const std::vector<ResultTraits> kKinds{separabilityKind(),
                                                  driftKind(),
                                                  comparedEncodingsKind(),
                                                  transitionsKind(),
                                                  variationKind(),
                                                  loadSafetyKind(),
                                                  stimulatorCalibrationKind(),
                                                  sensorCalibrationKind(),
                                                  recordingKind(ResultKind::Live),
                                                  recordingKind(ResultKind::Massager),
                                                  pilotThresholdsKind(),
                                                  pilotIdentificationKind(),
                                                  comparisonKind(),
                                                  studyFiguresKind()};
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
