// Results of trains as captured: separability, drift, encoding comparison, transitions.
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

ResultTraits separability() {
    return {.kind = ResultKind::Separability,
            .name = "separability",
            .decisionRule =
                "Separable when each pair of conditions is at least 5 just-noticeable differences apart in one "
                "dimension and no coefficient of variation exceeds 5 %, each judged by its one-sided 95 % confidence "
                "bound, and the accuracy's 95 % interval begins at 95 % or above. The 5 differences and the 5 % are "
                "choices of this program.",
            .tables = withBasis(
                {facts("Recognition", "",
                       {as(As::Share, "Recognised", "accuracy"), number("Folds of the cross-validation", "folds"),
                        number("Instrument's floor, amplitude", "floor.amplitude_v", "V"),
                        number("Instrument's floor, interval", "floor.interval_s", "s")}),
                 rows("Reference surfaces", "references",
                      {text("Material", "material"), number("Vibration h", "h"), number("Taxels v", "v"),
                       number("Frames", "frames")},
                      Else::InTheTerminal),
                 noted(rows("Conditions", "conditions",
                            {text("Condition", "name"), number("n", "n"),
                             number("Amplitude, mean and s.d.", "amplitude_v", "V"),
                             number("Interval, mean and s.d.", "interval_s", "s"),
                             as(As::Share, "Variation of amplitude", "amplitude_variation", "amplitude_variation_high"),
                             as(As::Share, "Variation of interval", "interval_variation", "interval_variation_high"),
                             number("Not measured", "not_measured")}),
                       "At most and at least: the one-sided 95 % confidence bound, by which each is judged."),
                 rows("Pairs", "pairs",
                      {text("Condition", "a"), text("Against", "b"),
                       as(As::AtLeast, "Amplitude (JND)", "amplitude_jnd", "amplitude_jnd_low"),
                       as(As::AtLeast, "Interval (JND)", "interval_jnd", "interval_jnd_low"),
                       number("Mahalanobis distance", "mahalanobis")}),
                 confusion()})};
}

ResultTraits drift() {
    const auto change = [](const char* title, const char* at) { return number(title, at, "%"); };
    return {.name = "drift",
            .decisionRule =
                "Steady when the 95 % intervals of two changes lie within the tolerance: that of a straight line from "
                "the first trial to the last, and the largest between two quarters of the trials; a fail when one of "
                "them lies beyond it. The tolerance is a choice.",
            .tables = withBasis(
                {facts("Drift of the amplitude", "",
                       {number("Trials", "trials"), tolerance("Accepted, ±", "tolerance_pct", "%"),
                        change("First trial to last", "change_pct"),
                        change("Between quarters, largest", "between_quarters_pct"),
                        spread("Instrument's floor", "floor_pct", "%")}),
                 noted(rows("Conditions", "conditions",
                            {text("Condition", "name"), number("n", "n"),
                             number("Amplitude, mean and s.d.", "amplitude_v", "V"),
                             change("First trial to last", "change_pct"), number("Not measured", "not_measured")}),
                       "Intervals are 95 %."),
                 rows("Quarters of the trials, against the mean of the four", "quarters",
                      {text("Trials", "trials"), number("n", "n"), change("Amplitude", "change_pct")})})};
}

