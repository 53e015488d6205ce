// PilotOrder.h - what a pilot run needs in addition to its protocol: the study and the participant.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/run/MarkerServer.h"
#include "core/pilot/PilotParticipant.h"
#include "core/seal/Passphrase.h"
#include "core/study/Gates.h"

namespace tacto {

/// The study of the session, and its participant.
struct PilotOrder {
    std::filesystem::path study;
    std::optional<Passphrase> passphrase;
    /// The participant's and operator's windows; null: without windows, a person is refused.
    PilotParticipant* people = nullptr;
    bool codeConfirmed = false;  ///< a person has checked the code on the screen
    /// Empty for a virtual participant, who answers no to all except those in `--set exclusions`.
    std::vector<ExclusionAnswer> exclusions;
    std::optional<MarkerAddress> markers;  ///< nothing: no markers are sent
    /// Is shown what a virtual participant is shown; must outlive the run. May be null.
    PilotParticipant* watch = nullptr;
    /// How many times faster than with a person a virtual participant's screens pass; 0: as fast as possible. No screen
    /// stays for more than a second. Where a person answers on simulated devices, how many times faster all but their
    /// answers passes; 0: in real time.
    double pace = 0;
};

}  // namespace tacto
