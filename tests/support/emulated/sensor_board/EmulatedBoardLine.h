// EmulatedBoardLine.h - an emulated board at the other end of a Transport, in this process: for tests and for training.
//
// On a virtual clock a read that waits moves the clock, so it must be the clock's only mover meanwhile; on a steady one
// it waits. The line outlives its transports.
//
// Thread-safety: every function from any thread.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>

#include "core/base/Clock.h"
#include "core/devices/Transport.h"
#include "drivers/sensor_board/SensorBoardDriver.h"
#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

namespace tacto::sensorboard {

class EmulatedBoardLine final : public SensorBoardPorts, public std::enable_shared_from_this<EmulatedBoardLine> {
public:
    /// `movable` is `clock` itself where it is virtual, else null. Without a `signal`, the simulated finger.
    EmulatedBoardLine(const Clock& clock, VirtualClock* movable, EmulatedBoardSettings settings = {},
                      std::unique_ptr<BoardSignal> signal = nullptr);

    /// A transport to the board. Errors: NotFound while unplugged.
    [[nodiscard]] Result<std::unique_ptr<Transport>> connect();
    void unplug();
    void plug();

    /// The one board, while it is plugged in.
    [[nodiscard]] std::vector<TransportPort> list() const override;
    [[nodiscard]] Result<std::unique_ptr<Transport>> open(const TransportPort& port) override;
    /// Errors: Unsupported, always.
    [[nodiscard]] Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) override;

    /// Calls `look(board, now)` while nothing else does.
    template <class Look>
    auto inspect(Look&& look) {
        const std::scoped_lock lock(mutex_);
        return look(board_, clock_.now());
    }

private:
    friend class EmulatedBoardTransport;

    const Clock& clock_;
    VirtualClock* const movable_;
    const std::string serial_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    EmulatedBoard board_;
    bool plugged_ = true;
    std::uint64_t session_ = 0;  // plug() makes old transports useless
};

}  // namespace tacto::sensorboard
