// Results of a fingertip's calibration: its scales and its references.
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

ResultTraits sensorCalibration() {
    return {
        .kind = ResultKind::SensorCalibration,
        .name = "sensor-calibration",
        .decisionRule =
            "Accepted when the 95 % interval of d′ between the two references begins at 1 or above: the scale then "
            "tells them apart.",
        .tables = {
            facts("Known reference", "reference",
                  {number("Mass", "mass_g", "g"), number("Weight", "reference_n", "N"),
                   number("Read as", "measured", "@unit", "expanded_uncertainty"),
                   number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
                   number("Allowed, ±", "allowed_pct", "%"), verdict()}),
            noted(rows("Distance of the two references, in d′ with its 95 % interval",
                       "d_prime.R|d_prime.all.h|d_prime.all.h_abs|d_prime.all.v_static|d_prime.all.v_dynamic",
                       {text("Of", "of"), number("d′", ""), as(As::YesNo, "Told apart", "told_apart")}),
                  "d′ is the difference of the means over the pooled standard deviation of single slides; the interval "
                  "is "
                  "from the non-central t distribution. Two surfaces are told apart when its lower end is at least 1, "
                  "the "
                  "customary threshold at which one slide over each names the rougher in 76 % of cases; otherwise the "
                  "calibration is refused."),
            facts("Roughness", "",
                  {number("Spearman's rank correlation of R and Ra", "spearman"), number("Surfaces", "spearman.n"),
                   text("Note", "spearman.note"), number("U of R for one slide, at R 0", "uncertainty_R.smooth"),
                   number("At R 0.5", "uncertainty_R.middle"), number("At R 1", "uncertainty_R.rough"),
                   number("k", "uncertainty_R.coverage_factor"), text("Profile", "profile.name")}),
            rows("Surfaces, under the scale that was found", "surfaces",
                 {text("Surface", "name"), number("Ra", "ra_um", "um"), number("Rz", "rz_um", "um"),
                  number("Slides", "slides"), number("Vibration h", "h"), number("Taxels v", "v"),
                  number("R", "R", "", "R_expanded_uncertainty"), spread("s.d. of R", "R_sd", ""),
                  number("Force", "force_n", "N"), text("Ra and Rz are", "source")},
                 Else::InTheTerminal),
            facts("Force", "force",
                  {number("Scale (N per reading)", "scale", "", "scale_expanded_uncertainty"),
                   number("Offset", "offset", "N", "offset_expanded_uncertainty"),
                   spread("Repeatability", "repeatability_pct_fs", "% FS"),
                   spread("Hysteresis", "hysteresis_pct_fs", "% FS"),
                   spread("Largest residual", "residual_max_pct_fs", "% FS"), number("Readings", "n"),
                   number("Standing out, marked and kept", "outliers"), text("Reason", "reason")}),
            rows("Force, weight by weight", "force.levels",
                 {number("Weight", "commanded", "N"), number("n", "n"), number("Mean reading", "mean"),
                  number("Going up", "mean_up"), number("Going down", "mean_down"), spread("s", "s", ""),
                  spread("Residual", "residual", "")},
                 Else::InTheTerminal),
            noted(
                rows("Taxels against force over the contact area", "taxels",
                     {number("Taxel", "taxel"),
                      number("Scale (Pa per reading)", "scale", "", "scale_expanded_uncertainty"),
                      number("Offset", "offset_pa", "Pa", "offset_expanded_uncertainty_pa"),
                      spread("Largest residual", "residual_max_pct_fs", "% FS"), text("Reason", "reason")},
                     Else::InTheTerminal),
                "A taxel's scale takes the weight as spread evenly over the contact area; it holds for a contact of "
                "that "
                "shape. Its U holds the tolerances of the weights, of local gravity and of the contact area; where one "
                "is not known there is no U."),
            rows("Slides", "slides",
                 {text("Surface", "material"), number("Vibration h", "h"), number("Vibration, absolute", "h_abs"),
                  number("Taxels, static", "v_static"), number("Taxels, dynamic", "v_dynamic"),
                  number("Force", "force_n", "N"), number("Sliding frames", "sliding_frames")},
                 Else::InTheTerminal),
            rows("Weights", "weights",
                 {number("Mass", "mass_g", "g"), text("Direction", "direction"), number("Repeat", "repeat"),
                  number("Weight", "reference_n", "N"), number("Read as", "force", "@force_unit")},
                 Else::InBoth),
            facts("At rest, nothing touched", "rest",
                  {number("Acceleration, 5 Hz to 1 kHz: mean square", "mean_square"), text("in the square of", "unit"),
                   number("Taxels' floor", "taxel_floor", "@taxel_unit"), text("Taxels' baselines", "taxel_baseline")},
                  Else::InTheTerminal),
            rows("Instruments", "instruments",
                 {text("Role", "role"), text("Instrument", "name"), text("Serial", "serial"),
                  as(As::YesNo, "Simulated", "simulated")},
                 Else::InBoth),
            sentences("Warnings", "warnings"), sentences("Warnings of the force", "force.warnings")}};
}

}  // namespace

Kinds sensorKinds() { return {sensorCalibration()}; }

}  // namespace tacto::describe
