// The object "report", with which a protocol writes its report: the functions for scripts, their arguments and results.
#include "app/scripting/host/report/ReportObject.h"

namespace tacto {

std::vector<HostFunction> reportFunctions() {
    using namespace takes;
    return {
        {.name = "figure",
         .parameters = {text("caption", "title of the figure"), object("figure", "from a plot function")},
         .text = "Adds a figure to the report.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::report::figure},
        {.name = "table",
         .parameters =
             {text("caption", "title of the table"),
              list("rows",
                   "their members are the columns and carry the unit; a member may be { value, expanded, unit }")
                  .of(ValueType::Object),
              list("columns", "names and order of the columns").optional("as in the rows")},
         .text = "Adds a table to the report.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::report::table},
        {.name = "matrix",
         .parameters = {text("caption", "title of the matrix"), list("columns", "names, of loads or conditions"),
                        list("rows",
                             "{ title, note, unit, limit, compare, set, cells }; a cell per column: null, or { value, "
                             "expanded_uncertainty, margin_pct, verdict, text }, as in the lines of "
                             "bench.loadSafety.judge()'s matrix")
                            .of(ValueType::Object)},
         .text = "Adds rows against columns to the report: limits or quantities against loads.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::report::matrix},
        {.name = "calibration",
         .parameters = {object("found", "from analysis.calibration()")},
         .text = "Adds a figure to the report: a calibration's errors against the tolerance.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::report::calibration},
        {.name = "certificate",
         .parameters =
             {list("found", "from bench.stimulatorCalibration.judge(), a quantity each").of(ValueType::Object),
              object("before", "bench.calibration, read before anything was kept")},
         .text = "Makes the report a calibration certificate, once a new calibration is kept or is not to be: what was "
                 "measured without a correction, as found with the one that was stored, as left with the one that this "
                 "run keeps. The last two are computed from the readings.",
         .errors = "Throws for a calibration of readings that this run did not take itself; when the session file "
                   "cannot be written.",
         .needs = Role::Stimulator,
         .call = host::report::certificate},
        {.name = "quantity",
         .parameters =
             {number("value", "", "null where it is not known").orNull(),
              text("unit", "\"s\", \"mA\", \"ohm\", \"%\"; may be empty").orEmpty(),
              number("expanded", "", "its expanded uncertainty U; null where that is not known").orNull().optional()},
         .text = "Writes a number as reports do: a scaled unit, U with two digits and the value to the same place.",
         .returns = "A text: \"40.12 ± 0.46 V\", \"16.8 µs\".",
         .call = host::report::quantity},
        {.name = "rounded",
         .parameters = {number("value", "", "null where it is not known").orNull(),
                        text("unit", "as for quantity(); may be empty").orEmpty(),
                        whole("digits", "significant digits").range(1, 15)},
         .text = "Writes a number that has no U with so many digits, in a scaled unit.",
         .returns = "A text: \"0.26 %\".",
         .call = host::report::rounded},
        {.name = "text",
         .parameters = {text("text", "a paragraph")},
         .text = "Adds a paragraph to the report.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::report::text},
    };
}

}  // namespace tacto
