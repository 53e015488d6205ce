// UsbEndpoints.h - which interface and endpoints of a device carry its bytes, found in its descriptors and checked.
// Descriptors are what a device says of itself, so they are untrusted: numbers out of the standard's ranges are
// refused here, before anything is claimed or allocated by them.
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
    std::uint8_t interface = 0;                 ///< carries the bulk endpoints
    std::optional<std::uint8_t> communication;  ///< CDC: takes line coding and line state
    std::uint8_t in = 0;                        ///< endpoint address, bit 7 set
    std::uint8_t out = 0;                       ///< endpoint address
    std::size_t inPacket = 0;                   ///< bytes of a full packet
    std::size_t outPacket = 0;
};

/// Errors: Unsupported where the device has no such function; Device where its descriptors contradict the standard or
/// themselves. `device` names it in messages.
[[nodiscard]] Result<UsbBulkPair> findBulkPair(const libusb_config_descriptor& configuration, UsbFunction function,
                                               std::string_view device);

}  // namespace tacto
