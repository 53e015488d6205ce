// The report items of a run: figures, tables, sentences and numbers.
#include <algorithm>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/plot/PlotFigures.h"
#include "app/scripting/host/report/Cells.h"
#include "app/scripting/host/report/CertificateItem.h"
#include "app/scripting/host/report/ReportObject.h"
#include "core/base/QuantityText.h"
#include "core/calibration/CalibrationTrend.h"
#include "core/devices/DeviceUri.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::report {

namespace {

Result<Json> writeItem(ScriptSession& session, const Json& item) {
    if (session.writer() == nullptr) return Json();
    return done(session.writer()->reportItem(session.now(), item));
}

/// Returns the correction that a stored calibration makes for one quantity.
Correction correctionOf(const Json& line) {
    CalibrationLine out;
    out.gain = numberOr(line, "gain");
    out.offset = numberOr(line, "offset");
    out.lowest = numberOr(line, "lowest");
    out.highest = numberOr(line, "highest");
    return validateNumbers(out, "the certificate") ? Correction(out) : Correction();
}

/// Returns the calibration that this run kept, or nothing.
std::optional<StoredCalibration> keptByThisRun(ScriptSession& session) {
    const auto& stimulator = *session.bench().devices().stimulator;
    const auto& device = stimulator.identity();
    const auto store = CalibrationStore::open(calibrationFile());
    const auto* kept =
        store ? store->latest(calibratedOutput(device.serial, device.uri), amplitudeUnit(stimulator.traits().drive))
              : nullptr;
    if (kept == nullptr || !session.own().noted({{"kept at", kept->sessionHead}})) return {};
    return *kept;
}

}  // namespace

Result<Json> figure(ScriptSession& session, const Arguments& arguments) {
    const auto caption = arguments.text("caption");
    const Json& figure = arguments.object("figure");
    if (!figure.contains("type")) return arguments.wrong("figure", figure, "what a plot function returned");
    return writeItem(session, {{"kind", "figure"}, {"caption", caption}, {"figure", figure}});
}

Result<Json> table(ScriptSession& session, const Arguments& arguments) {
    const auto caption = arguments.text("caption");
    const Json& rows = arguments.list("rows");
    Json item = {{"kind", "table"}, {"caption", caption}, {"rows", rows}};
    if (arguments.has("columns")) item["columns"] = arguments.list("columns");
    return writeItem(session, item);
}

Result<Json> matrix(ScriptSession& session, const Arguments& arguments) {
    const auto caption = arguments.text("caption");
    const Json& columns = arguments.list("columns");
    const Json& rows = arguments.list("rows");
    for (const auto& row : rows) {
        if (!row.value("cells", Json()).is_array())
            return arguments.wrong("a row", row, "an object with a title and a list of cells");
    }
    return writeItem(session, {{"kind", "matrix"}, {"caption", caption}, {"columns", columns}, {"rows", rows}});
}

Result<Json> calibration(ScriptSession& session, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    const auto caption = titleOfQuantity(textOr(found, "quantity")) + ": error, tolerance and the two sweep directions";
    return writeItem(session,
                     {{"kind", "figure"}, {"caption", caption}, {"figure", plot::calibrationFigure(found, "errors")}});
}

Result<Json> certificate(ScriptSession& session, const Arguments& arguments) {
    const Json& before = arguments.object("before");
    if (!session.own().noted(before)) return arguments.wrong("before", before, "bench.calibration, unchanged,");
    std::vector<const OwnCalibration*> all;
    for (const auto& found : arguments.list("found")) {
        const auto* own = session.own().calibration(found.value("calibration", Json()));
        if (own == nullptr)
            return arguments.wrong("found", found,
                                   "what bench.stimulatorCalibration.judge() made of this run's own readings");
        all.push_back(own);
    }
    if (session.writer() == nullptr) return Json();
    const auto kept = keptByThisRun(session);
    Json quantities = Json::array(), applied = Json::array();
    for (const auto* own : all) {
        if (own->calibrationApplied) applied.push_back(own->quantity);
        const auto* line = kept ? lineOf(*kept, own->quantity) : nullptr;
        const bool plain = !own->calibrationApplied;
        quantities.push_back(certifiedQuantity(own->found,
                                               plain ? correctionOf(before.value(own->quantity, Json())) : Correction(),
                                               plain && line != nullptr ? Correction(*line) : Correction()));
        quantities.back()["stated_by"] = own->statedBy;
    }
    Json item = {{"kind", "certificate"},
                 {"quantities", std::move(quantities)},
                 {"correction_in_readings", std::move(applied)},
                 {"before", {{"text", before.at("text")}, {"made", before.value("made", Json())}}},
                 {"kept", Json()}};
    if (kept) item["kept"] = {{"made", dateText(kept->made)}, {"valid_until", dateText(kept->validUntil)}};
    return writeItem(session, item);
}

Result<Json> quantity(ScriptSession&, const Arguments& arguments) {
    const double value = arguments.number("value");
    const auto unit = arguments.text("unit");
    if (arguments.all().size() < 3) return Json(scaledText(value, unit));
    return Json(measuredText(value, arguments.number("expanded"), unit));
}

Result<Json> rounded(ScriptSession&, const Arguments& arguments) {
    const double value = arguments.number("value");
    return Json(scaledText(value, arguments.text("unit"), arguments.whole("digits")));
}

Result<Json> text(ScriptSession& session, const Arguments& arguments) {
    return writeItem(session, {{"kind", "text"}, {"text", arguments.text("text")}});
}

}  // namespace tacto::host::report
