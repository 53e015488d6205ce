// PlotFigures.h - figures that reports add by themselves.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::plot {

using Json = nlohmann::json;

/// Returns a calibration figure. `view`: "measured" against commanded, or "errors". `found`: analysis.calibration().
[[nodiscard]] Json calibrationFigure(const Json& found, const char* view);

/// The first capture that was recorded under `condition`, named `label` in the figure.
struct Tracing {
    std::string condition;
    std::string label;
};
/// Returns a figure of recorded captures: voltage and current against time.
[[nodiscard]] Json tracingsFigure(ScriptSession& session, const std::vector<Tracing>& tracings);

}  // namespace tacto::host::plot
