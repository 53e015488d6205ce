// EmulatedBoardLine.h - connects an emulated board to a Transport in the same process, and lists it as a plugged-in
// board. Like DeviceLine; for tests and for training.
//
// Thread-safety: any thread.
#pragma once

#include <memory>

#include "drivers/sensor_board/SensorBoardDriver.h"
#include "tests/support/emulated/DeviceLine.h"
#include "tests/support/emulated/sensor_board/EmulatedBoard.h"

namespace tacto::sensorboard {

class EmulatedBoardLine final : public test::DeviceLine, public SensorBoardPorts {
public:
    /// Without a `signal` the board uses the simulated finger.
    EmulatedBoardLine(const Clock& clock, VirtualClock* movable, EmulatedBoardSettings settings = {},
                      std::unique_ptr<BoardSignal> signal = nullptr);

    /// Returns the only board while it is plugged in.
    [[nodiscard]] std::vector<TransportPort> list() const override;
    [[nodiscard]] Result<std::unique_ptr<Transport>> open(const TransportPort& port) override;
    /// Always returns the error Unsupported.
    [[nodiscard]] Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) override;

    template <class Look>
    auto inspect(Look&& look) {
        return lookAt(board_, std::forward<Look>(look));
    }

private:
    [[nodiscard]] Result<void> receive(std::span<const std::uint8_t> bytes, Instant now) override;
    void receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept override;
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now) override;
    [[nodiscard]] std::optional<Instant> nextTransmit(Instant now) override;

    const std::string serial_;
    EmulatedBoard board_;
};

}  // namespace tacto::sensorboard
