// The object "calibration", what calibrations begin and end with: what scripts can call, and what each function takes
// and returns.
#include "app/scripting/host/calibration/CalibrationObject.h"

namespace tacto {

std::vector<HostFunction> calibrationFunctions() {
    using namespace takes;
    return {
        {.name = "knownRanges",
         .parameters = {object("stored", "from bench.calibration, calibrated"),
                        object("ranges",
                               "{ amplitude_min_v, amplitude_max_v, interval_min_s, interval_max_s, width_min_us, "
                               "width_max_us, gap_min_us, gap_max_us }")},
         .text = "The part of the ranges that a stored calibration knows. The amplitude of a current source is set in "
                 "volts and known in mA, and stays as it is.",
         .returns = "The ranges, narrowed.",
         .call = host::calibration::knownRanges},
        {.name = "timeBase",
         .parameters = {any("interval", "from analysis.calibration() of the interval; null: not calibrated")},
         .text = "Judges the oscilloscope's time base by the computer's clock, which hands out the trains: one that "
                 "reads the clock wrong reads every time wrong. At most 0.5 % is allowed (choice), uncertainty "
                 "included.",
         .returns = "\"\" when it is right or was not read, else why not.",
         .call = host::calibration::timeBase},
        {.name = "knownWeight",
         .parameters = {any("reading", "from bench.measureWeight(); null: not evaluated"),
                        object("rest", "from bench.measureRest()"),
                        number("tolerance", "%", "of the weight").range(0, 100)},
         .text = "Before anything is believed: a weight must read as what it is. In counts it is not known what it "
                 "should read; then it must stand out from rest by five standard deviations.",
         .returns = "{ check, reason }: check { mass_g, reference_n, measured, unit, deviation_pct, allowed_pct, "
                    "passed }, passed null when not evaluated; reason \"\" unless it failed.",
         .call = host::calibration::knownWeight},
        {.name = "sensorVerdict",
         .parameters = {object("results",
                               "what analysis.sensorCalibration() returned, and force and taxels of "
                               "analysis.fingertipScales()"),
                        flag("weighed", "weights were put on the fingertip")},
         .text = "The verdict of a sensor calibration: of the references, and of force and taxels where weights were "
                 "asked for. What does not follow the weights is a fault of the fingertip.",
         .returns = "{ verdict, reasons }",
         .call = host::calibration::sensorVerdict},
    };
}

}  // namespace tacto
