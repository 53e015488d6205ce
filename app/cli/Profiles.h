// Profiles.h - the profile that --profile asks for.
//
// Thread-safety: reads files; the main thread.
#pragma once

#include <QCommandLineParser>

#include "app/run/Shipped.h"

namespace tacto::cli {

/// The profile of --profile, else the shipped one. Errors: as loadProfile().
[[nodiscard]] Result<Profile> profileOption(const QCommandLineParser& parser);

}  // namespace tacto::cli
