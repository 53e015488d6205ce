// What a protocol leaves behind: trials, measurements, events, and the report.
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/base/QuantityText.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<Json> trial(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.trial", list);
    auto condition = arguments.text(0, "condition");
    if (!condition) return failure(condition);
    auto measured = arguments.object(1, "measured");
    if (!measured) return failure(measured);
    auto number = session.addTrial(*condition, **measured);
    if (!number) return failure(number);
    return Json(*number);
}

Result<Json> trials(ScriptSession& session, const Json&) { return Json(session.trials()); }

Result<Json> measurement(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.measurement", list);
    auto name = arguments.text(0, "name");
    if (!name) return failure(name);
    auto values = arguments.object(1, "values");
    if (!values) return failure(values);
    // These names hold what the program found, not what a script says (hazard H9).
    if (*name == kExposureMeasurement || *name == kCalibrationMeasurement)
        return arguments.wrong("name", *name, "a name that the program does not use itself");
    if (session.writer() == nullptr) return Json();
    auto written = session.writer()->measurement(session.now(), *name, **values);
    if (!written) return failure(written);
    return Json();
}

Result<Json> event(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.event", list);
    auto kind = arguments.text(0, "kind");
    if (!kind) return failure(kind);
    if (session.writer() == nullptr) return Json();
    // No event of the program begins like this: "script abandoned" is one of its own (hazard H9).
    auto written = session.writer()->event(session.now(), "script: " + *kind, arguments.at(1));
    if (!written) return failure(written);
    return Json();
}

Result<Json> writeItem(ScriptSession& session, const Json& item) {
    if (session.writer() == nullptr) return Json();
    auto written = session.writer()->reportItem(session.now(), item);
    if (!written) return failure(written);
    return Json();
}

Result<Json> figure(ScriptSession& session, const Json& list) {
    const Arguments arguments("report.figure", list);
    auto caption = arguments.text(0, "caption");
    if (!caption) return failure(caption);
    auto figure = arguments.object(1, "figure");
    if (!figure) return failure(figure);
    if (!(*figure)->contains("type")) return arguments.wrong("figure", **figure, "what a plot function returned");
    return writeItem(session, {{"kind", "figure"}, {"caption", *caption}, {"figure", **figure}});
}

Result<Json> table(ScriptSession& session, const Json& list) {
    const Arguments arguments("report.table", list);
    auto caption = arguments.text(0, "caption");
    if (!caption) return failure(caption);
    auto rows = arguments.list(1, "rows");
    if (!rows) return failure(rows);
    for (const auto& row : **rows) {
        if (!row.is_object()) return arguments.wrong("a row", row, "an object whose members are the columns");
    }
    Json item = {{"kind", "table"}, {"caption", *caption}, {"rows", **rows}};
    const Json& columns = arguments.at(2);
    if (columns.is_array()) {
        item["columns"] = columns;
    } else if (!columns.is_null()) {
        return arguments.wrong("columns", columns, "a list of column names");
    }
    return writeItem(session, item);
}

Result<Json> matrix(ScriptSession& session, const Json& list) {
    const Arguments arguments("report.matrix", list);
    auto caption = arguments.text(0, "caption");
    if (!caption) return failure(caption);
    auto columns = arguments.list(1, "columns");
    if (!columns) return failure(columns);
    auto rows = arguments.list(2, "rows");
    if (!rows) return failure(rows);
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("cells", Json()).is_array())
            return arguments.wrong("a row", row, "an object with a title and a list of cells");
    }
    return writeItem(session, {{"kind", "matrix"}, {"caption", *caption}, {"columns", **columns}, {"rows", **rows}});
}

/// null is not known.
Result<double> numberOrNaN(const Arguments& arguments, int at, std::string_view name) {
    const Json& value = arguments.at(static_cast<std::size_t>(at));
    if (value.is_null()) return std::nan("");
    if (value.is_number()) return value.get<double>();
    return arguments.wrong(name, value, "a number or null");
}

Result<Json> quantity(ScriptSession&, const Json& list) {
    const Arguments arguments("report.quantity", list);
    auto value = numberOrNaN(arguments, 0, "value");
    if (!value) return failure(value);
    auto unit = arguments.text(1, "unit");
    if (!unit) return failure(unit);
    if (list.size() < 3) return Json(scaledText(*value, *unit));
    auto expanded = numberOrNaN(arguments, 2, "expanded");
    if (!expanded) return failure(expanded);
    return Json(measuredText(*value, *expanded, *unit));
}

