// ExportWatch.h - how an export learns that it was cancelled, and says how far it is.
//
// Thread-safety: both are called on the thread that exports; `stopped` also on another while SQLite asks nothing.
#pragma once

#include <functional>

namespace tacto {

struct ExportWatch {
    std::function<bool()> stopped = {};         ///< asked at least every 0.2 s
    std::function<void(double)> progress = {};  ///< the share done, 0 to 1, never less than before
};

}  // namespace tacto
