#include "core/pilot/LevelRamp.h"

#include <algorithm>

#include "core/pilot/PilotEnding.h"
#include "core/pilot/PilotStage.h"

namespace tacto {

Result<void> LevelRamp::judged(double level, bool tooStrong, const std::string& trial, bool replayed) {
    if (level <= 0) return {};
    auto& bench = stage_.bench();
    if (tooStrong) {
        tooStrong_ = std::min(tooStrong_, level);
        auto reported = bench.reportDiscomfort(stage_.levelOf(level));
        stage_.rest();  // Armed anew under the lower limit before anything else is presented
        return reported;
    }
    accepted_.try_emplace(level, trial);
    return replayed ? Result<void>() : bench.accept(stage_.levelOf(level));
}

Result<void> LevelRamp::reach() {
    if (!due_) return {};
    due_ = false;
    const auto accepted = accepted_;
    // Each ramp is presented: none takes the answers of another.
    std::size_t number = 0;
    const auto named = [&number](double level) { return fmt::format("ramp {} {}", number, level); };
    while (!accepted.empty() && stage_.record().begun(named(accepted.begin()->first)) > 0) ++number;
    for (const auto& [level, first] : accepted) {
        if (level >= tooStrong_ || (settled_ && level > *settled_)) break;
        if (auto reached = presentAgain(named(level), level, first); !reached) return reached;
    }
    if (accepted.empty()) return {};
    PilotScreen letGo;  // levels rise no more
    letGo.phase = "ascending";
    letGo.text = "You can let go now.";
    stage_.participant().show(letGo);
    return {};
}

Result<void> LevelRamp::presentAgain(const std::string& name, double level, const std::string& first) {
    auto& bench = stage_.bench();
    StageTrial again;
    again.name = name;
    again.about = {{row::kRamp, true}};
    again.level = level;
    again.presentation = ascendingPresentation(stage_.levelOf(level), stage_.settings().shortest);
    again.prompt = strengthPrompt();
    again.screen.state = ScreenState::Feel;
    again.screen.phase = "ascending";
    again.held = true;
    again.counts = false;   // So that a session that was resumed goes on as one that was not
    again.drawnAs = first;  // A virtual participant says of a level what they said of it before
    const auto answer = stage_.trial(again);
    if (!answer) return failure(answer);
    if (answer->response == row::kTooStrong) {
        if (auto reported = bench.reportDiscomfort(stage_.levelOf(level)); !reported) return reported;
        return stage_.end(PilotEnd::Stopped, tooStrongNow(textOf(stage_.levelOf(level))));
    }
    return bench.accept(stage_.levelOf(level));
}

}  // namespace tacto
