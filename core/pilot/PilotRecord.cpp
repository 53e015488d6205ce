#include "core/pilot/PilotRecord.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/base/Words.h"
#include "core/results/Describe.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

constexpr std::string_view kMarked[] = {
    row::kPlan,       row::kResumed,         row::kPhase,        row::kStopTest,  row::kImpedance,
    row::kTrialBegin, row::kPresentation,    row::kAnswer,       row::kNoAnswer,  row::kAnswerEarly,
    row::kRating,     row::kBreakBegin,      row::kBreakEnd,     row::kFocusLost, row::kPause,
    row::kContinue,   row::kParticipantStop, row::kOperatorStop, row::kFault,     row::kSessionEnd};

}  // namespace

bool hasMarker(std::string_view kind) noexcept { return std::ranges::find(kMarked, kind) != std::end(kMarked); }

PilotRecord::PilotRecord(SessionWriter& writer, const Clock& clock, const std::vector<SessionRow>& earlier)
    : writer_(writer), clock_(clock), resumed_(!earlier.empty()) {
    // The bench writes events of its own into the session, also one named "fault"; they have no member "name".
    for (const auto& each : earlier)
        if (each.body.contains("name")) keep(each.name, each.body);
}

void PilotRecord::keep(std::string_view kind, const Json& body) {
    const auto name = textOr(body, "name");
    ++counts_[std::string(kind)];
    if (kind == row::kTrialBegin) ++begun_[name];
    if (kind == row::kAnswer && !textOr(body, "response").empty()) ++answers_;
    last_[{std::string(kind), name}] = body;
}

const PilotRecord::Json* PilotRecord::find(std::string_view kind, const std::string& name) const {
    const auto found = last_.find({std::string(kind), name});
    return found != last_.end() ? &found->second : nullptr;
}

Result<void> PilotRecord::write(std::string_view kind, const std::string& name, Json body) {
    return writeAt(clock_.now(), kind, name, std::move(body));
}

Result<void> PilotRecord::writeAt(Instant at, std::string_view kind, const std::string& name, Json body) {
    if (!body.is_object()) body = Json{{"value", std::move(body)}};
    body["name"] = name;
    if (auto kept = writer_.event(at, kind, body); !kept) return failure(kept);
    keep(kind, body);
    ++written_;
    if (onMarker && hasMarker(kind)) onMarker({at, kind});
    if (onWritten) onWritten(written_);
    return {};
}

Result<PilotRecord::Json> PilotRecord::once(std::string_view kind, const std::string& name,
                                            const std::function<Result<Json>()>& make) {
    if (const auto* found = find(kind, name)) return *found;
    auto made = make();
    if (!made) return made;
    if (auto kept = write(kind, name, std::move(*made)); !kept) return failure(kept);
    return *find(kind, name);
}

void PilotRecord::each(const std::function<void(std::string_view kind, const Json& body)>& visit) const {
    for (const auto& [of, body] : last_) visit(of.first, body);
}

std::size_t PilotRecord::count(std::string_view kind) const {
    const auto found = counts_.find(kind);
    return found != counts_.end() ? found->second : 0;
}

std::size_t PilotRecord::begun(const std::string& name) const {
    const auto found = begun_.find(name);
    return found != begun_.end() ? found->second : 0;
}

std::size_t PilotRecord::voided() const {
    const auto begun = count(row::kTrialBegin), ended = count(row::kAnswer) + count(row::kNoAnswer);
    return begun - std::min(begun, ended);
}

PilotTrials pilotTrials(const std::vector<SessionRow>& rows) {
    PilotTrials out;
    std::map<std::size_t, std::size_t> attempts;        // trial number: attempts without an answer so far
    std::map<std::size_t, IdentificationTrial> silent;  // trial number: its last attempt without an answer
    for (const auto& each : rows) {
        if (each.name == row::kPlan) {
            out.plan = valueOr(each.body, "trials");
            continue;
        }
        const auto number = countOr(each.body, "number");
        if (number == 0) continue;
        if (each.name == row::kTrialBegin) attempts[number] = countOr(each.body, "attempt");
        if (each.name == row::kNoAnswer) {
            attempts.erase(number);
            silent[number] = identificationTrialFrom(each.body);
        }
        if (each.name != row::kAnswer) continue;
        attempts.erase(number);
        silent.erase(number);
        out.trials.push_back(identificationTrialFrom(each.body));
    }
    for (const auto& [number, trial] : silent) out.trials.push_back(trial);
    for (const auto& [number, attempt] : attempts) out.open.push_back({number, attempt});
    return out;
}

namespace {

constexpr Word<PilotEnd> kPilotEnds[] = {
    {"unfinished", PilotEnd::Unfinished}, {"complete", PilotEnd::Complete}, {"stopped", PilotEnd::Stopped}};

}  // namespace

std::string_view nameOf(PilotEnd end) noexcept { return wordFor<PilotEnd>(kPilotEnds, end); }

std::optional<PilotEnd> pilotEndFrom(std::string_view word) noexcept { return valueFor(kPilotEnds, word); }

std::string tooStrongNow(std::string_view level) {
    return fmt::format("{} was accepted before and is too strong now; the session ends here", level);
}

