#include "core/exchange/ExportTables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/JsonText.h"
#include "core/base/Words.h"
#include "core/kinds/ResultKinds.h"
#include "core/results/ResultRecord.h"
#include "core/session/Origin.h"

namespace tacto {

std::string uniqueName(const std::string& wanted, std::string_view between, std::set<std::string>& taken) {
    auto name = wanted;
    for (int again = 2; !taken.insert(name).second; ++again) name = fmt::format("{}{}{}", wanted, between, again);
    return name;
}

bool isSimulated(const SessionDevice& device) {
    const auto from = originOf(device);
    return device.simulated || from == origin::kSimulated || from == origin::kReplayedSimulated;
}

bool simulatedOf(const SessionAbout& about, std::initializer_list<Role> roles, bool otherwise) {
    bool any = false, simulated = false;
    for (const auto& device : about.devices) {
        if (std::ranges::none_of(roles, [&](Role role) { return device.is(role); })) continue;
        any = true;
        simulated |= isSimulated(device);
    }
    return any ? simulated : otherwise;
}

namespace {

std::string unitOf(const SessionStream& stream, const std::string& column) {
    if (!stream.unit.empty()) return stream.unit;
    return column.ends_with("_pa") ? "Pa" : "1";
}

}  // namespace

std::vector<ExportChannel> channelsOf(const SessionStream& stream, const std::string& kind) {
    std::vector<ExportChannel> channels;
    std::set<std::string> names;
    for (const auto& column : stream.columns) {
        const auto wanted = kind == "frames" ? column : stream.columns.size() == 1 ? kind : kind + "_" + column;
        channels.push_back({.name = uniqueName(wanted, "~", names), .unit = unitOf(stream, column)});
    }
    return channels;
}

namespace {

using describe::number;
using describe::text;
using nlohmann::json;
using As = ResultColumn::As;

const char* const kTimeTitle = "Time since the session's start";

ResultColumn simulatedColumn() { return number("1: simulated, 0: not", "simulated"); }

/// Returns a unit by a name's end, as cli.md has it: "a key carries its unit".
std::string unitInName(std::string_view name) {
    static constexpr std::pair<std::string_view, const char*> kEnds[] = {
        {"_w_cm2", "W/cm2"}, {"_ma_cm2", "mA/cm2"}, {"_pct", "%"},    {"_ohm", "ohm"}, {"_v", "V"}, {"_mv", "mV"},
        {"_ma", "mA"},       {"_a", "A"},           {"_ms", "ms"},    {"_us", "us"},   {"_s", "s"}, {"_hz", "Hz"},
        {"_uc", "uC"},       {"_mj", "mJ"},         {"_kpa", "kPa"},  {"_pa", "Pa"},   {"_n", "N"}, {"_bits", "bit"},
        {"_um", "um"},       {"_mm", "mm"},         {"_mm_s", "mm/s"}};
    for (const auto& [end, unit] : kEnds) {
        if (name.size() > end.size() && name.ends_with(end)) return unit;
    }
    return "1";
}

/// Calls `visit(name, value)` for each member, those of members as "a.b".
template <class Visit>
void eachMember(const json& object, const std::string& prefix, const Visit& visit) {
    if (!object.is_object()) return;
    for (const auto& [key, value] : object.items()) {
        if (value.is_object())
            eachMember(value, prefix + key + ".", visit);
        else
            visit(prefix + key, value);
    }
}

bool isPlainNumber(const json& value) { return value.is_number() || value.is_boolean(); }
double plainNumber(const json& value) {
    return value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.is_number() ? value.get<double>() : kNaN;
}

/// Returns "" for null, "1 2" for numbers, "a; b" for texts.
std::string plainText(const json& value) {
    if (value.is_null()) return {};
    if (value.is_string()) return value.get<std::string>();
    if (isPlainNumber(value)) return fmt::format("{}", plainNumber(value));
    if (!value.is_array() || std::ranges::any_of(value, [](const json& each) { return each.is_structured(); }))
        return dumpJson(value);
    std::string all;
    const bool words = std::ranges::any_of(value, &json::is_string);
    for (const auto& each : value) {
        if (!all.empty()) all += words ? "; " : " ";
        all += each.is_null() ? "nan" : plainText(each);
    }
    return all;
}

ExportCell cellOf(const ResultColumn& column, const json& value) {
    if (ExportTable::holdsText(column)) return plainText(value);
    return plainNumber(value);
}

/// Returns the column of a member, which joins those taken: its own name, unless a column of every trial has that.
std::string trialColumn(const std::string& member, std::set<std::string>& taken) {
    static constexpr std::array<std::string_view, 5> kOfEveryTrial{"time", "time_s", "trial", "condition", "simulated"};
    const bool own = std::ranges::find(kOfEveryTrial, member) == kOfEveryTrial.end();
    return uniqueName(own ? member : "measured_" + member, "~", taken);
}

/// The units that the tables of a kind state of their columns.
std::map<std::string, std::string> describedUnits(std::string_view kind) {
    std::map<std::string, std::string> all;
    for (const auto& table : resultTraits(kind).tables) {
        for (const auto& column : table.columns) {
            if (!column.unit.empty() && column.unit.front() != '@') all.emplace(column.at, column.unit);
        }
    }
    return all;
}

}  // namespace

ExportTable trialTable(const std::vector<SessionTrial>& trials, std::string_view kind) {
    std::map<std::string, bool> members;  // whether they need text
    for (const auto& trial : trials) {
        eachMember(trial.measured, "", [&](const std::string& name, const json& value) {
            members[name] |= !value.is_null() && !isPlainNumber(value);
        });
    }
    ExportTable table{
        "trials",
        "Trials",
        {number(kTimeTitle, "time_s", "s"), number("Trial, from 1", "trial"), text("Condition", "condition")}};
    const auto described = describedUnits(kind);
    std::set<std::string> taken;
    for (const auto& [name, isText] : members) {
        ResultColumn column{name, trialColumn(name, taken), isText ? As::Text : As::Number, unitInName(name)};
        if (const auto known = described.find(name); known != described.end()) column.unit = known->second;
        table.columns.push_back(std::move(column));
    }
    table.columns.push_back(simulatedColumn());
    return table;
}

void trialCells(const SessionTrial& trial, bool simulated, const ExportTable& table, std::vector<ExportCell>& cells) {
    cells = {toSeconds(trial.at), double(trial.number), trial.condition};
    std::map<std::string, const json*> members;
    eachMember(trial.measured, "", [&](const std::string& name, const json& value) { members[name] = &value; });
    for (std::size_t c = 3; c + 1 < table.columns.size(); ++c) {
        const auto found = members.find(table.columns[c].title);  // the member, as trialTable() has it
        cells.push_back(cellOf(table.columns[c], found == members.end() ? json() : *found->second));
    }
    cells.emplace_back(simulated ? 1.0 : 0.0);
}

namespace {

constexpr Word<ExportTrain::Outcome> kOutcomes[] = {{"delivered", ExportTrain::Outcome::Delivered},
                                                    {"refused", ExportTrain::Outcome::Refused},
                                                    {"voided", ExportTrain::Outcome::Voided},
                                                    {"failed", ExportTrain::Outcome::Failed},
                                                    {"check", ExportTrain::Outcome::Check},
                                                    {"burst", ExportTrain::Outcome::Burst},
                                                    {"", ExportTrain::Outcome::Unknown}};

ResultRecord<ExportTrain> describeTrain() {
    using T = ExportTrain;
    ResultRecord<T> all;
    all.shown(number(kTimeTitle, "time_s", "s"), &T::time_s);
    all.shown(text("What became of the train", "outcome"), &T::outcome);
    all.shown(number("Roughness R that it was made from", "roughness", "1"), &T::roughness);
    all.shown(number("Pressure P that it was made from", "pressure", "1"), &T::pressure);
    all.shown(number("Amplitude that the encoder wanted", "command_v", "V"), &T::command_v);
    all.shown(number("Amplitude that the device was sent", "told_v", "V"), &T::told_v);
    all.shown(number("Amplitude that the device was sent", "told_ma", "mA"), &T::told_ma);
    all.shown(number("Amplitude that the device read back", "read_back_v", "V"), &T::readBack_v);
    all.shown(number("Amplitude that the device read back", "read_back_ma", "mA"), &T::readBack_ma);
    all.shown(number("Interval to the next train", "interval_s", "s"), &T::interval_s);
    all.shown(number("Impedance that the device measured", "impedance_ohm", "ohm"), &T::impedance_ohm);
    all.shown(number("Charge imbalance of a pulse", "imbalance", "1"), &T::imbalance);
    all.shown(text("Why it was not delivered", "reason"), &T::reason);
    all.shown(simulatedColumn(), &T::simulated);
    return all;
}

// Never destroyed, like trainTable(): a thread that hangs in another's library may use them until the program has ended
// (lsl).
const ResultRecord<ExportTrain>& trainRecord() {
    static const auto* record = new ResultRecord<ExportTrain>(describeTrain());
    return *record;
}

ExportTable rowTable(const char* name, const char* title, describe::Columns columns) {
    columns.insert(columns.begin(), number(kTimeTitle, "time_s", "s"));
    columns.push_back(simulatedColumn());
    return {name, title, std::move(columns)};
}

}  // namespace

std::string_view nameOf(ExportTrain::Outcome outcome) noexcept { return wordFor(kOutcomes, outcome); }

const ExportTable& trainTable() {
    static const auto* table = new ExportTable{"trains", "Trains", trainRecord().columns()};
    return *table;
}

void trainCells(const ExportTrain& train, std::vector<ExportCell>& cells) {
    const auto row = trainRecord().write(train);
    cells.clear();
    for (const auto& column : trainTable().columns) {
        cells.push_back(cellOf(column, memberAt(row, column.at)));
    }
}

std::vector<ExportChannel> numberChannels(const ExportTable& table) {
    std::vector<ExportChannel> channels;
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
        const auto& column = table.columns[c];
        if (!ExportTable::holdsText(column))
            channels.push_back({.name = column.at, .unit = column.unit.empty() ? "1" : std::string(column.unit)});
    }
    return channels;
}

