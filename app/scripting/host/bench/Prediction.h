// Prediction.h - what a command would be and do on a load, and asking for it, for bench.predict(), bench.attempt() and
// the checks on loads.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/TrainCaptures.h"

namespace tacto::host::bench {

/// NaN: not known.
struct PredictedCommand {
    std::string load;
    double strength = 0;  ///< 0 the weakest amplitude to 1 the strongest
    double roughness = 0, pressure = 0;
    double command_v = 0, interval_s = 0;
    double nominal_ohm = kNaN;
    std::string checkForbidden{};  ///< what forbids the impedance check, and so arming; empty: nothing
    std::string notApplicable{};   ///< why the device cannot give it; empty: it can, and the rest is stated
    std::string forbidden{};       ///< the limit that forbids it; empty: none does
    double amplitude = kNaN;       ///< V or mA, by the source
    double rms5s_ma = kNaN, peak_ma = kNaN;
    double fineRange_ma = kNaN;  ///< for current that settles far below a charging spike; NaN: there is none
    CaptureOptions capture{};    ///< that show the whole train

    [[nodiscard]] bool mayBeGiven() const { return notApplicable.empty() && forbidden.empty(); }
};
/// As bench.predict() returns it.
[[nodiscard]] nlohmann::json toJson(const PredictedCommand& command);

/// What a command at the shortest interval would be on a load; nothing is delivered. Errors: InvalidArgument for a load
/// that cannot be read; as Encoder::encode().
[[nodiscard]] Result<PredictedCommand> predictCommand(ScriptSession& session, const std::string& load, double strength);

struct Attempt {
    bool refused = false;
    bool delivered = false;
    std::string reason;  ///< of the refusal
};
/// Asks for one train of this command while armed; the drive is off again afterwards. Errors: when the run is stopped
/// or a device fails.
[[nodiscard]] Result<Attempt> attemptCommand(Bench& bench, double R, double P);

}  // namespace tacto::host::bench
