// Published.h - a test's thread and umockdev's hand objects to each other through GLib, with locks that the thread
// sanitizer cannot see; it does see this.
//
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <memory>
#include <umockdev.h>

namespace tacto::test {

inline std::atomic<unsigned> publications{0};

/// Called when one side is done with an object and lets the other have it.
inline void publish() noexcept { publications.fetch_add(1, std::memory_order_acq_rel); }

/// The other side takes it over.
inline void takeOver() noexcept { (void)publications.load(std::memory_order_acquire); }

/// Has `callback` answer a signal of umockdev's. What is behind it lives as long as the handler, which a program
/// that still has the node open keeps: a test may be done with a device before the program is.
template <class T>
void connect(UMockdevIoctlBase* handler, const char* signal, GCallback callback, const std::shared_ptr<T>& emulation) {
    const auto release = [](void* user, GClosure*) {
        takeOver();
        delete static_cast<std::shared_ptr<T>*>(user);
    };
    g_signal_connect_data(handler, signal, callback, new std::shared_ptr<T>(emulation), release, GConnectFlags{});
}

/// The object behind the pointer that umockdev hands back.
template <class T>
[[nodiscard]] T& seen(void* user) noexcept {
    takeOver();
    return **static_cast<std::shared_ptr<T>*>(user);
}

}  // namespace tacto::test
