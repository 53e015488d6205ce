// ScopeRange.h - the settings that every oscilloscope accepts or refuses alike, whether real, simulated or replayed.
//
// Thread-safety: pure function.
#pragma once

#include "core/base/Result.h"
#include "core/devices/Oscilloscope.h"

namespace tacto {

inline constexpr double kMinScopeRate_hz = 100;     ///< below it no phase of a pulse is seen
inline constexpr double kMaxScopeRange_V = 10'000;  ///< with a high-voltage probe
inline constexpr double kMaxScopeRange_A = 1000;

/// An instrument may refuse more, such as a rate that it does not have. Errors: InvalidArgument naming the setting,
/// its value and its range.
[[nodiscard]] Result<void> checkScopeRange(const ScopeSettings& settings, const ScopeTraits& traits);

}  // namespace tacto
