// ProfileReach.h - whether a stimulator can deliver what a profile asks for, known when the bench opens rather than at
// the first train that the gate refuses.
//
// It is a warning and refuses nothing: a protocol may use amplitudes of its own, and a profile whose upper end is out
// of reach still drives its lower end.
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

}  // namespace tacto
