// PilotOrder.h - what a pilot run is asked for beside its protocol: the study and who is there.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/run/MarkerServer.h"
#include "core/pilot/PilotParticipant.h"
#include "core/seal/Passphrase.h"
#include "core/study/Gates.h"

namespace tacto {

/// Where the session runs, and with whom.
struct PilotOrder {
    std::filesystem::path study;
    std::optional<Passphrase> passphrase;
    /// The participant's and operator's windows; null: headless, and then a person is refused.
    PilotParticipant* people = nullptr;
    bool codeConfirmed = false;  ///< a person read the code on their screen
    /// Empty for a virtual participant, who answers no to each but those of `--set exclusions`.
    std::vector<ExclusionAnswer> exclusions;
    std::optional<MarkerAddress> markers;  ///< nothing: none are sent
};

}  // namespace tacto
