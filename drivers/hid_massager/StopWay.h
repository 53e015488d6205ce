// StopWay.h - how a separate process stops a massager: the device's node and the bytes to send to it. Passed to
// tactoscope-watchdog as arguments, so `ps` shows what the watchdog would send:
//
//   hidraw /dev/hidraw0 0203000000                  the bytes to write()
//   usb /dev/bus/usb/001/002 4301000000000000       the SETUP packet of a control request without data
//
// Thread-safety: plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tacto::hid {

struct StopWay {
    enum class Kind { Hidraw, Usb };
    Kind kind = Kind::Hidraw;
    std::string node;                 ///< such as "/dev/hidraw0" or "/dev/bus/usb/001/002"
    std::vector<std::uint8_t> bytes;  ///< hidraw: the stop report as written to the node; USB: the 8-byte SETUP packet

    [[nodiscard]] std::vector<std::string> arguments() const;
    /// Reads `count` arguments, without the program's name. Returns nothing if arguments() would not write them so.
    [[nodiscard]] static std::optional<StopWay> read(int count, char** arguments);
    friend bool operator==(const StopWay&, const StopWay&) = default;
};

}  // namespace tacto::hid
