// TrainProgram.h - a pulse train as Pulse Pal's parameters: which commands make a channel play it once.
//
// The device's inter-pulse interval runs from a pulse's end to the next onset, and its train duration ends all, so the
// duration lies one cycle behind the last pulse: a pulse is never cut, and none begins after the last.
#pragma once

#include <vector>

#include "core/encoding/PulseTrain.h"
#include "core/safety/SourceTraits.h"
#include "drivers/pulsepal/PulsePalCommands.h"

namespace tacto::pulsepal {

/// The output range of Pulse Pal 2. A voltage source without read-back: never for a person (the gate refuses it).
[[nodiscard]] SourceTraits sourceTraits() noexcept;

struct TrainProgram {
    std::vector<CommandBytes> commands;    ///< all parameters of the channel, each of which is acknowledged
    Cycles duration = Cycles::exactly(0);  ///< how long the whole train lasts, as programmed
};

/// Errors: as validate(); Unsupported naming what the device cannot do: a train in mA, more than ± 10 V, a time off its
/// 50 µs grid (rounding is done before approval), a pause between pulses of less than 2 cycles.
[[nodiscard]] Result<TrainProgram> programTrain(const PulseTrain& train, Channel channel);

/// Cuts a channel off from everything but our trigger: trigger inputs, stored trains, bursts, delays; rests at 0 V.
[[nodiscard]] std::vector<CommandBytes> quietChannel(Channel channel);

}  // namespace tacto::pulsepal
