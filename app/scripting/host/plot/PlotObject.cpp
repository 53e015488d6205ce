// The object "plot", figures for the report: what scripts can call, and what each function takes and returns.
#include "app/scripting/host/plot/PlotObject.h"

namespace tacto {

std::vector<HostFunction> plotFunctions() {
    using namespace takes;
    return {
        {.name = "conditions",
         .parameters = {object("found", "from analysis.separability()"),
                        object("captures",
                               "lists from bench.capture(), by the condition's name: consecutive trains of each, drawn "
                               "as captured in lettered lanes; left out: drawn from the means")
                            .optional()},
         .text = "The conditions: trains as captured, a lane for each; or from the means, texture alone, pressure "
                 "alone, the two combined.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::conditionsFigure},
        {.name = "plane",
         .parameters = {any("found",
                            "from analysis.separability(), or trials with condition, amplitude_v, interval_s")},
         .text = "Amplitude against interval, a point per trial.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plane},
        {.name = "confusion",
         .parameters = {object("found", "from analysis.separability()")},
         .text = "Presented against recognised condition.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::confusion},
        {.name = "waveforms",
         .text = "The first capture of each condition that was recorded as a trial.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::waveforms},
        {.name = "tracings",
         .parameters = {list("tracings", "{ condition, label }: the first capture recorded under that condition")
                            .of(ValueType::Object),
                        text("note", "a sentence below the figure").optional()},
         .text = "Voltage and current of recorded captures against time.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::tracings},
        {.name = "exposure",
         .parameters = {list("rows", "from bench.exposure()").optional("the run's largest")},
         .text = "Exposure against its limits.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::exposureFigure},
        {.name = "timeline",
         .parameters = {list("states", "from bench.live(), in time order")},
         .text = "Roughness, pressure and amplitude over time.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::timeline},
        {.name = "calibration",
         .parameters = {object("found", "from analysis.calibration()")},
         .text = "Measured against commanded, with the fitted line.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plotCalibration},
        {.name = "residuals",
         .parameters = {object("found", "from analysis.calibration()")},
         .text = "Errors against the command, up and down, with their uncertainty and the tolerance band.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plotResiduals},
        {.name = "transitions",
         .parameters = {object("found", "from analysis.transitions()")},
         .text = "The largest step per train over the R-P plane, amplitude and interval beside each other.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plotTransitions},
        {.name = "predicted",
         .parameters =
             {object("found", "from analysis.variation()"),
              text("view",
                   "accuracy: its distribution over participants; width: of the interval against trials; thresholds: "
                   "of the participants, beside the currents that the lowest and the highest command give them")
                  .oneOf({"confusion", "accuracy", "width", "thresholds"})},
         .text = "A prediction's figures, marked as predicted.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::predicted},
    };
}

}  // namespace tacto
