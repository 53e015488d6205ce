// TracingsFigure.h - voltage and current of recorded captures against time, for plot.tracings() and reports.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::plot {

/// The first capture that was recorded under `condition`, named `label` in the figure.
struct Tracing {
    std::string condition;
    std::string label;
};

[[nodiscard]] nlohmann::json tracingsFigure(ScriptSession& session, const std::vector<Tracing>& tracings);

}  // namespace tacto::host::plot
