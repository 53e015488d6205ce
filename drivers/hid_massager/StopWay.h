// StopWay.h - how a process that shares nothing with the driver stops a massager: the device's node and what is sent
// there. Travels to tactoscope-watchdog as its arguments, so that `ps` shows what it would send:
//
//   hidraw /dev/hidraw0 0203000000                  write() these bytes
//   usb /dev/bus/usb/001/002 4301000000000000       a control request without data: its SETUP packet
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
    std::string node;                 ///< "/dev/hidraw0", "/dev/bus/usb/001/002"
    std::vector<std::uint8_t> bytes;  ///< hidraw: the stop report as the node takes it; USB: the 8 of the SETUP packet

    [[nodiscard]] std::vector<std::string> arguments() const;
    /// `count` arguments without the program's name. Nothing for what arguments() does not write.
    [[nodiscard]] static std::optional<StopWay> read(int count, char** arguments);
    friend bool operator==(const StopWay&, const StopWay&) = default;
};

}  // namespace tacto::hid
