#include "drivers/usb/UsbEndpoints.h"

#include <algorithm>
#include <array>
#include <libusb.h>
#include <span>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

constexpr std::uint8_t kClassCommunication = 0x02;
constexpr std::uint8_t kSubclassAcm = 0x02;
constexpr std::uint8_t kClassData = 0x0A;
constexpr std::uint8_t kClassVendor = 0xFF;
constexpr std::uint8_t kFunctionalDescriptor = 0x24;
constexpr std::uint8_t kUnion = 0x06;
constexpr std::uint8_t kMaxInterface = 31;  // usbfs keeps claimed interfaces in 32 bits
constexpr std::array<std::size_t, 6> kBulkPackets{8, 16, 32, 64, 512, 1024};

std::span<const libusb_interface> interfacesOf(const libusb_config_descriptor& configuration) {
    return {configuration.interface, configuration.bNumInterfaces};
}

/// Returns the default setting, or null for an interface without settings.
const libusb_interface_descriptor* defaultOf(const libusb_interface& interface) {
    return interface.num_altsetting > 0 ? interface.altsetting : nullptr;
}

/// Returns the data interface that a CDC union names, or nothing if there is no union.
Result<std::optional<std::uint8_t>> unionOf(const libusb_interface_descriptor& communication, std::string_view device) {
    if (communication.extra == nullptr || communication.extra_length <= 0) return std::nullopt;
    std::span<const unsigned char> rest{communication.extra, static_cast<std::size_t>(communication.extra_length)};
    while (!rest.empty()) {
        const std::size_t length = rest[0];
        if (length < 3 || length > rest.size()) {
            return fail(ErrorCode::Device,
                        "{}: a descriptor says it is {} bytes long where {} are left; 3 to {} were "
                        "expected",
                        device, length, rest.size(), rest.size());
        }
        if (rest[1] == kFunctionalDescriptor && rest[2] == kUnion) {
            if (length < 5) {
                return fail(ErrorCode::Device, "{}: its union descriptor has {} bytes; 5 or more were expected", device,
                            length);
            }
            return rest[4];
        }
        rest = rest.subspan(length);
    }
    return std::nullopt;
}

/// Fills the pair from the interface's endpoints. Returns false if one of the two directions is missing.
Result<bool> takeEndpoints(const libusb_interface_descriptor& interface, std::string_view device, UsbBulkPair& pair) {
    if (interface.bInterfaceNumber > kMaxInterface) {
        return fail(ErrorCode::Device, "{}: an interface has number {}; 0 to {} was expected", device,
                    interface.bInterfaceNumber, kMaxInterface);
    }
    pair.interface = interface.bInterfaceNumber;
    // If the descriptors break off, libusb leaves out the list but keeps the number that the device stated.
    if (interface.endpoint == nullptr && interface.bNumEndpoints > 0) {
        return fail(ErrorCode::Device,
                    "{}: interface {} says it has {} endpoints and describes none; their descriptors were expected",
                    device, interface.bInterfaceNumber, interface.bNumEndpoints);
    }
    for (const auto& endpoint : std::span{interface.endpoint, interface.bNumEndpoints}) {
        if ((endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_BULK) continue;
        const int number = endpoint.bEndpointAddress & LIBUSB_ENDPOINT_ADDRESS_MASK;
        if (number == 0 || (endpoint.bEndpointAddress & 0x70) != 0) {
            return fail(ErrorCode::Device,
                        "{}: a bulk endpoint has address {:#04x}; 1 to 15, or 0x81 to 0x8f for "
                        "input, was expected",
                        device, endpoint.bEndpointAddress);
        }
        const std::size_t packet = endpoint.wMaxPacketSize;
        if (std::ranges::find(kBulkPackets, packet) == kBulkPackets.end()) {
            return fail(ErrorCode::Device,
                        "{}: endpoint {:#04x} says its packets have {} bytes; 8, 16, 32, 64, 512 or "
                        "1024 was expected",
                        device, endpoint.bEndpointAddress, packet);
        }
        const bool input = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0;
        auto& address = input ? pair.in : pair.out;
        if (address == endpoint.bEndpointAddress)
            return fail(ErrorCode::Device, "{}: {}", device, givenTwice("endpoint {:#04x}", address));
        if (address != 0) continue;  // keep the first endpoint of each direction
        address = endpoint.bEndpointAddress;
        (input ? pair.inPacket : pair.outPacket) = packet;
    }
    return pair.in != 0 && pair.out != 0;
}

Result<UsbBulkPair> findSerial(const libusb_config_descriptor& configuration, std::string_view device) {
    UsbBulkPair pair;
    std::optional<std::uint8_t> named;
    for (const auto& interface : interfacesOf(configuration)) {
        const auto* setting = defaultOf(interface);
        if (setting == nullptr || setting->bInterfaceClass != kClassCommunication ||
            setting->bInterfaceSubClass != kSubclassAcm) {
            continue;
        }
        if (setting->bInterfaceNumber > kMaxInterface) {
            return fail(ErrorCode::Device, "{}: an interface has number {}; 0 to {} was expected", device,
                        setting->bInterfaceNumber, kMaxInterface);
        }
        auto data = unionOf(*setting, device);
        if (!data) return failure(data);
        pair.communication = setting->bInterfaceNumber;
        named = *data;
        break;
    }
    if (!pair.communication) {
        return fail(ErrorCode::Unsupported, "{}: it has no serial port (CDC-ACM); one was expected", device);
    }
    for (const auto& interface : interfacesOf(configuration)) {
        const auto* setting = defaultOf(interface);
        if (setting == nullptr || setting->bInterfaceClass != kClassData) continue;
        if (named && *named != setting->bInterfaceNumber) continue;
        auto complete = takeEndpoints(*setting, device, pair);
        if (!complete) return failure(complete);
        if (*complete) return pair;
    }
    return fail(ErrorCode::Device,
                "{}: its serial port names no data interface with a bulk input and output; one was "
                "expected",
                device);
}

}  // namespace

Result<UsbBulkPair> findBulkPair(const libusb_config_descriptor& configuration, UsbFunction function,
                                 std::string_view device) {
    if (function == UsbFunction::CdcAcm) return findSerial(configuration, device);
    for (const auto& interface : interfacesOf(configuration)) {
        const auto* setting = defaultOf(interface);
        if (setting == nullptr || setting->bInterfaceClass != kClassVendor) continue;
        UsbBulkPair pair;
        auto complete = takeEndpoints(*setting, device, pair);
        if (!complete) return failure(complete);
        if (*complete) return pair;
    }
    return fail(ErrorCode::Unsupported,
                "{}: it has no vendor-specific interface with a bulk input and output; one was "
                "expected",
                device);
}

}  // namespace tacto
