// PlotObject.h - the functions of the object "plot"; PlotObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::plot {

using Json = nlohmann::json;

HostCall conditionsFigure, plane, confusion, waveforms, exposureFigure, timeline, tracings, plotTransitions,
    plotCalibration,
    plotResiduals;   // Figures.cpp
HostCall predicted;  // Predicted.cpp

}  // namespace tacto::host::plot
