// The output of the bench: arm, drive, wait, fit a load.
#include "app/scripting/engine/Arming.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"

namespace tacto::host::bench {

Result<Json> arm(ScriptSession& session, const Arguments& arguments) {
    const auto request = confirmedArming(session, arguments.load("options.load"));
    if (!request) return failure(request);
    return done(session.bench().arm(*request));
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

Result<Json> fitLoad(ScriptSession& session, const Arguments& arguments) {
    const auto load = arguments.load("load");
    session.bench().disarm();
    session.forgetConfirmed();
    if (auto& fitter = session.bench().devices().load) return done(fitter->fitLoad(load));
    OperatorQuestion question;
    question.name = "fit-load";
    question.text = fmt::format("Fit the load {}", load);
    return done(session.ask(question));
}

}  // namespace tacto::host::bench
