// Shipped.h - the profile, limit sets and instrument profiles that are built into the program: no file and no
// environment variable replaces them (hazards H1 and H9). Additional limit sets in the folder limits/ of the resources
// apply too, so they can only tighten the limits; every list of limits names them.
//
// Thread-safety: reads files; any thread.
#pragma once

#include <string>
#include <vector>

#include "core/bench/Profile.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

/// Errors: as parseProfile(); none in a tested program.
[[nodiscard]] Result<Profile> shippedProfile();

struct ShippedLimits {
    std::vector<LimitSet> sets;
    std::vector<std::string> sha256;  ///< digest of each set's file, in the same order
    std::vector<std::string> from;    ///< path of each set's file, in the same order; empty for a built-in set
};
/// Errors: as parseLimitSet(); ParseError for a file in the resources' limits/ that would replace a built-in set, or
/// that allows more than a built-in row of the same quantity.
[[nodiscard]] Result<ShippedLimits> shippedLimits();

/// Returns resources/instruments. Errors: as parseInstrumentProfile(); none in a tested program.
[[nodiscard]] Result<std::vector<InstrumentProfile>> shippedInstruments();

/// Returns "Limit sets in force beside the built-in ones: lab-x (/lab/limits/lab-x.json).", or an empty text.
[[nodiscard]] std::string addedLimitsText(const ShippedLimits& limits);

}  // namespace tacto
