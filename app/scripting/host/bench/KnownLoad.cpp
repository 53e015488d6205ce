// A known load, read and judged before anything that is measured on it is believed.
#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchObject.h"
#include "app/scripting/host/bench/TrainCaptures.h"
#include "app/scripting/host/measure/PulseReading.h"
#include "app/scripting/host/record/ReferenceCheck.h"

namespace tacto::host::bench {

Result<Json> readKnownLoad(ScriptSession& session, const Arguments& arguments) {
    const double load_ohm = arguments.number("load");
    if (auto armed = armConfirmed(session, fmt::format("{} ohm", load_ohm)); !armed) return failure(armed);
    if (auto driven = session.bench().drive(DriveSource::Manual, 1, 1); !driven) return failure(driven);
    auto captures = captureTrains(session, {});
    if (!captures) return failure(captures);
    const auto reading = measure::pulseReading(session, session.hold(std::move(*captures)));
    if (!reading) return reading;
    return record::judgeReference(session, *reading, {load_ohm, arguments.number("tolerance"), 0});
}

}  // namespace tacto::host::bench
