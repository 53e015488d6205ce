#include "tests/support/emulated/sensor_board/EmulatedBoardLine.h"

#include <algorithm>

namespace tacto::sensorboard {

class EmulatedBoardTransport final : public Transport {
public:
    EmulatedBoardTransport(std::shared_ptr<EmulatedBoardLine> line, std::uint64_t session)
        : line_(std::move(line)), session_(session) {}

    Result<void> write(std::span<const std::uint8_t> bytes, Seconds /*timeout*/) override {
        const std::scoped_lock lock(line_->mutex_);
        if (!there()) return gone();
        line_->board_.receive(bytes, line_->clock_.now());
        line_->changed_.notify_all();
        return {};
    }

    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        std::unique_lock lock(line_->mutex_);
        const Instant deadline = line_->clock_.now() + toInstant(timeout);
        for (;;) {
            if (!there()) return gone();
            const Instant now = line_->clock_.now();
            if (const auto got = line_->board_.transmit(into, now); got > 0) return got;
            if (now >= deadline) return fail(ErrorCode::Timeout, "nothing came from the emulated sensor board");
            const Instant next = std::min(deadline, line_->board_.nextTransmit().value_or(deadline));
            if (line_->movable_ != nullptr) {
                line_->movable_->advanceTo(std::max(next, now + Instant(1)));
            } else {
                line_->changed_.wait_for(lock, next - now);
            }
        }
    }

    std::uint64_t dropped() const noexcept override { return 0; }

    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override {
        const std::scoped_lock lock(line_->mutex_);
        if (there()) line_->board_.receive(bytes, line_->clock_.now());
    }

private:
    bool there() const noexcept { return line_->plugged_ && line_->session_ == session_; }
    static tl::unexpected<Error> gone() { return fail(ErrorCode::Device, "the emulated sensor board is unplugged"); }

    const std::shared_ptr<EmulatedBoardLine> line_;
    const std::uint64_t session_;
};

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
    : clock_(clock),
      movable_(movable),
      serial_(settings.serial),
      board_(orFinger(std::move(signal), settings, clock.now()), settings, clock.now()) {}

Result<std::unique_ptr<Transport>> EmulatedBoardLine::connect() {
    const std::scoped_lock lock(mutex_);
    if (!plugged_) return fail(ErrorCode::NotFound, "no emulated sensor board is plugged in");
    return std::make_unique<EmulatedBoardTransport>(shared_from_this(), session_);
}

void EmulatedBoardLine::unplug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = false;
    changed_.notify_all();
}

void EmulatedBoardLine::plug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = true;
    ++session_;
}

std::vector<TransportPort> EmulatedBoardLine::list() const {
    const std::scoped_lock lock(mutex_);
    if (!plugged_) return {};
    return {{serial_, "emulated", ""}};
}

Result<std::unique_ptr<Transport>> EmulatedBoardLine::open(const TransportPort& /*port*/) { return connect(); }

Result<std::unique_ptr<Transport>> EmulatedBoardLine::openTerminal(const std::string& path) {
    return fail(ErrorCode::Unsupported, "an emulated line opens no terminals, and tty={} is one", path);
}

}  // namespace tacto::sensorboard
