#include "app/gui/runner/ResultSchema.h"

#include <QCoreApplication>
#include <map>

#include "app/report/NumberText.h"
#include "core/encoding/CalibratedQuantity.h"
#include "core/session/ResultKind.h"

namespace tacto::gui {

namespace {

using As = RecordColumn::As;
using Shape = ResultTable::Shape;
using Columns = std::vector<RecordColumn>;
using Tables = std::vector<ResultTable>;

QString word(const char* text) { return QCoreApplication::translate("ResultSchema", text); }

RecordColumn text(const char* title, const char* at) { return {word(title), at, As::Text, {}, {}}; }
RecordColumn number(const char* title, const char* at, const char* unit = "", const char* uncertainty = "") {
    return {word(title), at, As::Number, QString::fromUtf8(unit), uncertainty};
}
RecordColumn spread(const char* title, const char* at, const char* unit) {
    return {word(title), at, As::Spread, QString::fromUtf8(unit), {}};
}
RecordColumn tolerance(const char* title, const char* at, const char* unit) {
    return {word(title), at, As::Tolerance, QString::fromUtf8(unit), {}};
}
RecordColumn as(As as, const char* title, const char* at) { return {word(title), at, as, {}, {}}; }
RecordColumn verdict() { return as(As::Verdict, "Verdict", "verdict"); }

ResultTable facts(const char* title, const char* at, Columns columns) {
    return {word(title), at, Shape::Facts, std::move(columns), {}};
}
ResultTable rows(const char* title, const char* at, Columns columns, const char* but = "") {
    return {word(title), at, Shape::Rows, std::move(columns), but};
}

/// What every run with an oscilloscope rests on.
Tables basis() {
    return {
        facts("Known reference", "reference",
              {number("Known load", "load_ohm", "ohm"), number("Read as", "measured_ohm", "ohm", "expanded_ohm"),
               number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
               number("Allowed, ±", "allowed_pct", "%"), verdict(), text("Reason", "reason")}),
        facts("Absolute reference", "absolute",
              {number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
               number("Allowed, ±", "allowed_pct", "%"), verdict(), text("It read", "text")}),
        rows("Instruments", "instruments",
             {text("Role", "role"), text("Instrument", "name"), text("Serial", "serial"), text("Channel", "channel"),
              tolerance("Gain, ±", "gain_pct", "%"), tolerance("Probe, ±", "probe_pct", "%"),
              tolerance("Time base, ±", "timebase_ppm", "ppm"), text("As stated by", "stated_by")}),
        {word("What it rests on"), "rests_on", Shape::Sentences, {}, {}}};
}

Tables operator+(Tables first, Tables second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

Columns conditionColumns() {
    return {text("Condition", "name"),
            number("n", "n"),
            number("Amplitude, mean and s.d.", "amplitude_v", "V"),
            number("Interval, mean and s.d.", "interval_s", "s"),
            as(As::Share, "Variation of amplitude", "amplitude_variation"),
            as(As::Share, "Variation of interval", "interval_variation"),
            number("Not measured", "not_measured")};
}

Columns pairColumns() {
    return {text("Condition", "a"), text("Against", "b"), number("Amplitude (JND)", "amplitude_jnd"),
            number("Interval (JND)", "interval_jnd"), number("Mahalanobis distance", "mahalanobis")};
}

Tables separability() {
    return Tables{facts("Recognition", "",
                        {as(As::Share, "Recognised", "accuracy"), number("Folds of the cross-validation", "folds"),
                         number("Instrument's floor, amplitude", "floor.amplitude_v", "V"),
                         number("Instrument's floor, interval", "floor.interval_s", "s")}),
                  rows("Conditions", "conditions", conditionColumns()),
                  rows("Pairs", "pairs", pairColumns()),
                  {word("Presented and recognised"), "confusion", Shape::Confusion, {}, {}}} +
           basis();
}

Tables encodings() {
    return Tables{facts("Conclusion", "",
                        {text("Found", "conclusion"), text("Compared with", "default"),
                         number("Asymmetry (JND)", "asymmetry_jnd")}),
                  rows("Encodings", "encodings",
                       {text("Encoding", "name"), number("Smallest pair (JND)", "smallest_pair_jnd"),
                        number("Neighbours, smallest (JND)", "neighbours.min_jnd"),
                        number("Neighbours, mean (JND)", "neighbours.mean_jnd"),
                        number("A train, at most (JND)", "gradual_jnd"), as(As::Share, "Recognised", "accuracy"),
                        as(As::Verdict, "Separable", "separable")}),
                  rows("Against the default", "differences",
                       {text("Encoding", "encoding"), number("Smallest pair (JND)", "pair_jnd"),
                        number("Neighbours, smallest (JND)", "neighbours_min_jnd"),
                        number("Neighbours, mean (JND)", "neighbours_mean_jnd"),
                        number("A train, at most (JND)", "per_train_jnd")})} +
           basis();
}

Tables transitions() {
    return Tables{facts("Changes", "",
                        {number("Wanted for a train, at most (JND)", "changes.wanted_jnd"),
                         number("Complete within", "changes.complete_limit_s", "s"),
                         number("Latency's tolerance, ±", "latency.tolerance_s", "s"),
                         number("Largest change, gradual (JND)", "transitions.gradual.largest_jnd"),
                         number("Largest change, abrupt (JND)", "transitions.abrupt.largest_jnd")}),
                  rows("Changes, as captured", "changes.groups",
                       {verdict(), text("Change", "name"), number("n", "n"), number("Trains", "trains"),
                        number("Complete after", "complete_s", "s"),
                        number("Interval, largest (JND)", "interval_jnd", "", "interval_u_jnd"),
                        number("Amplitude, largest (JND)", "amplitude_jnd", "", "amplitude_u_jnd"),
                        number("Late", "late")}),
                  rows("Latency, against its design", "latency.groups",
                       {verdict(), text("Change", "name"), number("n", "n"), number("Latency", "latency_s", "s"),
                        number("Designed", "designed_latency_s", "s"), number("Difference", "difference_s", "s"),
                        number("Not measured", "not_measured")}),
                  {word("Notes"), "notes", Shape::Sentences, {}, {}}} +
           basis();
}

Tables variation() {
    return {facts("Participants", "",
                  {text("Found", "headline"), number("Virtual participants", "participants"),
                   number("Served", "complete"), as(As::Share, "Clearly separable", "clearly_separable_share"),
                   as(As::Share, "Recognised, median", "accuracy"),
                   as(As::Share, "Recognised, all together", "pooled_accuracy"),
                   number("Information, median", "information_bits", "bit"),
                   number("Felt from, median", "detection_ma", "mA"),
                   number("Uncomfortable from, median", "discomfort_ma", "mA"),
                   number("Impedance, median", "impedance_ohm", "ohm")}),
            rows("Conditions", "conditions",
                 {text("Condition", "name"), number("Presented", "presented"), number("Current", "current_ma", "mA"),
                  number("Voltage", "voltage_v", "V"), number("Draws attention", "draws_attention"),
                  number("Too strong", "too_strong"), number("Not felt", "not_felt"), number("Refused", "refused")}),
            {word("Presented and recognised"), "confusion", Shape::Confusion, {}, {}},
            rows("Pairs on the bench", "bench.pairs",
                 {text("Condition", "a"), text("Against", "b"), number("Amplitude (JND)", "amplitude_jnd"),
                  number("Interval (JND)", "interval_jnd")}),
            rows("Pilots of that many people", "pilots",
                 {number("People", "people"), number("Trials each", "trials"), number("Right from", "right_from"),
                  as(As::Share, "All above chance", "all_above_chance"), as(As::Share, "All served", "all_served"),
                  as(As::Share, "Width of the interval", "width")}),
            rows("Premises", "premises",
                 {text("Quantity", "quantity"), text("Value", "value"), text("Spread", "spread"),
                  text("Source", "source")})};
}

Columns loadColumns() {
    return {verdict(),
            as(As::Load, "Load", "name"),
            number("Measured", "measured_ohm", "ohm", "measured_expanded_ohm"),
            number("Peak voltage", "peak_v", "V", "peak_v_expanded"),
            number("Peak current", "peak_ma", "mA", "peak_ma_expanded"),
            number("RMS over 5 s", "rms_5s_ma", "mA", "rms_5s_ma_expanded"),
            number("Net charge", "net_charge_uc", "uC", "net_charge_uc_expanded"),
            number("Given", "commands_delivered"),
            number("Refused", "commands_refused")};
}

Tables loadSafety() {
    const auto judged = [] {
        return Columns{verdict(),
                       as(As::Load, "Load", "load"),
                       text("What", "title"),
                       number("Value", "value", "@unit", "expanded_uncertainty"),
                       number("Limit", "limit", "@unit"),
                       as(As::LimitSet, "Set by", "set"),
                       text("Reason", "reason")};
    };
    return Tables{rows("Loads", "loads", loadColumns()), rows("Rows that did not pass", "rows", judged(), "pass"),
                  rows("Over all permitted loads, computed", "worst_case.rows", judged()),
                  rows("Outputs to disclose", "disclosed",
                       {text("Output", "output"), as(As::Load, "Load", "load"),
                        number("Value", "value", "@unit", "expanded_uncertainty"), number("±", "plus_minus_pct", "%"),
                        text("Reason", "reason")}),
                  rows("Output, described", "described",
                       {text("Output", "output"), text("Commanded", "commanded"), text("Measured", "measured")})} +
           basis();
}

Tables stimulatorCalibration() {
    Tables all;
    for (const auto& one : kCalibratedQuantities)
        all.push_back({word(one.title.data()), one.id.data(), Shape::Calibration, {}, {}});
    all.push_back(
        rows("Check of the stored calibration", "check",
             {verdict(), text("Quantity", "quantity"), number("Commanded", "commanded", "@unit"),
              number("Expected", "expected", "@unit"), number("Measured", "measured", "@unit"),
              number("Off", "off", "@unit", "expanded_uncertainty"), number("Allowed, ±", "allowed", "@unit")}));
    all.push_back(facts("Stored", "stored",
                        {text("Stimulator", "serial"), text("Valid until", "valid_until"),
                         number("Readings", "readings"), as(As::YesNo, "Simulated", "simulated")}));
    return all + basis();
}

Tables sensorCalibration() {
    return {facts("Roughness", "",
                  {number("d′ of R, smooth against rough", "d_prime.R"), number("d′ of h", "d_prime.h"),
                   number("d′ of v", "d_prime.v"), number("Rank correlation of R and Ra", "spearman"),
                   text("Profile", "profile.name"), text("Known limit", "known_limit")}),
            facts("Known reference", "reference",
                  {number("Mass", "mass_g", "g"), number("Weight", "reference_n", "N"),
                   number("Read as", "measured", "@unit", "expanded_uncertainty"),
                   number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
                   number("Allowed, ±", "allowed_pct", "%"), verdict()}),
            rows("Surfaces", "surfaces",
                 {text("Surface", "name"), number("Ra", "ra_um", "um"), number("Rz", "rz_um", "um"),
                  number("R", "R", "", "R_expanded_uncertainty"), number("Vibration h", "h"), number("Taxels v", "v"),
                  number("Force", "force_n", "N"), number("Slides", "slides"), text("Ra and Rz are", "source")}),
            facts("Force", "force",
                  {number("Scale", "scale", "", "scale_expanded_uncertainty"),
                   number("Offset", "offset", "@unit", "offset_expanded_uncertainty"),
                   spread("Repeatability", "repeatability_pct_fs", "% FS"),
                   spread("Hysteresis", "hysteresis_pct_fs", "% FS"),
                   spread("Largest residual", "residual_max_pct_fs", "% FS"), number("Readings", "n"),
                   number("Standing out, marked and kept", "outliers"), text("Reason", "reason")}),
            rows("Force, weight by weight", "force.levels",
                 {number("Weight", "commanded", "N"), number("n", "n"), number("Mean", "mean", "N"),
                  number("Mean, going up", "mean_up", "N"), number("Mean, going down", "mean_down", "N"),
                  spread("s", "s", "N"), number("Residual", "residual", "N")}),
            rows("Taxels", "taxels",
                 {number("Taxel", "taxel"), number("Scale", "scale", "", "scale_expanded_uncertainty"),
                  number("Offset", "offset_pa", "Pa", "offset_expanded_uncertainty_pa"),
                  spread("Largest residual", "residual_max_pct_fs", "% FS"), text("Reason", "reason")}),
            rows("Slides", "slides",
                 {text("Surface", "material"), number("Vibration h", "h"), number("Vibration, absolute", "h_abs"),
                  number("Taxels, static", "v_static"), number("Taxels, dynamic", "v_dynamic"),
                  number("Force", "force_n", "N"), number("Sliding frames", "sliding_frames")}),
            rows("Weights", "weights",
                 {number("Mass", "mass_g", "g"), text("Direction", "direction"), number("Repeat", "repeat"),
                  number("Weight", "reference_n", "N"), number("Read as", "force", "@force_unit")}),
            rows("Instruments", "instruments",
                 {text("Role", "role"), text("Instrument", "name"), text("Serial", "serial"),
                  as(As::YesNo, "Simulated", "simulated")}),
            {word("Warnings"), "force.warnings", Shape::Sentences, {}, {}}};
}

Tables deliveries(const char* title, const char* delivered) {
    return {facts("Delivered", "",
                  {number("Duration", "duration_s", "s"), number(title, delivered),
                   number("Trains refused", "trains_refused"), number("Trains skipped", "trains_skipped"),
                   number("Samples lost", "samples_lost"), number("Gaps in the recording", "gaps")})};
}

std::map<ResultKind, Tables> buildSchemas() {
    using enum ResultKind;
    return {{Separability, separability()},
            {EncodingComparison, encodings()},
            {Transitions, transitions()},
            {Variation, variation()},
            {LoadSafety, loadSafety()},
            {StimulatorCalibration, stimulatorCalibration()},
            {SensorCalibration, sensorCalibration()},
            {Live, deliveries("Trains delivered", "trains_delivered")},
            {Massager, deliveries("Bursts delivered", "bursts_delivered")}};
}

bool isCell(const nlohmann::json& value) {
    return value.is_primitive() || (value.is_object() && (value.contains("mean") || value.contains("value")));
}

/// A column for a member that no schema knows.
RecordColumn guessed(const std::string& key, const nlohmann::json& value) {
    const auto name = columnName(QString::fromStdString(key));
    const bool counts = value.is_number() || value.is_object();
    const auto kind = key == "verdict" ? As::Verdict : counts ? As::Number : As::Text;
    return {name.title, key, kind, name.unit, {}};
}

Columns columnsIn(const nlohmann::json& records) {
    Columns columns;
    for (const auto& record : records) {
        for (const auto& [key, value] : record.items()) {
            const bool has = std::any_of(columns.begin(), columns.end(),
                                         [&wanted = key](const RecordColumn& column) { return column.at == wanted; });
            if (!has && isCell(value)) columns.push_back(guessed(key, value));
        }
    }
    // A JSON object forgets the order: what names a record comes first.
    static const std::vector<std::string> first{"name", "condition", "load", "a", "b", "n"};
    std::stable_sort(columns.begin(), columns.end(), [](const RecordColumn& one, const RecordColumn& other) {
        const auto rank = [](const RecordColumn& c) { return std::find(first.begin(), first.end(), c.at); };
        return rank(one) < rank(other);
    });
    return columns;
}

}  // namespace

const Tables& tablesOf(std::string_view kind) {
    static const auto schemas = buildSchemas();
    static const Tables none;
    const auto at = schemas.find(resultTraits(kind).kind);
    return at == schemas.end() ? none : at->second;
}

Tables tablesIn(const nlohmann::json& results) {
    Tables tables;
    Columns single;
    for (const auto& [key, value] : results.items()) {
        if (key == "verdict" || key == "kind" || key == "reasons" || key == "trials") continue;
        const auto title = columnName(QString::fromStdString(key)).title;
        const bool records = value.is_array() && !value.empty() &&
                             std::all_of(value.begin(), value.end(), [](const auto& row) { return row.is_object(); });
        const bool texts = value.is_array() && !value.empty() &&
                           std::all_of(value.begin(), value.end(), [](const auto& row) { return row.is_string(); });
        if (isCell(value))
            single.push_back(guessed(key, value));
        else if (records)
            tables.push_back({title, key, Shape::Rows, columnsIn(value), {}});
        else if (texts)
            tables.push_back({title, key, Shape::Sentences, {}, {}});
    }
    if (!single.empty()) tables.insert(tables.begin(), {word("Found"), {}, Shape::Facts, std::move(single), {}});
    return tables;
}

}  // namespace tacto::gui
