// Shipped.h - the profile and the limit sets that come with the program.
//
// Thread-safety: reads files; any thread.
#pragma once

#include <string>
#include <vector>

#include "core/bench/Profile.h"

namespace tacto {

/// Errors: as loadProfile(), and when the resources folder is missing.
[[nodiscard]] Result<Profile> shippedProfile();

struct ShippedLimits {
    std::vector<LimitSet> sets;
    std::vector<std::string> sha256;  ///< of each set's file, in the same order
};
/// Errors: as parseLimitSet(), and when the resources folder or every set in it is missing.
[[nodiscard]] Result<ShippedLimits> shippedLimits();

}  // namespace tacto
