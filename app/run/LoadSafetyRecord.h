// LoadSafetyRecord.h - what a run of the load-safety protocol leaves of the stimulator that it checked: a line when it
// begins and one when it ends (core/calibration/LoadSafetyStore.h).
//
// Only the shipped protocol leaves such a record: the bytes that run must be those that the program was built with.
// What it says comes from the open devices, the bench's profile and limits, and the program's own verdict (hazard H9).
//
// Thread-safety: pure but for the store's file.
#pragma once

#include <optional>
#include <string>

#include "app/run/Shipped.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/bench/Profile.h"
#include "core/calibration/LoadSafetyStore.h"
#include "core/session/SessionTypes.h"

namespace tacto {

/// Hash of the protocol that this program was built with.
[[nodiscard]] std::string shippedLoadSafetySha256();

/// How far the trains of a profile go, and into which loads.
[[nodiscard]] TrainReach reachOf(const Profile& profile);

/// The widest with which a pass counts for a session: what the protocol is shipped with.
[[nodiscard]] CheckTolerances ownTolerances();

/// A check that begins; nothing for another protocol, altered bytes, or a stimulator without a serial number.
[[nodiscard]] std::optional<LoadSafetyCheck> loadSafetyCheckOf(const ProtocolSource& script, const SessionAbout& about,
                                                               const Profile& profile, const std::string& session);

/// Errors: as LoadSafetyStore. Nothing depends on it for simulated devices: what cannot be kept is not an error.
[[nodiscard]] Result<void> keepCheck(const LoadSafetyCheck& check);

}  // namespace tacto
