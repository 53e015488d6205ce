// Counts what this program allocates, alone in a file so that no call of new is inlined into its delete.
#ifndef TACTOSCOPE_SANITIZED  // the sanitizers bring their own
#include <atomic>
#include <cstdlib>
#include <new>

extern std::atomic<long> allocationsMade;
std::atomic<long> allocationsMade{0};

void* operator new(std::size_t bytes) {
    allocationsMade.fetch_add(1, std::memory_order_relaxed);
    void* room = std::malloc(bytes > 0 ? bytes : 1);
    if (room == nullptr) throw std::bad_alloc();
    return room;
}
void operator delete(void* room) noexcept { std::free(room); }
void operator delete(void* room, std::size_t) noexcept { std::free(room); }
#endif
