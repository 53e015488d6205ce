// MachineGate.h - decides whether the open stimulator or massager may be used on a person today (pilot.md section 3). A
// stimulator must be a biphasic current source with a valid calibration, a load-safety check passed at most 30 days
// ago, and limits no wider than those of the study's approval. A massager must distinguish its strengths.
//
// Thread-safety: pure, except for reading the stores.
#pragma once

#include "app/run/Shipped.h"
#include "core/bench/Profile.h"
#include "core/calibration/CalibrationStore.h"
#include "core/devices/DeviceSet.h"
#include "core/study/Gates.h"

namespace tacto {

/// A simulated stimulator states its own calibration and needs no check. A massager must state its strength steps, and
/// no stimulator may be connected. It delivers no current, so calibration, load safety and limits are not checked.
/// `profile`: the session's, with the study's electrode and train. Errors: kGateRefused, one sentence.
[[nodiscard]] Result<void> machineGate(const StudySettings& study, const Profile& profile, const ShippedLimits& limits,
                                       const DeviceSet& devices, CalibrationDate today);

}  // namespace tacto
