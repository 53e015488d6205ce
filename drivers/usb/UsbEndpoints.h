// UsbEndpoints.h - finds in a device's descriptors the interface and endpoints that carry its bytes. Descriptors come
// from the device and are untrusted: numbers outside the standard's ranges are refused here, before they are used to
// claim or allocate anything.
//
// Source of the ranges: USB 2.0 chapters 5.8.3 and 9.6, USB 3.2 chapter 9.6.6; CDC 1.2 section 5.2.3.2 (union).
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/Result.h"

struct libusb_config_descriptor;

namespace tacto {

enum class UsbFunction {
    CdcAcm,  ///< a serial port: a CDC communication interface and its data interface
    Vendor,  ///< the first vendor-specific interface with a bulk pair
};

struct UsbBulkPair {
    std::uint8_t interface = 0;                 ///< the interface with the bulk endpoints
    std::optional<std::uint8_t> communication;  ///< CDC: the interface that takes line coding and line state
    std::uint8_t in = 0;                        ///< endpoint address, bit 7 set
    std::uint8_t out = 0;                       ///< endpoint address
    std::size_t inPacket = 0;                   ///< bytes of a full packet
    std::size_t outPacket = 0;
};

/// Errors: Unsupported if the device has no such function; Device if its descriptors contradict the standard or
/// themselves. `device` is its name for messages.
[[nodiscard]] Result<UsbBulkPair> findBulkPair(const libusb_config_descriptor& configuration, UsbFunction function,
                                               std::string_view device);

}  // namespace tacto
