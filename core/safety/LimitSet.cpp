#include "core/safety/LimitSet.h"

#include <algorithm>
#include <limits>

#include "core/base/RecordFields.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxRows = 1000;
constexpr AcceptedText kLimitText{.mostBytes = 2000}, kLimitNote{.mayBeEmpty = true, .mostBytes = 2000};
constexpr Word<JudgedAt> kJudged[] = {{"load_range", JudgedAt::LoadRange}, {"500_ohm", JudgedAt::Ohm500}};
constexpr Word<LimitAction> kActions[] = {
    {"refuse", LimitAction::Refuse}, {"warn", LimitAction::Warn}, {"disclose", LimitAction::Disclose}};
constexpr Word<bool> kStrict[] = {{"<=", false}, {"<", true}};

ValueKind<Quantity> quantityKind() {
    return codedKind<Quantity>(
        "a known quantity",
        [](const json& value) { return value.is_string() ? quantityOf(value.get<std::string>()) : std::nullopt; },
        [](const Quantity& quantity) { return json(keyOf(quantity)); });
}

/// A key that must repeat a property of the row's quantity, so that no value is read in another unit or window.
template <class Stated>
ValueKind<LimitRow> repeatedKind(Stated stated) {
    ValueKind<LimitRow> kind;
    kind.info.accepted = "that of the quantity";
    kind.reads(
        [stated](const json& value, LimitRow& row, const RecordPlace& place, std::string_view key) -> Result<void> {
            if (value == stated(row)) return {};
            return place.refuse(ErrorCode::ParseError, key, shownJson(value),
                                fmt::format("{} of {}", shownJson(stated(row)), keyOf(row.quantity)));
        });
    kind.writes(std::move(stated));
    return kind;
}

/// Adds the two keys that every value must have: its source, and our confidence in it.
template <class Row>
void addSource(RecordFields<Row>& row) {
    row.text("source", &Row::source, kLimitText).required = true;
    row.word("confidence", &Row::confidence, kConfidences).required = true;
}

RecordFields<LimitRow> limitFields() {
    RecordFields<LimitRow> row;
    row.add("quantity", &LimitRow::quantity, quantityKind()).required = true;
    row.number("max", &LimitRow::max, {.low = 0, .openLow = true}).required = true;
    const auto unit = [](const LimitRow& limit) { return json(unitOf(limit.quantity)); };
    row.add("unit", std::identity{}, repeatedKind(unit)).required = true;
    const auto window = [](const LimitRow& limit) { return json(windowOf(limit.quantity)); };
    row.add("window_s", std::identity{}, repeatedKind(window));
    row.word("compare", &LimitRow::strict, kStrict).required = true;
    row.word("judged", &LimitRow::judged, kJudged).required = true;
    row.word("action", &LimitRow::action, kActions).required = true;
    row.number("above_hz", &LimitRow::aboveHz, {.low = 0, .unit = "Hz"});
    row.number("up_to_hz", &LimitRow::upToHz, {.low = 0, .unit = "Hz"});
    addSource(row);
    row.text("note", &LimitRow::note, kLimitNote);
    row.rule([](const LimitRow& limit) -> Result<void> {
        if (limit.quantity != Quantity::CommandVoltage || limit.judged != JudgedAt::Ohm500) return {};
        return fail(ErrorCode::ParseError,
                    "command_voltage is judged at the nominal load; \"judged\": \"load_range\" is accepted");
    });
    row.rule([](const LimitRow& limit) -> Result<void> {
        if (limit.upToHz == 0 || limit.upToHz > limit.aboveHz) return {};
        return fail(ErrorCode::ParseError, "the frequency band {} to {} Hz is empty", limit.aboveHz, limit.upToHz);
    });
    return row;
}

Result<void> idIsPlain(const LimitSet& set) {
    const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.'; };
    if (set.id.size() <= 31 && std::ranges::all_of(set.id, plain) && set.id != "profile") return {};
    return fail(ErrorCode::ParseError,
                "the id \"{}\" is not accepted: up to 31 of a-z, 0-9, '-' and '.', and not \"profile\"", set.id);
}

