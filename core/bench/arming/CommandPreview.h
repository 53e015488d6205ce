// CommandPreview.h - how the gate would judge a command, before a bench is open: the same in the window and in the
// terminal.
//
// The train goes to an ideal voltage source (any amplitude up to 500 V, any width, no gap of its own) into a declared
// load, ± 20 %, on the bench.
//
// Thread-safety: pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/bench/Profile.h"
#include "core/devices/Device.h"
#include "core/encoding/Encoder.h"
#include "core/safety/GateSetup.h"
#include "core/safety/SourceTraits.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

struct CommandPreview {
    Ohms impedance{0};              ///< the load's impedance at the end of the leading phase
    std::vector<ExposureRow> rows;  ///< exposureTable() of the train
    std::optional<Error> refusal;   ///< the gate's; nothing where it approves
};

/// Errors: as validate() of an encoding and SafetyGate::configure().
[[nodiscard]] Result<CommandPreview> previewOf(const Command& command, const Profile& profile,
                                               const std::vector<LimitSet>& limits, const Load& load);

// Whether a profile fits the devices of a bench: whether the stimulator can deliver what it asks for,
// known when the bench opens rather than at the first train that the gate refuses, and whether its scales are of this
// fingertip.
//
// These are warnings and refuse nothing: a protocol may use amplitudes of its own, a profile whose upper end is out of
// reach still drives its lower end, and scales of another fingertip are left aside (core/dsp/RoughnessChain.h).

/// One sentence that names the profile, the device, the most that it delivers and what to do; nothing where the device
/// reaches the profile's largest amplitude at one load at least of the profile's range.
[[nodiscard]] std::optional<std::string> beyondReach(const Profile& profile, const SourceTraits& source,
                                                     std::string_view device);

/// One sentence that names both serial numbers and what becomes of R and pressure; nothing where the profile holds no
/// scales of another fingertip than `serial`.
[[nodiscard]] std::optional<std::string> madeWithAnother(const Profile& profile, std::string_view serial);

// What an operator confirms before the output goes live: which device, into what, and how much at most.
// A confirmation is of this text and of no other: another unit, load, profile or electrode has another text, and arming
// refuses the confirmation that was given for the first (hazard H12).
//
// Plain ASCII without quotes or anything that a shell or a terminal would act on, whatever a device calls itself, so
// that it can be shown, pasted and compared.

/// As "P24 P24-0017 into 1 kohm, up to 40 V and 50 mA, electrode area 3 cm2". The amplitudes are the largest of the
/// profile's encoding over the load range that the limits are judged over. `source` is null for a massager, which has
/// neither load nor electrodes.
[[nodiscard]] std::string armingText(const DeviceIdentity& output, const SourceTraits* source, const Profile& profile,
                                     OutputMode mode, const Load& load);

}  // namespace tacto