Result<Json> rounded(ScriptSession&, const Json& list) {
    const Arguments arguments("report.rounded", list);
    auto value = numberOrNaN(arguments, 0, "value");
    if (!value) return failure(value);
    auto unit = arguments.text(1, "unit");
    if (!unit) return failure(unit);
    auto digits = arguments.number(2, "digits", {1, 15, true});
    if (!digits) return failure(digits);
    return Json(scaledText(*value, *unit, static_cast<int>(*digits)));
}

Result<Json> text(ScriptSession& session, const Json& list) {
    auto paragraph = Arguments("report.text", list).text(0, "text");
    if (!paragraph) return failure(paragraph);
    return writeItem(session, {{"kind", "text"}, {"text", *paragraph}});
}

}  // namespace

std::vector<HostFunction> recordFunctions() {
    constexpr std::string_view kDisk = "Throws when the session file cannot be written.";
    return {
        {"record",
         "trial",
         HostKind::Function,
         {{"condition", "text", "", "name of the condition presented"},
          {"measured", "object", "", "from measure.train(), or any values with their units in the names"}},
         "Records a trial and the captures it was measured on.",
         "The trial's number, from 1.",
         kDisk,
         trial},
        {"record",
         "trials",
         HostKind::Function,
         {},
         "Every trial recorded so far.",
         "List of { condition, trial, and what was measured }.",
         "",
         trials},
        {"record",
         "measurement",
         HostKind::Function,
         {{"name", "text", "", "what was measured"}, {"values", "object", "", "values with their units in the names"}},
         "Records a measured or calibrated value.",
         "",
         kDisk,
         measurement},
        {"record",
         "event",
         HostKind::Function,
         {{"kind", "text", "", "what happened, in a word or two"},
          {"details", "object", "", "anything worth keeping", true}},
         "Records that something happened, as the event \"script: KIND\".",
         "",
         kDisk,
         event},
        {"report",
         "figure",
         HostKind::Function,
         {{"caption", "text", "", "title of the figure"}, {"figure", "figure", "", "from a plot function"}},
         "Adds a figure to the report.",
         "",
         kDisk,
         figure},
        {"report",
         "table",
         HostKind::Function,
         {{"caption", "text", "", "title of the table"},
          {"rows", "list", "",
           "objects; their members are the columns and carry the unit; a member may be { value, expanded, unit }"},
          {"columns", "list", "", "names and order of the columns; as in the rows where left out", true}},
         "Adds a table to the report.",
         "",
         kDisk,
         table},
        {"report",
         "matrix",
         HostKind::Function,
         {{"caption", "text", "", "title of the matrix"},
          {"columns", "list", "", "names, of loads or conditions"},
          {"rows", "list", "",
           "{ title, note, unit, limit, compare, set, cells }; a cell per column: null, or { value, "
           "expanded_uncertainty, margin_pct, verdict, text }, as in the lines of analysis.loadSafety()'s matrix"}},
         "Adds rows against columns to the report: limits or quantities against loads.",
         "",
         kDisk,
         matrix},
        {"report",
         "quantity",
         HostKind::Function,
         {{"value", "number", "", "null where it is not known"},
          {"unit", "text", "", "\"s\", \"mA\", \"ohm\", \"%\"; may be empty"},
          {"expanded", "number", "", "its expanded uncertainty U; null where that is not known", true}},
         "Writes a number as reports do: a scaled unit, U with two digits and the value to the same place.",
         "A text: \"40.12 ± 0.46 V\", \"16.8 µs\".",
         "",
         quantity},
        {"report",
         "rounded",
         HostKind::Function,
         {{"value", "number", "", "null where it is not known"},
          {"unit", "text", "", "as for quantity(); may be empty"},
          {"digits", "number", "", "significant digits, 1 to 15"}},
         "Writes a number that has no U with so many digits, in a scaled unit.",
         "A text: \"0.26 %\".",
         "",
         rounded},
        {"report",
         "text",
         HostKind::Function,
         {{"text", "text", "", "a paragraph"}},
         "Adds a paragraph to the report.",
         "",
         kDisk,
         text},
    };
}

}  // namespace tacto
