// The object "analysis", judging what was measured, and predicting: what scripts can call, and what each function takes
// and returns.
#include "app/scripting/host/analysis/AnalysisObject.h"

#include <array>

#include "core/analysis/load_safety/LoadSafety.h"
#include "core/analysis/variation/PopulationField.h"
#include "core/analysis/variation/Variation.h"
#include "core/analysis/variation/VariationBench.h"

namespace tacto {

namespace {

std::vector<HostParameter> variationParameters(const VariationOptions& predicted) {
    using namespace takes;
    const auto& people = predicted.population;
    std::vector<HostParameter> all{
        whole("options.participants", "virtual people").range(1, 100'000).otherwise(predicted.participants),
        whole("options.trials", "per condition and participant").range(1, 10'000).otherwise(predicted.trials),
        text("options.levels",
             "personal: from what the participant feels to what is too strong, as far as the profile allows; "
             "profile: the profile's for everybody")
            .oneOf({nameOf(AmplitudeLevels::Personal), nameOf(AmplitudeLevels::Profile)})
            .otherwise(nameOf(predicted.stimulation.levels)),
        text("options.source", "current: A / |Z|; voltage: as on the bench, refused for people")
            .oneOf({"current", "voltage"})
            .otherwise("current"),
        text("options.guess", "what is answered when nothing is felt")
            .oneOf({nameOf(GuessBehaviour::None), nameOf(GuessBehaviour::Uniform)})
            .otherwise(nameOf(predicted.guess)),
        number("options.width", "", "wanted width of the 95 % interval of accuracy")
            .range(0.02, 1)
            .otherwise(predicted.wanted.width),
        number("options.assurance", "", "with which a pilot is to reach it")
            .range(0.5, 0.999)
            .otherwise(predicted.wanted.assurance),
        whole("options.pilot", "participants of the pilot").range(1, 100'000).otherwise(predicted.wanted.participants),
        number("options.area_cm2", "cm2", "electrode area: R_p falls with it and C grows")
            .range(0, 1000)
            .optional("the profile's, or 1 where it has none,")};
    // Names of parameters stay where they are.
    static const auto names = [] {
        std::vector<std::array<std::string, 2>> made;
        for (const auto& field : populationFields()) {
            made.push_back({"options." + std::string(field.key), std::string(field.name)});
            if (!field.holdsFor.empty()) made.back()[1] += " " + std::string(field.holdsFor);
        }
        return made;
    }();
    PopulationModel shipped = people;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto& field = populationFields()[i];
        all.push_back(number(names[i][0], field.accepted.unit, names[i][1])
                          .range(field.accepted.low, field.accepted.high)
                          .otherwise(field.in(shipped)));
    }
    const std::vector<HostParameter> rest{
        number("options.above_detection", "", "a personal range begins at this times the perception threshold")
            .range(1, 10)
            .otherwise(predicted.stimulation.aboveDetection),
        number("options.below_discomfort", "", "and ends at this times what is too strong")
            .range(0.01, 1)
            .otherwise(predicted.stimulation.belowDiscomfort),
        number("options.skin_spread", "", "geometric standard deviation between people, 1 for none")
            .range(kAcceptedSpread.low, kAcceptedSpread.high)
            .optional("1.5, and for C 1.3,"),
        number("options.threshold_spread", "", "of the three thresholds, likewise")
            .range(kAcceptedSpread.low, kAcceptedSpread.high)
            .otherwise(people.detection_ma.spread),
        number("options.weber_spread", "", "the same of the Weber fractions")
            .range(kAcceptedSpread.low, kAcceptedSpread.high)
            .otherwise(people.amplitudeWeber.spread),
        text("options.label", "what the progress bar says").otherwise("Virtual participants")};
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

}  // namespace

std::vector<HostParameter> host::analysis::withWeighing(HostParameter first) {
    using namespace takes;
    return {std::move(first),
            number("options.tolerance_pct", "%", "half-width that all weights share").range(0, 50).otherwise(0),
            number("options.gravity_tolerance_pct", "%", "half-width of local gravity; 0: not known")
                .range(0, 50)
                .otherwise(0),
            number("options.contact_area_cm2", "cm2", "area under a weight; 0: not known").range(0, 100).otherwise(0),
            number("options.contact_area_tolerance_pct", "%", "half-width of the area; 0: not known")
                .range(0, 90)
                .otherwise(0)};
}

std::vector<HostFunction> analysisFunctions() {
    using namespace takes;
    constexpr double kLargest = 1e9;  // of a tolerance
    const LoadSafetyTolerances tolerances;
    const VariationOptions predicted;
    const BenchTolerances bench;
    return {
        {.name = "separability",
         .parameters =
             {list("trials",
                   "objects with condition, amplitude_v, interval_s, and their uncertainties amplitude_u_v, "
                   "interval_u_s, time_base_u, without which the verdict cannot be a pass, and amplitude_gain_u, the "
                   "part of amplitude_u_v that all trials share; from record.trials()"),
              list("options.conditions", "names that must all be there, else the verdict cannot be a pass")
                  .of(ValueType::Text)
                  .optional()},
         .text = "Judges whether the conditions can be told apart from what was measured.",
         .returns =
             "{ verdict, reasons, conditions, pairs, confusion, accuracy, folds, trials }, for plot.* and verdict().",
         .errors = "Throws for fewer than two conditions, or a value that is not above zero.",
         .call = host::analysis::separability},
        {.name = "loadValue",
         .parameters =
             {object("load", "as in analysis.loadSafety()"), object("tolerances", "as in it"),
              number("tolerances.load_pct", "%", "of the load").range(0.01, 50).otherwise(tolerances.load_pct),
              number("tolerances.resistor_pct", "%", "of the resistor where no multimeter read it")
                  .range(0.01, 50)
                  .otherwise(tolerances.resistor_pct)},
         .text =
             "Judges by its first command whether a load is what it should be: one that is not gets no other command.",
         .returns = "\"\" when it is, else why not.",
         .errors = "Throws for a load that cannot be read.",
         .call = host::analysis::loadValue},
        {.name = "loadSafety",
         .parameters =
             {list("loads",
                   "{ name, dmm_ohm, dmm_u_ohm, serial, steps: [{ command_v, interval_s, reading }], refusals: [{ "
                   "command_v, interval_s, forbidden, refused, predicted, reason, what }], undriven: [{ command_v, "
                   "interval_s, reason }], not_applicable, problem }"),
              list("trips", "from bench.trip...()"),
              object("options.reference", "the load of the known-reference check, as in loads").optional(),
              object("options.tolerances", "what is accepted").optional(),
              number("options.tolerances.load_pct", "%", "of a load").range(0.01, 50).otherwise(tolerances.load_pct),
              number("options.tolerances.amplitude_pct", "%", "of the amplitude")
                  .range(0.01, 50)
                  .otherwise(tolerances.amplitude_pct),
              number("options.tolerances.timing_pct", "%", "of widths and intervals")
                  .range(0.01, 50)
                  .otherwise(tolerances.timing_pct),
              number("options.tolerances.resistor_pct", "%", "of the resistor of the known-reference check")
                  .range(0.01, 50)
                  .otherwise(tolerances.resistor_pct),
              number("options.tolerances.area_pct", "%", "of the electrode area")
                  .range(0.01, 50)
                  .otherwise(tolerances.area_pct),
              object("options.absolute", "from bench.readReference()").optional(),
              object("options.open_circuit", "{ command_v, interval_s, reading }: a train into the open circuit")
                  .optional()},
         .text = "Judges everything measured against every limit set with its guard band.",
         .returns = "{ kind, verdict, reasons, loads, rows, matrix, disclosed, described, worst_case }: what is "
                    "missing reads \"not evaluated\", and then the verdict is not a pass. matrix is { loads, lines }, "
                    "every limit once with a cell per load and the margin left, the smallest first.",
         .errors = "Throws for a load that cannot be read.",
         .call = host::analysis::loadSafety},
        {.name = "calibration",
         .parameters =
             {list("readings",
                   "objects with commanded, measured and direction (up, down); where each has a reading, the number "
                   "from measure.pulse(), the program's own record of that reading counts in place of the two values"),
              text("options.quantity", "what was calibrated").otherwise("amplitude"),
              text("options.unit", "of the readings").optional(),
              number("options.tolerance_pct", "%", "of the command at each level")
                  .range(0, kLargest)
                  .orNull()
                  .optional("2 %"),
              number("options.gain_tolerance", "", "of the instrument, relative half-width")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.probe_tolerance", "", "of the probe, relative half-width")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.offset_tolerance", "as the readings", "of the instrument, half-width")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.resolution", "as the readings", "one step of the instrument")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.load_tolerance", "", "relative half-width").range(0, kLargest).orNull().optional(),
              number("options.load_sensitivity", "", "relative change of a reading per relative change of the load")
                  .range(-10, kLargest)
                  .orNull()
                  .optional(),
              number("options.sampling_step", "s", "of the record, for widths and intervals")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.same_level", "", "commands this close, relative to the largest, are one level")
                  .range(0, kLargest)
                  .orNull()
                  .optional()},
         .text = "Fits measured against commanded, works out the uncertainty and judges each level with a guard band. "
                 "The uncertainty of own readings is at least what the oscilloscope states.",
         .returns = "{ gain, offset, residual_max_pct_fs, repeatability_pct_fs, hysteresis_pct_fs, "
                    "expanded_uncertainty, verdict, verdict_iec (± 20 %), reasons, levels, readings with outlier, "
                    "budget: { rows }, calibration, ... }; calibration is its number for record.calibration(), null "
                    "where a reading is not the program's own.",
         .errors = "Throws for fewer than two levels, or where nothing was repeated.",
         .call = host::analysis::calibration},
        {.name = "calibrationCheck",
         .parameters = {object("found", "from analysis.calibration()"),
                        object("line", "what bench.calibration has of the same quantity"),
                        number("tolerance", "%", "of the command at each level").range(0.01, 50)},
         .text = "Judges whether a stored calibration still holds where its range was read again, with a guard band.",
         .returns = "{ rows: [{ quantity, commanded, expected, measured, off, expanded_uncertainty, allowed, unit, "
                    "verdict }], verdict, reasons }; widths and gaps in us.",
         .call = host::analysis::calibrationCheck},
        {.name = "sensorScale",
         .parameters =
             {list("readings", "objects with commanded (the reference), measured and direction (up, down)"),
              text("options.name", "of the sensor, for messages").otherwise("the sensor"),
              number("options.tolerance_pct", "%", "half-width that all references share").range(0, 50).otherwise(0)},
         .text = "A straight line through readings against references, inverted: reference = scale · reading + offset.",
         .returns =
             "{ scale, scale_expanded_uncertainty, offset, offset_expanded_uncertainty, gain, offset_reading, "
             "residual_max_pct_fs, repeatability_pct_fs, hysteresis_pct_fs, levels, readings, warnings }: U for 95 %.",
         .errors = "Throws for fewer than two references, or where the readings do not follow them.",
         .call = host::analysis::sensorScale},
        {.name = "fingertipScales",
         .parameters = host::analysis::withWeighing(
             list("weighed", "objects { reading: from bench.measureWeight(), direction: up or down }")),
         .text = "What one unit of force and of each taxel stands for: force against the weights, taxels against their "
                 "pressure over the contact area.",
         .returns = "{ force, taxels: list }: force as analysis.sensorScale() with unit, taxels { taxel, unit, scale, "
                    "offset_pa, … }; scale is null with a reason where there is none, and an uncertainty is null where "
                    "a tolerance that it rests on is not known.",
         .errors = "Throws for rows that are not readings of one fingertip.",
         .call = host::analysis::fingertipScales},
        {.name = "sensorCalibration",
         .parameters = {list("surfaces",
                             "objects { name, ra_um, rz_um, slides from bench.measureSlide() }; first the smooth, then "
                             "the rough reference"),
                        object("rest", "from bench.measureRest()")},
         .text = "The scale of R from two reference surfaces, how far apart they are in d′, and Spearman's rank "
                 "correlation of R against Ra where five or more surfaces have one.",
         .returns = "{ surfaces, d_prime: { h, v, R, all }, spearman, accepted, verdict, reasons, warnings, roughness: "
                    "section of a profile }.",
         .errors = "Throws for fewer than three slides of a reference, or a rough one whose Ra is not above that of "
                   "the smooth one.",
         .call = host::analysis::sensorCalibration},
        {.name = "transitions",
         .parameters =
             {whole("options.lines", "lines along R and along P").range(2, 101).otherwise(11),
              number("options.traverse_s", "s", "from one end of the plane to the other").range(0.1, 600).otherwise(5),
              flag("options.jumps", "whether jumps between the corners are judged too").otherwise(true)},
         .text = "Computes the trains of a sweep of the R-P plane with the bench's encoding and finds the largest step "
                 "from one train to the next, in just-noticeable differences; at most 2 are wanted.",
         .returns = "{ verdict, reasons, wanted_jnd, gradual, abrupt, amplitude_map, interval_map, ... }; gradual and "
                    "abrupt hold largest_jnd, and the worst step of amplitude and of interval { jnd, roughness, "
                    "pressure, from_v, to_v, from_s, to_s }, its place being that of the later train; maps are rows of "
                    "P by columns of R, null where no train went.",
         .call = host::analysis::transitions},
        {.name = "difference",
         .parameters = {text("quantity", "what is compared").oneOf({"amplitude", "interval"}),
                        number("from", "", "in any unit, above 0").orNull(),
                        number("to", "", "in the same unit").orNull()},
         .text = "How many just-noticeable differences lie between two values; below 0 where the second is smaller.",
         .returns = "Number; null where a value is absent or not above 0.",
         .call = host::analysis::difference},
        {.name = "latency",
         .parameters = {list("steps", "from bench.step(), each with a name").of(ValueType::Object),
                        number("options.tolerance_s", "s", "accepted between measurement and design")
                            .range(0, 60)
                            .otherwise(0.02),
                        list("options.names", "names that must all be there, else the verdict cannot be a pass")
                            .of(ValueType::Text)
                            .optional()},
         .text = "Judges the latency of steps, name by name, against the scheduler's design.",
         .returns = "{ verdict, reasons, tolerance_s, groups }; a group is { name, n, not_measured, latency_s, "
                    "designed_latency_s, difference_s, trains, designed_trains, verdict } with statistics { mean, sd, "
                    "median, min, max, n }.",
         .call = host::analysis::latency},
        {.name = "changes",
         .parameters =
             {list("changes", "from bench.step() and bench.traverse(), each with a name").of(ValueType::Object),
              number("options.complete_s", "s", "a change is complete within this").range(0.01, 600).otherwise(2),
              flag("options.seconds_alone",
                   "also where steps of two differences cannot be so fast: else such a change passes with "
                   "the fewest trains that such steps take")
                  .otherwise(false),
              list("options.names", "names that must all be there, else the verdict cannot be a pass")
                  .of(ValueType::Text)
                  .optional()},
         .text = "Judges changes on the trains as captured, name by name: the largest step from train to train with "
                 "its uncertainty (twice the scatter of trains of one command; a gain is common to both and cancels), "
                 "and the time until a change is complete.",
         .returns = "{ verdict, reasons, notes, wanted_jnd, complete_limit_s, seconds_alone, groups }; notes say which "
                    "changes cannot be complete in time and why; a group is { name, n, trains_captured, amplitude_jnd, "
                    "amplitude_u_jnd, interval_jnd, interval_u_jnd, completes, complete_s, fastest_complete_s, trains, "
                    "fewest_trains, late, out_of_reach, verdict }.",
         .call = host::analysis::changes},
        {.name = "variation",
         .parameters = variationParameters(predicted),
         .text = "Predicts how virtual participants tell the conditions apart, drawn with the run's seed: no person "
                 "and no device takes part. Works on all cores, with the same result whatever their number.",
         .returns = "{ simulated, participants, seed, partial, range_v, served, participants_refused, "
                    "participants_not_feeling, participants_without_range, conditions, separability: [{ a, b, jnd, "
                    "amplitude_jnd, interval_jnd }], labels, columns, confusion, complete, accuracy: { median, low, "
                    "high }, presented_accuracy, information_bits, refused, not_felt, withheld, trials_needed: { "
                    "per_participant, pooled, curve, assumptions }, pilots, premises, model, people }: low and high "
                    "are 5 and 95 % of the participants. A condition counts where it is presented, felt and not too "
                    "strong; served are those for whom every one counts, and accuracy, confusion and pilots are "
                    "theirs. people holds the first 1000, a list per column.",
         .errors = "Throws for an option out of its range, and when the run is stopped; what was predicted until "
                   "then is kept as partial.",
         .call = host::analysis::variation},
        {.name = "uncertainBench",
         .parameters =
             {whole("options.draws", "benches").range(100, 1'000'000).otherwise(4000),
              text("options.source", "what the stimulator drives").oneOf({"current", "voltage"}).otherwise("current"),
              number("options.gain_pct", "%", "stimulator's gain, half-width")
                  .range(0, 50)
                  .otherwise(100 * bench.stimulatorGain),
              number("options.offset_v", "V", "stimulator's offset, half-width")
                  .range(0, 1000)
                  .otherwise(bench.stimulatorOffset.value()),
              number("options.load_pct", "%", "load's tolerance, half-width, of a current source alone")
                  .range(0, 50)
                  .otherwise(100 * bench.load),
              number("options.scope_gain_pct", "%", "oscilloscope's gain, half-width")
                  .range(0, 50)
                  .otherwise(100 * bench.scopeGain),
              number("options.scope_offset_pct", "%", "oscilloscope's offset, of the range, half-width")
                  .range(0, 50)
                  .otherwise(100 * bench.scopeOffset),
              number("options.clock_ppm", "ppm", "clocks against each other, half-width")
                  .range(0, 5e5)
                  .otherwise(1e6 * bench.clock),
              number("options.jitter_us", "us", "of one interval, half-width")
                  .range(0, 1e6)
                  .otherwise(bench.jitter.count())},
         .text =
             "Predicts what different benches within their tolerances would read of the same conditions (Monte Carlo).",
         .returns = "{ draws, conditions: [{ name, amplitude_v, interval_s }], pairs: [{ a, b, amplitude_jnd, "
                    "interval_jnd }] }, each { value, low, high }: median, 5 and 95 % of the benches.",
         .call = host::analysis::uncertainBench},
    };
}

}  // namespace tacto
