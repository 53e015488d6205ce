// The output of the bench: arming, driving, waiting, fitting a load.
#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchCalls.h"

namespace tacto::host::bench {

Result<void> changeLoad(ScriptSession& session, const std::string& load, const char* question,
                        const std::string& request) {
    session.forgetConfirmed();
    if (auto& fitter = session.bench().devices().load) return fitter->fitLoad(load);
    return session.askTo(question, request);
}

namespace {

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

Result<Json> fitLoad(ScriptSession& session, const Arguments& arguments) {
    const auto load = arguments.load("load");
    session.bench().disarm();
    return done(changeLoad(session, load, "fit-load", fmt::format("Fit the load {}", load)));
}

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> outputFunctions() {
    using namespace takes;
    return {
        {.name = "arm",
         .parameters = {load("options.load", "declared load, ± 20 % for the limits").otherwise(ArmRequest{}.load)},
         .text = "Checks the load with one small pulse and arms the output. From then on trains are delivered as the "
                 "drive says. Where the output is real, the operator confirms device, load and largest amplitude first "
                 "(question confirm-arming).",
         .errors = "Throws with what is missing; without the confirmation; when the impedance is out of range; when "
                   "the run is stopped. Then the output is disarmed.",
         .asks = {kConfirmArming},
         .failsDisarmed = true,
         .call = host::bench::arm},
        {.name = "disarm", .text = "Ends the output. Leaving run(p) does it too.", .call = host::bench::disarm},
        {.name = "wait",
         .parameters = {number("seconds", "s", "on the bench's clock").range(0, 86'400)},
         .text = "Lets time pass while the bench goes on.",
         .errors = "Throws when the run is stopped or a device fails.",
         .call = host::bench::wait},
        {.name = "drive",
         .parameters = {text("source", "where R and P come from").oneOf({"off", "manual", "sensor"}),
                        number("options.roughness", "", "R, for manual").range(0, 1).otherwise(0),
                        number("options.pressure", "", "P, for manual").range(0, 1).otherwise(0)},
         .text = "Says where R and P come from, from the next train on.",
         .errors = "Throws for sensor without a sensor.",
         .call = host::bench::drive},
        {.name = "fitLoad",
         .parameters = {load("load", "\"500 ohm\", \"open\", \"200 ohm + 10 kohm || 50 nF\"")},
         .text = "Disarms and changes the load: by itself where the bench can, else the operator is asked to (question "
                 "fit-load).",
         .errors = "Throws for a load that cannot be read, or without an answer.",
         .asks = {"fit-load"},
         .call = host::bench::fitLoad},
    };
}

}  // namespace tacto
