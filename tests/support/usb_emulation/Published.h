// Published.h - a test's thread and umockdev's thread pass objects to each other through GLib, with locks that the
// thread sanitizer does not see. These functions make the hand-over visible to it.
//
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <memory>
#include <umockdev.h>

namespace tacto::test {

inline std::atomic<unsigned> publications{0};

/// Called when one side has finished with an object and passes it on.
inline void publish() noexcept { publications.fetch_add(1, std::memory_order_acq_rel); }

/// Called when the other side takes the object over.
inline void takeOver() noexcept { (void)publications.load(std::memory_order_acquire); }

/// Connects `callback` to a signal of umockdev. `emulation` lives as long as the handler, which a program that still
/// has the node open keeps alive: a test may finish with a device before the program does.
template <class T>
void connect(UMockdevIoctlBase* handler, const char* signal, GCallback callback, const std::shared_ptr<T>& emulation) {
    const auto release = [](void* user, GClosure*) {
        takeOver();
        delete static_cast<std::shared_ptr<T>*>(user);
    };
    g_signal_connect_data(handler, signal, callback, new std::shared_ptr<T>(emulation), release, GConnectFlags{});
}

/// Returns the object behind the pointer that umockdev passes back. The pointer is deleted after its last reading.
template <class T>
[[nodiscard]] T& seen(void* user) noexcept {
    takeOver();
    T& object = **static_cast<std::shared_ptr<T>*>(user);
    publish();
    return object;
}

}  // namespace tacto::test
