// VirtualPilotParticipant.h - both people of a rehearsal: a virtual participant, and an operator who answers everything
// harmlessly, through the same interface as people at a window.
//
// Feelings follow from what was delivered (VirtualObserver.h); the participant knows the conditions by the names under
// which familiarisation presented them. Response times are drawn without a source: they say nothing about people.
//
// Thread-safety: as PilotParticipant.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/pilot/PilotParticipant.h"

namespace tacto {

class VirtualPilotParticipant final : public PilotParticipant {
public:
    /// `conditions`: names of the four conditions, in the order of the study.
    VirtualPilotParticipant(VirtualObserver observer, std::vector<std::string> conditions);

    void show(const PilotScreen& screen) override;
    void counted(const PilotCounts& counts) override;
    /// Called with each screen, and with each count; may be empty.
    std::function<void(const PilotScreen&)> onShow;
    std::function<void(const PilotCounts&)> onCounted;
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override;
    void delivered(const FeltPresentation& felt) override;
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return {}; }
    void cancel() noexcept override;
    [[nodiscard]] bool holding() const noexcept override { return true; }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return false; }

    [[nodiscard]] const VirtualObserver& observer() const noexcept { return observer_; }

private:
    [[nodiscard]] std::string answerTo(const PilotPrompt& prompt) const;
    [[nodiscard]] std::string identified() const;
    [[nodiscard]] int ratedFrom(const PilotPrompt& prompt) const;

    const VirtualObserver observer_;
    const std::vector<std::string> conditions_;
    std::map<std::string, DeliveredCondition> learned_;
    FeltPresentation felt_;  // the last presentation
};

}  // namespace tacto
