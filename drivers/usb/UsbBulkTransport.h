// UsbBulkTransport.h - a Transport over the bulk IN and OUT endpoints of a USB device: a serial port (CDC-ACM) without
// the kernel's tty, or a vendor-specific interface.
//
// The transport claims the interfaces from the kernel's driver and returns them at the end. When the device is
// unplugged, every waiting call returns Device within milliseconds; bytes that arrived before can still be read. The
// transport does not recover: open a new one for the device when it comes back (UsbContext::find()).
//
// After a stall or an interrupted transfer, the call that notices it clears the endpoint and returns Device.
// Destruction lets an urgent message leave (0.1 s at most), ends all transfers, drops DTR and closes.
//
// Thread-safety: as Transport; one thread reads, writes and destroys, never libusb's event thread.
#pragma once

#include <chrono>
#include <memory>

#include "core/devices/TransportPorts.h"
#include "drivers/usb/UsbContext.h"
#include "drivers/usb/UsbEndpoints.h"

namespace tacto {

struct UsbBulkOptions {
    UsbFunction function = UsbFunction::CdcAcm;
    /// CDC: tells the device that the host listens. Pulse Pal sends no replies without this.
    bool dataTerminalReady = true;
    /// CDC: bit/s for SET_LINE_CODING, 8 bits, no parity, 1 stop bit. A device without line coding may refuse it.
    std::uint32_t bitRate = 115200;
    /// Number of IN transfers in flight at once, 1 to 64, one packet each.
    std::size_t inTransfers = 8;
    /// Bytes kept until they are read, 1 to 16 MiB.
    std::size_t ringBytes = 65536;
};

class UsbBulkTransport final : public Transport {
public:
    /// Opens the device that `info` lists. Errors: InvalidArgument (options); NotFound (unplugged meanwhile); Io (not
    /// permitted, in use); Unsupported (no such function); Device (wrong descriptors, refused requests).
    [[nodiscard]] static Result<std::unique_ptr<UsbBulkTransport>> open(std::shared_ptr<UsbContext> context,
                                                                        const UsbDeviceInfo& info,
                                                                        const UsbBulkOptions& options);
    ~UsbBulkTransport() override;

    [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) override;
    [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override;
    [[nodiscard]] std::uint64_t dropped() const noexcept override;
    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override;

    /// Returns how many urgent messages the device took. Any thread.
    [[nodiscard]] std::uint64_t urgentDelivered() const noexcept;
    /// Returns when the last write() was handed to libusb, to measure the host's own latency. Any thread.
    [[nodiscard]] std::chrono::steady_clock::time_point submittedAt() const noexcept;
    [[nodiscard]] const UsbDeviceInfo& info() const noexcept;
    [[nodiscard]] const UsbBulkPair& pair() const noexcept;

private:
    struct Parts;
    explicit UsbBulkTransport(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace tacto
