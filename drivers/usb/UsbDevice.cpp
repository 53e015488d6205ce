#include "drivers/usb/UsbDevice.h"

#include <algorithm>
#include <condition_variable>
#include <libusb.h>
#include <mutex>

#include "drivers/system/KernelNodes.h"
#include "drivers/usb/UsbError.h"
#include "drivers/usb/UsbLine.h"

namespace tacto {

namespace {

constexpr std::size_t kMaxControl = 4096;  // usbfs takes at most one page

/// Lets a thread wait for the end of one transfer. libusb's own synchronous calls are not used, because they may run
/// all callbacks in the calling thread.
struct Ended {
    std::mutex mutex;
    std::condition_variable changed;
    bool over = false;

    static void LIBUSB_CALL callback(libusb_transfer* transfer) noexcept {
        auto& self = *static_cast<Ended*>(transfer->user_data);
        const std::lock_guard lock(self.mutex);
        self.over = true;
        self.changed.notify_all();  // under the lock: the waiting thread may destroy `self` right after
    }
};

}  // namespace

Result<std::shared_ptr<UsbDevice>> UsbDevice::open(std::shared_ptr<UsbContext> context, const UsbDeviceInfo& info) {
    auto handle = context->openHandle(info);
    if (!handle) return failure(handle);
    return std::shared_ptr<UsbDevice>(new UsbDevice(std::move(context), info, *handle));
}

UsbDevice::~UsbDevice() {
    // A serial port's kernel driver takes both its interfaces at once, so all are released before any is returned. Even
    // an interface that had no driver when claimed is returned, because a killed program may have left it so.
    for (const auto interface : claimed_) libusb_release_interface(handle_, interface);
    for (const auto interface : claimed_) libusb_attach_kernel_driver(handle_, interface);
    libusb_close(handle_);
}

Result<UsbBulkPair> UsbDevice::bulkPair(UsbFunction function) const {
    libusb_config_descriptor* read = nullptr;
    if (const int code = libusb_get_active_config_descriptor(libusb_get_device(handle_), &read); code != 0) {
        return tl::unexpected(usbError(code, label_, "reading its descriptors"));
    }
    const std::unique_ptr<libusb_config_descriptor, void (*)(libusb_config_descriptor*)> configuration(
        read, &libusb_free_config_descriptor);
    return findBulkPair(*configuration, function, label_);
}

Result<void> UsbDevice::claim(std::uint8_t interface) {
    const auto taking = fmt::format("claiming interface {}", interface);
    // 1 means the kernel's own driver. Another program's claim does not show here, but makes the claim below fail.
    if (libusb_kernel_driver_active(handle_, interface) == 1) {
        for (const auto& node : kernelNodesOf(info_.path)) {
            const auto holders = holdersOf(node);
            if (!holders.empty()) return inUse(taking, node, holders);
        }
        if (const int code = libusb_detach_kernel_driver(handle_, interface);
            code != 0 && code != LIBUSB_ERROR_NOT_FOUND) {
            return tl::unexpected(usbError(code, label_, "taking it from the kernel's driver"));
        }
    }
    if (const int code = libusb_claim_interface(handle_, interface); code != 0) {
        if (code == LIBUSB_ERROR_BUSY) return inUse(taking, info_.node(), holdersOf(info_.node()));
        return tl::unexpected(usbError(code, label_, taking));
    }
    claimed_.push_back(interface);
    return {};
}

tl::unexpected<Error> UsbDevice::inUse(const std::string& what, const std::filesystem::path& node,
                                       const std::vector<FileHolder>& holders) const {
    return fail(ErrorCode::Io, "{}: {} failed: {} is held by {}; close that program first", label_, what, node.string(),
                textOf(holders));
}

Result<void> UsbDevice::controlOut(const UsbRequest& request, std::span<const std::uint8_t> data, Seconds timeout) {
    if ((request.type & LIBUSB_ENDPOINT_IN) != 0) {
        return fail(ErrorCode::InvalidArgument, "{}: request type {:#04x} is for input; bit 7 clear was expected",
                    label_, request.type);
    }
    const auto what = fmt::format("request {:#04x}", request.request);
    const auto deadline = deadlineAfter(timeout);
    if (!deadline) {
        return fail(ErrorCode::InvalidArgument, "{}: the time-out of {} is {} s; {}", label_, what, timeout.count(),
                    kTimeoutRange);
    }
    if (data.size() > kMaxControl) {
        return fail(ErrorCode::InvalidArgument, "{}: {} has {} bytes; at most {} were expected", label_, what,
                    data.size(), kMaxControl);
    }
    std::vector<std::uint8_t> bytes(LIBUSB_CONTROL_SETUP_SIZE + data.size());
    libusb_fill_control_setup(bytes.data(), request.type, request.request, request.value, request.index,
                              static_cast<std::uint16_t>(data.size()));
    std::ranges::copy(data, bytes.begin() + LIBUSB_CONTROL_SETUP_SIZE);
    const UsbTransferPtr transfer(libusb_alloc_transfer(0));
    if (transfer == nullptr) return tl::unexpected(usbError(LIBUSB_ERROR_NO_MEM, label_, what));
    Ended ended;
    libusb_fill_control_transfer(transfer.get(), handle_, bytes.data(), &Ended::callback, &ended, 0);
    if (const int code = libusb_submit_transfer(transfer.get()); code != 0) {
        return tl::unexpected(usbError(code, label_, what));
    }
    std::unique_lock lock(ended.mutex);
    if (!ended.changed.wait_until(lock, *deadline, [&] { return ended.over; })) {
        lock.unlock();
        libusb_cancel_transfer(transfer.get());
        lock.lock();
        ended.changed.wait(lock, [&] { return ended.over; });
    }
    if (transfer->status != LIBUSB_TRANSFER_COMPLETED) {
        return tl::unexpected(usbTransferError(transfer->status, label_, what));
    }
    const auto taken = static_cast<std::size_t>(std::max(transfer->actual_length, 0));
    if (taken != data.size()) {
        return fail(ErrorCode::Device, "{}: it took {} bytes of request {:#04x}; {} were expected", label_, taken,
                    request.request, data.size());
    }
    return {};
}

Result<void> UsbDevice::clearHalt(std::uint8_t endpoint) {
    if (const int code = libusb_clear_halt(handle_, endpoint); code != 0) {
        return tl::unexpected(usbError(code, label_, fmt::format("clearing endpoint {:#04x}", endpoint)));
    }
    return {};
}

}  // namespace tacto
