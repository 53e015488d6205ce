// Profiles.h - the shipped profile and limit sets, and what --profile puts in their place.
//
// Thread-safety: reads files; the main thread.
#pragma once

#include <QCommandLineParser>
#include <string>
#include <vector>

#include "core/bench/Profile.h"

namespace tacto::cli {

/// The profile of --profile, else the shipped one. Errors: as loadProfile().
[[nodiscard]] Result<Profile> profileOption(const QCommandLineParser& parser);

struct ShippedLimits {
    std::vector<LimitSet> sets;
    std::vector<std::string> sha256;  ///< of each set's file, in the same order
};
/// Errors: as loadLimitSet(), and when the resources folder is missing.
[[nodiscard]] Result<ShippedLimits> shippedLimits();

}  // namespace tacto::cli
