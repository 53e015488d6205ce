// AllDrivers.h - every driver of the programs, in the one place that names them. All share one USB context.
//
// Thread-safety: the maker may be called from any thread; each registry has one caller.
#pragma once

#include <functional>

#include "core/devices/Driver.h"

namespace tacto {

/// Registries of everything this version can open.
[[nodiscard]] std::function<Registry()> allDrivers();

}  // namespace tacto
