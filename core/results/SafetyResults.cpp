// Results of a load-safety check. Reports have the limits as a matrix.
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

}  // namespace

ResultTraits loadSafety() {
    return {.kind = ResultKind::LoadSafety,
            .name = "load-safety",
            .decisionRule =
                "Each value passes when value + U keeps its limit, fails when value − U does not, and is indeterminate "
                "between. Values that were not measured are not evaluated and prevent a pass.",
            .guardBanded = true,
            .procedure = "safety check",
            .tables = withBasis(
                {rows("Loads", "loads",
                      {verdict(), as(As::Load, "Load", "name"),
                       number("Measured", "measured_ohm", "ohm", "measured_expanded_ohm"),
                       number("Peak voltage", "peak_v", "V", "peak_v_expanded"),
                       number("Peak current", "peak_ma", "mA", "peak_ma_expanded"),
                       number("RMS over 5 s", "rms_5s_ma", "mA", "rms_5s_ma_expanded"),
                       number("Net charge", "net_charge_uc", "uC", "net_charge_uc_expanded"),
                       number("Given", "commands_delivered"), number("Refused", "commands_refused")},
                      Else::InTheReport),
                 failing(rows("Rows that did not pass", "rows", judged(), Else::InTheReport)),
                 failing(rows("Over all permitted loads, computed", "worst_case.rows", judged(), Else::InTheReport)),
                 rows("Outputs to disclose", "disclosed",
                      {text("Output", "output"), as(As::Load, "Load", "load"),
                       number("Value", "value", "@unit", "expanded_uncertainty"), tolerance("±", "plus_minus_pct", "%"),
                       text("Reason", "reason")},
                      Else::InTheReport),
                 rows("Output, described", "described",
                      {text("Output", "output"), text("Commanded", "commanded"), text("Measured", "measured")},
                      Else::InBoth)})};
}

}  // namespace tacto::describe
