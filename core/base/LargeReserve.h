// LargeReserve.h - room for many elements that are about to be filled.
//
// The first access to a page of memory causes a fault, which takes several microseconds on a virtual machine; for 64 MB
// this takes longer than the later work on the data. If the kernel offers huge pages (Linux, "madvise" or "always" in
// /sys/kernel/mm/transparent_hugepage/enabled), this asks for them, with one fault for 512 pages. Otherwise
// reserveLarge() is the same as reserve().
//
// Thread-safety: as the vector.
#pragma once

#include <cstddef>
#include <vector>

namespace tacto {

/// Marks the whole pages of a block for the kernel; ignores blocks of only a few pages. Never fails.
void askForHugePages(void* block, std::size_t bytes) noexcept;

template <class T>
void reserveLarge(std::vector<T>& vector, std::size_t elements) {
    vector.reserve(elements);
    askForHugePages(vector.data(), vector.capacity() * sizeof(T));
}

}  // namespace tacto