std::vector<double> numbersIn(std::span<const ExportCell> cells) {
    std::vector<double> numbers;
    for (const auto& cell : cells.subspan(1))
        if (const auto* number = std::get_if<double>(&cell)) numbers.push_back(*number);
    return numbers;
}

const ExportTable& eventTable() {
    static const ExportTable table =
        rowTable("events", "Events", {text("Event", "event"), text("Its details, JSON", "details")});
    return table;
}

const ExportTable& recordTable() {
    static const ExportTable table =
        rowTable("records", "Commands, measurements, verdicts, items of the report and log lines",
                 {text("Kind of the row", "kind"), text("Name", "name"), text("Its details, JSON", "details")});
    return table;
}

TrainJoin::TrainJoin(std::vector<const SessionRow*> refused, bool simulated)
    : refused_(std::move(refused)), simulated_(simulated) {}

bool TrainJoin::isOfTrains(std::string_view command) noexcept {
    static constexpr std::array<std::string_view, 6> kNames{"train",  "burst",  "delivered",
                                                            "voided", "failed", "impedance check"};
    return std::ranges::find(kNames, command) != kNames.end();
}

Result<void> TrainJoin::refuse(const SessionRow& event, const Visit& visit) {
    ExportTrain train;
    train.time_s = toSeconds(event.at);
    train.simulated = simulated_;
    // A plan that is refused when it is handed over: its onset is not before that moment, and nothing came between.
    if (!plans_.empty() && plans_.back().train.time_s >= train.time_s) {
        train = plans_.back().train;
        plans_.pop_back();
    }
    train.outcome = ExportTrain::Outcome::Refused;
    train.reason = textOr(event.body, "text");
    return visit(train);
}

