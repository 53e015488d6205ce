// The output of the bench: arm, drive, wait, fit a load.
#include "app/scripting/engine/Arming.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"

namespace tacto::host::bench {

Result<Json> arm(ScriptSession& session, const Arguments& arguments) {
    return done(armConfirmed(session, arguments.load("options.load")));
}

Result<Json> disarm(ScriptSession& session, const Arguments&) {
    session.bench().disarm();
    return Json();
}

Result<Json> wait(ScriptSession& session, const Arguments& arguments) {
    return done(session.bench().wait(Seconds(arguments.number("seconds"))));
}

Result<Json> drive(ScriptSession& session, const Arguments& arguments) {
    const auto source = arguments.text("source");
    const auto driven = source == "off"      ? DriveSource::Off
                        : source == "manual" ? DriveSource::Manual
                                             : DriveSource::Sensor;
    return done(
        session.bench().drive(driven, arguments.number("options.roughness"), arguments.number("options.pressure")));
}

Result<void> changeLoad(ScriptSession& session, const std::string& load, const char* question,
                        const std::string& request) {
    session.forgetConfirmed();
    if (auto& fitter = session.bench().devices().load) return fitter->fitLoad(load);
    return session.askTo(question, request);
}

Result<Json> fitLoad(ScriptSession& session, const Arguments& arguments) {
    const auto load = arguments.load("load");
    session.bench().disarm();
    return done(changeLoad(session, load, "fit-load", fmt::format("Fit the load {}", load)));
}

}  // namespace tacto::host::bench
