#include "core/analysis/LoadSafetyJson.h"

#include <cmath>

#include "core/analysis/ResultJson.h"

namespace tacto {

using nlohmann::json;

namespace {

struct Member {
    const char* key;
    Reading LoadReading::*reading;
};
constexpr Member kMembers[] = {{"delivered", &LoadReading::delivered},
                               {"amplitude_v", &LoadReading::amplitude_v},
                               {"highest_v", &LoadReading::highest_v},
                               {"amplitude_ma", &LoadReading::amplitude_ma},
                               {"width_s", &LoadReading::width_s},
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

/// Null and absent are NaN; anything else that is no number is an error.
Result<double> numberAt(const json& object, const std::string& key) {
    const auto at = object.find(key);
    if (at == object.end() || at->is_null()) return std::nan("");
    if (at->is_number()) return at->get<double>();
    return fail(ErrorCode::InvalidArgument, "{} is {}; a number or null is expected", key, at->dump());
}

Result<std::string> textAt(const json& object, const char* key) {
    const auto at = object.find(key);
    if (at == object.end() || at->is_null()) return std::string();
    if (at->is_string()) return at->get<std::string>();
    return fail(ErrorCode::InvalidArgument, "{} is {}; a text is expected", key, at->dump());
}

Result<bool> flagAt(const json& object, const char* key) {
    const auto at = object.find(key);
    if (at == object.end() || at->is_null()) return false;
    if (at->is_boolean()) return at->get<bool>();
    return fail(ErrorCode::InvalidArgument, "{} is {}; true or false is expected", key, at->dump());
}

/// The elements of a list member; none where it is absent.
Result<std::vector<json>> listAt(const json& object, const char* key) {
    const auto at = object.find(key);
    if (at == object.end() || at->is_null()) return std::vector<json>{};
    if (!at->is_array()) return fail(ErrorCode::InvalidArgument, "{} is {}; a list is expected", key, at->dump());
    for (const auto& item : *at) {
        if (!item.is_object())
            return fail(ErrorCode::InvalidArgument, "{} holds {}; objects are expected", key, item.dump());
    }
    return at->get<std::vector<json>>();
}

/// What every kind of step begins with.
template <class Step>
Result<void> readCommand(const json& from, Step& step) {
    for (const auto& [key, into] :
         {std::pair("command_v", &step.command_v), std::pair("interval_s", &step.interval_s)}) {
        const auto value = numberAt(from, key);
        if (!value) return failure(value);
        *into = *value;
    }
    return {};
}

template <class Step>
Result<void> readTexts(const json& from, std::initializer_list<std::pair<const char*, std::string Step::*>> texts,
                       Step& step) {
    for (const auto& [key, member] : texts) {
        auto text = textAt(from, key);
        if (!text) return failure(text);
        step.*member = std::move(*text);
    }
    return {};
}

}  // namespace

Result<LoadStep> loadStepFrom(const json& from) {
    LoadStep step;
    if (auto read = readCommand(from, step); !read) return failure(read);
    auto reading = loadReadingFrom(from.value("reading", json::object()));
    if (!reading) return failure(reading);
    step.reading = std::move(*reading);
    return step;
}

namespace {

Result<RefusedStep> refusalFrom(const json& from) {
    RefusedStep step;
    if (auto read = readCommand(from, step); !read) return failure(read);
    for (const auto& [key, into] : {std::pair("forbidden", &step.forbidden), std::pair("refused", &step.refused)}) {
        const auto flag = flagAt(from, key);
        if (!flag) return failure(flag);
        *into = *flag;
    }
    if (auto read = readTexts<RefusedStep>(
            from,
            {{"predicted", &RefusedStep::predicted}, {"reason", &RefusedStep::reason}, {"what", &RefusedStep::what}},
            step);
        !read) {
        return failure(read);
    }
    return step;
}

Result<UndrivenStep> undrivenFrom(const json& from) {
    UndrivenStep step;
    if (auto read = readCommand(from, step); !read) return failure(read);
    if (auto read = readTexts<UndrivenStep>(from, {{"reason", &UndrivenStep::reason}}, step); !read)
        return failure(read);
    return step;
}

json toJson(const LoadLine& line) {
    const auto& most = line.strongest;
    return {{"name", line.name},
            {"serial", line.serial.empty() ? json() : json(line.serial)},
            {"nominal_ohm", numberOrNull(line.nominal_ohm)},
            {"measured_ohm", numberOrNull(line.measured_ohm.value)},
            {"measured_u_ohm", numberOrNull(line.measured_ohm.u)},
            {"measured_expanded_ohm", numberOrNull(line.measured_ohm.expanded)},
            {"peak_v", numberOrNull(most.peak_v.value)},
            {"peak_v_u", numberOrNull(most.peak_v.u)},
            {"peak_v_expanded", numberOrNull(most.peak_v.expanded)},
            {"peak_ma", numberOrNull(most.peak_ma.value)},
            {"peak_ma_u", numberOrNull(most.peak_ma.u)},
            {"peak_ma_expanded", numberOrNull(most.peak_ma.expanded)},
            {"rms_train_ma", numberOrNull(most.rms_train_ma.value)},
            {"rms_train_ma_expanded", numberOrNull(most.rms_train_ma.expanded)},
            {"rms_1s_ma", numberOrNull(most.rms_1s_ma.value)},
            {"rms_1s_ma_expanded", numberOrNull(most.rms_1s_ma.expanded)},
            {"rms_5s_ma", numberOrNull(most.rms_5s_ma.value)},
            {"rms_5s_ma_u", numberOrNull(most.rms_5s_ma.u)},
            {"rms_5s_ma_expanded", numberOrNull(most.rms_5s_ma.expanded)},
            {"charge_uc", numberOrNull(most.charge_uc.value)},
            {"charge_uc_expanded", numberOrNull(most.charge_uc.expanded)},
            {"net_charge_uc", numberOrNull(most.net_charge_uc.value)},
            {"net_charge_uc_expanded", numberOrNull(most.net_charge_uc.expanded)},
            {"imbalance", numberOrNull(most.imbalance.value)},
            {"energy_mj", numberOrNull(most.energy_mj.value)},
            {"energy_mj_expanded", numberOrNull(most.energy_mj.expanded)},
            {"current_density_ma_cm2", numberOrNull(line.currentDensity_ma_cm2)},
            {"power_density_w_cm2", numberOrNull(line.powerDensity_w_cm2)},
            {"trains", most.trains},
            {"commands_delivered", line.steps},
            {"commands_refused", line.refused},
            {"verdict", nameOf(line.verdict)}};
}

}  // namespace

json toJson(const LoadReading& reading) {
    json out = {{"trains", reading.trains},
                {"biphasic", reading.biphasic},
                {"under_10_lsb", reading.underTenLsb},
                {"not_stated", reading.notStated},
                {"warnings", reading.warnings}};
    for (const auto& member : kMembers) {
        out[member.key] = numberOrNull((reading.*member.reading).value);
        out[std::string(member.key) + "_u"] = numberOrNull((reading.*member.reading).u);
        out[std::string(member.key) + "_expanded"] = numberOrNull((reading.*member.reading).expanded);
    }
    return out;
}

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

Result<LoadReading> loadReadingFrom(const json& from) {
    if (!from.is_object())
        return fail(ErrorCode::InvalidArgument, "a reading is {}; an object is expected", from.dump());
    LoadReading out;
    for (const auto& member : kMembers) {
        const auto value = numberAt(from, member.key);
        if (!value) return failure(value);
        const auto u = numberAt(from, std::string(member.key) + "_u");
        if (!u) return failure(u);
        const auto expanded = numberAt(from, std::string(member.key) + "_expanded");
        if (!expanded) return failure(expanded);
        out.*member.reading = {*value, *u, *expanded};
    }
    const auto trains = numberAt(from, "trains");
    if (!trains) return failure(trains);
    if (std::isfinite(*trains) && *trains >= 0) out.trains = static_cast<std::size_t>(std::min(*trains, 1e9));
    auto lacking = textAt(from, "not_stated");
    if (!lacking) return failure(lacking);
    out.notStated = std::move(*lacking);
    const auto under = flagAt(from, "under_10_lsb");
    if (!under) return failure(under);
    out.underTenLsb = *under;
    const auto warnings = from.value("warnings", json::array());
    for (const auto& warning : warnings) {
        if (warning.is_string()) out.warnings.push_back(warning.get<std::string>());
    }
    return out;
}

Result<LoadRecord> loadRecordFrom(const json& from) {
    if (!from.is_object()) return fail(ErrorCode::InvalidArgument, "a load is {}; an object is expected", from.dump());
    LoadRecord out;
    for (const auto& [key, into] :
         {std::pair("name", &out.name), std::pair("serial", &out.serial),
          std::pair("not_applicable", &out.notApplicable), std::pair("problem", &out.problem)}) {
        auto text = textAt(from, key);
        if (!text) return failure(text);
        *into = std::move(*text);
    }
    const auto load = parseLoad(out.name);
    if (!load) return failure(load);
    out.load = *load;
    const auto dmm = numberAt(from, "dmm_ohm");
    if (!dmm) return failure(dmm);
    const auto dmmU = numberAt(from, "dmm_u_ohm");
    if (!dmmU) return failure(dmmU);
    out.dmm_ohm = {*dmm, *dmmU, 2 * *dmmU};
    const auto steps = listAt(from, "steps");
    if (!steps) return failure(steps);
    for (const auto& item : *steps) {
        auto step = loadStepFrom(item);
        if (!step) return failure(step);
        out.steps.push_back(std::move(*step));
    }
    const auto refusals = listAt(from, "refusals");
    if (!refusals) return failure(refusals);
    for (const auto& item : *refusals) {
        auto refusal = refusalFrom(item);
        if (!refusal) return failure(refusal);
        out.refusals.push_back(std::move(*refusal));
    }
    const auto undriven = listAt(from, "undriven");
    if (!undriven) return failure(undriven);
    for (const auto& item : *undriven) {
        auto step = undrivenFrom(item);
        if (!step) return failure(step);
        out.undriven.push_back(std::move(*step));
    }
    return out;
}

Result<SafetyRow> absoluteRowFrom(const json& from) {
    if (!from.is_object()) {
        return fail(ErrorCode::InvalidArgument, "the absolute reference is {}; an object is expected", from.dump());
    }
    SafetyRow row;
    row.item = "absolute_reference";
    row.title = "absolute reference: error of the voltage";
    row.unit = "%";
    row.set = "laboratory";
    row.source = "science.md section 12";
    const auto off = numberAt(from, "deviation_pct"), expanded = numberAt(from, "expanded_uncertainty_pct");
    const auto allowed = numberAt(from, "allowed_pct");
    for (const auto* number : {&off, &expanded, &allowed}) {
        if (!*number) return failure(*number);
    }
    row.value = std::abs(*off);
    row.expanded = *expanded;
    row.limit = *allowed;
    row.verdict = judgeUpper(row.value, row.expanded, row.limit, false);
    auto text = textAt(from, "text");
    if (!text) return failure(text);
    if (row.verdict != RowVerdict::Pass) row.reason = "absolute reference: " + *text;
    row.note = std::move(*text);
    return row;
}

Result<TripTrial> tripTrialFrom(const json& from) {
    if (!from.is_object()) return fail(ErrorCode::InvalidArgument, "a trip is {}; an object is expected", from.dump());
    TripTrial out;
    auto name = textAt(from, "name");
    if (!name) return failure(name);
    const auto evaluated = flagAt(from, "evaluated");
    if (!evaluated) return failure(evaluated);
    const auto tripped = flagAt(from, "tripped");
    if (!tripped) return failure(tripped);
    const auto after = numberAt(from, "after_s");
    if (!after) return failure(after);
    auto reason = textAt(from, "reason");
    if (!reason) return failure(reason);
    return TripTrial{std::move(*name), *evaluated, *tripped, *after, std::move(*reason)};
}

}  // namespace tacto
