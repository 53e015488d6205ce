#include "tests/support/usb_emulation/UsbDescription.h"

#include <utility>

namespace tacto::test {

namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value); }
std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>(value >> 8); }

Bytes join(std::initializer_list<Bytes> parts) {
    Bytes whole;
    for (const auto& part : parts) whole.insert(whole.end(), part.begin(), part.end());
    return whole;
}

/// Bus powered, 100 mA; correctTotalLength() fills in the length.
Bytes configurationHeader(std::uint8_t interfaces) { return {9, 2, 0, 0, interfaces, 1, 0, 0x80, 50}; }

Bytes interfaceOf(std::uint8_t number, std::uint8_t endpoints, std::uint8_t cls, std::uint8_t sub,
                  std::uint8_t protocol) {
    return {9, 4, number, 0, endpoints, cls, sub, protocol, 0};
}

Bytes bulk(std::uint8_t address, std::size_t packet) { return {7, 5, address, 2, low(packet), high(packet), 0}; }
Bytes interrupt(std::uint8_t address, std::size_t packet) { return {7, 5, address, 3, low(packet), high(packet), 1}; }

UsbDescription identified(std::uint16_t vendor, std::uint16_t product, std::string serial) {
    UsbDescription description;
    description.vendor = vendor;
    description.product = product;
    description.serial = std::move(serial);
    return description;
}

}  // namespace

std::vector<std::uint8_t> UsbDescription::deviceDescriptor() const {
    // USB 2.0, class per interface, endpoint 0 of 64 bytes, release 1.00, strings 1 to 3, one configuration.
    return {18, 1, 0, 2, 0, 0, 0, 64, low(vendor), high(vendor), low(product), high(product), 0, 1, 1, 2, 3, 1};
}

UsbDescription cdcAcmDevice(std::uint16_t vendor, std::uint16_t product, std::string serial, std::uint16_t packet) {
    auto made = identified(vendor, product, std::move(serial));
    made.speed_mbit = packet > 64 ? 480 : 12;
    made.configuration = join({configurationHeader(2),
                               interfaceOf(0, 1, 2, 2, 1),
                               {5, 0x24, 0, 0x10, 1},  // CDC 1.10
                               {5, 0x24, 1, 0, 1},     // call management over the data interface
                               {4, 0x24, 2, 2},        // line coding and line state
                               {5, 0x24, 6, 0, 1},     // union: interface 0 controls interface 1
                               interrupt(0x82, 8),
                               interfaceOf(1, 2, 0x0A, 0, 0),
                               bulk(0x01, packet),
                               bulk(0x81, packet)});
    made.kernelInterfaces = {0, 1};
    correctTotalLength(made);
    return made;
}

UsbDescription vendorDevice(std::uint16_t vendor, std::uint16_t product, std::string serial, std::uint16_t packet) {
    auto made = identified(vendor, product, std::move(serial));
    made.configuration =
        join({configurationHeader(1), interfaceOf(0, 2, 0xFF, 0, 0), bulk(0x01, packet), bulk(0x81, packet)});
    correctTotalLength(made);
    return made;
}

UsbDescription hidDevice(std::uint16_t vendor, std::uint16_t product, std::string serial,
                         std::size_t reportDescriptorLength) {
    auto made = identified(vendor, product, std::move(serial));
    made.configuration =
        join({configurationHeader(1),
              interfaceOf(0, 2, 3, 0, 0),
              {9, 0x21, 0x11, 1, 0, 1, 0x22, low(reportDescriptorLength), high(reportDescriptorLength)},
              interrupt(0x81, 64),
              interrupt(0x01, 64)});
    made.kernelInterfaces = {0};
    made.kernelDriver = "usbhid";
    correctTotalLength(made);
    return made;
}

void correctTotalLength(UsbDescription& description) {
    description.configuration[2] = low(description.configuration.size());
    description.configuration[3] = high(description.configuration.size());
}

std::map<std::uint8_t, EndpointFacts> endpointsOf(const UsbDescription& description) {
    std::map<std::uint8_t, EndpointFacts> found;
    std::uint8_t interface = 0;
    const auto& bytes = description.configuration;
    for (std::size_t at = 0; at + 6 < bytes.size() && bytes[at] >= 2; at += bytes[at]) {
        if (bytes[at + 1] == 4) interface = bytes[at + 2];
        if (bytes[at + 1] == 5) {
            found[bytes[at + 2]] = {interface, static_cast<std::size_t>(bytes[at + 4] | bytes[at + 5] << 8)};
        }
    }
    return found;
}

}  // namespace tacto::test
