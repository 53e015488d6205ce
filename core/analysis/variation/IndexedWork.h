// IndexedWork.h - the same piece of work for 0..count-1 on several threads, with cancel and progress.
//
// Indices are taken in order and each taken one is finished, so that a cancel always leaves a prefix: 0..done-1 and
// nothing else. Work that writes only to its own index gives the same result whatever the number of threads.
//
// Thread-safety: a call keeps its threads to itself and joins them before it returns. `work` is called from several
// threads at once, `progress` from the calling thread alone.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "core/base/Result.h"

namespace tacto {

struct IndexedWork {
    std::size_t count = 0;
    unsigned threads = 0;  ///< 0: one per core
    std::function<void(std::size_t index)> work;
    std::function<void(std::size_t done)> progress = {};  ///< about every 50 ms, and at the end; may be empty
};

/// Returns how many are done: `count` unless `stop` was requested, after which it returns when the pieces under way are
/// done. Errors: Unsupported with the reason when `work` threw, or a thread could not be had; then none counts.
[[nodiscard]] Result<std::size_t> runIndexed(const IndexedWork& wanted, std::stop_token stop);

}  // namespace tacto
