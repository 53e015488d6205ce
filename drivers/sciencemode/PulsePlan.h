// PulsePlan.h - from an approved pulse train to the points of a ScienceMode pulse. Refuses, never rounds: what reaches
// the wire is what the gate approved.
//
// Thread-safety: pure functions; nothing allocates on success.
#pragma once

#include "core/encoding/PulseTrain.h"
#include "core/safety/SourceTraits.h"
#include "drivers/sciencemode/ScienceModeCommands.h"

namespace tacto::sciencemode {

/// One pulse as sent, and what its read-back is compared with.
struct PulsePlan {
    Points points;
    Milliamps amplitude{0};  ///< the leading phase's, unsigned
    Micros leading{0};       ///< widths
    Micros gap{0};
    Micros second{0};  ///< 0: monophasic
};

/// The abilities of a P24: a current source of 0 to 130 mA in steps of 0.5 mA, phases of 10 to 4095 µs. The driver
/// sends its pulses one by one, so that a train ends with the program; a dead-man of 2 s is stated for that.
/// `readsBack`: whether status() can tell |Z|.
[[nodiscard]] SourceTraits sourceTraits(bool readsBack) noexcept;

/// The plan of the train's pulse. Errors: Device for a train in volts (a current source never gets volts, H4), for
/// values off the device's grid or range, and for a pulse of more than 16 points.
[[nodiscard]] Result<PulsePlan> planPulse(const PulseTrain& train);

}  // namespace tacto::sciencemode
