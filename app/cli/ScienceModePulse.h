// ScienceModePulse.h - `sciencemode pulse`: one pulse into a bench load; its read-back is plotted and saved.
#pragma once

#include <QCommandLineParser>
#include <array>

#include "core/base/Result.h"
#include "core/devices/DeviceUri.h"

namespace tacto::cli {

inline constexpr std::array<const char*, 7> kPulseOptions{"current",        "width", "gap",        "load",
                                                          "yes-bench-load", "out",   "reset-fault"};

void declarePulse(QCommandLineParser& parser);

/// Returns the address in --device, or sciencemode:. Errors: InvalidArgument for no URI or another kind of device.
[[nodiscard]] Result<DeviceUri> scienceModeUri(const QCommandLineParser& parser);

/// Runs the whole command and returns its exit code.
[[nodiscard]] int pulse(const QCommandLineParser& parser);

}  // namespace tacto::cli
