// Lock order: libusb calls our callbacks (hot-plug, transfers) while it holds locks that libusb_open() and
// libusb_close() also take. So mutex_, which a callback takes, is never held during a call that can wait inside libusb.
#include "drivers/usb/UsbContext.h"

#include <algorithm>
#include <csignal>
#include <libusb.h>
#include <pthread.h>

#include "drivers/usb/UsbError.h"
#include "drivers/usb/UsbLine.h"

namespace tacto {

struct UsbContext::Callbacks {
    static int LIBUSB_CALL plugged(libusb_context* /*context*/, libusb_device* device, libusb_hotplug_event event,
                                   void* user) noexcept {
        auto& self = *static_cast<UsbContext*>(user);
        libusb_device* gone = nullptr;
        try {
            const std::lock_guard lock(self.mutex_);
            const auto known = std::ranges::find(self.present_, device);
            if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED && known == self.present_.end()) {
                self.present_.push_back(device);
                libusb_ref_device(device);
            } else if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT && known != self.present_.end()) {
                gone = *known;
                self.present_.erase(known);
            } else {
                return 0;  // already listed: registering lists all devices, and one may arrive meanwhile
            }
        } catch (...) {
            return 0;  // no memory for one more entry: the device stays unlisted until it is plugged in again
        }
        if (gone != nullptr) libusb_unref_device(gone);
        return 0;
    }
};

Result<std::shared_ptr<UsbContext>> UsbContext::start() {
    std::shared_ptr<UsbContext> made(new UsbContext);
    if (const int code = libusb_init(&made->context_); code != 0) {
        made->context_ = nullptr;
        return fail(ErrorCode::Io, "USB: libusb does not start here: {}; a system with USB and udev was expected",
                    libusb_error_name(code));
    }
    if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) == 0) {
        return fail(ErrorCode::Unsupported,
                    "USB: this libusb cannot report plugging; one built with udev was expected");
    }
    const int code = libusb_hotplug_register_callback(
        made->context_, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
        LIBUSB_HOTPLUG_ENUMERATE, LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY,
        &Callbacks::plugged, made.get(), &made->hotplug_);
    if (code != 0) return tl::unexpected(usbError(code, "USB", "listening for plugged devices"));
    // Blocks signals here: they belong to the program's own threads, and no Ctrl-C handler may run during a callback.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    made->events_ = std::thread([self = made.get()] { self->runEvents(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return made;
}

UsbContext::~UsbContext() {
    if (context_ == nullptr) return;
    if (hotplug_ >= 0) libusb_hotplug_deregister_callback(context_, hotplug_);
    ending_ = true;
    libusb_interrupt_event_handler(context_);
    if (events_.joinable()) events_.join();
    for (auto* device : present_) libusb_unref_device(device);
    libusb_exit(context_);
}

void UsbContext::runEvents() noexcept {
    while (!ending_) {
        timeval timeout{60, 0};
        const int code = libusb_handle_events_timeout_completed(context_, &timeout, nullptr);
        // A lasting error must not keep a whole core busy.
        if (code != 0 && code != LIBUSB_ERROR_INTERRUPTED) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

std::vector<libusb_device*> UsbContext::present() const {
    const std::lock_guard lock(mutex_);
    for (auto* device : present_) libusb_ref_device(device);
    return present_;
}

std::vector<UsbDeviceInfo> UsbContext::devices() const {
    std::vector<UsbDeviceInfo> list;
    for (auto* device : present()) {
        list.push_back(describe(device));
        libusb_unref_device(device);
    }
    std::ranges::sort(list, {}, &UsbDeviceInfo::path);
    return list;
}

Result<UsbDeviceInfo> UsbContext::find(const UsbIdentity& wanted, std::string_view socket) const {
    auto list = devices();
    std::erase_if(list, [&](const auto& info) { return !info.is(wanted) || (!socket.empty() && info.path != socket); });
    if (list.empty()) {
        return fail(ErrorCode::NotFound, "no USB device {:04x}:{:04x}{} is plugged in", wanted.vendor, wanted.product,
                    wanted.serial.empty() ? "" : " with serial number " + wanted.serial);
    }
    if (list.size() > 1) {
        std::string all;
        for (const auto& info : list) all += (all.empty() ? "" : ", ") + info.label();
        return fail(ErrorCode::InvalidArgument,
                    "{} devices match {:04x}:{:04x}: {}; a serial number that tells "
                    "them apart was expected",
                    list.size(), wanted.vendor, wanted.product, all);
    }
    if (!list.front().permitted) return tl::unexpected(Error{ErrorCode::Io, list.front().obstacle()});
    return list.front();
}

Result<libusb_device_handle*> UsbContext::openHandle(const UsbDeviceInfo& info) const {
    libusb_device_handle* handle = nullptr;
    int code = LIBUSB_ERROR_NOT_FOUND;
    for (auto* device : present()) {
        if (code == LIBUSB_ERROR_NOT_FOUND) {
            const auto now = describe(device);
            if (now.path == info.path && now.address == info.address && now.is(info.identity())) {
                code = libusb_open(device, &handle);
            }
        }
        libusb_unref_device(device);
    }
    switch (code) {
        case 0:
            return handle;
        case LIBUSB_ERROR_NOT_FOUND:
        case LIBUSB_ERROR_NO_DEVICE:
            return fail(ErrorCode::NotFound, "{} was unplugged; plug it in and open it again", info.label());
        case LIBUSB_ERROR_ACCESS: {
            auto refused = info;
            refused.permitted = false;
            return tl::unexpected(Error{ErrorCode::Io, refused.obstacle()});
        }
        default:
            return tl::unexpected(usbError(code, info.label(), "opening"));
    }
}

}  // namespace tacto
