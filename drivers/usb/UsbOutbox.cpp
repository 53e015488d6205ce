#include "drivers/usb/UsbOutbox.h"

#include <algorithm>
#include <libusb.h>

#include "drivers/usb/UsbError.h"

namespace tacto {

namespace {

/// How long close() lets a stop reach the device: ten times what a busy full-speed bus needs for 64 bytes.
constexpr auto kCloseTimeout = std::chrono::milliseconds(100);

}  // namespace

struct UsbOutbox::Callbacks {
    static void LIBUSB_CALL sent(libusb_transfer* transfer) noexcept {
        auto& self = *static_cast<UsbOutbox*>(transfer->user_data);
        const std::lock_guard lock(self.line_.mutex);
        self.sendingNow_ = false;
        self.sendingStatus_ = transfer->status;
        self.sendingTaken_ = static_cast<std::size_t>(std::max(transfer->actual_length, 0));
        ended(self, transfer->status);
    }

    static void LIBUSB_CALL urgentSent(libusb_transfer* transfer) noexcept {
        auto& self = *static_cast<UsbOutbox*>(transfer->user_data);
        const std::lock_guard lock(self.line_.mutex);
        self.urgentNow_ = false;
        if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
            ++self.delivered_;
        } else if (self.nextLength_ == 0 && transfer->status != LIBUSB_TRANSFER_CANCELLED) {
            self.next_ = self.urgentBytes_;  // the device did not get the message: keep it, unless there is a newer one
            self.nextLength_ = self.urgentLength_;
        }
        ended(self, transfer->status);
        // After an error only the device's own thread retries; retrying here too could loop without end.
        const bool fine = transfer->status == LIBUSB_TRANSFER_COMPLETED;
        if (fine && self.nextLength_ != 0) self.submitUrgent();
    }

    static void ended(UsbOutbox& self, int status) noexcept {
        if (status == LIBUSB_TRANSFER_NO_DEVICE) self.line_.gone = true;
        // A stall of the control endpoint ends by itself with the next SETUP packet.
        if (status == LIBUSB_TRANSFER_STALL && self.endpoint_ != 0) self.line_.outHalted = true;
        self.line_.changed.notify_all();
    }
};

UsbOutbox::UsbOutbox(UsbDevice& device, UsbLine& line, std::uint8_t endpoint)
    : device_(device),
      line_(line),
      endpoint_(endpoint),
      sending_(libusb_alloc_transfer(0)),
      urgent_(libusb_alloc_transfer(0)) {
    sent_.reserve(4096);
    if (sending_ == nullptr || urgent_ == nullptr) throw std::bad_alloc();
}

UsbOutbox::~UsbOutbox() { close(); }

void UsbOutbox::fill(libusb_transfer* transfer, std::span<std::uint8_t> buffer, bool urgent) noexcept {
    const auto callback = urgent ? &Callbacks::urgentSent : &Callbacks::sent;
    // No timeout of libusb's is used: the waiting caller cancels.
    if (endpoint_ == 0) {
        libusb_fill_control_transfer(transfer, device_.handle(), buffer.data(), callback, this, 0);
    } else {
        libusb_fill_bulk_transfer(transfer, device_.handle(), endpoint_, buffer.data(), static_cast<int>(buffer.size()),
                                  callback, this, 0);
    }
}

