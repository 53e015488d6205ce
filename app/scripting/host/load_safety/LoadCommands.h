// LoadCommands.h - the parts of a check on loads: what a command would be and do on a load, giving it, and provoking
// what must end the output by itself.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchCalls.h"

namespace tacto::host::load_safety {

using Json = nlohmann::json;

struct LoadCommand {
    std::string load;
    double roughness = 0, pressure = 0;
    double command_v = 0, interval_s = 0;
    std::string checkForbidden{};     ///< the limit that forbids the impedance check, and so arming; empty: none
    std::string notApplicable{};      ///< why the device cannot give it; empty: it can, and the rest is stated
    std::string forbidden{};          ///< the limit that forbids it; empty: none does
    double fineRange_ma = kNaN;       ///< range for current that settles far below a charging spike; NaN: there is none
    bench::CaptureOptions capture{};  ///< captures must show the whole train
};

/// The computed commands for a load: `count` commands at the shortest interval, from the weakest amplitude to the
/// strongest in even steps. Errors: InvalidArgument for a load that cannot be read; as Encoder::encode().
[[nodiscard]] Result<std::vector<LoadCommand>> commandsFor(ScriptSession& session, const std::string& load, int count);
/// The strongest of these that the device can give and the limits allow, counted from the weakest at 0. Nothing where
/// there is none.
[[nodiscard]] std::optional<std::size_t> strongestOf(const std::vector<LoadCommand>& commands);

/// Arms as bench.arm() does. Nothing when armed, else what is wrong with this load, which ends its part of the check
/// and not the run. Errors: a fault, a stop, no confirmation.
[[nodiscard]] Result<std::optional<Error>> tryToArm(ScriptSession& session, const std::string& load);

/// An entry of a load's list "steps", "refusals" or, where the device cannot give the command, "undriven", as
/// loadRecordFrom() reads them.
struct Given {
    const char* list;
    Json entry;
};
/// Gives a command on the load that is armed. What the limits forbid is asked for once and must be refused; else
/// `trains` trains are captured and read, the end of a phase in a current range of its own where a charging spike is
/// far above it. The drive is off afterwards. Errors: a fault, a stop, fewer trains.
[[nodiscard]] Result<Given> give(ScriptSession& session, const LoadCommand& command, int trains);
/// Three trains in one record, on the load that is armed: { command_v, interval_s, rate_hz, captures }.
[[nodiscard]] Result<Json> captureBurst(ScriptSession& session, const LoadCommand& command);

// Trips, as tripTrialFrom() reads them: not evaluated where the stimulator cannot read back. The fault that was
// provoked is reset and does not end the run. Errors: a fault of another kind, a load that cannot be changed, a stop.

/// Tries to arm into what is `fitted`, declared as `declared`: it must be refused after its one small pulse.
[[nodiscard]] Result<Json> tripWhenArming(ScriptSession& session, const std::string& fitted,
                                          const std::string& declared);
/// Delivers trains at the shortest interval, `strength` from 0 the weakest to 1 the strongest, and changes the load
/// under way: output must end before the next train. Also "command_v", "interval_s" and "captures": the record of the
/// train that found the circuit open.
[[nodiscard]] Result<Json> tripWhileDelivering(ScriptSession& session, const std::string& becomes,
                                               const std::string& load, double strength);
/// Delivers the weakest trains and withholds the heartbeat: output must end 100 ms later and stay off.
[[nodiscard]] Result<Json> tripBySilence(ScriptSession& session, const std::string& load, double seconds);

}  // namespace tacto::host::load_safety
