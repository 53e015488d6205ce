// LoadSafetyRecord.h - the record that a run of the load-safety protocol keeps about the stimulator: one line when it
// begins and one when it ends (core/calibration/LoadSafetyStore.h).
//
// Only the shipped protocol makes such a record, with exactly the bytes that the program was built with. The contents
// come from the open devices, the bench's profile and limits, and the program's own verdict (hazard H9).
//
// Thread-safety: pure, except for the store's file.
#pragma once

#include <optional>
#include <string>

#include "app/run/Shipped.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/bench/Profile.h"
#include "core/calibration/LoadSafetyStore.h"
#include "core/session/SessionTypes.h"

namespace tacto {

/// Returns the hash of the protocol that this program was built with.
[[nodiscard]] std::string shippedLoadSafetySha256();

/// Returns the extremes of a profile's trains, and the range of loads that they may drive.
[[nodiscard]] TrainReach reachOf(const Profile& profile);

/// Returns the shipped protocol's tolerances: a pass with wider tolerances permits no session.
[[nodiscard]] CheckTolerances ownTolerances();

/// Returns a check that begins; nothing for another protocol, altered bytes, or a stimulator without a serial number.
[[nodiscard]] std::optional<LoadSafetyCheck> loadSafetyCheckOf(const ProtocolSource& script, const SessionAbout& about,
                                                               const Profile& profile, const std::string& session);

/// Errors: as LoadSafetyStore. If the device is simulated, a check that cannot be kept is no error: nothing needs it.
[[nodiscard]] Result<void> keepCheck(const LoadSafetyCheck& check);

}  // namespace tacto
