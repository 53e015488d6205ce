#include "core/analysis/load_safety/LoadSafetyJson.h"

#include <cmath>
#include <set>
#include <string_view>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"

namespace tacto {

using nlohmann::json;

namespace {

constexpr AcceptedText kAnyWords{.mayBeEmpty = true};
constexpr std::size_t kMaxEntries = 1'000'000;

/// A table of what a protocol script carries between its steps.
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

const RecordFields<LoadReading>& readingFields() {
    static const auto fields = buildReadingFields();
    return fields;
}

/// What every kind of step begins with.
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

/// How far the absolute reference was off.
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

json toJson(const LoadLine& line) {
    json out = {{"name", line.name},
                {"serial", line.serial.empty() ? json() : json(line.serial)},
                {"nominal_ohm", numberOrNull(line.nominal_ohm)},
                {"measured_ohm", numberOrNull(line.measured_ohm.value)},
                {"measured_u_ohm", numberOrNull(line.measured_ohm.u)},
                {"measured_expanded_ohm", numberOrNull(line.measured_ohm.expanded)},
                {"imbalance", numberOrNull(line.strongest.imbalance.value)},
                {"current_density_ma_cm2", numberOrNull(line.currentDensity_ma_cm2)},
                {"power_density_w_cm2", numberOrNull(line.powerDensity_w_cm2)},
                {"trains", line.strongest.trains},
                {"commands_delivered", line.steps},
                {"commands_refused", line.refused},
                {"verdict", nameOf(line.verdict)}};
    const std::set<std::string_view> withU{"peak_v", "peak_ma", "rms_5s_ma"};
    const std::set<std::string_view> shown{"rms_train_ma", "rms_1s_ma", "charge_uc", "net_charge_uc", "energy_mj"};
    for (const auto& [key, reading] : kMembers) {
        if (!withU.contains(key) && !shown.contains(key)) continue;
        const auto& most = line.strongest.*reading;
        const std::string name = key;
        out[name] = numberOrNull(most.value);
        if (withU.contains(key)) out[name + "_u"] = numberOrNull(most.u);
        out[name + "_expanded"] = numberOrNull(most.expanded);
    }
    return out;
}

}  // namespace

json toJson(const LoadReading& reading) { return readingFields().write(reading); }

json toJson(const SafetyRow& row) {
    return {{"load", row.load},
            {"item", row.item},
            {"title", row.title},
            {"value", numberOrNull(row.value)},
            {"expanded_uncertainty", numberOrNull(row.expanded)},
            {"limit", numberOrNull(row.limit)},
            {"unit", row.unit},
            {"set", row.set},
            {"source", row.source},
            {"verdict", nameOf(row.verdict)},
            {"reason", row.reason},
            {"basis", nameOf(row.basis)},
            {"note", row.note}};
}

json toJson(const LoadSafety& found) {
    json loads = json::array(), rows = json::array(), disclosed = json::array(), worst = json::array();
    for (const auto& line : found.loads) loads.push_back(toJson(line));
    for (const auto& row : found.rows) rows.push_back(toJson(row));
    for (const auto& row : found.worstCase.rows) worst.push_back(toJson(row));
    for (const auto& row : found.disclosed) {
        disclosed.push_back({{"output", row.output},
                             {"load", row.load},
                             {"value", numberOrNull(row.value)},
                             {"expanded_uncertainty", numberOrNull(row.expanded)},
                             {"plus_minus_pct", numberOrNull(row.expanded_pct)},
                             {"unit", row.unit},
                             {"reason", row.reason}});
    }
    return {{"loads", loads},
            {"worst_case",
             {{"load_low_ohm", found.worstCase.low_ohm},
              {"load_high_ohm", found.worstCase.high_ohm},
              {"amplitude_factor", numberOrNull(found.worstCase.amplitudeFactor.value)},
              {"amplitude_factor_expanded", numberOrNull(found.worstCase.amplitudeFactor.expanded)},
              {"rows", worst},
              {"verdict", nameOf(found.worstCase.verdict)}}},
            {"rows", rows},
            {"disclosed", disclosed},
            {"verdict", nameOf(found.verdict)},
            {"reasons", found.reasons}};
}

Result<LoadStep> loadStepFrom(const json& from) {
    static const auto fields = loadStepFields();
    return fields.read(from, {.path = "step"}).map_error(asInvalidArgument);
}

Result<LoadRecord> loadRecordFrom(const json& from) {
    static const auto fields = buildRecordFields();
    auto out = fields.read(from, {.path = "load"}).map_error(asInvalidArgument);
    if (!out) return out;
    const auto load = parseLoad(out->name);
    if (!load) return failure(load);
    out->load = *load;
    if (!(out->dmm_ohm.u > 0)) out->dmm_ohm.u = kNaN;  // no meter is exact: its uncertainty is not known
    out->dmm_ohm.expanded = 2 * out->dmm_ohm.u;
    return out;
}

Result<SafetyRow> absoluteRowFrom(const json& from) {
    static const auto fields = buildAbsoluteFields();
    auto error = fields.read(from, {.path = "absolute"}).map_error(asInvalidArgument);
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
    static const auto fields = buildTripFields();
    return fields.read(from, {.path = "trip"}).map_error(asInvalidArgument);
}

}  // namespace tacto
