// StopWay.h - how a process that shares nothing with the driver stops a massager: the device's node and what is sent
// there. Travels to tactoscope-watchdog as its arguments, so that `ps` shows what it would send:
//
//   hidraw /dev/hidraw0 0203000000                           write() these bytes
//   usb /dev/bus/usb/001/002 0 01 - 0203000000               interface 0, endpoint 01: these bytes
//   usb /dev/bus/usb/001/002 0 00 4301000000000000 -         interface 0, a control request: SETUP packet, data
//
// Thread-safety: plain data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tacto::hid {

struct StopWay {
    enum class Kind { Hidraw, Usb };
    Kind kind = Kind::Hidraw;
    std::string node;                     ///< "/dev/hidraw0", "/dev/bus/usb/001/002"
    std::vector<std::uint8_t> bytes;      ///< the stop report as the node takes it; may be empty for a control request
    std::uint8_t interface = 0;           ///< USB: given back to the kernel's driver after the program's death
    std::uint8_t endpoint = 0;            ///< USB: an interrupt endpoint, or 0 for `setup`
    std::array<std::uint8_t, 8> setup{};  ///< USB, endpoint 0: the SETUP packet, its length included

    /// Whether the kernel wants the interface claimed for this (usbdevfs: endpoints, and class requests to it).
    [[nodiscard]] bool needsClaim() const noexcept;

    [[nodiscard]] std::vector<std::string> arguments() const;
    /// `count` arguments without the program's name. Nothing for what arguments() does not write.
    [[nodiscard]] static std::optional<StopWay> read(int count, char** arguments);
    friend bool operator==(const StopWay&, const StopWay&) = default;
};

}  // namespace tacto::hid
