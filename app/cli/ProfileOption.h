// ProfileOption.h - the profile that a command is run with.
//
// Thread-safety: the main thread only.
#pragma once

#include "app/cli/Command.h"
#include "core/bench/Profile.h"

namespace tacto::cli {

/// The profile of --profile, else the shipped one. Errors: as loadProfile().
[[nodiscard]] Result<Profile> profileOption(const QCommandLineParser& parser);

}  // namespace tacto::cli
