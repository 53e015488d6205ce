// Results that are predicted: virtual participants.
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

ResultTraits variation() {
    return {
        .kind = ResultKind::Variation,
        .name = "variation",
        .decisionRule = "A prediction: nothing is measured, and nothing is judged.",
        .tables = {
            facts("Participants", "",
                  {number("Virtual participants", "participants"), number("Served", "complete"),
                   as(As::Share, "Clearly separable", "clearly_separable_share"),
                   as(As::Share, "Recognised, median", "accuracy"),
                   as(As::Share, "Recognised, all together", "pooled_accuracy"),
                   number("Information, median", "information_bits", "bit"),
                   number("Felt from, median", "detection_ma", "mA"),
                   number("Uncomfortable from, median", "discomfort_ma", "mA"),
                   number("Impedance, median", "impedance_ohm", "ohm")}),
            rows("Who is served, predicted, not measured", "ranges",
                 {text("Amplitudes", "amplitudes"), number("Served", "served"),
                  number("Refused", "participants_refused"), number("Do not feel all", "participants_not_feeling"),
                  number("Without a range", "participants_without_range"),
                  number("Every pair 5 JND apart", "clearly_separable"),
                  as(As::Share, "Right answers of the served", "accuracy")}),
            rows("Served by what is too strong, predicted, not measured", "readings",
                 {text("Too strong from", "too_strong_from"), number("Median", "median_ma", "mA"),
                  number("Fixed range serves", "fixed_served"), number("It is refused to", "fixed_refused"),
                  number("Its lowest not felt by", "fixed_not_feeling"), number("Own range serves", "personal_served"),
                  as(As::Share, "Right answers of these", "accuracy")}),
            noted(rows("What few people can show, predicted, not measured", "pilots",
                       {number("People", "people"), number("Trials each", "trials"),
                        number("Above chance from", "right_from"), as(As::Share, "All are served", "all_served"),
                        as(As::Share, "And above chance", "all_above_chance"),
                        as(As::Share, "If all: can do it, at least", "prevalence_all"),
                        as(As::Share, "If all but one: at least", "prevalence_but_one"),
                        as(As::Share, "One person's interval is wide", "width")}),
                  "“If all” says what share of such people can do it, at least (95 %), when everyone in the pilot is "
                  "above "
                  "chance (p < 0.05, one-sided); “if all but one” when one is not (Bayesian prevalence, Ince et al. "
                  "2021, "
                  "doi:10.7554/eLife.62461). So few people say whether people can do it, not how well people do it on "
                  "average."),
            noted(rows("Premises", "premises",
                       {text("Quantity", "quantity"), text("Value", "value"), text("Spread", "spread"),
                        text("Mark", "mark"), text("Source", "source")},
                       Else::InTheTerminal),
                  "Source: the value is the source's. Choice: ours, to be replaced with the laboratory's own. Set: for "
                  "this run. Every spread (geometric standard deviation) is a choice."),
            noted(rows("Conditions, predicted, not measured", "conditions",
                       {text("Condition", "name"), number("Presented", "presented"), number("Refused", "refused"),
                        number("Not felt", "not_felt"), number("Draws attention", "draws_attention"),
                        number("Too strong", "too_strong"), number("Counted", "counted"),
                        number("Current", "current_ma", "mA"), number("Voltage", "voltage_v", "V")},
                       Else::InTheTerminal),
                  "A value is the median, and in brackets stand 5 and 95 %, of participants or of benches. A condition "
                  "counts for a participant only if it is presented, felt and not too strong."),
            rows("Conditions of the other amplitudes, predicted, not measured", "other_levels.conditions",
                 {text("Condition", "name"), number("Presented", "presented"), number("Not felt", "not_felt"),
                  number("Counted", "counted"), number("Draws attention", "draws_attention"),
                  number("Too strong", "too_strong"), number("Not tolerated", "not_tolerated")},
                 Else::InTheTerminal),
            rows("Pairs in just-noticeable differences, predicted, not measured", "separability",
                 {text("Condition", "a"), text("Against", "b"), number("Participants", "participants"),
                  number("Together (JND)", "jnd"), number("Amplitude (JND)", "amplitude_jnd"),
                  number("Interval (JND)", "interval_jnd")}),
            confusion(),
            rows("Trials that the pilot needs, predicted, not measured", "trials_needed.aims",
                 {text("Aim", "aim"), number("One participant", "one_participant"),
                  number("Pooled, each", "pooled_each"), number("Pooled, all", "pooled_trials"),
                  number("Design effect", "design_effect"), number("Participants, at least", "participants_at_least")}),
            sentences("Assumptions", "trials_needed.assumptions", Else::InTheTerminal),
            rows("Benches within their tolerances, predicted, not measured", "bench.conditions",
                 {text("Condition", "name"), number("Amplitude", "amplitude_v", "V"),
                  number("Interval", "interval_s", "s")},
                 Else::InTheTerminal),
            rows("Benches: pairs in just-noticeable differences, predicted, not measured", "bench.pairs",
                 {text("Condition", "a"), text("Against", "b"), number("Amplitude (JND)", "amplitude_jnd"),
                  number("Interval (JND)", "interval_jnd")},
                 Else::InTheTerminal)}};
}

}  // namespace

Kinds predictionKinds() { return {variation()}; }

}  // namespace tacto::describe
