#include "tests/drivers/sciencemode/EmulatedLine.h"

#include <algorithm>

namespace tacto::test {

class LineTransport final : public Transport {
public:
    explicit LineTransport(std::shared_ptr<EmulatedLine> line) : line_(std::move(line)), session_(line_->session_) {}

    Result<void> write(std::span<const std::uint8_t> bytes, Seconds /*timeout*/) override {
        std::shared_ptr<const std::function<void()>> hook;
        {
            const std::scoped_lock lock(line_->mutex_);
            hook = line_->hook_;
        }
        if (hook) (*hook)();
        const std::scoped_lock lock(line_->mutex_);
        if (!there()) return fail(ErrorCode::Device, "the emulated stimulator is unplugged");
        line_->hearUrgent();
        line_->written_.emplace_back(bytes.begin(), bytes.end());
        line_->device_->receive(bytes, line_->clock_.now());
        line_->changed_.notify_all();
        return {};
    }

    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        std::unique_lock lock(line_->mutex_);
        const Instant deadline = line_->clock_.now() + toInstant(timeout);
        for (;;) {
            if (!there()) return fail(ErrorCode::Device, "the emulated stimulator is unplugged");
            line_->hearUrgent();
            const Instant now = line_->clock_.now();
            if (const auto got = line_->device_->transmit(into, now); got > 0) return got;
            if (now >= deadline) return fail(ErrorCode::Timeout, "nothing came");
            const Instant next = std::min(deadline, line_->device_->nextTransmit().value_or(deadline));
            if (line_->movable_ != nullptr) {
                line_->movable_->advanceTo(next);
            } else {
                line_->changed_.wait_for(lock, next - now);
            }
        }
    }

    std::uint64_t dropped() const noexcept override { return 0; }

    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override {
        const std::scoped_lock lock(line_->mutex_);
        if (!there()) return;
        // Like a transfer that is still queued: the same bytes again add nothing.
        for (std::size_t i = 0; i < line_->urgentCount_; ++i) {
            if (std::ranges::equal(std::span(line_->urgent_[i]).first(line_->urgentSize_[i]), bytes)) return;
        }
        if (line_->urgentCount_ == line_->urgent_.size()) return;
        std::ranges::copy(bytes, line_->urgent_[line_->urgentCount_].begin());
        line_->urgentSize_[line_->urgentCount_++] = bytes.size();
        line_->changed_.notify_all();
    }

private:
    bool there() const noexcept { return line_->plugged_ && line_->session_ == session_; }

    const std::shared_ptr<EmulatedLine> line_;
    const std::uint64_t session_;
};

EmulatedLine::EmulatedLine(const Clock& clock, VirtualClock* movable, sciencemode::EmulatedSettings settings)
    : clock_(clock), movable_(movable), device_(std::make_unique<Device>(std::move(settings))) {}

Result<std::unique_ptr<Transport>> EmulatedLine::connect() {
    const std::scoped_lock lock(mutex_);
    if (!plugged_) return fail(ErrorCode::NotFound, "no emulated stimulator is plugged in");
    return std::make_unique<LineTransport>(shared_from_this());
}

Connect EmulatedLine::connector() {
    return [line = shared_from_this()] { return line->connect(); };
}

void EmulatedLine::unplug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = false;
    urgentCount_ = 0;
    device_->powerCycle(clock_.now());
    changed_.notify_all();
}

void EmulatedLine::plug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = true;
    ++session_;
}

void EmulatedLine::plugAnother(sciencemode::EmulatedSettings settings) {
    plug();
    const std::scoped_lock lock(mutex_);
    device_ = std::make_unique<Device>(std::move(settings));
}

std::vector<std::vector<std::uint8_t>> EmulatedLine::written() {
    const std::scoped_lock lock(mutex_);
    hearUrgent();
    return written_;
}

void EmulatedLine::onWrite(std::function<void()> hook) {
    const std::scoped_lock lock(mutex_);
    hook_ = std::make_shared<const std::function<void()>>(std::move(hook));
}

void EmulatedLine::hearUrgent() {
    for (std::size_t i = 0; i < urgentCount_; ++i) {
        const auto bytes = std::span(urgent_[i]).first(urgentSize_[i]);
        written_.emplace_back(bytes.begin(), bytes.end());
        device_->receive(bytes, clock_.now());
    }
    urgentCount_ = 0;
}

}  // namespace tacto::test
