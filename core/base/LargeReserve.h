// LargeReserve.h - room for many elements that are about to be filled.
//
// Every fresh page of memory that is touched costs a fault, several microseconds on a virtual machine: of 64 MB, more
// than what is then done with it. Where the kernel has huge pages to give (Linux, "madvise" or "always" in
// /sys/kernel/mm/transparent_hugepage/enabled), it is asked for them: one fault for 512 pages. Elsewhere this is
// reserve().
//
// Thread-safety: as the vector's.
#pragma once

#include <cstddef>
#include <vector>

namespace tacto {

/// The whole pages of a block are marked; smaller blocks than a few pages are left alone. Never fails.
void askForHugePages(void* block, std::size_t bytes) noexcept;

template <class T>
void reserveLarge(std::vector<T>& vector, std::size_t elements) {
    vector.reserve(elements);
    askForHugePages(vector.data(), vector.capacity() * sizeof(T));
}

}  // namespace tacto
