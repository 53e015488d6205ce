// PulsePlan.h - turns an approved pulse train into the points of a ScienceMode pulse. Refuses and never rounds, so that
// the device gets exactly what the gate approved.
//
// Thread-safety: pure functions; nothing allocates on success.
#pragma once

#include "core/encoding/PulseTrain.h"
#include "core/safety/SourceTraits.h"
#include "drivers/sciencemode/ScienceModeCommands.h"

namespace tacto::sciencemode {

/// One pulse as sent, with the values to compare its read-back with.
struct PulsePlan {
    Points points;
    Milliamps amplitude{0};  ///< amplitude of the leading phase, unsigned
    Micros leading{0};       ///< width of the leading phase
    Micros gap{0};
    Micros second{0};  ///< width of the second phase; 0: monophasic
};

/// Returns the abilities of a P24: a current source of 0 to 130 mA in steps of 0.5 mA, phases of 10 to 4095 µs. The
/// driver sends every pulse itself, so a train ends when the program ends; it states this as a dead-man of 2 s.
/// `readsBack`: true if status() can give |Z|.
[[nodiscard]] SourceTraits sourceTraits(bool readsBack) noexcept;

/// Plans the train's pulse. Errors: Device for a train in volts (a current source never gets volts, H4), for values off
/// the device's grid or range, and for a pulse of more than 16 points.
[[nodiscard]] Result<PulsePlan> planPulse(const PulseTrain& train);

}  // namespace tacto::sciencemode
