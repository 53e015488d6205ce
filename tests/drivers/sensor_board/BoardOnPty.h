// BoardOnPty.h - the emulated sensor board in real time behind a pseudo-terminal, for `sensor:?tty=` and for programs
// in another process.
//
// Thread-safety: as DeviceOnPty.
#pragma once

#include "tests/support/emulated/DeviceOnPty.h"
#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

namespace tacto::test {

/// A streaming board is asked for bytes once a millisecond, as on full-speed USB.
inline constexpr Instant kBoardRest = std::chrono::milliseconds(1);

using MakeSignal = std::function<std::unique_ptr<sensorboard::BoardSignal>(Instant)>;
/// Makes a board that has power and waits for START. Without a signal the board counts (CountingSignal), so that
/// missing samples show.
[[nodiscard]] inline auto poweredBoard(sensorboard::EmulatedBoardSettings settings, MakeSignal signal = {}) {
    return [settings = std::move(settings), signal = std::move(signal)](Instant now) {
        return std::make_unique<sensorboard::EmulatedBoard>(
            signal ? signal(now) : std::make_unique<sensorboard::CountingSignal>(), settings, now);
    };
}

class BoardOnPty : public DeviceOnPty<sensorboard::EmulatedBoard> {
public:
    /// Throws if the system provides no pseudo-terminal.
    explicit BoardOnPty(const Clock& clock, sensorboard::EmulatedBoardSettings settings = {})
        : DeviceOnPty(PseudoTerminal::open().value(), clock, poweredBoard(std::move(settings)), kBoardRest) {}
};

}  // namespace tacto::test
