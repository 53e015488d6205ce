// Any answer of a Pulse Pal is read or refused, and any bytes from a host leave the emulated Pulse Pal within its range
// and its limits (hazard H10).
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "tests/fuzz/FuzzTarget.h"
#include "tests/support/emulated/pulsepal/EmulatedPulsePal.h"

namespace tacto::fuzz::PulsePalFuzz {

TACTO_FUZZ(PulsePalFuzz, const std::uint8_t* data, std::size_t size) {
    using namespace tacto::pulsepal;
    const std::span<const std::uint8_t> bytes(data, size);
    if (const auto read = readHandshake(bytes); read && (size != kHandshakeSize || read->firmware / 2 != 10))
        std::abort();

    EmulatedPulsePal device;
    device.setReady(true);
    tacto::Instant now{0};
    // Transfers of 1 to 8 bytes, one millisecond apart.
    for (std::size_t at = 0; at < std::min<std::size_t>(size, 256);) {
        const std::size_t length = std::min<std::size_t>(1 + data[at] % 8, size - at);
        device.receive(bytes.subspan(at, length), now);
        at += length;
        now += std::chrono::milliseconds(1);
        for (int channel = 1; channel <= kChannels; ++channel) {
            if (!(std::abs(device.level(channel, now).value()) <= kMaxVolts)) std::abort();
        }
    }
    std::uint8_t answers[64];
    static_cast<void>(device.transmit(answers, now));
    // Clicks twice: a stored trigger starts its train after the first click, as after an abort.
    device.clickJoystick(now);
    now += std::chrono::milliseconds(1);
    device.clickJoystick(now);
    for (int channel = 1; channel <= kChannels; ++channel) {
        const auto rest = device.stored(Parameter::RestingVoltage, channel);
        if (!rest || device.level(channel, now) != voltsOf(static_cast<std::uint16_t>(*rest))) std::abort();
    }
    return 0;
}

}  // namespace tacto::fuzz::PulsePalFuzz
