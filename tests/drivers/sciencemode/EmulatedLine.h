// EmulatedLine.h - connects an emulated stimulator, which loses its power when unplugged, to a Transport in this
// process (see DeviceLine).
//
// Thread-safety: any thread.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "tests/support/emulated/DeviceLine.h"
#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

namespace tacto::test {

class EmulatedLine final : public DeviceLine {
public:
    using Device = sciencemode::EmulatedStimulator;

    EmulatedLine(const Clock& clock, VirtualClock* movable, sciencemode::EmulatedSettings settings = {});

    /// Plugs another device into the same socket.
    void plugAnother(sciencemode::EmulatedSettings settings);
    void onWrite(std::function<void()> hook) {
        DeviceLine::onWrite([hook = std::move(hook)](std::span<const std::uint8_t>) { hook(); });
    }

    template <class Look>
    auto inspect(Look&& look) {
        return lookAt(*device_, std::forward<Look>(look));
    }
    [[nodiscard]] std::size_t pulses() {
        return inspect([](Device& device, Instant now) { return device.pulses(now).size(); });
    }
    [[nodiscard]] std::vector<sciencemode::EmittedPulse> pulseList() {
        return inspect([](Device& device, Instant now) {
            const auto& all = device.pulses(now);
            return std::vector<sciencemode::EmittedPulse>(all.begin(), all.end());
        });
    }

private:
    [[nodiscard]] Result<void> receive(std::span<const std::uint8_t> bytes, Instant now) override;
    /// Queues the bytes, as a transfer would be; the device receives them at the next call. Never allocates.
    void receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept override;
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now) override;
    [[nodiscard]] std::optional<Instant> nextTransmit(Instant now) override;
    void catchUp(Instant now) override;
    void powerCycle(Instant now) override;

    std::unique_ptr<Device> device_;
    std::array<std::array<std::uint8_t, Transport::kMaxUrgent>, 4> urgent_{};
    std::array<std::size_t, 4> urgentSize_{};
    std::size_t urgentCount_ = 0;
};

}  // namespace tacto::test