Result<void> TrainJoin::refuseBefore(std::int64_t seq, const Visit& visit) {
    for (; next_ < refused_.size() && refused_[next_]->seq < seq; ++next_) {
        if (auto visited = refuse(*refused_[next_], visit); !visited) return visited;
    }
    return {};
}

Result<void> TrainJoin::take(const SessionRow& command, const Visit& visit) {
    using Outcome = ExportTrain::Outcome;
    constexpr std::size_t kMaxPlans = 4;
    if (auto refused = refuseBefore(command.seq, visit); !refused) return refused;
    const bool burst = command.name == "burst";
    const auto& body = command.body;
    if (burst || command.name == "train") {
        if (plans_.size() == kMaxPlans) {
            if (auto visited = visit(plans_.front().train); !visited) return visited;
            plans_.erase(plans_.begin());
        }
        ExportTrain train;
        train.time_s = toSeconds(command.at);
        train.roughness = numberOr(body, "roughness");
        train.pressure = numberOr(body, "pressure");
        train.command_v = numberOr(body, "amplitude_v");
        train.interval_s = numberOr(body, "interval_s");
        train.held_v = numberOr(body, "held_v");
        train.roundedBy = numberOr(body, "rounded_by");
        if (train.limitShare = numberOr(body, "limit_share"); train.limitShare >= 0) train.limit = textOr(body, "text");
        train.drivenBy = std::isnan(train.command_v) ? "presentation" : drive_;
        train.simulated = simulated_;
        plans_.push_back({std::move(train), command.seq});
        return {};
    }
    if (command.name == "drive") drive_ = textOr(body, "text");
    if (!isOfTrains(command.name)) return {};
    ExportTrain train;
    const bool check = command.name == "impedance check" || numberOr(body, "is_check") == 1;
    if (!check && !plans_.empty()) {
        auto plan = plans_.begin();
        while (std::next(plan) != plans_.end() && toInstant(std::next(plan)->train.time_s) <= command.at) ++plan;
        for (auto earlier = plans_.begin(); earlier != plan; ++earlier) {
            if (auto visited = visit(earlier->train); !visited) return visited;
        }
        train = std::move(plan->train);
        plans_.erase(plans_.begin(), std::next(plan));
    }
    train.time_s = toSeconds(command.at);
    train.simulated = simulated_;
    if (check) train.drivenBy = "check";
    train.told_v = numberOr(body, "amplitude_v");
    train.told_ma = numberOr(body, "amplitude_ma");
    (std::isnan(train.told_ma) ? train.readBack_v : train.readBack_ma) = numberOr(body, "measured");
    train.interval_s = numberOr(body, "interval_s");
    train.impedance_ohm = numberOr(body, "impedance_ohm");
    train.imbalance = numberOr(body, "imbalance");
    train.outcome = command.name == "voided"     ? Outcome::Voided
                    : command.name == "failed"   ? Outcome::Failed
                    : check                      ? Outcome::Check
                    : body.contains("intensity") ? Outcome::Burst
                                                 : Outcome::Delivered;
    if (train.outcome == Outcome::Failed) train.reason = textOr(body, "text");
    train.details = body;
    return visit(train);
}

Result<void> TrainJoin::end(const Visit& visit) {
    if (auto refused = refuseBefore(std::numeric_limits<std::int64_t>::max(), visit); !refused) return refused;
    for (const auto& plan : plans_) {
        if (auto visited = visit(plan.train); !visited) return visited;
    }
    plans_.clear();
    return {};
}

}  // namespace tacto
