// The object "record", what a protocol leaves in the session file: what scripts can call, and what each function takes
// and returns.
#include "app/scripting/host/record/RecordObject.h"

#include "core/calibration/CalibrationStore.h"

namespace tacto {

std::vector<HostFunction> recordFunctions() {
    using namespace takes;
    return {
        {.name = "trial",
         .parameters = {text("condition", "name of the condition presented"),
                        object("measured", "from measure.train(), or any values with their units in the names")},
         .text = "Records a trial and the captures it was measured on.",
         .returns = "The trial's number, from 1.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::trial},
        {.name = "trials",
         .text = "Every trial recorded so far.",
         .returns = "List of { condition, trial, and what was measured }.",
         .call = host::record::trials},
        {.name = "measurement",
         .parameters = {text("name", "what was measured"), object("values", "values with their units in the names")},
         .text = "Records a measured or calibrated value.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::measurement},
        {.name = "event",
         .parameters = {text("kind", "what happened, in a word or two"),
                        any("details", "anything worth keeping").optional()},
         .text = "Records that something happened, as the event \"script: KIND\".",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::event},
        {.name = "partial",
         .parameters = {object("found", "results so far, as verdict() takes them"),
                        list("tables", "{ caption, rows, columns }, for the report; kind is \"table\" or \"matrix\"")
                            .of(ValueType::Object)
                            .optional("those of report.loadSafety() for a load-safety check, else none")},
         .text = "Keeps what a run has come to, in case it ends early: results and tables then say that they are "
                 "partial. The last one counts; a run that ends by itself uses none.",
         .call = host::record::partial},
        {.name = "reference",
         .parameters = {object("reading", "from measure.pulse(), of a load that is known"),
                        number("load", "ohm", "what is connected").atLeast(1e-3),
                        number("tolerance", "%", "how far the reading may lie from the load, its uncertainty included")
                            .range(0, 100),
                        number("of the load", "%", "the load's own tolerance").range(0, 100).otherwise(0)},
         .text = "Judges whether a known load reads as what it is, and records that: instruments that misread it can "
                 "judge nothing else.",
         .returns =
             "{ load_ohm, measured_ohm, expanded_ohm, deviation_pct, expanded_uncertainty_pct, allowed_pct, verdict, "
             "passed, reason }: verdict \"pass\" when |deviation| + U is allowed, \"fail\" when |deviation| - U is "
             "not, "
             "else \"indeterminate\"; \"not evaluated\" where nothing was measured or no uncertainty is stated. passed "
             "is true for a pass alone; reason is a sentence where it did not pass, else null.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::reference},
        {.name = "calibration",
         .parameters =
             {object("found",
                     "{ amplitude, interval, width, gap }: complete calibrations of each, from analysis.calibration(); "
                     "the program keeps its own record of them, not what the objects say"),
              whole("options.valid_days", "how long it holds")
                  .range(1, static_cast<double>(kLongestValidity.count()))
                  .otherwise(365),
              text("options.scope_due", "day on which the oscilloscope's own calibration is due").optional()},
         .text = "Keeps a calibration for the stimulator's serial. An older one stays in the store and is superseded.",
         .returns = "{ serial, valid_until, supersedes, readings, session_head, simulated }: supersedes is the date of "
                    "the one before, or null.",
         .errors = "Throws for a calibration that is incomplete or does not rest on readings of this run, a run that "
                   "is not recorded, a stimulator without a serial, an oscilloscope that is overdue or does not state "
                   "its accuracy, or a store that cannot be written.",
         .needs = Role::Stimulator,
         .call = host::record::keepCalibration},
        {.name = "sensorProfile",
         .parameters =
             {object("found", "accepted, from analysis.sensorCalibration()"),
              flag("options.store", "keep it as a file, in the folder profiles beside the calibrations")
                  .otherwise(false),
              number("options.contact_area_cm2", "cm2", "contact area").range(0.01, 100).optional("the profile's")},
         .text = "The profile that the operator chose, with the scales of R, force and taxels, the fingertip's serial "
                 "number, the surfaces and the rest that were found; these are in force for the rest of the run. What "
                 "the script changed besides is not kept. A file is never overwritten: a later one gets a number.",
         .returns = "{ name, file, profile }: file is null where it was not stored; what --profile takes.",
         .errors = "Throws for a refused calibration, while armed with another encoding, or where the file cannot be "
                   "written.",
         .needs = Role::Sensor,
         .call = host::record::keepProfile},
    };
}

}  // namespace tacto