RecordFields<LimitSet> buildLimitSetFields() {
    RecordFields<AccuracyRow> accuracy;
    accuracy.text("parameter", &AccuracyRow::parameter, kLimitText).required = true;
    accuracy.number("tolerance_pct", &AccuracyRow::tolerance_pct, {.low = 0, .unit = "%"});
    addSource(accuracy);
    RecordFields<DisclosureRow> disclosure;
    disclosure.text("output", &DisclosureRow::output, kLimitText).required = true;
    addSource(disclosure);

    RecordFields<LimitSet> set;
    set.text("id", &LimitSet::id, kLimitText).required = true;
    set.text("title", &LimitSet::title, kLimitText).required = true;
    set.note("about", kLimitNote);
    set.list("limits", &LimitSet::rows, limitFields().kind(), 1, kMaxRows).required = true;
    set.list("accuracy", &LimitSet::accuracy, accuracy.kind(), 0, kMaxRows);
    set.list("disclosures", &LimitSet::disclosures, disclosure.kind(), 0, kMaxRows);
    set.rule(idIsPlain);
    return set;
}

}  // namespace

std::string_view nameOf(JudgedAt judged) noexcept { return wordFor(kJudged, judged); }
std::string_view nameOf(LimitAction action) noexcept { return wordFor(kActions, action); }

Result<LimitSet> parseLimitSet(std::string_view text, std::string_view name) {
    return parseRecord(builtOnce<buildLimitSetFields>(), text, name);
}

std::string_view shortTitleOf(std::string_view id) noexcept {
    if (id == "fda-pms") return "FDA guidance";
    if (id == "iec-60601-2-10") return "IEC 60601-2-10";
    if (id == "paper") return "the paper";
    if (id == "gate") return "this program";  // a refusal by the program itself
    if (id == "interlock") return "the rules of arming";
    if (id == "laboratory") return "the laboratory";
    return id;
}

std::string_view titleOf(std::span<const LimitSet> sets, std::string_view id) noexcept {
    if (id == "profile") return "the encoding profile";
    for (const auto& set : sets) {
        if (set.id == id) return set.title;
    }
    return id;
}

namespace {
struct Entry {
    std::string_view key;
    std::string_view title;
    std::string_view unit;
    double window_s;
};
constexpr std::array<Entry, kQuantityCount> kEntries{{
    {"command_voltage", "commanded voltage", "V", 0},
    {"peak_voltage", "peak voltage", "V", 0},
    {"peak_current", "peak current", "mA", 0},
    {"phase_charge", "charge per phase", "uC", 0},
    {"net_charge", "net charge per pulse", "uC", 0},
    {"pulse_energy", "energy per pulse", "mJ", 0},
    {"rms_current_train", "RMS current in the train", "mA", 0},
    {"rms_current_1s", "RMS current over 1 s", "mA", 1},
    {"rms_current_5s", "RMS current over 5 s", "mA", 5},
    {"rms_voltage_5s", "RMS voltage over 5 s", "V", 5},
    {"dc_current", "mean current over 5 s", "mA", 5},
    {"current_density", "current density", "mA/cm2", 5},
    {"power_density", "power density over 1 s", "W/cm2", 1},
}};
}  // namespace

std::string_view keyOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].key; }
std::string_view titleOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].title; }
std::string_view unitOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].unit; }
double windowOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].window_s; }
bool needsArea(Quantity quantity) noexcept {
    return quantity == Quantity::CurrentDensity || quantity == Quantity::PowerDensity;
}

std::optional<Quantity> quantityOf(std::string_view key) noexcept {
    for (std::size_t i = 0; i < kEntries.size(); ++i) {
        if (kEntries[i].key == key) return static_cast<Quantity>(i);
    }
    return std::nullopt;
}

}  // namespace tacto
