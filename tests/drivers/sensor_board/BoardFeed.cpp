#include "tests/drivers/sensor_board/BoardFeed.h"

#include <algorithm>
#include <array>

namespace tacto::test {

using namespace sensorboard;

BoardFeed::BoardFeed(const Clock& clock, EmulatedBoardSettings settings, Send send, MakeSignal signal)
    : clock_(clock),
      settings_(std::move(settings)),
      send_(std::move(send)),
      signal_(std::move(signal)),
      board_(powerUp()),
      thread_([this] { run(); }) {}

BoardFeed::~BoardFeed() { stop(); }

void BoardFeed::stop() {
    {
        const std::scoped_lock lock(mutex_);
        quitting_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

std::unique_ptr<EmulatedBoard> BoardFeed::powerUp() const {
    const Instant now = clock_.now();
    auto signal = signal_ ? signal_(now) : std::make_unique<CountingSignal>();
    return std::make_unique<EmulatedBoard>(std::move(signal), settings_, now);
}

void BoardFeed::receive(std::span<const std::uint8_t> bytes) {
    {
        const std::scoped_lock lock(mutex_);
        if (!powered_) return;
        board_->receive(bytes, clock_.now());
    }
    changed_.notify_all();
}

void BoardFeed::power(bool on) {
    {
        const std::scoped_lock lock(mutex_);
        if (on && !powered_) board_ = powerUp();
        powered_ = on;
    }
    changed_.notify_all();
}

void BoardFeed::run() {
    std::array<std::uint8_t, 1024> bytes{};
    std::unique_lock lock(mutex_);
    while (!quitting_) {
        const auto size = powered_ ? board_->transmit(bytes, clock_.now()) : 0;
        if (size > 0) {
            lock.unlock();
            send_(std::span<const std::uint8_t>(bytes).first(size));
            lock.lock();
            continue;
        }
        const auto due = powered_ ? board_->nextTransmit() : std::nullopt;
        // A board that streams is looked at once a millisecond, as full-speed USB does; one that waits, when told.
        if (due)
            changed_.wait_for(lock, std::max(*due - clock_.now(), Instant(std::chrono::milliseconds(1))));
        else
            changed_.wait(lock);
    }
}

}  // namespace tacto::test
