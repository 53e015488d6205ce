// LoadCommands.h - the parts of a check on loads: computing a command's effect on a load, giving the command, and
// provoking faults that must end the output by themselves.
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
    std::string checkForbidden{};     ///< the limit that forbids the impedance check and so arming; empty: none
    std::string notApplicable{};      ///< why the device cannot give the command; if empty, the rest is stated
    std::string forbidden{};          ///< the limit that forbids the command; empty: none
    double fineRange_ma = kNaN;       ///< range for a current that settles far below a charging spike; NaN: none
    bench::CaptureOptions capture{};  ///< such that captures show the whole train
};

/// Returns `count` computed commands for a load at the shortest interval, from the weakest to the strongest amplitude
/// in even steps. Errors: InvalidArgument for a load that cannot be read; as Encoder::encode().
[[nodiscard]] Result<std::vector<LoadCommand>> commandsFor(ScriptSession& session, const std::string& load, int count);
/// Returns the index of the strongest command that the device can give and the limits allow (0: the weakest), or
/// nothing if there is no such command.
[[nodiscard]] std::optional<std::size_t> strongestOf(const std::vector<LoadCommand>& commands);

/// Arms as bench.arm() does. Returns nothing if armed, else the problem with this load: it ends the check of this load
/// but not the run. Errors: a fault, a stop, no confirmation.
[[nodiscard]] Result<std::optional<Error>> tryToArm(ScriptSession& session, const std::string& load);

/// An entry of a load's list "steps", "refusals" or, if the device cannot give the command, "undriven", in the form
/// that loadRecordFrom() reads.
struct Given {
    const char* list;
    Json entry;
};
/// Gives a command on the armed load. A command that the limits forbid is requested once and must be refused. Otherwise
/// `trains` trains are captured and read; the end of a phase far below its charging spike is read in its own current
/// range. The drive is off afterwards. Errors: a fault, a stop, fewer trains.
[[nodiscard]] Result<Given> give(ScriptSession& session, const LoadCommand& command, int trains);
/// Captures three trains in one record on the armed load: { command_v, interval_s, rate_hz, captures }.
[[nodiscard]] Result<Json> captureBurst(ScriptSession& session, const LoadCommand& command);

// Trips, in the form that tripTrialFrom() reads; not evaluated if the stimulator cannot read back. The provoked fault
// is reset and does not end the run. Errors: a fault of another kind, a load that cannot be changed, a stop.

/// Tries to arm with `fitted` connected and `declared` declared: must be refused after one small pulse.
[[nodiscard]] Result<Json> tripWhenArming(ScriptSession& session, const std::string& fitted,
                                          const std::string& declared);
/// Delivers trains at the shortest interval (`strength`: 0 weakest to 1 strongest) and changes the load meanwhile: the
/// output must end before the next train. Also returns "command_v", "interval_s" and "captures": the record of the
/// train that met the open circuit.
[[nodiscard]] Result<Json> tripWhileDelivering(ScriptSession& session, const std::string& becomes,
                                               const std::string& load, double strength);
/// Delivers the weakest trains and withholds the heartbeat: the output must end 100 ms later and stay off.
[[nodiscard]] Result<Json> tripBySilence(ScriptSession& session, const std::string& load, double seconds);

}  // namespace tacto::host::load_safety
