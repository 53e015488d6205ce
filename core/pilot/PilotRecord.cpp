#include "core/pilot/PilotRecord.h"

#include <algorithm>
#include <set>

#include "core/analysis/identification/IdentificationJson.h"
#include "core/base/JsonText.h"
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
    for (const auto& each : earlier) keep(each.name, each.body);
}

void PilotRecord::keep(std::string_view kind, const Json& body) {
    const auto name = textOr(body, "name");
    ++counts_[std::string(kind)];
    if (kind == row::kTrialBegin) ++begun_[name];
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

PilotTrials pilotTrials(const std::vector<SessionRow>& rows) {
    PilotTrials out;
    std::map<std::size_t, std::size_t> attempts;        // of begun trials without an answer
    std::map<std::size_t, IdentificationTrial> silent;  // the last time without an answer
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

}  // namespace tacto
