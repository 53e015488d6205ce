// UsbDescription.h - an emulated device's identity and descriptors, as bytes, so that a test can falsify them.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tacto::test {

struct UsbDescription {
    std::uint16_t vendor = 0x1234;
    std::uint16_t product = 0x5678;
    std::string maker = "Acme";
    std::string name = "Loopback";
    std::string serial = "SN001";
    int speed_mbit = 480;
    /// The configuration descriptor and everything after it, as sent by GET_DESCRIPTOR.
    std::vector<std::uint8_t> configuration;
    /// Interfaces that a kernel driver holds when the device is plugged in; it takes and releases them together.
    std::vector<std::uint8_t> kernelInterfaces;
    std::string kernelDriver = "cdc_acm";

    /// Returns the 18 bytes of the device descriptor.
    [[nodiscard]] std::vector<std::uint8_t> deviceDescriptor() const;
};

/// Describes a serial port: communication interface 0 (interrupt IN 0x82) and data interface 1 (bulk OUT 0x01, IN
/// 0x81), held by cdc_acm.
[[nodiscard]] UsbDescription cdcAcmDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                          std::uint16_t packet = 64);
/// Describes one vendor-specific interface 0: bulk OUT 0x01, bulk IN 0x81.
[[nodiscard]] UsbDescription vendorDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                          std::uint16_t packet = 512);
/// Describes one HID interface 0: interrupt IN 0x81, interrupt OUT 0x01, held by usbhid.
[[nodiscard]] UsbDescription hidDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                       std::size_t reportDescriptorLength);

/// Writes the configuration's total length into its first descriptor, after a test has changed it.
void correctTotalLength(UsbDescription& description);

/// What a correct parser finds in a configuration: each endpoint's packet size and interface.
struct EndpointFacts {
    std::uint8_t interface = 0;
    std::size_t packet = 0;
};
[[nodiscard]] std::map<std::uint8_t, EndpointFacts> endpointsOf(const UsbDescription& description);

}  // namespace tacto::test
