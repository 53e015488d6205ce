// WatchdogLine.h - what a program and its tactoscope-watchdog say to each other over a socket that keeps messages
// apart. Each message is one byte. The end of the line without Leave is the program's death.
//
// Thread-safety: values.
#pragma once

#include <chrono>

namespace tacto::hid {

/// With output on, the stop follows after so long a silence of the program.
inline constexpr std::chrono::milliseconds kWatchdogSilence{200};

inline constexpr int kWatchdogSocket = 3;  ///< the watchdog's end is this file descriptor

enum class WatchdogWord : char {
    Ready = 'r',   ///< watchdog: the device's node is open
    Failed = 'f',  ///< watchdog: it could not be opened; the error's number follows as an int
    Beat = 'b',    ///< program: output begins or continues; the watchdog answers with the same
    Rest = 'o',    ///< program: the device took its stop
    Leave = 'q',   ///< program: ends in order, with the output off
};

}  // namespace tacto::hid
