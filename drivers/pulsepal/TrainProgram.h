// TrainProgram.h - turns a pulse train into the parameter commands that make a Pulse Pal channel play it once.
//
// The device's inter-pulse interval runs from a pulse's end to the next onset, and its train duration ends everything.
// The duration is therefore one cycle longer than the train: no pulse is cut, and none begins after the last.
#pragma once

#include <vector>

#include "core/encoding/PulseTrain.h"
#include "core/safety/SourceTraits.h"
#include "drivers/pulsepal/PulsePalCommands.h"

namespace tacto::pulsepal {

/// The abilities of Pulse Pal 2. A voltage source without read-back: never for a person (the gate refuses it).
[[nodiscard]] SourceTraits sourceTraits() noexcept;

struct TrainProgram {
    std::vector<CommandBytes> commands;    ///< all parameters of the channel; the device acknowledges each
    Cycles duration = Cycles::exactly(0);  ///< programmed length of the whole train
};

/// Errors: as validate(); Unsupported naming what the device cannot do: a train in mA, more than ± 10 V, a time off its
/// 50 µs grid (times are rounded before approval), a pause of less than 2 cycles between pulses.
[[nodiscard]] Result<TrainProgram> programTrain(const PulseTrain& train, Channel channel);

/// Makes a channel respond to our trigger only: no trigger inputs, stored trains, bursts or delays; it rests at 0 V.
[[nodiscard]] std::vector<CommandBytes> quietChannel(Channel channel);

}  // namespace tacto::pulsepal