std::string endedBy(const PilotRecord& record) {
    if (record.count(row::kParticipantStop) >= kMaxParticipantStops) return kThirdStop;
    if (record.count(row::kFault) >= kMaxFaults) return kSecondFault;
    std::string ended;
    record.each([&](std::string_view kind, const nlohmann::json& body) {
        if (kind == row::kGate && flagOr(body, row::kEnds)) ended = textOr(body, "said");
        if (kind != row::kAnswer || !flagOr(body, row::kRamp) || textOr(body, "response") != row::kTooStrong) return;
        const auto* meant = record.find(row::kPhase, row::meantName(textOr(body, "name")));
        if (meant == nullptr || textOr(*meant, "key") != "no") ended = tooStrongNow("a level");
    });
    return ended;
}

namespace {

using nlohmann::json;

RecordFields<PlanRow> planFields() {
    using P = PlanRow;
    RecordFields<P> all;
    all.number("seed", &P::seed);
    all.text("encoding", &P::encoding, {.mayBeEmpty = true});
    all.number("blocks", &P::blocks);
    all.texts({{"run_sha256", &P::runSha256},
               {"answers", &P::answers},
               {"language", &P::language},
               {"words_version", &P::wordsVersion},
               {"words_sha256", &P::wordsSha256}},
              {.mayBeEmpty = true});
    return all;
}

/// The fields of a range row, and their columns in the results that contain it.
struct RangeDescription {
    RecordFields<RangeRow> fields = {};
    describe::Columns columns = {};
};

RangeDescription describeRange(LevelUnit unit) {
    using R = RangeRow;
    using As = ResultColumn::As;
    RangeDescription all;
    const auto shown = [&all](const FieldInfo& field, const char* title, As as, const char* unitShown = "") {
        all.columns.push_back({title, field.key, as, unitShown});
    };
    const auto level = [&](std::string_view what, double R::*member, const char* title) {
        shown(all.fields.number(levelKey(what, unit), member), title, As::Number,
              unit == LevelUnit::Current ? "mA" : "");
    };
    shown(all.fields.flag("usable", &R::usable), "The range is usable", As::YesNo);
    shown(all.fields.add("reason", &R::reason, textOrNullKind()), "Why not", As::Text);
    level("min", &R::min, "Range, from");
    level("max", &R::max, "to");
    if (unit == LevelUnit::Current) {
        shown(all.fields.number("min_v", &R::minVoltage), "Voltage, from", As::Number, "V");
        shown(all.fields.number("max_v", &R::maxVoltage), "to", As::Number, "V");
        shown(all.fields.number("impedance_ohm", &R::impedance), "at", As::Number, "ohm");
    }
    shown(all.fields.number("jnd", &R::jnd), "Width (JND)", As::Jnd);
    shown(all.fields.word("limited_by", &R::limitedBy, kLevelLimits), "Limited by", As::Condition);
    return all;
}

RecordFields<DriftRow> driftFields(LevelUnit unit) {
    using D = DriftRow;
    RecordFields<D> all;
    all.number("block", &D::block);
    all.add(levelKey("detection", unit), &D::detection,
            codedKind<Estimate>(
                "an estimate or null", [](const json& value) { return std::optional(estimateFrom(value)); },
                [](const Estimate& estimate) { return estimateOrNull(estimate); }));
    all.number("probability", &D::probability);
    all.number("rests", &D::rests);
    all.flag("adapted", &D::adapted);
    return all;
}

/// Returns the unit of a row that contains `level`.
LevelUnit unitIn(const json& body, std::string_view level) {
    return body.contains(levelKey(level, LevelUnit::Intensity)) ? LevelUnit::Intensity : LevelUnit::Current;
}

/// Reads a row into a new record; members that cannot be read keep their defaults.
template <class Row>
Row rowFrom(const RecordFields<Row>& fields, const json& body, Row row = {}) {
    static_cast<void>(fields.read(body, row, {.lenient = true}));
    return row;
}

}  // namespace

json estimateOrNull(const Estimate& estimate) { return std::isfinite(estimate.value) ? toJson(estimate) : json(); }

Estimate estimateFrom(const json& value) {
    return {numberOr(value, "value"), numberOr(value, "low"), numberOr(value, "high")};
}

json toJson(const PlanRow& row) { return builtOnce<planFields>().write(row); }

PlanRow planRowFrom(const json& body) { return rowFrom(builtOnce<planFields>(), body); }

json toJson(const RangeRow& row) { return describeRange(row.unit).fields.write(row); }

RangeRow rangeRowFrom(const json& body) {
    const auto unit = unitIn(body, "min");
    return rowFrom(describeRange(unit).fields, body, {.unit = unit});
}

std::vector<ResultColumn> rangeColumns(LevelUnit unit) { return describeRange(unit).columns; }

json toJson(const DriftRow& row) { return driftFields(row.unit).write(row); }

DriftRow driftRowFrom(const json& body) {
    const auto unit = unitIn(body, "detection");
    return rowFrom(driftFields(unit), body, {.unit = unit});
}

}  // namespace tacto
