// ArmingText.h - what an operator confirms before the output goes live: which device, into what, and how much at most.
// A confirmation is of this text and of no other: another unit, load, profile or electrode has another text, and arming
// refuses the confirmation that was given for the first (hazard H12).
//
// Plain ASCII without quotes or anything that a shell or a terminal would act on, whatever a device calls itself, so
// that it can be shown, pasted and compared.
//
// Thread-safety: pure functions.
#pragma once

#include <string>

#include "core/bench/Profile.h"
#include "core/devices/Device.h"
#include "core/safety/GateSetup.h"

namespace tacto {

/// As "P24 P24-0017 into 1 kohm, up to 40 V and 50 mA, electrode area 3 cm2". The amplitudes are the largest of the
/// profile's encoding over the load range that the limits are judged over. `source` is null for a massager, which has
/// neither load nor electrodes.
[[nodiscard]] std::string armingText(const DeviceIdentity& output, const SourceTraits* source, const Profile& profile,
                                     OutputMode mode, const Load& load);

}  // namespace tacto
