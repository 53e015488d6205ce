#include "core/pilot/VirtualPilotParticipant.h"

#include <algorithm>
#include <cmath>

#include "core/base/Random.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

PilotAnswer answered(std::string key, Seconds after) {
    PilotAnswer answer;
    answer.keys.push_back(std::move(key));
    answer.after = after;
    return answer;
}

bool isSame(const DeliveredCondition& learned, const FeltPresentation& felt) {
    return std::abs(learned.level - felt.level) < 1e-6 && std::abs((learned.interval - felt.interval).count()) < 1e-6;
}

}  // namespace

VirtualPilotParticipant::VirtualPilotParticipant(VirtualObserver observer, std::vector<std::string> conditions)
    : observer_(observer), conditions_(std::move(conditions)) {}

void VirtualPilotParticipant::show(const PilotScreen& screen) {
    if (onShow) onShow(screen);
}

void VirtualPilotParticipant::counted(const PilotCounts& counts) {
    if (onCounted) onCounted(counts);
}

void VirtualPilotParticipant::cancel() noexcept {}

void VirtualPilotParticipant::delivered(const FeltPresentation& felt) {
    felt_ = felt;
    if (!felt.named.empty() && felt.level > 0) learned_[felt.named] = {felt.level, felt.interval};
}

Result<PilotAnswer> VirtualPilotParticipant::ask(const PilotPrompt& prompt) {
    if (prompt.name == "stop-test") {
        if (stop) stop(prompt.to == PromptTo::Operator ? "operator" : "participant");
        return fail(ErrorCode::Stopped, "stopped by the {}, as asked", nameOf(prompt.to));
    }
    // Rounded to whole milliseconds, like the reading of a clock.
    Random times(observer_.settings().seed, "response time " + felt_.drawnFor + " " + prompt.name);
    const Seconds after(std::round(1000 * 0.7 * std::exp(0.35 * times.normal())) / 1000);
    if (prompt.kind == PromptKind::Scale) {
        PilotAnswer answer;
        answer.value = ratedFrom(prompt);
        answer.after = after;
        return answer;
    }
    if (prompt.kind == PromptKind::Several) {
        PilotAnswer answer;
        answer.after = after;
        if (prompt.name == "qualities") {
            for (const auto word : observer_.rate(felt_.drawnFor, felt_.level, felt_.stimulated).qualities)
                answer.keys.emplace_back(word);
        }
        return answer;
    }
    return answered(answerTo(prompt), after);
}

std::string VirtualPilotParticipant::answerTo(const PilotPrompt& prompt) const {
    const auto& key = felt_.drawnFor;
    switch (prompt.kind) {
        case PromptKind::Strength:
            return std::string(nameOf(observer_.strength(key, felt_.level, felt_.stimulated)));
        case PromptKind::Interval: {
            const auto held = felt_.inInterval == 2 ? TrialInterval::Second : TrialInterval::First;
            if (felt_.weaker > 0) return std::string(nameOf(observer_.compare(key, felt_.weaker, felt_.level, held)));
            return std::string(nameOf(observer_.detect(key, felt_.level, held, felt_.stimulated)));
        }
        case PromptKind::Condition:
            return identified();
        case PromptKind::YesNo:
            if (prompt.name == "half-an-hour")
                return observer_.acceptable(key, felt_.level, felt_.stimulated) ? "yes" : "no";
            return prompt.name.starts_with("exclusion") || prompt.name == "measure-again" ? "no" : "yes";
        case PromptKind::Choice:
            if (prompt.name == "naturalness")
                return std::string(nameOf(observer_.rate(key, felt_.level, felt_.stimulated).naturalness));
            if (prompt.name.starts_with(row::kEncodings)) return row::kNoDifference;  // it compares no encodings
            // Prefers "go on" at any place in the list: nothing is felt a second time.
            if (std::ranges::find(prompt.targets, "go-on", &PromptTarget::key) != prompt.targets.end()) return "go-on";
            return prompt.targets.empty() ? "" : prompt.targets.front().key;
        case PromptKind::Hold:
            return "held";
        case PromptKind::GoOn:
            return "go-on";
        case PromptKind::Text:
            return "simulated";
        case PromptKind::Several:
        case PromptKind::Scale:
            break;
    }
    return {};
}

/// Identifies the felt condition among the learned conditions; a condition never learned is no answer.
std::string VirtualPilotParticipant::identified() const {
    std::vector<DeliveredCondition> known;
    std::vector<std::string> names;
    std::optional<std::size_t> presented;
    for (const auto& name : conditions_) {
        const auto found = learned_.find(name);
        if (found == learned_.end()) continue;
        if (felt_.level > 0 && isSame(found->second, felt_)) presented = known.size();
        known.push_back(found->second);
        names.push_back(name);
    }
    if (known.empty()) return "not-sure";
    const auto said = observer_.identify(felt_.drawnFor, known, presented, felt_.stimulated);
    return said < names.size() ? names[said] : "none";
}

int VirtualPilotParticipant::ratedFrom(const PilotPrompt& prompt) const {
    const auto rating = observer_.rate(felt_.drawnFor, felt_.level, felt_.stimulated);
    if (prompt.name == "intensity") return rating.intensity;
    if (prompt.name == "unpleasantness") return rating.unpleasantness;
    if (prompt.name == "pain") return rating.pain;
    return prompt.least;
}

}  // namespace tacto
