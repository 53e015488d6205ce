// EmulatedPty.h - the emulated stimulator behind a pseudo-terminal.
//
// Thread-safety: as DeviceOnPty.
#pragma once

#include "tests/support/emulated/DeviceOnPty.h"
#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

namespace tacto::sciencemode {

class EmulatedPty : public test::DeviceOnPty<EmulatedStimulator> {
public:
    using DeviceOnPty::DeviceOnPty;
    /// `clock` must outlive this object and be steady. Errors: Io if the system provides no pseudo-terminal.
    [[nodiscard]] static Result<std::unique_ptr<EmulatedPty>> open(EmulatedSettings settings, const Clock& clock) {
        auto terminal = test::PseudoTerminal::open();
        if (!terminal) return failure(terminal);
        return std::make_unique<EmulatedPty>(std::move(*terminal), clock, [settings = std::move(settings)](Instant) {
            return std::make_unique<EmulatedStimulator>(settings);
        });
    }
};

}  // namespace tacto::sciencemode
