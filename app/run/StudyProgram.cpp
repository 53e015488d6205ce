#include "app/run/StudyProgram.h"

#include "app/run/Shipped.h"
#include "app/scripting/ShippedResources.h"

namespace tacto {

namespace {
constexpr std::string_view kPilotScripts = "pilot-";
}

Result<void> stateProgram(StudySettings& settings) {
    const auto limits = shippedLimits();
    if (!limits) return failure(limits);
    settings.limits.clear();
    for (std::size_t i = 0; i < limits->sets.size(); ++i)
        settings.limits.push_back({limits->sets[i].id, limits->sha256[i]});
    settings.scripts.clear();
    for (const auto& script : shippedProtocols()) {
        if (script.name.starts_with(kPilotScripts))
            settings.scripts.push_back({std::string(script.name), std::string(script.sha256)});
    }
    return {};
}

}  // namespace tacto
