#include "tests/support/emulated/DeviceLine.h"

#include <algorithm>

namespace tacto::test {

class LineTransport final : public Transport {
public:
    explicit LineTransport(std::shared_ptr<DeviceLine> line) : line_(std::move(line)), session_(line_->session_) {}

    Result<void> write(std::span<const std::uint8_t> bytes, Seconds /*timeout*/) override {
        std::unique_lock lock(line_->mutex_);
        if (const auto hook = line_->hook_) {
            lock.unlock();
            (*hook)(bytes);
            lock.lock();
        }
        if (!there()) return gone();
        line_->catchUp(line_->clock_.now());
        line_->keepWritten(bytes);
        auto taken = line_->receive(bytes, line_->clock_.now());
        line_->changed_.notify_all();
        return taken;
    }

    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        std::unique_lock lock(line_->mutex_);
        const Instant deadline = line_->clock_.now() + toInstant(timeout);
        for (;;) {
            if (!there()) return gone();
            const Instant now = line_->clock_.now();
            line_->catchUp(now);
            if (const auto got = line_->transmit(into, now); got > 0) return got;
            if (now >= deadline) return fail(ErrorCode::Timeout, "nothing came from the emulated {}", line_->name_);
            const Instant next = std::min(deadline, line_->nextTransmit(now).value_or(deadline));
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
        if (!there()) return;
        line_->receiveUrgent(bytes, line_->clock_.now());
        line_->changed_.notify_all();
    }

private:
    bool there() const noexcept { return line_->plugged_ && line_->session_ == session_; }
    tl::unexpected<Error> gone() const { return fail(ErrorCode::Device, "the emulated {} is unplugged", line_->name_); }

    const std::shared_ptr<DeviceLine> line_;
    const std::uint64_t session_;
};

DeviceLine::DeviceLine(const Clock& clock, VirtualClock* movable, std::string name)
    : clock_(clock), movable_(movable), name_(std::move(name)) {}

Result<std::unique_ptr<Transport>> DeviceLine::connect() {
    const std::scoped_lock lock(mutex_);
    if (!plugged_) return fail(ErrorCode::NotFound, "no emulated {} is plugged in", name_);
    connected();
    return std::make_unique<LineTransport>(shared_from_this());
}

Connect DeviceLine::connector() {
    return [line = shared_from_this()] { return line->connect(); };
}

void DeviceLine::unplug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = false;
    powerCycle(clock_.now());
    changed_.notify_all();
}

void DeviceLine::plug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = true;
    ++session_;
}

bool DeviceLine::plugged() const {
    const std::scoped_lock lock(mutex_);
    return plugged_;
}

std::vector<std::vector<std::uint8_t>> DeviceLine::written() {
    const std::scoped_lock lock(mutex_);
    catchUp(clock_.now());
    return written_;
}

void DeviceLine::onWrite(Hook hook) {
    const std::scoped_lock lock(mutex_);
    hook_ = hook ? std::make_shared<const Hook>(std::move(hook)) : nullptr;
}

}  // namespace tacto::test
