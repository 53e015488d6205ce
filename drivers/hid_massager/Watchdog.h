// Watchdog.h - sends a massager's stop from outside this program, because nothing inside can send it after kill -9.
//
// A watchdog sends the stop if the program ends without having said so, or if the program is silent for kSilence while
// output is on. A massager without a watchdog is not driven (safety.md, "Interlock").
//
// Thread-safety: one caller at a time. Destruction after rest() just ends the watchdog; without rest() the watchdog
// sends the stop.
#pragma once

#include <memory>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "drivers/hid_massager/WatchdogLine.h"

namespace tacto::hid {

enum class WatchdogState {
    Watching,
    Silent,  ///< did not answer beats for kUnansweredLimit: its process or the computer hangs
    Ended,   ///< the watchdog's process has ended
};

class Watchdog {
public:
    static constexpr Instant kSilence = kWatchdogSilence;            ///< longest silence with output on before the stop
    static constexpr Instant kBeat = std::chrono::milliseconds(50);  ///< interval of beats while output is on
    static constexpr Instant kUnansweredLimit =
        std::chrono::milliseconds(500);  ///< how long the watchdog may leave beats unanswered

    virtual ~Watchdog() = default;

    /// Tells that output is about to begin, or continues. Never waits. Output is allowed only if this returns Watching.
    [[nodiscard]] virtual WatchdogState beat() noexcept = 0;
    /// Tells that the device took its stop: silence is then allowed until the next beat(). Never waits.
    virtual void rest() noexcept = 0;
};

}  // namespace tacto::hid
