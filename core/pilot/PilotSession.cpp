#include "core/pilot/PilotSession.h"

#include <algorithm>

#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/psychophysics/PredictedFit.h"
#include "core/base/JsonText.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/PilotResults.h"

namespace tacto {

namespace {

std::vector<DeliveredCondition> delivered(const std::vector<PresentedCondition>& presented) {
    std::vector<DeliveredCondition> out;
    for (const auto& each : presented) out.push_back({each.level, each.interval});
    return out;
}

/// Adds a column "not sure" with probability 0, since a virtual participant never says that.
std::vector<double> withNotSure(std::vector<double> probabilities) {
    probabilities.push_back(0);
    return probabilities;
}

}  // namespace

PilotSession::PilotSession(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings,
                           const VirtualObserver* truth, int parts)
    : stage_(bench, participant, record, std::move(settings)),
      care_(stage_),
      thresholds_(stage_),
      identification_(stage_, thresholds_),
      truth_(truth),
      parts_(parts) {}

void PilotSession::resumesFrom(std::string part, std::string chainHead) {
    resumedPart_ = std::move(part);
    resumedHead_ = std::move(chainHead);
}

Result<void> PilotSession::begin(bool withTrials) {
    auto& record = stage_.record();
    if (record.isResumed()) {
        auto kept = record.write(row::kResumed, fmt::format("part {}", parts_),
                                 {{"part", resumedPart_}, {"chain_head", resumedHead_}});
        if (!kept) return kept;
    }
    // The session ended, but the study was not told. A complete session is replayed to its results without questions.
    const auto* ended = record.find(row::kSessionEnd, row::kEnd);
    const bool complete = ended != nullptr && textOr(*ended, "state") == nameOf(PilotEnd::Complete);
    if (ended != nullptr && !complete) {
        const auto why = textOr(*ended, "why");
        return stage_.end(PilotEnd::Stopped, why.empty() ? "its record says that it is over" : why);
    }
    if (auto why = endedBy(record); !complete && !why.empty()) return stage_.end(PilotEnd::Stopped, why);
    if (auto planned = identification_.plan(withTrials); !planned || complete) return planned;
    return care_.checklist();
}

Result<void> PilotSession::beforeBlock(int block) {
    const auto name = fmt::format("block {} approval", block);
    auto& record = stage_.record();
    if (mayGoOn && record.find(row::kGate, name) == nullptr) {
        const auto may = mayGoOn();
        if (auto held = care_.gate(name, may.has_value(), may ? std::string() : may.error().message); !held)
            return held;
    }
    return care_.beforeBlock(block);
}

nlohmann::json PilotSession::participantJson() const {
    const auto& settings = stage_.settings();
    return {{"code", settings.code},
            {"virtual", settings.basis == SessionBasis::Virtual},
            {"basis", nameOf(settings.basis)}};
}

nlohmann::json PilotSession::truthJson() const {
    if (truth_ == nullptr) return nullptr;
    const auto& who = truth_->settings().who;
    const auto unit = stage_.settings().unit;
    return {{levelKey("detection", unit), truth_->detection()},
            {levelKey("too_strong", unit), truth_->tooStrong()},
            {"amplitude_weber", who.amplitudeWeber},
            {"interval_weber", who.intervalWeber},
            {"lapse", who.lapse},
            {"noise_jnd", who.noise_jnd}};
}

nlohmann::json PilotSession::thresholdResults() const {
    auto results = thresholds_.toJson();
    results["kind"] = "pilot-thresholds";
    results["modality"] = stage_.settings().modality();
    results["participant"] = participantJson();
    results["parts"] = parts_;
    results["resumed"] = parts_ > 1;
    results["truth"] = truthJson();
    return results;
}

Result<Identification> PilotSession::found() const {
    return identify(identification_.trials(), identification_.labels());
}

Result<nlohmann::json> PilotSession::identificationResults() const {
    const auto all = found();
    if (!all) return failure(all);
    auto results = toJson(*all);
    results["kind"] = "pilot-identification";
    results["modality"] = stage_.settings().modality();
    results["participant"] = participantJson();
    results["encoding"] = stage_.settings().encoding;
    results["parts"] = parts_;
    results["resumed"] = parts_ > 1;
    results["range"] = thresholds_.rangeJson();
    results["thresholds"] = thresholds_.toJson();
    results["drift"] = identification_.driftJson();
    results["presented"] = presentedJson(identification_.presented(), stage_.settings().unit);
    if (stage_.settings().unit == LevelUnit::Intensity) {
        const auto vibration = judgeVibration(identification_.vibrations(), identification_.labels());
        if (!vibration) return failure(vibration);
        results["vibration"] = toJson(*vibration);
    }
    for (const char* key : {"predicted", "fit", "truth", "plan", "trials"}) results[key] = nullptr;
    results["notes"] = nlohmann::json::array();
    if (stage_.settings().basis == SessionBasis::PersonSimulated)
        results["notes"] = {"A person answered, and the devices are simulated: nothing was felt."};
    if (truth_ == nullptr) return results;
    results["notes"] = {"The participant, the operator, their checklist and the skin are simulated.",
                        "Response times of a virtual participant are drawn and have no source."};
    results["truth"] = truthJson();
    results["plan"] = identification_.planJson();
    auto trials = nlohmann::json::array();
    for (const auto& each : identification_.trials()) trials.push_back(toJson(each));
    results["trials"] = std::move(trials);
    if (auto added = addPredicted(results); !added) return failure(added);
    return results;
}

/// Predicts results from the delivered levels and from the stimulated time before each trial.
Result<void> PilotSession::addPredicted(nlohmann::json& results) const {
    const auto conditions = delivered(identification_.presented());
    if (conditions.empty()) return {};
    auto columns = identification_.labels();
    columns.emplace_back(kNoneResponse);
    columns.emplace_back(kNotSureResponse);
    std::vector<PredictedTrial> trials;
    const auto& answered = identification_.trials();
    for (std::size_t i = 0; i < answered.size(); ++i) {
        const auto& each = answered[i];
        const auto row = std::ranges::find(columns, each.condition);
        const auto said = std::ranges::find(columns, each.response);
        if (each.phase != TrialPhase::Test || row == columns.end() || said == columns.end()) continue;
        const auto index = static_cast<std::size_t>(row - columns.begin());
        auto rows = truth_->predicted(conditions, identification_.stimulatedBefore()[i]);
        trials.push_back(
            {index, static_cast<std::size_t>(said - columns.begin()), withNotSure(std::move(rows[index]))});
    }
    auto table = truth_->predicted(conditions, Seconds(0));
    if (trials.empty()) {
        for (auto& row : table) row = withNotSure(std::move(row));
        results["predicted"] = table;
        return {};
    }
    const auto fit = fitOf(trials, conditions.size(), stage_.settings().seed);
    if (!fit) return failure(fit);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = fit->predicted[i].empty() ? withNotSure(std::move(table[i])) : fit->predicted[i];
    results["predicted"] = table;
    results["fit"] = {{"g", fit->all.g}, {"p", fit->all.p}};
    return {};
}

Result<std::string> PilotSession::headlineText() const {
    const auto all = found();
    if (!all) return failure(all);
    PresentedRange range;
    const auto row = rangeRowFrom(thresholds_.rangeJson());
    if (stage_.settings().unit == LevelUnit::Current) {
        range.low = Milliamps(row.min);
        range.high = Milliamps(row.max);
        range.lowVoltage = row.minVoltage;
        range.highVoltage = row.maxVoltage;
        range.impedance = row.impedance;
    } else {
        range.lowIntensity = row.min;
        range.highIntensity = row.max;
    }
    return headline(namedWith(stage_.settings().basis, stage_.settings().code), *all, range);
}

}  // namespace tacto
