// ReferenceCheck.h - whether a known load reads as what it is, judged and recorded: for record.reference() and
// bench.readKnownLoad().
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::record {

struct KnownLoad {
    double load_ohm;
    double tolerance_pct;     ///< how far the reading may lie from the load, its uncertainty included
    double itsTolerance_pct;  ///< the load's own
};

/// As record.reference() returns it; `reading` is one of measure.pulse(). Errors: Io.
[[nodiscard]] Result<nlohmann::json> judgeReference(ScriptSession& session, const nlohmann::json& reading,
                                                    const KnownLoad& known);

}  // namespace tacto::host::record
