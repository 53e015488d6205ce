// UsbContext.h - runs libusb: one context with its own event thread, and the list of plugged-in devices.
//
// All transfer callbacks run on the event thread; no callback calls into a driver or a program.
//
// Ownership: shared. Open devices hold the context, so that it ends after the last of them. It must not be released on
// the event thread; nothing in this library does so.
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "drivers/usb/UsbDeviceInfo.h"

struct libusb_context;
struct libusb_device_handle;

namespace tacto {

class UsbContext {
public:
    /// Starts libusb and its event thread. Errors: Io if libusb does not start (no USB in this system or container);
    /// Unsupported if libusb cannot report plugging and unplugging.
    [[nodiscard]] static Result<std::shared_ptr<UsbContext>> start();
    ~UsbContext();
    UsbContext(const UsbContext&) = delete;
    UsbContext& operator=(const UsbContext&) = delete;

    /// Returns all plugged-in devices in order of socket, including those that may not be opened. Each call checks the
    /// permissions again, because they can change without a re-plug.
    [[nodiscard]] std::vector<UsbDeviceInfo> devices() const;

    /// Returns the only device of this identity, in `socket` ("1-4.2") if one is given. Errors: NotFound;
    /// InvalidArgument if several match, naming their serial numbers; Io if it may not be opened, with a sentence that
    /// says what helps.
    [[nodiscard]] Result<UsbDeviceInfo> find(const UsbIdentity& wanted, std::string_view socket = {}) const;

    /// Opens a listed device for UsbDevice, if it is still plugged in. The caller closes it, never on the event thread.
    /// Errors: NotFound; Io (not permitted, or the system refused).
    [[nodiscard]] Result<libusb_device_handle*> openHandle(const UsbDeviceInfo& info) const;

private:
    struct Callbacks;  // the functions that libusb calls
    UsbContext() = default;
    void runEvents() noexcept;
    /// Returns references to all present devices; the caller gives each back with libusb_unref_device().
    [[nodiscard]] std::vector<libusb_device*> present() const;

    libusb_context* context_ = nullptr;  // Constant after start()
    int hotplug_ = -1;                   // libusb's number of our registration; constant after start()
    std::thread events_;
    std::atomic<bool> ending_{false};
    mutable std::mutex mutex_;             // never held while libusb opens or closes a device: see UsbContext.cpp
    std::vector<libusb_device*> present_;  // holds a reference to each; guarded by mutex_
};

}  // namespace tacto
