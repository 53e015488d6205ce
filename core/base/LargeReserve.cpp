#include "core/base/LargeReserve.h"

#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>

namespace tacto {

void askForHugePages(void* block, std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t kMinBytes = 0x40000;
    if (block == nullptr || bytes < kMinBytes) return;
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(block) % page) % page;
    // A kernel without huge pages returns an error, which has no effect.
    static_cast<void>(::madvise(static_cast<char*>(block) + before, (bytes - before) / page * page, MADV_HUGEPAGE));
#else
    static_cast<void>(block);
    static_cast<void>(bytes);
#endif
}

}  // namespace tacto
