// Watchdog.h - keeps a massager's stop outside of this program, because nothing inside can send it after kill -9.
//
// A watchdog sends the stop when the program that made it ends in any way without saying so, and when the program
// is silent for kSilence while output is on. A massager without a watchdog is not driven (safety.md, "Interlock").
//
// Thread-safety: one caller at a time. Destruction after rest() ends the watchdog; without it the watchdog sends the
// stop.
#pragma once

#include <memory>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "drivers/hid_massager/WatchdogLine.h"

namespace tacto::hid {

enum class WatchdogState {
    Watching,
    Silent,  ///< left beats unanswered for kUnansweredLimit: its process, or the computer, stands still
    Ended,   ///< the process is gone
};

class Watchdog {
public:
    static constexpr Instant kSilence = kWatchdogSilence;            ///< silence allowed with output on, then a stop
    static constexpr Instant kBeat = std::chrono::milliseconds(50);  ///< how often a caller beats meanwhile
    static constexpr Instant kUnansweredLimit =
        std::chrono::milliseconds(500);  ///< how long it may leave beats unanswered

    virtual ~Watchdog() = default;

    /// Output is about to begin, or continues. Never waits. Unless Watching is returned there must be no output.
    [[nodiscard]] virtual WatchdogState beat() noexcept = 0;
    /// The device took its stop: silence is allowed until the next beat(). Never waits.
    virtual void rest() noexcept = 0;
};

}  // namespace tacto::hid