ResultTraits encodingComparison() {
    return {.kind = ResultKind::EncodingComparison,
            .name = "encoding-comparison",
            .decisionRule = "A comparison: the encodings are set side by side, and none is judged.",
            .tables = withBasis(
                {facts("Comparison", "", {text("Compared with", "default"), jnd("Asymmetry (JND)", "asymmetry_jnd")},
                       Else::InTheTerminal),
                 rows("Encodings: smallest distances in just-noticeable differences", "encodings",
                      {text("Encoding", "name"), jnd("Amplitude (JND)", "smallest_amplitude_jnd"),
                       jnd("Interval (JND)", "smallest_interval_jnd"), jnd("Smallest pair (JND)", "smallest_pair_jnd"),
                       jnd("Neighbours, smallest (JND)", "neighbours.min_jnd"),
                       jnd("A train, at most (JND)", "gradual_jnd"), as(As::Share, "Recognised", "accuracy"),
                       as(As::Verdict, "Separable", "separable")}),
                 rows("Conditions as measured, and how far they moved against the default", "conditions",
                      {text("Encoding", "encoding"), text("Condition", "name"),
                       number("Amplitude, mean and s.d.", "amplitude_v", "V"),
                       number("Interval, mean and s.d.", "interval_s", "s"),
                       jnd("Amplitude moved (JND)", "amplitude_jnd"), jnd("Interval moved (JND)", "interval_jnd")},
                      Else::InTheTerminal),
                 rows("Distances against the default", "differences",
                      {text("Encoding", "encoding"), jnd("Smallest pair (JND)", "pair_jnd"),
                       jnd("Neighbours, smallest (JND)", "neighbours_min_jnd"),
                       jnd("Neighbours, mean (JND)", "neighbours_mean_jnd"),
                       jnd("A train, at most (JND)", "per_train_jnd")},
                      Else::InTheTerminal)})};
}

ResultTraits transitions() {
    return {
        .kind = ResultKind::Transitions,
        .name = "transitions",
        .decisionRule =
            "No step from one captured train to the next may exceed the just-noticeable differences wanted, "
            "uncertainty included; a change must be complete in the time wanted or, where steps of that size "
            "cannot, in the fewest trains that they take (choice); no latency may differ from its design by more "
            "than the tolerance.",
        .tables = withBasis(
            {facts("Changes", "",
                   {jnd("Wanted for a train, at most (JND)", "changes.wanted_jnd"),
                    number("Complete within", "changes.complete_limit_s", "s"),
                    number("Latency's tolerance, ±", "latency.tolerance_s", "s"),
                    jnd("Largest change, gradual (JND)", "transitions.gradual.largest_jnd"),
                    jnd("Largest change, abrupt (JND)", "transitions.abrupt.largest_jnd")},
                   Else::InTheTerminal),
             noted(rows("Changes as captured: largest step per train, and time until complete", "changes.groups",
                        {verdict(), text("Change", "name"), number("n", "n"), jnd("Amplitude (JND)", "amplitude_jnd"),
                         jnd("Interval (JND)", "interval_jnd"), number("Complete, median", "complete_s.median", "s"),
                         number("Largest", "complete_s.max", "s"),
                         number("Fastest possible", "fastest_complete_s.min", "s"), number("Trains", "trains.max"),
                         number("Fewest possible", "fewest_trains.max"), number("Late", "late")}),
                   "Complete: from the change to the train that reaches the new state. Fastest and fewest: the least "
                   "that steps of the size wanted allow."),
             noted(
                 rows("Latency: from the step to the first train that carries it, against its design", "latency.groups",
                      {verdict(), text("Step", "name"), number("n", "n"),
                       number("Latency, mean and s.d.", "latency_s", "s"), number("Largest", "latency_s.max", "s"),
                       number("Designed, mean and s.d.", "designed_latency_s", "s"), spread("Off, most", "off_s", "s"),
                       number("Trains", "trains.max"), number("Designed", "designed_trains.max"),
                       number("Not measured", "not_measured")}),
                 "Design: the pending train is pulled forward to max(now, last onset + new interval), and carries the "
                 "newest amplitude. Steps fall on moments spread over the interval. Off: the largest difference "
                 "between a step and its design. Trains: how many a change takes until it is complete."),
             rows("Computed from the encoding: largest step from train to train", "transitions.largest",
                  {text("Movement", "movement"), text("Of", "of"), number("From", "from", "@unit"),
                   number("To", "to", "@unit"), jnd("Step (JND)", "jnd"), number("R", "roughness"),
                   number("P", "pressure"), as(As::YesNo, "As wanted", "wanted")},
                  Else::InTheTerminal),
             sentences("Notes", "notes", Else::InBoth)})};
}

}  // namespace

Kinds trainKinds() { return {separability(), drift(), encodingComparison(), transitions()}; }

}  // namespace tacto::describe
