#include "drivers/usb/UsbInbox.h"

#include <algorithm>
#include <libusb.h>

#include "drivers/usb/UsbError.h"
#include "drivers/usb/UsbOutbox.h"

namespace tacto {

struct UsbInbox::Callbacks {
    static void LIBUSB_CALL received(libusb_transfer* transfer) noexcept {
        auto& slot = *static_cast<Slot*>(transfer->user_data);
        auto& self = *slot.inbox;
        const std::lock_guard lock(self.line_.mutex);
        slot.flying = false;
        // A cancelled or failed transfer may also carry bytes, which came before it ended.
        const auto length = static_cast<std::size_t>(std::clamp(transfer->actual_length, 0, transfer->length));
        self.arrived_.push(std::span(slot.bytes).first(length));
        switch (transfer->status) {
            case LIBUSB_TRANSFER_COMPLETED:
                if (!self.closed_ && self.failure_ == 0) {
                    slot.flying = self.line_.submit(transfer) == 0;
                    if (!slot.flying && !self.line_.gone) self.failure_ = LIBUSB_TRANSFER_ERROR;
                }
                break;
            case LIBUSB_TRANSFER_CANCELLED:
                break;
            case LIBUSB_TRANSFER_NO_DEVICE:
                self.line_.gone = true;
                break;
            default:
                if (self.failure_ == 0) self.failure_ = transfer->status;
        }
        self.line_.changed.notify_all();
    }
};

UsbInbox::UsbInbox(UsbDevice& device, UsbLine& line, UsbOutbox& outbox, const UsbBulkPair& pair, std::size_t transfers,
                   std::size_t ringBytes)
    : device_(device), line_(line), outbox_(outbox), endpoint_(pair.in), slots_(transfers), arrived_(ringBytes) {
    for (auto& slot : slots_) {
        slot.inbox = this;
        slot.transfer.reset(libusb_alloc_transfer(0));
        if (slot.transfer == nullptr) throw std::bad_alloc();
        slot.bytes.resize(pair.inPacket);
        libusb_fill_bulk_transfer(slot.transfer.get(), device_.handle(), endpoint_, slot.bytes.data(),
                                  static_cast<int>(slot.bytes.size()), &Callbacks::received, &slot, 0);
    }
}

UsbInbox::~UsbInbox() { close(); }

Result<void> UsbInbox::start() {
    const std::lock_guard lock(line_.mutex);
    return startLocked();
}

Result<void> UsbInbox::startLocked() {
    for (auto& slot : slots_) {
        if (const int code = line_.submit(slot.transfer.get()); code != 0) {
            return tl::unexpected(usbError(code, device_.label(), "starting to read"));
        }
        slot.flying = true;
    }
    return {};
}

bool UsbInbox::anyFlying() const noexcept { return std::ranges::any_of(slots_, &Slot::flying); }

void UsbInbox::cancelAll() noexcept {
    for (auto& slot : slots_) {
        if (slot.flying) libusb_cancel_transfer(slot.transfer.get());
    }
}

Error UsbInbox::recover(std::unique_lock<std::mutex>& lock) {
    auto told = usbTransferError(failure_, device_.label(), "reading");
    cancelAll();
    line_.changed.wait(lock, [&] { return !anyFlying(); });
    lock.unlock();
    const auto cleared = device_.clearHalt(endpoint_);
    lock.lock();
    if (!cleared) return cleared.error();  // failure_ is kept, so the next read() tries again
    failure_ = 0;
    if (const auto started = startLocked(); !started) {
        if (!line_.gone) failure_ = LIBUSB_TRANSFER_ERROR;
        return started.error();
    }
    return told;
}

Result<std::size_t> UsbInbox::read(std::span<std::uint8_t> into, Seconds timeout) {
    const auto deadline = deadlineAfter(timeout);
    if (!deadline) {
        return fail(ErrorCode::InvalidArgument, "{}: the time-out of a read is {} s; {}", device_.label(),
                    timeout.count(), kTimeoutRange);
    }
    if (into.empty()) {
        return fail(ErrorCode::InvalidArgument, "{}: a read has room for 0 bytes; 1 or more was expected",
                    device_.label());
    }
    std::unique_lock lock(line_.mutex);
    const auto decided = [&] { return !arrived_.empty() || line_.gone || failure_ != 0; };
    line_.changed.wait_until(lock, *deadline, [&] { return decided() || outbox_.wantsTending(); });
    if (outbox_.wantsTending()) {
        outbox_.tend(lock);
        line_.changed.wait_until(lock, *deadline, decided);
    }
    if (!arrived_.empty()) return arrived_.pop(into);
    if (line_.gone) return tl::unexpected(usbError(LIBUSB_ERROR_NO_DEVICE, device_.label(), "reading"));
    if (failure_ != 0) return tl::unexpected(recover(lock));
    return fail(ErrorCode::Timeout, "{}: nothing came within {} s", device_.label(), timeout.count());
}

std::uint64_t UsbInbox::dropped() const noexcept {
    const std::lock_guard lock(line_.mutex);
    return arrived_.dropped();
}

void UsbInbox::close() noexcept {
    std::unique_lock lock(line_.mutex);
    closed_ = true;
    cancelAll();
    line_.changed.wait(lock, [&] { return !anyFlying(); });
}

}  // namespace tacto
