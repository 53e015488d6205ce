#include "tests/drivers/sciencemode/EmulatedLine.h"

#include <algorithm>

namespace tacto::test {

EmulatedLine::EmulatedLine(const Clock& clock, VirtualClock* movable, sciencemode::EmulatedSettings settings)
    : DeviceLine(clock, movable, "stimulator"), device_(std::make_unique<Device>(std::move(settings))) {}

void EmulatedLine::plugAnother(sciencemode::EmulatedSettings settings) {
    plug();
    const std::scoped_lock lock(mutex_);
    device_ = std::make_unique<Device>(std::move(settings));
}

Result<void> EmulatedLine::receive(std::span<const std::uint8_t> bytes, Instant now) {
    device_->receive(bytes, now);
    return {};
}

void EmulatedLine::receiveUrgent(std::span<const std::uint8_t> bytes, Instant /*now*/) noexcept {
    // Ignores bytes that are already queued.
    for (std::size_t i = 0; i < urgentCount_; ++i) {
        if (std::ranges::equal(std::span(urgent_[i]).first(urgentSize_[i]), bytes)) return;
    }
    if (urgentCount_ == urgent_.size()) return;
    std::ranges::copy(bytes, urgent_[urgentCount_].begin());
    urgentSize_[urgentCount_++] = bytes.size();
}

std::size_t EmulatedLine::transmit(std::span<std::uint8_t> into, Instant now) { return device_->transmit(into, now); }

std::optional<Instant> EmulatedLine::nextTransmit(Instant /*now*/) { return device_->nextTransmit(); }

void EmulatedLine::catchUp(Instant now) {
    for (std::size_t i = 0; i < urgentCount_; ++i) {
        const auto bytes = std::span(urgent_[i]).first(urgentSize_[i]);
        keepWritten(bytes);
        device_->receive(bytes, now);
    }
    urgentCount_ = 0;
}

void EmulatedLine::powerCycle(Instant now) {
    urgentCount_ = 0;
    device_->powerCycle(now);
}

}  // namespace tacto::test
