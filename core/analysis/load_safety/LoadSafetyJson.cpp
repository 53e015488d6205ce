#include "core/analysis/load_safety/LoadSafetyJson.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/load_safety/LimitMatrix.h"
#include "core/analysis/load_safety/OutputDescription.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"
#include "core/results/ResultRecord.h"

namespace tacto {

using nlohmann::json;

namespace {

constexpr AcceptedText kAnyWords{.mayBeEmpty = true};
constexpr std::size_t kMaxEntries = 1'000'000;

/// Adapts a table to JSON that a protocol script passes between its steps.
template <class Record>
RecordFields<Record> scripted(RecordFields<Record> fields) {
    fields.takeNullAsMissing();
    fields.passOverUnknownKeys();
    return fields;
}

struct Member {
    const char* key;
    Reading LoadReading::*reading;
};
constexpr Member kMembers[] = {{"delivered", &LoadReading::delivered},
                               {"amplitude_v", &LoadReading::amplitude_v},
                               {"highest_v", &LoadReading::highest_v},
                               {"amplitude_ma", &LoadReading::amplitude_ma},
                               {"width_s", &LoadReading::width_s},
                               {"rate_hz", &LoadReading::rate_hz},
                               {"interval_s", &LoadReading::interval_s},
                               {"impedance_ohm", &LoadReading::impedance_ohm},
                               {"peak_v", &LoadReading::peak_v},
                               {"peak_ma", &LoadReading::peak_ma},
                               {"charge_uc", &LoadReading::charge_uc},
                               {"net_charge_uc", &LoadReading::net_charge_uc},
                               {"imbalance", &LoadReading::imbalance},
                               {"energy_mj", &LoadReading::energy_mj},
                               {"rms_train_ma", &LoadReading::rms_train_ma},
                               {"rms_1s_ma", &LoadReading::rms_1s_ma},
                               {"rms_5s_ma", &LoadReading::rms_5s_ma},
                               {"rms_5s_v", &LoadReading::rms_5s_v},
                               {"dc_ma", &LoadReading::dc_ma},
                               {"power_1s_w", &LoadReading::power_1s_w}};

RecordFields<LoadReading> buildReadingFields() {
    RecordFields<LoadReading> all;
    for (const auto& [key, reading] : kMembers) {
        const std::string name = key;
        all.number(name, in(reading, &Reading::value));
        all.number(name + "_u", in(reading, &Reading::u));
        all.number(name + "_expanded", in(reading, &Reading::expanded));
    }
    all.number("trains", &LoadReading::trains);
    all.flag("biphasic", &LoadReading::biphasic);
    all.flag("under_10_lsb", &LoadReading::underTenLsb);
    all.text("not_stated", &LoadReading::notStated, kAnyWords);
    all.list("warnings", &LoadReading::warnings, textKind(kAnyWords), 0, kMaxEntries);
    return scripted(std::move(all));
}

const RecordFields<LoadReading>& readingFields() { return builtOnce<buildReadingFields>(); }

/// The first fields, which all kinds of steps share.
template <class Step>
RecordFields<Step> stepFields() {
    RecordFields<Step> all;
    all.number("command_v", &Step::command_v);
    all.number("interval_s", &Step::interval_s);
    return scripted(std::move(all));
}

RecordFields<LoadStep> loadStepFields() {
    auto all = stepFields<LoadStep>();
    all.record("reading", &LoadStep::reading, readingFields());
    return all;
}

RecordFields<LoadRecord> buildRecordFields() {
    using R = LoadRecord;
    auto refused = stepFields<RefusedStep>();
    refused.flag("forbidden", &RefusedStep::forbidden);
    refused.flag("refused", &RefusedStep::refused);
    refused.texts(
        {{"predicted", &RefusedStep::predicted}, {"reason", &RefusedStep::reason}, {"what", &RefusedStep::what}},
        kAnyWords);
    auto undriven = stepFields<UndrivenStep>();
    undriven.text("reason", &UndrivenStep::reason, kAnyWords);

    RecordFields<R> all;
    all.texts(
        {{"name", &R::name}, {"serial", &R::serial}, {"not_applicable", &R::notApplicable}, {"problem", &R::problem}},
        kAnyWords);
    all.number("dmm_ohm", in(&R::dmm_ohm, &Reading::value));
    all.number("dmm_u_ohm", in(&R::dmm_ohm, &Reading::u));
    all.list("steps", &R::steps, loadStepFields().kind(), 0, kMaxEntries);
    all.list("refusals", &R::refusals, refused.kind(), 0, kMaxEntries);
    all.list("undriven", &R::undriven, undriven.kind(), 0, kMaxEntries);
    return scripted(std::move(all));
}

RecordFields<TripTrial> buildTripFields() {
    RecordFields<TripTrial> all;
    all.text("name", &TripTrial::name, kAnyWords);
    all.flag("evaluated", &TripTrial::evaluated);
    all.flag("tripped", &TripTrial::tripped);
    all.number("after_s", &TripTrial::after_s);
    all.number("stop_s", &TripTrial::stop_s);
    all.number("allowed_s", &TripTrial::allowed_s);
    all.text("reason", &TripTrial::reason, kAnyWords);
    return scripted(std::move(all));
}

/// The error of the absolute reference.
struct AbsoluteError {
    double off_pct = kNaN, expanded_pct = kNaN, allowed_pct = kNaN;
    std::string text;
};

RecordFields<AbsoluteError> buildAbsoluteFields() {
    using E = AbsoluteError;
    RecordFields<E> all;
    all.number("deviation_pct", &E::off_pct);
    all.number("expanded_uncertainty_pct", &E::expanded_pct);
    all.number("allowed_pct", &E::allowed_pct);
    all.text("text", &E::text, kAnyWords);
    return scripted(std::move(all));
}

using namespace describe;

/// A figure of the strongest step on a load that is shown in tables.
struct ShownReading {
    const char* title;
    const char* unit;
    Reading LoadReading::*reading;
    bool keepsStandard = false;  ///< true if u is shown in addition to U
};
constexpr ShownReading kShownReadings[] = {{"Peak voltage", "V", &LoadReading::peak_v, true},
                                           {"Peak current", "mA", &LoadReading::peak_ma, true},
                                           {"RMS current in the train", "mA", &LoadReading::rms_train_ma},
                                           {"RMS current over 1 s", "mA", &LoadReading::rms_1s_ma},
                                           {"RMS current over 5 s", "mA", &LoadReading::rms_5s_ma, true},
                                           {"Charge of a phase", "uC", &LoadReading::charge_uc},
                                           {"Net charge of a pulse", "uC", &LoadReading::net_charge_uc},
                                           {"Energy of a pulse", "mJ", &LoadReading::energy_mj}};

std::string keyOf(Reading LoadReading::*reading) { return std::ranges::find(kMembers, reading, &Member::reading)->key; }

ResultRecord<LoadLine> describeLoad() {
    using L = LoadLine;
    ResultRecord<L> all;
    all.shown(as(As::Load, "Load", "name"), &L::name);
    all.kept("serial", nullIfEmpty(&L::serial));
    all.shown(number("Nominal |Z|", "nominal_ohm", "ohm"), &L::nominal_ohm);
    all.shown(number("|Z| at the end of the leading phase", "measured_ohm", "ohm", "measured_expanded_ohm"),
              in(&L::measured_ohm, &Reading::value));
    all.kept("measured_u_ohm", in(&L::measured_ohm, &Reading::u));
    all.kept("measured_expanded_ohm", in(&L::measured_ohm, &Reading::expanded));
    for (const auto& each : kShownReadings) {
        const std::string key = keyOf(each.reading), expanded = key + "_expanded";
        const auto strongest = in(&L::strongest, each.reading);
        all.shown({each.title, key, As::Number, each.unit, expanded}, in(strongest, &Reading::value));
        if (each.keepsStandard) all.kept(key + "_u", in(strongest, &Reading::u));
        all.kept(expanded, in(strongest, &Reading::expanded));
    }
    all.kept("imbalance", in(in(&L::strongest, &LoadReading::imbalance), &Reading::value));
    all.shown(number("Current density", "current_density_ma_cm2", "mA/cm2"), &L::currentDensity_ma_cm2);
    all.shown(number("Power density over 1 s", "power_density_w_cm2", "W/cm2"), &L::powerDensity_w_cm2);
    all.shown(number("Trains captured", "trains"), in(&L::strongest, &LoadReading::trains));
    all.shown(verdict(), &L::verdict);
    all.kept("commands_delivered", &L::steps);
    all.kept("commands_refused", &L::refused);
    return all;
}

ResultRecord<SafetyRow> describeRow() {
    using R = SafetyRow;
    ResultRecord<R> all;
    all.shown(verdict(), &R::verdict);
    all.shown(as(As::Load, "Load", "load"), &R::load);
    all.kept("item", &R::item);
    all.shown(text("What", "title"), &R::title);
    all.shown(number("Value", "value", "@unit", "expanded_uncertainty"), &R::value);
    all.kept("expanded_uncertainty", &R::expanded);
    all.shown(number("Limit", "limit", "@unit"), &R::limit);
    all.kept("unit", &R::unit);
    all.shown(as(As::LimitSet, "Set by", "set"), &R::set);
    all.kept("source", &R::source);
    all.shown(text("Reason", "reason"), &R::reason);
    all.kept("basis", &R::basis);
    all.kept("note", &R::note);
    return all;
}

ResultRecord<DisclosedOutput> describeDisclosed() {
    using D = DisclosedOutput;
    ResultRecord<D> all;
    all.shown(as(As::Heading, "Output", "output"), &D::output);
    all.shown(as(As::Load, "Load", "load"), &D::load);
    all.shown(number("Value", "value", "@unit", "expanded_uncertainty"), &D::value);
    all.kept("expanded_uncertainty", &D::expanded);
    all.shown(tolerance("±", "plus_minus_pct", "%"), &D::expanded_pct);
    all.kept("unit", &D::unit);
    all.shown(text("Reason", "reason"), &D::reason);
    return all;
}

ResultRecord<LoadWorstCase> describeWorstCase() {
    using W = LoadWorstCase;
    ResultRecord<W> all;
    all.kept("load_low_ohm", &W::low_ohm);
    all.kept("load_high_ohm", &W::high_ohm);
    all.kept("amplitude_factor", in(&W::amplitudeFactor, &Reading::value));
    all.kept("amplitude_factor_expanded", in(&W::amplitudeFactor, &Reading::expanded));
    all.kept("rows", &W::rows, describeRow());
    all.kept("verdict", &W::verdict);
    return all;
}

/// The description also covers the limit matrix and output description, which the steps of the protocol add.
ResultRecord<LoadSafety> describeLoadSafety() {
    using S = LoadSafety;
    const auto load = describeLoad();
    const auto row = describeRow();
    ResultRecord<S> all;
    all.table({.title = "Limits against loads, closest to a limit first",
               .at = "matrix",
               .shape = Shape::Limits,
               .shown = Else::InTheWindow});
    all.table(
        rows("Loads", "loads",
             {load.column("verdict", "Verdict"), load.column("name", "Load"), load.column("measured_ohm", "Measured"),
              load.column("peak_v", "Peak voltage"), load.column("peak_ma", "Peak current"),
              load.column("rms_5s_ma", "RMS over 5 s"), load.column("net_charge_uc", "Net charge"),
              number("Given", "commands_delivered"), number("Refused", "commands_refused")},
             Else::InTheReport));
    all.kept("loads", &S::loads, load);
    all.table(noted(across("Each load, and what was measured into it or computed from that, the strongest command that "
                           "the limits allow",
                           "loads", load.columns(), Else::OnlyInTheReport),
                    "What is over 1 s and 5 s is from the trains captured, repeated: no record is that long."));
    all.kept("rows", &S::rows, row);
    all.table(failing(rows("Rows that did not pass", "rows", row.columns(), Else::InTheReport)));
    all.kept("worst_case", &S::worstCase, describeWorstCase());
    all.table(failing(rows("Over all permitted loads, computed", "worst_case.rows", row.columns(), Else::InTheReport)));
    all.table(rows("Output, as the FDA guidance asks", "described", outputColumns(), Else::InTheTerminal));
    all.rows("Outputs to disclose", "disclosed", &S::disclosed, describeDisclosed());
    all.table(
        whose(rows("Commands that were refused", "rows",
                   {verdict(), row.column("load", "Load"), row.column("title", "Asked"), text("Would be", "source")},
                   Else::OnlyInTheReport),
              "set", "gate"));
    all.table(whose(rows("Faults that must switch the output off", "rows",
                         {verdict(), as(As::Heading, "What", "title"), number("Ended after", "value", "s"),
                          text("Remark", "note"), row.column("reason", "Reason")},
                         Else::OnlyInTheReport),
                    "set", "interlock"));
    all.table(noted(rows("Where each limit comes from, and our confidence in it", "matrix.lines", limitColumns(),
                         Else::OnlyInTheReport),
                    "Where no confidence stands the limit is our own."));
    all.judged();
    return all;
}

}  // namespace

json toJson(const LoadReading& reading) { return readingFields().write(reading); }

json toJson(const SafetyRow& row) { return builtOnce<describeRow>().write(row); }

json toJson(const LoadSafety& found) { return builtOnce<describeLoadSafety>().write(found); }

ResultTraits loadSafetyKind() {
    return {.kind = ResultKind::LoadSafety,
            .name = "load-safety",
            .decisionRule =
                "Each value passes when value + U keeps its limit, fails when value − U does not, and is "
                "indeterminate between. Values that were not measured are not evaluated and prevent a pass.",
            .guardBanded = true,
            .procedure = "safety check",
            .members = builtOnce<describeLoadSafety>().keys(),
            .tables = withBasis(builtOnce<describeLoadSafety>().tables())};
}

Result<LoadStep> loadStepFrom(const json& from) {
    return builtOnce<loadStepFields>().read(from, {.path = "step"}).map_error(asInvalidArgument);
}

Result<LoadRecord> loadRecordFrom(const json& from) {
    auto out = builtOnce<buildRecordFields>().read(from, {.path = "load"}).map_error(asInvalidArgument);
    if (!out) return out;
    const auto load = parseLoad(out->name);
    if (!load) return failure(load);
    out->load = *load;
    if (!(out->dmm_ohm.u > 0)) out->dmm_ohm.u = kNaN;  // no meter is exact, so zero means an unknown uncertainty
    out->dmm_ohm.expanded = 2 * out->dmm_ohm.u;
    return out;
}

Result<SafetyRow> absoluteRowFrom(const json& from) {
    auto error = builtOnce<buildAbsoluteFields>().read(from, {.path = "absolute"}).map_error(asInvalidArgument);
    if (!error) return failure(error);
    SafetyRow row;
    row.item = "absolute_reference";
    row.title = "absolute reference: error of the voltage";
    row.unit = "%";
    row.set = "laboratory";
    row.source = "science.md section 12";
    row.value = std::abs(error->off_pct);
    row.expanded = error->expanded_pct;
    row.limit = error->allowed_pct;
    row.verdict = judgeUpper(row.value, row.expanded, row.limit, false);
    if (row.verdict != RowVerdict::Pass) row.reason = "absolute reference: " + error->text;
    row.note = std::move(error->text);
    return row;
}

Result<TripTrial> tripTrialFrom(const json& from) {
    return builtOnce<buildTripFields>().read(from, {.path = "trip"}).map_error(asInvalidArgument);
}

}  // namespace tacto
