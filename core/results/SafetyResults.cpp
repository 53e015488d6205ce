// Results of a load-safety check.
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

Columns judged() {
    return {verdict(),
            as(As::Load, "Load", "load"),
            text("What", "title"),
            number("Value", "value", "@unit", "expanded_uncertainty"),
            number("Limit", "limit", "@unit"),
            as(As::LimitSet, "Set by", "set"),
            text("Reason", "reason")};
}

ResultTraits loadSafety() {
    return {
        .kind = ResultKind::LoadSafety,
        .name = "load-safety",
        .decisionRule =
            "Each value passes when value + U keeps its limit, fails when value − U does not, and is indeterminate "
            "between. Values that were not measured are not evaluated and prevent a pass.",
        .guardBanded = true,
        .procedure = "safety check",
        .tables = withBasis(
            {{.title = "Limits against loads, closest to a limit first",
              .at = "matrix",
              .shape = Shape::Limits,
              .shown = Else::InTheWindow},
             rows("Loads", "loads",
                  {verdict(), as(As::Load, "Load", "name"),
                   number("Measured", "measured_ohm", "ohm", "measured_expanded_ohm"),
                   number("Peak voltage", "peak_v", "V", "peak_v_expanded"),
                   number("Peak current", "peak_ma", "mA", "peak_ma_expanded"),
                   number("RMS over 5 s", "rms_5s_ma", "mA", "rms_5s_ma_expanded"),
                   number("Net charge", "net_charge_uc", "uC", "net_charge_uc_expanded"),
                   number("Given", "commands_delivered"), number("Refused", "commands_refused")},
                  Else::InTheReport),
             noted(
                 across("Each load, and what was measured into it or computed from that, the strongest command "
                        "that the limits allow",
                        "loads",
                        {as(As::Load, "Load", "name"), number("Nominal |Z|", "nominal_ohm", "ohm"),
                         number("|Z| at the end of the leading phase", "measured_ohm", "ohm", "measured_expanded_ohm"),
                         number("Peak voltage", "peak_v", "V", "peak_v_expanded"),
                         number("Peak current", "peak_ma", "mA", "peak_ma_expanded"),
                         number("RMS current in the train", "rms_train_ma", "mA", "rms_train_ma_expanded"),
                         number("RMS current over 1 s", "rms_1s_ma", "mA", "rms_1s_ma_expanded"),
                         number("RMS current over 5 s", "rms_5s_ma", "mA", "rms_5s_ma_expanded"),
                         number("Charge of a phase", "charge_uc", "uC", "charge_uc_expanded"),
                         number("Net charge of a pulse", "net_charge_uc", "uC", "net_charge_uc_expanded"),
                         number("Energy of a pulse", "energy_mj", "mJ", "energy_mj_expanded"),
                         number("Current density", "current_density_ma_cm2", "mA/cm2"),
                         number("Power density over 1 s", "power_density_w_cm2", "W/cm2"),
                         number("Trains captured", "trains"), verdict()},
                        Else::OnlyInTheReport),
                 "What is over 1 s and 5 s is from the trains captured, repeated: no record is that long."),
             failing(rows("Rows that did not pass", "rows", judged(), Else::InTheReport)),
             failing(rows("Over all permitted loads, computed", "worst_case.rows", judged(), Else::InTheReport)),
             rows("Output, as the FDA guidance asks", "described",
                  {as(As::Heading, "Output", "output"), text("Commanded", "commanded"), text("Measured", "measured")},
                  Else::InTheTerminal),
             rows("Outputs to disclose", "disclosed",
                  {as(As::Heading, "Output", "output"), as(As::Load, "Load", "load"),
                   number("Value", "value", "@unit", "expanded_uncertainty"), tolerance("±", "plus_minus_pct", "%"),
                   text("Reason", "reason")}),
             whose(rows("Asked for and refused", "rows",
                        {verdict(), as(As::Load, "Load", "load"), text("Asked", "title"), text("Would be", "source")},
                        Else::OnlyInTheReport),
                   "set", "gate"),
             whose(rows("What must end output by itself", "rows",
                        {verdict(), as(As::Heading, "What", "title"), number("Ended after", "value", "s"),
                         text("Remark", "note"), text("Reason", "reason")},
                        Else::OnlyInTheReport),
                   "set", "interlock"),
             noted(rows("Where each limit comes from, and our confidence in it", "matrix.lines",
                        {as(As::Heading, "Requirement", "title"),
                         {"Limit", "limit", As::Limit, "@unit", "compare"},
                         text("Source", "source"),
                         text("Confidence", "confidence")},
                        Else::OnlyInTheReport),
                   "Where no confidence stands the limit is our own.")})};
}

}  // namespace

Kinds safetyKinds() { return {loadSafety()}; }

}  // namespace tacto::describe
