// ProfileReach.h - whether a profile fits the devices of a bench: whether the stimulator can deliver what it asks for,
// known when the bench opens rather than at the first train that the gate refuses, and whether its scales are of this
// fingertip.
//
// These are warnings and refuse nothing: a protocol may use amplitudes of its own, a profile whose upper end is out of
// reach still drives its lower end, and scales of another fingertip are left aside (core/dsp/RoughnessChain.h).
//
// Thread-safety: pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/bench/Profile.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

/// One sentence that names the profile, the device, the most that it delivers and what to do; nothing where the device
/// reaches the profile's largest amplitude at one load at least of the profile's range.
[[nodiscard]] std::optional<std::string> beyondReach(const Profile& profile, const SourceTraits& source,
                                                     std::string_view device);

/// One sentence that names both serial numbers and what becomes of R and pressure; nothing where the profile holds no
/// scales of another fingertip than `serial`.
[[nodiscard]] std::optional<std::string> madeWithAnother(const Profile& profile, std::string_view serial);

}  // namespace tacto
