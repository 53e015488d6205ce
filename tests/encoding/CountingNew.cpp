// Counts what this program allocates. In a file of its own, so that no call of new is inlined into its delete.
#ifndef TACTOSCOPE_SANITIZED  // the sanitizers bring their own
#include <atomic>
#include <cstdlib>
#include <new>

extern std::atomic<long> allocations;
std::atomic<long> allocations{0};

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif
