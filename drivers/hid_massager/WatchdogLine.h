// WatchdogLine.h - the messages, one byte each, between a program and its tactoscope-watchdog, over a socket that keeps
// messages apart. If the line ends without Leave, the program has died.
//
// Thread-safety: constants.
#pragma once

#include <chrono>

namespace tacto::hid {

/// While output is on, the watchdog sends the stop after the program has been silent for this long.
inline constexpr std::chrono::milliseconds kWatchdogSilence{200};

inline constexpr int kWatchdogSocket = 3;  ///< file descriptor of the watchdog's end of the line

enum class WatchdogWord : char {
    Ready = 'r',   ///< watchdog: the device's node is open
    Failed = 'f',  ///< watchdog: it could not open the node; the error number follows as an int
    Beat = 'b',    ///< program: output begins or continues; the watchdog answers with the same
    Rest = 'o',    ///< program: the device took its stop
    Leave = 'q',   ///< program: it ends normally, with the output off
};

}  // namespace tacto::hid
