#include "drivers/usb/UsbBulkTransport.h"

#include "drivers/usb/UsbInbox.h"
#include "drivers/usb/UsbOutbox.h"

namespace tacto {

namespace {

// CDC PSTN 1.2, table 13.
constexpr std::uint8_t kClassToInterface = 0x21;
constexpr std::uint8_t kSetLineCoding = 0x20;
constexpr std::uint8_t kSetControlLineState = 0x22;
constexpr std::uint16_t kDtr = 1;
constexpr std::uint16_t kRts = 2;

constexpr Seconds kSetupTimeout{0.5};
constexpr Seconds kFarewellTimeout{0.1};
constexpr std::size_t kMaxInTransfers = 64;
constexpr std::size_t kMaxRing = std::size_t{16} << 20;

Result<void> check(const UsbBulkOptions& options) {
    if (options.inTransfers < 1 || options.inTransfers > kMaxInTransfers) {
        return fail(ErrorCode::InvalidArgument, "USB: {} input transfers at once; 1 to {} were expected",
                    options.inTransfers, kMaxInTransfers);
    }
    if (options.ringBytes < 1 || options.ringBytes > kMaxRing) {
        return fail(ErrorCode::InvalidArgument, "USB: a ring of {} bytes; 1 to {} were expected", options.ringBytes,
                    kMaxRing);
    }
    return {};
}

Result<void> setLineState(UsbDevice& device, std::uint8_t interface, bool ready, Seconds timeout) {
    const auto state = static_cast<std::uint16_t>(ready ? kDtr | kRts : 0);
    return device.controlOut({kClassToInterface, kSetControlLineState, state, interface}, {}, timeout);
}

Result<void> setUpSerial(UsbDevice& device, std::uint8_t interface, const UsbBulkOptions& options) {
    const auto rate = options.bitRate;
    const std::uint8_t coding[] = {static_cast<std::uint8_t>(rate),
                                   static_cast<std::uint8_t>(rate >> 8),
                                   static_cast<std::uint8_t>(rate >> 16),
                                   static_cast<std::uint8_t>(rate >> 24),
                                   0,   // 1 stop bit
                                   0,   // no parity
                                   8};  // data bits
    // A device without a UART ignores the line coding, and may stall the request (PSTN 1.2, 6.3.10).
    const auto coded = device.controlOut({kClassToInterface, kSetLineCoding, 0, interface}, coding, kSetupTimeout);
    if (!coded && coded.error().code != ErrorCode::Device) return coded;
    if (!options.dataTerminalReady) return {};
    return setLineState(device, interface, true, kSetupTimeout);
}

}  // namespace

/// Destroyed from last to first: the inbox and outbox end their transfers, then the device is closed.
struct UsbBulkTransport::Parts {
    Parts(std::shared_ptr<UsbDevice> opened, const UsbBulkPair& found, const UsbBulkOptions& options)
        : device(std::move(opened)),
          pair(found),
          lowersReady(found.communication.has_value() && options.dataTerminalReady),
          outbox(*device, line, pair.out),
          inbox(*device, line, outbox, pair, options.inTransfers, options.ringBytes) {}

    const std::shared_ptr<UsbDevice> device;
    const UsbBulkPair pair;
    const bool lowersReady;
    UsbLine line;
    UsbOutbox outbox;
    UsbInbox inbox;
};

Result<std::unique_ptr<UsbBulkTransport>> UsbBulkTransport::open(std::shared_ptr<UsbContext> context,
                                                                 const UsbDeviceInfo& info,
                                                                 const UsbBulkOptions& options) {
    if (auto checked = check(options); !checked) return failure(checked);
    auto device = UsbDevice::open(std::move(context), info);
    if (!device) return failure(device);
    auto pair = (*device)->bulkPair(options.function);
    if (!pair) return failure(pair);
    if (pair->communication) {
        if (auto claimed = (*device)->claim(*pair->communication); !claimed) return failure(claimed);
    }
    if (auto claimed = (*device)->claim(pair->interface); !claimed) return failure(claimed);
    if (pair->communication) {
        if (auto set = setUpSerial(**device, *pair->communication, options); !set) return failure(set);
    }
    auto parts = std::make_unique<Parts>(std::move(*device), *pair, options);
    if (auto started = parts->inbox.start(); !started) return failure(started);
    return std::unique_ptr<UsbBulkTransport>(new UsbBulkTransport(std::move(parts)));
}

UsbBulkTransport::UsbBulkTransport(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

UsbBulkTransport::~UsbBulkTransport() {
    parts_->outbox.close();
    parts_->inbox.close();
    const bool gone = [this] {
        const std::lock_guard lock(parts_->line.mutex);
        return parts_->line.gone;
    }();
    if (parts_->lowersReady && !gone) {
        // If the device does not answer, this error can no longer be reported.
        (void)setLineState(*parts_->device, *parts_->pair.communication, false, kFarewellTimeout);
    }
}

Result<void> UsbBulkTransport::write(std::span<const std::uint8_t> bytes, Seconds timeout) {
    return parts_->outbox.send(bytes, timeout);
}

Result<std::size_t> UsbBulkTransport::read(std::span<std::uint8_t> into, Seconds timeout) {
    return parts_->inbox.read(into, timeout);
}

std::uint64_t UsbBulkTransport::dropped() const noexcept { return parts_->inbox.dropped(); }

void UsbBulkTransport::writeUrgent(std::span<const std::uint8_t> bytes) noexcept { parts_->outbox.sendUrgent(bytes); }

std::uint64_t UsbBulkTransport::urgentDelivered() const noexcept { return parts_->outbox.delivered(); }

std::chrono::steady_clock::time_point UsbBulkTransport::submittedAt() const noexcept {
    return parts_->outbox.submittedAt();
}

const UsbDeviceInfo& UsbBulkTransport::info() const noexcept { return parts_->device->info(); }
const UsbBulkPair& UsbBulkTransport::pair() const noexcept { return parts_->pair; }

}  // namespace tacto
