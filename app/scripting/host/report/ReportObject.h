// ReportObject.h - the functions of the object "report"; ReportObject.cpp describes their arguments and results.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::report {

using Json = nlohmann::json;

HostCall figure, table, matrix, quantity, rounded, text, calibration, certificate;  // ReportItems.cpp

}  // namespace tacto::host::report
