#include "tests/support/emulated/sensor_board/EmulatedBoardLine.h"

namespace tacto::sensorboard {

namespace {
std::unique_ptr<BoardSignal> orFinger(std::unique_ptr<BoardSignal> signal, const EmulatedBoardSettings& settings,
                                      Instant now) {
    if (signal) return signal;
    sim::FingerSettings finger;
    finger.tickRate_hz = settings.tickRate_hz;
    finger.seed = settings.seed;
    return std::make_unique<FingerSignal>(finger, now);
}
}  // namespace

EmulatedBoardLine::EmulatedBoardLine(const Clock& clock, VirtualClock* movable, EmulatedBoardSettings settings,
                                     std::unique_ptr<BoardSignal> signal)
    : DeviceLine(clock, movable, "sensor board"),
      serial_(settings.serial),
      board_(orFinger(std::move(signal), settings, clock.now()), settings, clock.now()) {}

Result<void> EmulatedBoardLine::receive(std::span<const std::uint8_t> bytes, Instant now) {
    board_.receive(bytes, now);
    return {};
}

void EmulatedBoardLine::receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept {
    board_.receive(bytes, now);
}

std::size_t EmulatedBoardLine::transmit(std::span<std::uint8_t> into, Instant now) {
    return board_.transmit(into, now);
}

std::optional<Instant> EmulatedBoardLine::nextTransmit(Instant /*now*/) { return board_.nextTransmit(); }

std::vector<TransportPort> EmulatedBoardLine::list() const {
    if (!plugged()) return {};
    return {{serial_, "emulated", ""}};
}

Result<std::unique_ptr<Transport>> EmulatedBoardLine::open(const TransportPort& /*port*/) { return connect(); }

Result<std::unique_ptr<Transport>> EmulatedBoardLine::openTerminal(const std::string& path) {
    return fail(ErrorCode::Unsupported, "an emulated line opens no terminals, and tty={} is one", path);
}

}  // namespace tacto::sensorboard
