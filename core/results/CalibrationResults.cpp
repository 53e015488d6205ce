// Results of a stimulator's calibration, and of a check of one that is stored.
#include "core/encoding/StimulatorCalibration.h"
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

/// The uncertainty of each quantity at one command.
ResultTable budgets(const char* title, const char* at) {
    return rows(title, at,
                {as(As::Quantity, "Quantity", "quantity"), number("Combined, u", "combined", "@unit"),
                 number("Expanded, U (95 %)", "expanded_uncertainty", "@unit"), number("k", "coverage_factor"),
                 text("Method", "method")},
                Else::InTheTerminal);
}

/// Levels, what the uncertainty is made of at both ends (what weighs at one need not at the other), marked readings.
void addQuantity(Tables& all, const std::string& title, const std::string& id) {
    const auto add = [&](const char* what, const char* at, Columns columns) -> ResultTable& {
        all.push_back(rows((title + what).c_str(), (id + at).c_str(), std::move(columns), Else::InTheTerminal));
        return all.back();
    };
    add(": levels", ".levels",
        {verdict(),
         number("Commanded", "commanded", "@unit"),
         number("n", "n"),
         number("Error, going up", "mean_up-commanded", "@unit"),
         number("Error, going down", "mean_down-commanded", "@unit"),
         spread("s", "s", "@unit"),
         number("Error judged", "worst_error", "@unit", "worst_expanded_uncertainty"),
         number("k", "worst_coverage_factor"),
         number("Tolerance, ±", "tolerance", "@unit"),
         {"Used", "worst_error", As::Used, "@tolerance", "worst_expanded_uncertainty"}})
        .note = "The error that is judged is that of the worse direction, with its U (95 %).";
    const auto contributions = [&](const char* what, const char* at) {
        add(what, at,
            {text("Contribution", "name"), text("Distribution", "distribution"), number("u", "contribution", "@unit"),
             as(As::Freedom, "Degrees of freedom", "degrees_of_freedom")});
    };
    contributions(": uncertainty at the largest command", ".budget.rows");
    contributions(": uncertainty at the smallest command", ".budget_smallest.rows");
    all.back().shown = Else::OnlyInTheReport;
    add(": readings that stand out, marked and kept", ".readings",
        {number("Commanded", "commanded", "@unit"), number("Measured", "measured", "@unit"),
         text("Direction", "direction")});
    all.back() = whose(std::move(all.back()), "outlier", true);
}

ResultTraits stimulatorCalibration() {
    Tables all{rows(
        "What was found: gain and offset ± U (95 %), the rest in % of the largest command",
        "amplitude|interval|width|gap",
        {verdict(), as(As::Quantity, "Quantity", "quantity"), number("Gain", "gain", "", "gain_expanded_uncertainty"),
         number("k", "gain_coverage_factor"), number("Offset", "offset", "@unit", "offset_expanded_uncertainty"),
         number("k", "offset_coverage_factor"), spread("Residual", "residual_max_pct_fs", "%"),
         spread("Repeatability", "repeatability_pct_fs", "%"), spread("Hysteresis", "hysteresis_pct_fs", "%")})};
    all.push_back(rows("Readings", "amplitude|interval|width|gap",
                       {as(As::Quantity, "Quantity", "quantity"), number("Measured", "n"),
                        number("Not measured", "not_measured"), number("Stand out, marked and kept", "outliers")},
                       Else::InTheTerminal));
    all.push_back(
        budgets("Uncertainty at the largest command", "amplitude.budget|interval.budget|width.budget|gap.budget"));
    all.push_back(budgets("Uncertainty at the smallest command",
                          "amplitude.budget_smallest|interval.budget_smallest|width.budget_smallest|"
                          "gap.budget_smallest"));
    for (const auto& one : kCalibratedQuantities) addQuantity(all, std::string(one.title), std::string(one.id));
    all.push_back(rows("Check of the stored calibration", "check",
                       {verdict(), as(As::Quantity, "Quantity", "quantity"), number("Commanded", "commanded", "@unit"),
                        number("Expected", "expected", "@unit"), number("Measured", "measured", "@unit"),
                        number("Off", "off", "@unit", "expanded_uncertainty"), text("Direction", "direction"),
                        number("Allowed, ±", "allowed", "@unit")}));
    all.push_back(facts("Stored", "stored",
                        {text("Stimulator", "serial"), text("Valid until", "valid_until"),
                         number("Readings", "readings"), as(As::YesNo, "Simulated", "simulated")}));
    return {.kind = ResultKind::StimulatorCalibration,
            .name = "stimulator-calibration",
            .decisionRule =
                "Each level passes when |error| + U is within the tolerance, fails when |error| − U is not, and is "
                "indeterminate between; the worse sweep direction is judged. The verdict is the worst level's.",
            .guardBanded = true,
            .tables = withBasis(std::move(all))};
}

}  // namespace

Kinds calibrationKinds() { return {stimulatorCalibration()}; }

}  // namespace tacto::describe
