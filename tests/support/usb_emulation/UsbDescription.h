// UsbDescription.h - what an emulated device says of itself: its identity and its descriptors, as bytes, so that a
// test can make them lie.
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
    /// The configuration descriptor and all that follows it, as sent by GET_DESCRIPTOR.
    std::vector<std::uint8_t> configuration;
    /// Interfaces that a driver of the kernel holds when the device is plugged in; they come and go together.
    std::vector<std::uint8_t> kernelInterfaces;
    std::string kernelDriver = "cdc_acm";

    /// The 18 bytes of the device descriptor.
    [[nodiscard]] std::vector<std::uint8_t> deviceDescriptor() const;
};

/// A serial port: communication interface 0 (interrupt IN 0x82), data interface 1 (bulk OUT 0x01, IN 0x81), held by
/// cdc_acm.
[[nodiscard]] UsbDescription cdcAcmDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                          std::uint16_t packet = 64);
/// One vendor-specific interface 0: bulk OUT 0x01, bulk IN 0x81.
[[nodiscard]] UsbDescription vendorDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                          std::uint16_t packet = 512);
/// One HID interface 0: interrupt IN 0x81, interrupt OUT 0x01, held by usbhid.
[[nodiscard]] UsbDescription hidDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                                       std::size_t reportDescriptorLength);

/// Length of the whole configuration written into its first descriptor: after a test changed it.
void correctTotalLength(UsbDescription& description);

/// What a well-behaved reader finds in a configuration: each endpoint's packet size and interface.
struct EndpointFacts {
    std::uint8_t interface = 0;
    std::size_t packet = 0;
};
[[nodiscard]] std::map<std::uint8_t, EndpointFacts> endpointsOf(const UsbDescription& description);

}  // namespace tacto::test
