#include "core/results/ResultKind.h"

#include <algorithm>

#include "core/results/Describe.h"

namespace tacto {

const ResultTraits& resultTraits(std::string_view name) {
    using namespace describe;
    static const ResultTraits kOther;
    static const Kinds kKinds = [] {
        Kinds all;
        for (const auto& family :
             {trainKinds(), predictionKinds(), safetyKinds(), calibrationKinds(), sensorKinds(), recordingKinds()})
            all.insert(all.end(), family.begin(), family.end());
        return all;
    }();
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
