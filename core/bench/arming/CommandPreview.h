// CommandPreview.h - how the gate would judge a command, before a bench is open; the window and the terminal show the
// same result.
//
// The preview assumes an ideal voltage source (any amplitude up to 500 V, any width, no gap of its own) that drives a
// declared load, ± 20 %, on the bench.
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
    std::vector<ExposureRow> rows;  ///< the train's exposureTable()
    std::optional<Error> refusal;   ///< the gate's refusal; nothing if it approves
};

/// Errors: as validate() for an encoding, and as SafetyGate::configure().
[[nodiscard]] Result<CommandPreview> previewOf(const Command& command, const Profile& profile,
                                               const std::vector<LimitSet>& limits, const Load& load);

// Checks whether a profile fits the devices of a bench: whether the stimulator can deliver the profile's
// amplitudes, and whether the profile's scales belong to this fingertip. Checked when the bench opens, before a train.
//
// The results are warnings and refuse nothing: a protocol may use its own amplitudes, a profile with an unreachable
// upper end still drives its lower end, and scales of another fingertip are unused (core/dsp/RoughnessChain.h).

/// Returns one sentence with the profile, the device, its largest output and what to do; nothing if the device
/// reaches the profile's largest amplitude for at least one load in the profile's range.
[[nodiscard]] std::optional<std::string> beyondReach(const Profile& profile, const SourceTraits& source,
                                                     std::string_view device);

/// Returns one sentence with both serial numbers and the consequence for R and pressure; nothing unless the profile's
/// scales belong to a fingertip other than `serial`.
[[nodiscard]] std::optional<std::string> madeWithAnother(const Profile& profile, std::string_view serial);

// The text that an operator confirms before the output goes live: the device, the load and the largest output.
// A confirmation holds for this text only: with another unit, load, profile or electrode the text differs, and arming
// refuses the confirmation of the earlier text (hazard H12).
//
// The text is plain ASCII without quotes or other characters that a shell or terminal would interpret, whatever the
// device's name contains, so that it can be shown, pasted and compared.

/// Example: "P24 P24-0017 into 1 kohm, up to 40 V and 50 mA, electrode area 3 cm2". The amplitudes are the largest that
/// the profile's encoding gives over the load range that the limits use. `source` is null for a massager, which has
/// neither load nor electrodes.
[[nodiscard]] std::string armingText(const DeviceIdentity& output, const SourceTraits* source, const Profile& profile,
                                     OutputMode mode, const Load& load);

}  // namespace tacto
