// ScienceModePulse.h - `sciencemode pulse`: one pulse into a bench load, with its read-back drawn and saved.
#pragma once

#include <QCommandLineParser>
#include <array>

#include "core/base/Result.h"
#include "core/devices/DeviceUri.h"

namespace tacto::cli {

inline constexpr std::array<const char*, 7> kPulseOptions{"current",        "width", "gap",        "load",
                                                          "yes-bench-load", "out",   "reset-fault"};

void declarePulse(QCommandLineParser& parser);

/// From --device, or sciencemode:. Errors: InvalidArgument for what is not a URI or names another kind of device.
[[nodiscard]] Result<DeviceUri> scienceModeUri(const QCommandLineParser& parser);

/// The whole command; the value is its exit code.
[[nodiscard]] int pulse(const QCommandLineParser& parser);

}  // namespace tacto::cli
