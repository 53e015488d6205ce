// Published.h - a test's thread and umockdev's hand objects to each other through GLib, whose locks the thread
// sanitizer cannot see; it does see this.
#pragma once

#include <atomic>

namespace tacto::test {

inline std::atomic<unsigned> publications{0};

/// One side is done with an object and lets the other have it.
inline void publish() noexcept { publications.fetch_add(1, std::memory_order_acq_rel); }

/// The other side takes it over.
inline void takeOver() noexcept { (void)publications.load(std::memory_order_acquire); }

/// The object behind the pointer that umockdev hands back.
template <class T>
[[nodiscard]] T& seen(void* user) noexcept {
    takeOver();
    return *static_cast<T*>(user);
}

}  // namespace tacto::test
