// IndexedWork.h - runs the same work for every index 0..count-1 on several threads, with cancel and progress.
//
// Threads take the indices in order and finish every index they take. A cancelled call has therefore done exactly the
// indices 0..done-1. If work writes only to its own index, the result does not depend on the number of threads.
//
// Thread-safety: a call starts its own threads and joins them before it returns. `work` is called from several threads
// at once, `progress` only from the calling thread.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "core/base/Result.h"

namespace tacto {

struct IndexedWork {
    std::size_t count = 0;
    unsigned threads = 0;  ///< 0: one thread per core
    std::function<void(std::size_t index)> work;
    std::function<void(std::size_t done)> progress = {};  ///< called about every 50 ms and at the end; may be empty
};

/// Returns the number of finished indices. This is `count` unless `stop` was requested; then the call returns once the
/// started work is done. Errors: Unsupported with the reason if `work` threw or no thread could start.
[[nodiscard]] Result<std::size_t> runIndexed(const IndexedWork& wanted, std::stop_token stop);

}  // namespace tacto
