// SystemTime.h - time as other processes read it too, for what outlives the program. A Clock begins with the program.
//
// The second seam to the system's time beside Clock: nothing else in core asks for it.
//
// Thread-safety: any thread.
#pragma once

#include <chrono>
#include <string>

#include "core/base/Units.h"

namespace tacto {

class SystemTime {
public:
    virtual ~SystemTime() = default;
    /// Since the computer was started, the time for which it slept included. Never goes back. Does not block.
    [[nodiscard]] virtual Instant sinceBoot() const noexcept = 0;
    /// Names this start of the computer; empty where the system does not tell.
    [[nodiscard]] virtual std::string boot() const = 0;
    /// Wall time, UTC. May jump. Does not block.
    [[nodiscard]] virtual std::chrono::sys_seconds wall() const noexcept = 0;

    /// The system's own.
    [[nodiscard]] static const SystemTime& real() noexcept;
};

}  // namespace tacto
