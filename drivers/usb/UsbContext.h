// UsbContext.h - libusb, running: one context with an event thread of its own, and the list of what is plugged in.
//
// Every transfer's callback runs on the event thread; no callback calls into a driver or a program.
//
// Ownership: shared; open devices hold it, so that it ends after the last of them. It must not be let go on the event
// thread; nothing of this library does.
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
    /// Starts libusb and its event thread. Errors: Io where libusb does not start (no USB in this system or
    /// container); Unsupported where it cannot report plugging and unplugging.
    [[nodiscard]] static Result<std::shared_ptr<UsbContext>> start();
    ~UsbContext();
    UsbContext(const UsbContext&) = delete;
    UsbContext& operator=(const UsbContext&) = delete;

    /// Every device that is plugged in, in order of socket, including those that may not be opened. Permission is
    /// looked up again by each call: it can change without plugging.
    [[nodiscard]] std::vector<UsbDeviceInfo> devices() const;

    /// The one device of this identity, in this socket ("1-4.2") where one is named. Errors: NotFound; InvalidArgument
    /// where several match, naming their serial numbers; Io for one that may not be opened, with the sentence that
    /// helps.
    [[nodiscard]] Result<UsbDeviceInfo> find(const UsbIdentity& wanted, std::string_view socket = {}) const;

    /// Opens a listed device for UsbDevice, if it was not unplugged meanwhile. The caller closes it, never on the event
    /// thread. Errors: NotFound; Io (not permitted, or the system refused).
    [[nodiscard]] Result<libusb_device_handle*> openHandle(const UsbDeviceInfo& info) const;

private:
    struct Callbacks;  // the functions that libusb calls
    UsbContext() = default;
    void runEvents() noexcept;
    /// References to all that is plugged in, each to be given back with libusb_unref_device().
    [[nodiscard]] std::vector<libusb_device*> present() const;

    libusb_context* context_ = nullptr;  // Constant after start()
    int hotplug_ = -1;                   // libusb's number of our registration; constant after start()
    std::thread events_;
    std::atomic<bool> ending_{false};
    mutable std::mutex mutex_;             // never held while libusb opens or closes: see UsbContext.cpp
    std::vector<libusb_device*> present_;  // referenced; guarded by mutex_
};

}  // namespace tacto
