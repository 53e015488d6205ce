// The object "calibration", the steps of a stimulator's and of a fingertip's calibration: what scripts can call, and
// what each function takes and returns.
#include "app/scripting/host/calibration/CalibrationObject.h"

#include "app/scripting/engine/Arming.h"

namespace tacto {

namespace {

using namespace takes;
using Parameters = std::vector<HostParameter>;

/// `first`, the settings, and the ranges over which each quantity is calibrated; the script may hand over all of its
/// parameters.
Parameters withRanges(Parameters first) {
    first.push_back(object("settings", "the parameters of the run"));
    const Parameters ranges{
        number("settings.amplitude_min_v", "V", "lowest amplitude").range(0, 200),
        number("settings.amplitude_max_v", "V", "largest; of a current source times |Z|").range(0, 200),
        number("settings.interval_min_s", "s", "shortest interval").range(0, 60),
        number("settings.interval_max_s", "s", "longest").range(0, 60),
        number("settings.width_min_us", "us", "shortest phase").range(0, 10'000),
        number("settings.width_max_us", "us", "longest").range(0, 10'000),
        number("settings.gap_min_us", "us", "shortest gap").range(0, 10'000),
        number("settings.gap_max_us", "us", "longest").range(0, 10'000)};
    first.insert(first.end(), ranges.begin(), ranges.end());
    return first;
}

/// The same, and how each level is read.
Parameters withLevels(Parameters first) {
    auto all = withRanges(std::move(first));
    const Parameters levels{number("settings.load", "ohm", "that is connected; ± 20 % for the limits").range(1, 1e6),
                            number("settings.rate_hz", "Hz", "sampling rate").range(1, 1e9),
                            number("settings.settling_s", "s", "at each level before it is read").range(0, 3600)};
    all.insert(all.end(), levels.begin(), levels.end());
    return all;
}

HostParameter quantity() {
    std::vector<std::string_view> ids;
    for (const auto& one : kCalibratedQuantities) ids.push_back(one.id);
    return text("quantity", "what is calibrated").oneOf(std::move(ids));
}

}  // namespace

std::vector<HostFunction> calibrationFunctions() {
    return {
        {.name = "checkRanges",
         .parameters = withRanges({}),
         .text = "Refuses ranges whose lowest level is not below the largest.",
         .errors = "Throws for such a range.",
         .call = host::calibration::checkRanges},
        {.name = "knownRanges",
         .parameters = withRanges({object("stored", "from bench.calibration, calibrated")}),
         .text = "Narrows the ranges to what a stored calibration knows. The amplitude of a current source is set in "
                 "volts and known in mA, and stays as it is.",
         .returns = "The settings, with these ranges.",
         .call = host::calibration::knownRanges},
        {.name = "readKnownLoad",
         .parameters = withLevels({}),
         .text = "Before anything is believed: arms, reads one train of the largest amplitude, and disarms. For "
                 "record.reference().",
         .returns = "As measure.pulse().",
         .errors = "As bench.arm() and bench.capture().",
         .asks = kConfirmArming,
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::calibration::readKnownLoad},
        {.name = "warmUp",
         .parameters = {number("load", "ohm", "that is connected").range(1, 1e6),
                        number("seconds", "s", "0: not at all").range(0, 86'400)},
         .text = "Delivers trains of the lowest amplitude at the shortest interval for so long, and disarms.",
         .errors = "As bench.arm().",
         .asks = kConfirmArming,
         .failsDisarmed = true,
         .call = host::calibration::warmUp},
        {.name = "beginLevels",
         .parameters = withLevels({quantity()}),
         .text =
             "Sets straight curves over the ranges, so that R sets the amplitude and P the interval level by level, "
             "and arms for levels of these two. Each level of width and gap arms again, as they are part of the "
             "profile.",
         .errors = "As bench.arm().",
         .asks = kConfirmArming,
         .failsDisarmed = true,
         .call = host::calibration::beginLevels},
        {.name = "readLevel",
         .parameters = withLevels({quantity(), object("step", "of random.sweeps()"),
                                   number("step.share", "", "0 the lowest level to 1 the largest").range(0, 1),
                                   text("step.direction", "of the sweep").oneOf({"up", "down"}),
                                   whole("step.repeat", "of the sweep").range(1, 1e6)}),
         .text =
             "Sets a level, waits until it has settled, and reads a train; for the interval two trains, in one record "
             "where the oscilloscope does not state how good the time stamps of its records are. All levels are "
             "read in one range of the oscilloscope: its errors are then the same for all.",
         .returns =
             "{ row, reading }: row { reading, commanded, measured, direction, repeat } for calibration.judge(), "
             "reading as measure.pulse() returns it.",
         .errors = "As bench.arm() and bench.capture().",
         .asks = kConfirmArming,
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::calibration::readLevel},
        {.name = "judge",
         .parameters = {quantity(), list("rows", "of calibration.readLevel()").of(ValueType::Object),
                        object("settings", "the parameters of the run"),
                        number("settings.tolerance_pct", "%", "of amplitude").range(0.01, 50),
                        number("settings.timing_tolerance_pct", "%", "of interval, width and gap").range(0.01, 50),
                        number("settings.load_tolerance_pct", "%", "of the load").range(0, 50)},
         .text = "The line through the readings of a quantity, its uncertainty and its verdict.",
         .returns = "As analysis.calibration().",
         .errors = "As analysis.calibration().",
         .needs = Role::Stimulator,
         .call = host::calibration::judge},
        {.name = "timeBase",
         .parameters = {any("interval", "from calibration.judge() of the interval; null: not calibrated")},
         .text = "Judges the oscilloscope's time base by the computer's clock, which hands out the trains: one that "
                 "reads the clock wrong reads every time wrong. At most 0.5 % is allowed (choice), uncertainty "
                 "included.",
         .returns = "\"\" when it is right or was not read, else why not.",
         .call = host::calibration::timeBase},
        {.name = "stimulatorVerdict",
         .parameters = {list("found", "from calibration.judge(), of each quantity").of(ValueType::Object),
                        text("clock", "from calibration.timeBase()").orEmpty(),
                        flag("store", "the result was to be kept")},
         .text = "The verdict of a stimulator calibration: the worst quantity's, and indeterminate where the time base "
                 "is not sure.",
         .returns = "{ verdict, reasons }",
         .call = host::calibration::stimulatorVerdict},
        {.name = "checkVerdict",
         .parameters = {list("checks", "from analysis.calibrationCheck(), of each quantity").of(ValueType::Object),
                        object("stored", "from bench.calibration")},
         .text = "The verdict on a stored calibration that was checked: the worst quantity's.",
         .returns = "{ verdict, reasons }",
         .call = host::calibration::checkVerdict},
        {.name = "knownWeight",
         .parameters = {any("reading", "from bench.measureWeight(); null: not evaluated"),
                        object("rest", "from bench.measureRest()"),
                        number("tolerance", "%", "of the weight").range(0, 100),
                        number("options.weight_tolerance_pct", "%", "half-width of the weight; 0: not known")
                            .range(0, 100)
                            .otherwise(0),
                        number("options.gravity_tolerance_pct", "%", "half-width of local gravity; 0: not known")
                            .range(0, 100)
                            .otherwise(0)},
         .text =
             "Before anything is believed: a weight must read as what it is, within the tolerance with its U, which "
             "is that of the weight, of local gravity and of both readings. In counts it is not known what it "
             "should read; then it must stand out from rest by five standard deviations.",
         .returns = "{ check, reason }: check { mass_g, reference_n, measured, expanded_uncertainty, unit, "
                    "deviation_pct, expanded_uncertainty_pct, allowed_pct, verdict, passed }: verdict \"not "
                    "evaluated\" and passed false where nothing was read or U is not known, passed null without a "
                    "reading; reason \"\" where it passed and without a reading.",
         .call = host::calibration::knownWeight},
        {.name = "weighings",
         .parameters = {list("masses", "g").of(ValueType::Number),
                        whole("repeats", "of each weight, each way").range(1, 1000)},
         .text = "The order in which weights are laid on, up and down, again and again: what stays behind when weight "
                 "is taken off shows as hysteresis.",
         .returns = "List of { mass_g, direction, repeat }.",
         .call = host::calibration::weighings},
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
