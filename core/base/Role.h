// Role.h - what a device is to the bench, and the word for it in addresses, files and results.
//
// Thread-safety: pure functions.
#pragma once

#include "core/base/Words.h"

namespace tacto {

enum class Role { Sensor, Stimulator, Oscilloscope, Massager };
inline constexpr Word<Role> kRoles[] = {{"sensor", Role::Sensor},
                                        {"stimulator", Role::Stimulator},
                                        {"oscilloscope", Role::Oscilloscope},
                                        {"massager", Role::Massager}};
[[nodiscard]] constexpr std::string_view nameOf(Role role) noexcept { return wordFor(kRoles, role, "device"); }

}  // namespace tacto
