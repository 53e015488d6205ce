// CaptureLoad.h - what one capture shows of its pulses: of the load that they met, for a stimulator that cannot read it
// back, of their amplitude, and whether they are what was commanded.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <span>

#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/bench/Telemetry.h"
#include "core/encoding/PulseTrain.h"
#include "core/measure/Capture.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

struct SeenLoad {
    Ohms impedance;        ///< |Z| at the end of the leading phase (science.md section 4), mean over the pulses
    bool atLeast = false;  ///< the voltage drove no current that the channel could show: |Z| is this or more
    Instant at{0};         ///< when it was triggered
};

/// The size of a train as it came out, beside the size that it should have had; V or mA by the stimulator's drive.
struct SeenAmplitude {
    const char* by = "the oscilloscope shows";  ///< begins the sentence of a fault
    double amplitude = 0;
    double expected = 0;     ///< NaN: no command, or more than one
    double programmed = 0;   ///< for it
    double uncertainty = 0;  ///< half-width for `amplitude`, as its instrument states it
    double unstated = 0;     ///< the uncertainty where none is stated: it proves no limit broken, and excuses nothing
    Instant onset{0};
    bool isCheck = false;
};

/// The one command that a record shows, by its time: nothing where it shows none, or a part of two that differ, since a
/// reading of both is one of neither. `programmed` are the last commands, with none missing between them.
[[nodiscard]] std::optional<ProgrammedTrain> commandShownIn(const Capture& capture,
                                                            std::span<const ProgrammedTrain> programmed);

/// The amplitude of the voltage, or of the current, in a record of `command`, without one of what it shows:
/// the pulse furthest off, and where that is beyond the range, the least that it can be. Where the device has
/// acknowledged the command, no pulse is found and none could be missed, it is how far the signal moves at most.
/// Nothing without exactly one channel in V and one in A, and else without a pulse that was measured.
[[nodiscard]] std::optional<SeenAmplitude> amplitudeSeenIn(const Capture& capture, const SourceTraits& source,
                                                           const ProgrammedTrain& command = {});

/// Nothing for a record without a trigger, without a channel in V and one in A, or without a measured pulse.
[[nodiscard]] std::optional<SeenLoad> loadSeenIn(const Capture& capture);

/// |Z| of the load, where `capture` shows `commanded`: a voltage or a current within 20 % and the reading's own
/// uncertainty of it. Errors: NotArmed, saying what the oscilloscope shows instead, or that it shows no load.
[[nodiscard]] Result<Ohms> loadConfirmedBy(const Capture& capture, const PulseTrain& commanded);

}  // namespace tacto