Result<void> UsbOutbox::send(std::span<const std::uint8_t> bytes, Seconds timeout) {
    const auto deadline = deadlineAfter(timeout);
    if (!deadline) {
        return fail(ErrorCode::InvalidArgument, "{}: the time-out of a write is {} s; {}", device_.label(),
                    timeout.count(), kTimeoutRange);
    }
    if (bytes.empty() || bytes.size() > kMaxSend) {
        return fail(ErrorCode::InvalidArgument, "{}: a write has {} bytes; 1 to {} were expected", device_.label(),
                    bytes.size(), kMaxSend);
    }
    std::unique_lock lock(line_.mutex);
    tend(lock);
    line_.changed.wait_until(lock, *deadline, [&] { return line_.gone || !urgentNow_ || nextLength_ == 0; });
    if (!line_.gone && urgentNow_ && nextLength_ != 0) {
        return fail(ErrorCode::Timeout, "{}: a write waited {} s behind a stop that the device does not take",
                    device_.label(), timeout.count());
    }
    sent_.assign(bytes.begin(), bytes.end());
    fill(sending_.get(), sent_, false);
    if (const int code = line_.submit(sending_.get()); code != 0) {
        return tl::unexpected(usbError(code, device_.label(), "writing"));
    }
    sendingNow_ = true;
    submittedAt_ = std::chrono::steady_clock::now();
    if (!line_.changed.wait_until(lock, *deadline, [&] { return !sendingNow_; })) {
        libusb_cancel_transfer(sending_.get());
        line_.changed.wait(lock, [&] { return !sendingNow_; });  // the kernel ends a cancelled transfer at once
    }
    if (sendingStatus_ != LIBUSB_TRANSFER_COMPLETED) {
        auto error = usbTransferError(sendingStatus_, device_.label(), fmt::format("writing {} bytes", bytes.size()));
        tend(lock);
        return tl::unexpected(std::move(error));
    }
    const std::size_t expected = endpoint_ == 0 ? bytes.size() - LIBUSB_CONTROL_SETUP_SIZE : bytes.size();
    if (sendingTaken_ != expected) {
        return fail(ErrorCode::Device, "{}: it took {} bytes of a write; {} were expected", device_.label(),
                    sendingTaken_, expected);
    }
    return {};
}

void UsbOutbox::sendUrgent(std::span<const std::uint8_t> bytes) noexcept {
    if (bytes.empty() || bytes.size() > next_.size()) return;
    const std::lock_guard lock(line_.mutex);
    if (closed_ || line_.gone) return;
    std::ranges::copy(bytes, next_.begin());
    nextLength_ = bytes.size();
    if (!urgentNow_) submitUrgent();
}

void UsbOutbox::submitUrgent() noexcept {
    urgentBytes_ = next_;
    urgentLength_ = nextLength_;
    fill(urgent_.get(), std::span(urgentBytes_).first(urgentLength_), true);
    if (line_.submit(urgent_.get()) != 0) return;  // the message is kept: tend() tries again
    urgentNow_ = true;
    nextLength_ = 0;
}

bool UsbOutbox::wantsTending() const noexcept {
    return !line_.gone && (line_.outHalted || (nextLength_ != 0 && !urgentNow_));
}

void UsbOutbox::tend(std::unique_lock<std::mutex>& lock) {
    if (line_.gone) return;
    if (line_.outHalted) {
        lock.unlock();
        const auto cleared = device_.clearHalt(endpoint_);
        lock.lock();
        if (cleared) line_.outHalted = false;
    }
    if (nextLength_ != 0 && !urgentNow_ && !closed_) submitUrgent();
}

std::uint64_t UsbOutbox::delivered() const noexcept {
    const std::lock_guard lock(line_.mutex);
    return delivered_;
}

std::chrono::steady_clock::time_point UsbOutbox::submittedAt() const noexcept {
    const std::lock_guard lock(line_.mutex);
    return submittedAt_;
}

void UsbOutbox::close() noexcept {
    std::unique_lock lock(line_.mutex);
    if (!closed_) tend(lock);
    closed_ = true;
    line_.changed.wait_for(lock, kCloseTimeout, [&] { return line_.gone || (!urgentNow_ && nextLength_ == 0); });
    nextLength_ = 0;
    if (urgentNow_) libusb_cancel_transfer(urgent_.get());
    line_.changed.wait(lock, [&] { return !urgentNow_ && !sendingNow_; });
}

}  // namespace tacto
