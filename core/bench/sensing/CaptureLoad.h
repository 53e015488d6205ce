// CaptureLoad.h - what one capture shows of its pulses: their load (for a stimulator that cannot read it back), their
// amplitude, and whether they match the command.
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
    bool atLeast = false;  ///< true if the current was too small to see: |Z| is at least this
    Instant at{0};         ///< the time of the trigger
};

/// The measured and the expected amplitude of a train; V or mA, depending on the stimulator's drive.
struct SeenAmplitude {
    const char* by = "the oscilloscope shows";  ///< begins the text of a fault
    double amplitude = 0;
    double expected = 0;     ///< NaN: no command, or several commands
    double programmed = 0;   ///< the programmed value
    double uncertainty = 0;  ///< half-width of `amplitude`, as stated for the instrument
    double unstated = 0;     ///< uncertainty if none is stated; can neither prove a broken limit nor excuse a deviation
    Instant onset{0};
    bool isCheck = false;
};

/// Returns the one command that a record shows, by its time. Nothing if it shows none, or parts of two that differ,
/// since their common reading fits neither. `programmed` are the last commands, with none missing between them.
[[nodiscard]] std::optional<ProgrammedTrain> commandShownIn(const Capture& capture,
                                                            std::span<const ProgrammedTrain> programmed);

/// Returns the amplitude of the voltage or current in a record of `command` (without a command: of any pulse), taken
/// from the pulse furthest off; if it exceeds the range, the least possible value. If the device acknowledged the
/// command, and no pulse is found and none could be missed, returns the signal's largest swing. Nothing unless exactly
/// one channel is in V and one in A; otherwise nothing without a measured pulse.
[[nodiscard]] std::optional<SeenAmplitude> amplitudeSeenIn(const Capture& capture, const SourceTraits& source,
                                                           const ProgrammedTrain& command = {});

/// Returns nothing for a record without a trigger, without one channel in V and one in A, or without a measured pulse.
[[nodiscard]] std::optional<SeenLoad> loadSeenIn(const Capture& capture);

/// Returns |Z| of the load if `capture` shows the voltage or current of `commanded` within 20 % plus the reading's
/// uncertainty. Errors: NotArmed, saying what the oscilloscope shows instead, or that it shows no load.
[[nodiscard]] Result<Ohms> loadConfirmedBy(const Capture& capture, const PulseTrain& commanded);

}  // namespace tacto
