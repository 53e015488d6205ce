#include "tests/support/Allocations.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t allocations = 0;
}

std::size_t tacto::test::allocationsOfThisThread() noexcept { return allocations; }

#ifdef TACTOSCOPE_SANITIZED
bool tacto::test::countsAllocations() noexcept { return false; }
#else
bool tacto::test::countsAllocations() noexcept { return true; }

// In a file of its own, so that the compiler cannot inline a call of new into its delete.
void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif
