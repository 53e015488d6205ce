// Results of a stimulator's calibration, and of a check of one that is stored.
#include "core/encoding/StimulatorCalibration.h"
#include "core/results/Describe.h"

namespace tacto::describe {

ResultTraits stimulatorCalibration() {
    Tables all{rows(
        "What was found: gain and offset ± U (95 %), the rest in % of the largest command",
        "amplitude|interval|width|gap",
        {verdict(), as(As::Quantity, "Quantity", "quantity"), number("Gain", "gain", "", "gain_expanded_uncertainty"),
         number("k", "gain_coverage_factor"), number("Offset", "offset", "@unit", "offset_expanded_uncertainty"),
         number("k", "offset_coverage_factor"), spread("Residual", "residual_max_pct_fs", "%"),
         spread("Repeatability", "repeatability_pct_fs", "%"), spread("Hysteresis", "hysteresis_pct_fs", "%")},
        Else::InTheWindow)};
    for (const auto& one : kCalibratedQuantities)
        all.push_back({.title = std::string(one.title),
                       .at = std::string(one.id),
                       .shape = Shape::Calibration,
                       .shown = Else::InBoth});
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

}  // namespace tacto::describe
