// The object "bench", the bench: what scripts can call, and what each function takes and returns.
#include "app/scripting/host/bench/BenchObject.h"

#include "app/scripting/engine/Arming.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/TrainCaptures.h"

namespace tacto {

std::vector<HostFunction> benchFunctions() {
    using namespace takes;
    constexpr std::string_view kTripErrors =
        "Throws when a fault of another kind came, when the bench cannot change the load, and when the run is stopped. "
        "The fault that was provoked is reset and does not end the run.";
    static const auto kHowMany = fmt::format("how many trains; {} to {} with intervals", host::bench::kMinTrainsInOne,
                                             host::bench::kMaxTrainsInOne);
    constexpr auto kMaxTrains = static_cast<double>(ScriptSession::kHeldCaptures);
    const auto speed = number("options.speed_mm_s", "mm/s", "sliding speed").range(0, 1000).otherwise(50);
    const auto force = number("options.force_n", "N", "normal force").range(0, 50);
    const auto sliding = number("options.duration_s", "s", "of reading").range(1, 600).otherwise(4);
    const auto surface = text("material", "surface, as \"P120\"");
    const auto onPlane = [](std::string_view name, std::string_view symbol) {
        return number(name, "", symbol).range(0, 1);
    };
    const auto rate =
        number("options.rate_hz", "Hz", "sampling rate").range(1, 1e9).optional("1e6 or the instrument's largest");
    return {
        {.name = "arm",
         .parameters = {load("options.load", "declared load, ± 20 % for the limits").otherwise(ArmRequest{}.load)},
         .text = "Checks the load with one small pulse and arms the output. From then on trains are delivered as the "
                 "drive says. Where the output is real, the operator confirms device, load and largest amplitude first "
                 "(question confirm-arming).",
         .errors = "Throws with what is missing; without the confirmation; when the impedance is out of range; when "
                   "the run is stopped. Then the output is disarmed.",
         .asks = kConfirmArming,
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
        {.name = "capture",
         .parameters =
             {whole("options.trains", kHowMany).range(1, kMaxTrains).optional("1, or 2 with intervals,"), rate,
              whole("options.samples", "per capture").range(1, 1e8).optional("the whole train"),
              number("options.voltage_range_v", "V", "full scale is ± this")
                  .range(1e-3, 1e4)
                  .optional("1.3 times the command"),
              number("options.current_range_ma", "mA", "full scale is ± this")
                  .range(1e-3, 1e5)
                  .optional("a range for command and |Z|"),
              number("options.trigger_v", "V", "trigger level").range(1e-6, 1e4).optional("a fifth of the command"),
              flag("options.intervals",
                   "the intervals between the trains are wanted: where the oscilloscope does not state how "
                   "good the time stamps of its records are, one record holds them all, at a lower rate where it would "
                   "be longer than half a million samples")
                  .otherwise(false)},
         .text = "Waits for the next trains and takes one oscilloscope record of each.",
         .returns =
             "List of captures { capture, start_s, trigger_s, rate_hz, samples, stamp_tolerance_s, not_stated }, for "
             "measure.train(): stamp_tolerance_s is how good trigger_s is against other records, null where the "
             "oscilloscope does not state it; not_stated says what else it does not, \"\" where it states all.",
         .errors = "Throws without an oscilloscope; when fewer trains came; when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::bench::capture},
        {.name = "fitLoad",
         .parameters = {load("load", "\"500 ohm\", \"open\", \"200 ohm + 10 kohm || 50 nF\"")},
         .text = "Disarms and changes the load: by itself where the bench can, else the operator is asked to (question "
                 "fit-load).",
         .errors = "Throws for a load that cannot be read, or without an answer.",
         .asks = "fit-load",
         .call = host::bench::fitLoad},
        {.name = "present",
         .parameters =
             {object("condition", "one of bench.conditions"), onPlane("condition.roughness", "R"),
              onPlane("condition.pressure", "P"),
              text("options.source", "\"finger\": slide over a surface; \"direct\": set R and P")
                  .oneOf({"finger", "direct"})
                  .otherwise("finger"),
              text("options.material", "surface").optional("glass below R 0.5, else P60,"), speed,
              force.optional("0.15 below P 0.5, else 6,"),
              number("options.tolerance", "", "settled: R and P did not change in 0.5 s").range(0, 1).otherwise(0.02),
              number("options.limit_s", "s", "longest wait for that").range(0.5, 600).otherwise(5)},
         .text = "Sets the bench to a condition. On a rig that cannot present surfaces the operator is asked to "
                 "(question surface-MATERIAL).",
         .returns = "{ settled, roughness, pressure }: settled is false when R or P still moved at the limit.",
         .errors = "Throws for an unknown surface, without an answer, or when the run is stopped.",
         .asks = "surface-*",
         .call = host::bench::present},
        {.name = "lift",
         .text = "Lifts the finger off the surface, on a rig that can.",
         .errors = "Throws when the run is stopped.",
         .call = host::bench::lift},
        {.name = "measureReference",
         .parameters = {surface, speed, force.otherwise(1), sliding},
         .text = "Disarms, slides over a reference surface and averages the two roughness features.",
         .returns = "{ material, h, v, frames }; a feature this rig does not have is null.",
         .errors = "Throws when nothing was felt or the run is stopped.",
         .asks = "surface-*",
         .call = host::bench::measureReference},
        {.name = "setReferences",
         .parameters = {object("smooth", "from bench.measureReference()"), object("rough", "the same")},
         .text = "Scales roughness to the two reference surfaces, for the rest of the run.",
         .errors = "Throws for what was not measured in this run, and for equal references.",
         .call = host::bench::setReferences},
        {.name = "conditions",
         .kind = HostKind::Property,
         .text = "The profile's conditions, in its order.",
         .returns = "List of { name, roughness, pressure }, roughness and pressure from 0 to 1.",
         .call = host::bench::conditions},
        {.name = "time",
         .kind = HostKind::Property,
         .text = "Seconds since the session's clock started.",
         .returns = "Number (s).",
         .call = host::bench::time},
        {.name = "finished",
         .kind = HostKind::Property,
         .text = "Whether a replayed recording has ended.",
         .returns = "true or false; a live or simulated sensor never ends.",
         .call = host::bench::finished},
        {.name = "replayed",
         .kind = HostKind::Property,
         .text = "Whether the sensor is a recording, which ends by itself.",
         .returns = "true or false.",
         .call = host::bench::replayed},
        {.name = "devices",
         .kind = HostKind::Property,
         .text = "What is connected.",
         .returns = "List of { role, name, serial, simulated }.",
         .call = host::bench::devices},
        {.name = "live",
         .text = "What the bench is doing now. What is absent is null.",
         .returns =
             "{ time_s, state, reason, roughness, pressure, h, v, pressure_pa, contact, sliding, sensor_age_s, "
             "amplitude_v, interval_s, impedance_ohm, imbalance, trains_delivered, trains_refused, trains_skipped, "
             "last_refusal, samples_lost, gaps }; amplitude_v and interval_s are the encoder's command.",
         .call = host::bench::live},
        {.name = "watch",
         .parameters = {number("seconds", "s", "how long; a recording ends by itself").range(0.1, 86'400)},
         .text = "Lets time pass and reads live() meanwhile: every 50 ms, and less often the longer it takes.",
         .returns = "List of what live() returns, for plot.timeline(); 2000 at most.",
         .errors = "Throws when the run is stopped or a device fails.",
         .call = host::bench::watch},
        {.name = "exposure",
         .text = "The largest exposure seen in this run against each limit, at the ends of wait() and capture().",
         .returns =
             "Rows { name, value, limit, unit, source, warning, reason, measured, measured_beyond } for "
             "plot.exposure(); "
             "value null: not evaluated; measured null: not measured; measured_beyond: the stimulator's accuracy "
             "does not explain it.",
         .call = host::bench::exposure},
        {.name = "loads",
         .kind = HostKind::Property,
         .text = "The loads of the bench set: six resistors, a skin equivalent, open, short.",
         .returns = "List of { name, kind }, kind \"resistor\", \"skin\", \"open\" or \"short\"; the name serves "
                    "fitLoad() and arm().",
         .call = host::bench::loads},
        {.name = "predict",
         .parameters = {text("load", "a resistor or a skin equivalent"),
                        number("strength", "", "0 the weakest amplitude to 1 the strongest, at the shortest interval")
                            .range(0, 1)},
         .text = "What a command would be and do on a load, by computation; nothing is delivered.",
         .returns =
             "{ load, strength, roughness, pressure, command_v, interval_s, nominal_ohm, amplitude (V or mA, as the "
             "device is "
             "programmed), forbidden, predicted, rms_5s_ma, peak_ma, fine_range_ma, check_forbidden, not_applicable, "
             "capture "
             "}: forbidden when a limit is broken at worst within 20 % of the load, predicted says by what; "
             "check_forbidden says what forbids arming on this load, \"\" where nothing does; not_applicable says why "
             "the device cannot drive it; capture holds options for bench.capture(), fine_range_ma the current range "
             "of the fine captures of measure.load(), null where the current has no charging spike.",
         .errors = "Throws without a stimulator.",
         .needs = Role::Stimulator,
         .call = host::bench::predict},
        {.name = "attempt",
         .parameters = {object("command", "from bench.predict()"), onPlane("command.roughness", "R").otherwise(0),
                        onPlane("command.pressure", "P").otherwise(0)},
         .text = "Asks for one train of this command while armed, and ends the drive again. A refusal is not an error "
                 "here.",
         .returns = "{ refused, delivered, reason }",
         .errors = "Throws when the run is stopped or a device fails.",
         .call = host::bench::attempt},
        {.name = "setEncoding",
         .parameters = {object(
             "changes", "keys of a profile's encoding section (amplitude_min_v, interval_max_s, phase_width_us, ...)")},
         .text = "Changes how R and P become a train, for the rest of the run. The output must be disarmed.",
         .errors = "Throws while armed; for an unknown key, a wrong type, or a range that does not fit.",
         .call = host::bench::setEncoding},
        {.name = "setElectrodeArea",
         .parameters = {number("area", "cm2",
                               "of the smallest electrode: at most the profile's; where the profile states none, what "
                               "the operator gave as the parameter area")
                            .range(1e-3, 1e3)},
         .text = "Sets the area that densities are judged with, for this run. The session and its report say so.",
         .errors = "Throws while armed; for an area that is larger than the profile's, or that only the script states.",
         .call = host::bench::setElectrodeArea},
        {.name = "electrodeArea",
         .kind = HostKind::Property,
         .text = "The area that densities are judged with, in cm2.",
         .returns = "Number, or null when it is not known.",
         .call = host::bench::electrodeArea},
        {.name = "calibration",
         .kind = HostKind::Property,
         .text = "The stored calibration that holds today for the stimulator that is connected.",
         .returns = "{ calibrated, text }, and where calibrated: { made, valid_until, amplitude, interval, width, gap "
                    "}, each of these { unit, gain, offset, uncertainty_pct, lowest, highest }.",
         .errors = "Throws without a stimulator, or when the store is damaged.",
         .needs = Role::Stimulator,
         .call = host::bench::storedCalibration},
        {.name = "useCalibration",
         .parameters = {flag("use", "false: the commands are programmed as they are; true: as at the start")},
         .text = "Ignores the stored calibration for the rest of the run, as a new calibration must, or applies it "
                 "again. The output must be disarmed.",
         .errors = "Throws while armed.",
         .call = host::bench::useCalibration},
        {.name = "readKnownLoad",
         .parameters = {number("load", "ohm", "that is connected").range(1, 1e6),
                        number("tolerance", "%", "how far the reading may lie from the load, its uncertainty included")
                            .range(0, 100)},
         .text = "Before anything is believed: arms, reads one train of the strongest command and judges it as "
                 "record.reference() does. The output stays armed and driven.",
         .returns = "As record.reference().",
         .errors = "As bench.arm() and bench.capture().",
         .asks = kConfirmArming,
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::bench::readKnownLoad},
        {.name = "readReference",
         .parameters = {number("volts", "V",
                               "of the reference source, as its certificate or a calibrated multimeter says")
                            .range(1e-3, 500),
                        number("uncertainty", "%", "of it, k = 2").range(1e-6, 10),
                        number("tolerance", "%",
                               "how far the reading may lie from the reference, its uncertainty included")
                            .range(1e-3, 50)},
         .text = "Reads a voltage of known size and its zero on the oscilloscope's voltage channel, with the output "
                 "disarmed: a gain error that voltage and current share does not show in a known load. The operator "
                 "connects the source (questions \"reference-source\" and \"reference-zero\"); a simulated bench does "
                 "it by itself.",
         .returns =
             "{ reference_v, measured_v, expanded_v, deviation_pct, expanded_uncertainty_pct, allowed_pct, verdict, "
             "passed, text, captures }: verdict \"not evaluated\" where the oscilloscope does not state its accuracy.",
         .errors = "Throws without an oscilloscope, for one that takes no record without a trigger, or when no "
                   "operator can answer.",
         .needs = Role::Oscilloscope,
         .call = host::bench::readReference},
        {.name = "tripWhenArming",
         .parameters = {text("load", "what is fitted").oneOf({"open", "short"}),
                        text("declared", "the load that arming is given")},
         .text = "Tries to arm into an open or short circuit. Arming must be refused after its one small pulse.",
         .returns = "{ name, evaluated, tripped, after_s, reason } for analysis.loadSafety(): not evaluated where the "
                    "stimulator cannot read back; after_s from the change to the end of output.",
         .errors = kTripErrors,
         .asks = kConfirmArming,
         .call = host::bench::inChecking},
        {.name = "tripWhileDelivering",
         .parameters = {text("becomes", "what the load becomes").oneOf({"open", "short", "intermittent"}),
                        text("load", "the load before"),
                        number("within", "s", "how long to wait for the trip").range(0.1, 300),
                        number("strength", "", "of the trains: 0 the weakest amplitude to 1 the strongest")
                            .range(0, 1)
                            .otherwise(0)},
         .text = "Delivers trains at the shortest interval and changes the load under way. Output must end before the "
                 "next train.",
         .returns = "{ name, evaluated, tripped, after_s, stop_s, allowed_s, reason } for analysis.loadSafety(): "
                    "stop_s, at most, from the train that found the change to the end of output, and allowed_s to when "
                    "the next was due. And { command_v, interval_s, captures }: the record of the train that found the "
                    "circuit open, for measure.load(); an empty list where there is none.",
         .errors = kTripErrors,
         .asks = kConfirmArming,
         .call = host::bench::whileDelivering},
        {.name = "tripBySilence",
         .parameters = {text("load", "the load"),
                        number("seconds", "s", "how long the control loop is silent").range(0.2, 10)},
         .text = "Delivers the weakest trains and withholds the heartbeat. Output must end 100 ms later and stay off.",
         .returns = "{ name, evaluated, tripped, after_s, reason } for analysis.loadSafety(): not evaluated where the "
                    "stimulator cannot read back; after_s from the change to the end of output.",
         .errors = kTripErrors,
         .asks = kConfirmArming,
         .call = host::bench::bySilence},
        {.name = "sensorStreams",
         .kind = HostKind::Property,
         .text = "What the fingertip measures.",
         .returns = "List of { kind (acceleration, force, taxels), unit, channels, rate_hz }.",
         .errors = "Throws without a sensor.",
         .needs = Role::Sensor,
         .call = host::bench::streams},
        {.name = "surfaces",
         .parameters = {object("smooth", "the smooth reference: { name, ra_um, rz_um, file }"),
                        text("smooth.name", "its name"), number("smooth.ra_um", "um", "its Ra").above(0),
                        number("smooth.rz_um", "um", "its Rz; 0: not stated").atLeast(0),
                        text("smooth.file", "in place of both, its profilometer CSV").orEmpty(),
                        object("rough", "the rough reference: { name, ra_um, rz_um, file }"),
                        text("rough.name", "its name"), number("rough.ra_um", "um", "its Ra").above(0),
                        number("rough.rz_um", "um", "its Rz; 0: not stated").atLeast(0),
                        text("rough.file", "in place of both, its profilometer CSV").orEmpty(),
                        text("more", "further surfaces: NAME RA RZ in um, or NAME FILE.csv; separated by ;").orEmpty()},
         .text = "Reads what the operator says of the surfaces, before anything moves.",
         .returns = "List of { name, ra_um, rz_um, source }: the references first; rz_um null where it is not stated.",
         .errors =
             "Throws for a text that cannot be read, a surface that is named twice, an Rz below its Ra, or a rough "
             "reference that is not the rougher; as bench.profilometer().",
         .call = host::bench::surfaces},
        {.name = "weights",
         .parameters = {text("masses", "in g, separated by ;; empty for none").orEmpty()},
         .text = "Reads which weights the operator has.",
         .returns = "List of masses in g, the smallest first.",
         .errors = "Throws for a text that cannot be read, one weight alone, or one that comes twice.",
         .call = host::bench::weights},
        {.name = "profilometer",
         .parameters = {text(
             "path", "path of a CSV that a profilometer exported: a parameter that the operator gave, or entered")},
         .text = "Finds Ra and Rz in it, by name and unit.",
         .returns = "{ ra_um, rz_um, ra_values, rz_values }: means over that many values; rz_um is null where it is "
                    "not stated.",
         .errors = "Throws for a path that the operator did not give; with the line and the reason where no Ra with a "
                   "unit is found.",
         .call = host::bench::profilometer},
        {.name = "measureRest",
         .parameters = {number("options.duration_s", "s", "of reading").range(0.5, 600).otherwise(3)},
         .text =
             "Disarms, lifts the finger (question rest on a rig that cannot) and reads the fingertip without contact.",
         .returns =
             "{ taxel_baseline, taxel_floor, taxel_unit, mean_square, unit, duration_s, force, force_in_use }: "
             "mean_square is the power of the acceleration at rest, in unit squared, and null without acceleration; "
             "force is a statistic in the sensor's unit, force_in_use { mean, unit, u } as the profile scales it, u "
             "the standard uncertainty of the mean.",
         .errors =
             "Throws when something touched the fingertip, when too few samples came, or when the run is stopped.",
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::bench::measureRest},
        {.name = "measureSlide",
         .parameters = {surface, object("rest", "from bench.measureRest()"), speed, force.otherwise(1), sliding},
         .text =
             "Disarms, slides over a surface as bench.measureReference() does, and reads every feature of the slide.",
         .returns = "{ material, h, h_abs, v_static, v_dynamic, force_n, sliding_frames }: a feature that the rig "
                    "does not have is null.",
         .errors =
             "Throws for an unknown surface, without an answer, when too few samples came, or when the run is stopped.",
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::bench::measureSlide},
        {.name = "measureWeight",
         .parameters = {number("mass_g", "g", "of the weight").range(0, 5000),
                        number("options.gravity_m_s2", "m/s2", "local gravity").range(9.7, 9.9).otherwise(9.80665),
                        number("options.duration_s", "s", "of reading").range(0.5, 600).otherwise(2)},
         .text = "Puts a weight on the resting fingertip (question weight-MASSg on a rig that cannot) and reads force "
                 "and taxels.",
         .returns = "{ mass_g, reference_n, force, force_unit, taxels, taxel_unit, force_in_use }: means, in the "
                    "sensor's own units; force_in_use { mean, unit, u } as the profile scales it, u the standard "
                    "uncertainty of the mean.",
         .errors = "Throws without an answer, when too few samples came, or when the run is stopped.",
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::bench::measureWeight},
        {.name = "useFingertipScales",
         .parameters = {object("found", "from analysis.fingertipScales()")},
         .text = "Turns force and taxels into N and Pa by these scales for the rest of the run; R is uncalibrated "
                 "until references were read under them. record.sensorProfile() keeps them.",
         .returns = "{ force, taxels }: whether each is scaled now.",
         .errors = "Throws for scales that this run did not measure itself.",
         .needs = Role::Sensor,
         .call = host::bench::useFingertipScales},
        {.name = "step",
         .parameters = {object("from", "{ roughness, pressure } before the step"), onPlane("from.roughness", "R"),
                        onPlane("from.pressure", "P"),
                        object("to", "the same after it; at least one just-noticeable difference away"),
                        onPlane("to.roughness", "R"), onPlane("to.pressure", "P"),
                        number("options.phase", "", "when, as a share of the interval between trains")
                            .range(0.05, 0.9)
                            .otherwise(0.5),
                        rate},
         .text = "Lets trains run at one place of the plane, steps to another and watches the trains that follow, each "
                 "in a record of its own.",
         .returns =
             "{ type, step_s, since_onset_s, latency_s, designed_latency_s, trains, designed_trains, complete_s, "
             "designed_complete_s, fastest_complete_s, fewest_trains, from_v, to_v, from_s, to_s, before_v, onsets, "
             "captures }: latency_s is from the step to the onset of the first train whose amplitude, or interval "
             "since the train before, has left what was there by a quarter of a just-noticeable difference; trains how "
             "many it takes until the new ones are reached; designed_ the same of the trains that the scheduler's "
             "design has, with _low_s and _high as a reading that is off by 0.05 of a difference finds them; "
             "complete_s is from the step to the train that reaches the new ones, fastest_complete_s and fewest_trains "
             "what no sequence of trains in steps of at most two differences can undercut; onsets { after_step_s, "
             "amplitude_v, interval_s, onset_u_s, amplitude_u_v, amplitude_jnd, interval_jnd } as measured, _u_ the "
             "standard uncertainty (of the amplitude without that of the gain), _jnd against the train before; "
             "before_v the amplitudes before the step; captures those of the train that carries it and of the "
             "train before the step, for record.trial(). What was not measured is null.",
         .errors =
             "Throws without an oscilloscope, when it sees no two trains before the step, or when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::bench::step},
        {.name = "traverse",
         .parameters =
             {object("from", "{ roughness, pressure } where the movement begins"), onPlane("from.roughness", "R"),
              onPlane("from.pressure", "P"), object("to", "the same where it turns"), onPlane("to.roughness", "R"),
              onPlane("to.pressure", "P"),
              number("options.seconds", "s", "from one to the other, and the same back").range(0.1, 600).otherwise(5),
              rate},
         .text =
             "Moves through the plane at an even pace and back, and watches every train, each in a record of its own.",
         .returns = "{ type, seconds, onsets }; onsets as of bench.step().",
         .errors = "Throws without an oscilloscope, or when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::bench::traverse},
    };
}

}  // namespace tacto
