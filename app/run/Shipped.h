// Shipped.h - the profile, the limit sets and the instrument profiles that come with the program, built into it: no
// file and no environment variable replaces them (hazards H1 and H9). A limit set in the folder limits/ of the
// resources that is none of them is in force as well, so it can only tighten, and is named wherever limits are.
//
// Thread-safety: reads files; any thread.
#pragma once

#include <string>
#include <vector>

#include "core/bench/Profile.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

/// Errors: as parseProfile(); none in a program whose tests pass.
[[nodiscard]] Result<Profile> shippedProfile();

struct ShippedLimits {
    std::vector<LimitSet> sets;
    std::vector<std::string> sha256;  ///< digest of each set's file, in the same order
    std::vector<std::string> from;    ///< where each one's file lies; empty for a built-in one; in the same order
};
/// Errors: as parseLimitSet(); ParseError for a file in the resources' limits/ that would take the place of a built-in
/// set, or that allows more than a built-in row of the same quantity.
[[nodiscard]] Result<ShippedLimits> shippedLimits();

/// resources/instruments. Errors: as parseInstrumentProfile(); none in a program whose tests pass.
[[nodiscard]] Result<std::vector<InstrumentProfile>> shippedInstruments();

/// "Limit sets in force beside the built-in ones: lab-x (/lab/limits/lab-x.json)."; empty without any.
[[nodiscard]] std::string addedLimitsText(const ShippedLimits& limits);

}  // namespace tacto
