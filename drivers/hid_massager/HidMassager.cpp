#include "drivers/hid_massager/HidMassager.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/devices/Device.h"

namespace tacto::hid {

namespace {

/// Returns the error after the watchdog failed; `what` says what then happened to the device.
Error unwatched(std::string_view device, std::string_view what, WatchdogState watchdog) {
    if (watchdog == WatchdogState::Ended)
        return {ErrorCode::Device, fmt::format("{} {}: its watchdog has ended", device, what)};
    return {ErrorCode::Timeout, fmt::format("{} {}: its watchdog has not answered for {:.0f} ms", device, what,
                                            toSeconds(Watchdog::kUnansweredLimit) * 1e3)};
}

}  // namespace

HidMassager::HidMassager(OpenPort open, DeviceIdentity identity, VibrationReports reports, const Clock& clock)
    : open_(std::move(open)),
      identity_(std::move(identity)),
      reports_(std::move(reports)),
      clock_(clock),
      timer_(reports_.keepAlive, reports_.shortestWrite),
      burst_(reports_.start),
      sending_(reports_.start) {}

Result<std::unique_ptr<HidMassager>> HidMassager::open(OpenPort open, DeviceIdentity identity, VibrationReports reports,
                                                       const Clock& clock) {
    if (auto sound = validate(reports); !sound) return failure(sound);
    std::unique_ptr<HidMassager> made(new HidMassager(std::move(open), std::move(identity), std::move(reports), clock));
    auto& self = *made;
    if (auto connected = self.connect(); !connected) return failure(connected);
    if (!clock.isVirtual()) self.thread_ = std::thread([&self] { self.run(); });
    return made;
}

HidMassager::~HidMassager() {
    forceOff();
    {
        const std::scoped_lock state(state_);
        quitting_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) {
        thread_.join();
    } else {
        serve(clock_.now());
    }
}

Result<void> HidMassager::connect() {
    std::unique_ptr<HidPort> old;
    {
        const std::scoped_lock urgent(urgent_);
        old = std::move(port_);
    }
    old.reset();  // closes the old port before the same device is opened again
    auto port = open_();
    if (!port) return failure(port);
    {
        const std::scoped_lock urgent(urgent_);
        port_ = std::move(*port);
    }
    const Instant began = clock_.now();
    const auto stopped = send(reports_.stop);
    {
        const std::scoped_lock state(state_);
        timer_.askStop();
        timer_.wrote(HidWrite::Stop, began, clock_.now(), stopped.has_value());
    }
    if (!stopped) return stopped;
    auto watchdog = port_->watch(reports_.stop);
    if (!watchdog) return fail(watchdog.error().code, "{}: {}", identity_.name, watchdog.error().message);
    if (watchdog_) watchdog_->rest();  // calms an earlier watchdog: the device has been stopped by now
    watchdog_ = std::move(*watchdog);
    return {};
}

Result<void> HidMassager::send(std::span<const std::uint8_t> report) {
    if (!port_) return fail(ErrorCode::Device, "{} is not open", identity_.name);
    const auto taken = port_->write(report);
    if (!taken) {
        return fail(taken.error().code, "{} did not take a report: {}", identity_.name, taken.error().message);
    }
    if (*taken != report.size()) {
        return fail(ErrorCode::Device, "{} took {} bytes of a report; {} were expected", identity_.name, *taken,
                    report.size());
    }
    return {};
}

double HidMassager::step() const noexcept {
    std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
    for (const auto& field : reports_.fields) fewest = std::min(fewest, field.max - field.min);
    return 1 / static_cast<double>(fewest);
}

Result<void> HidMassager::vibrate(ApprovedBurst&& burst) {
    const ApprovedBurst consumed = std::move(burst);
    std::unique_lock lock(state_);
    const auto offs = offs_;
    if (!clock_.isVirtual()) endBurstAfterStandstill();
    if (fault_ && !std::exchange(faultTold_, true)) return tl::unexpected<Error>(*fault_);
    // A write that an earlier call gave up on may still be running.
    if (!changed_.wait_for(lock, kTimeout, [&] { return !writing_; })) {
        return fail(ErrorCode::Timeout, "{} is still taking the report before; within {:.0f} ms was expected",
                    identity_.name, kTimeout.count() * 1e3);
    }
    if (fault_) {
        if (auto again = reconnect(lock); !again) return again;
    }
    if (const auto written = writeStart(reports_, consumed.burst().intensity, consumed.burst().duration, burst_);
        !written) {
        return fail(ErrorCode::Device, "{} refused a burst: {}", identity_.name, written.error().message);
    }
    if (offs != offs_) return {};
    job_ = Job{consumed.expires(), offs, std::nullopt};
    timer_.askBurst(toInstant(consumed.burst().duration));
    if (clock_.isVirtual()) {
        lock.unlock();
        serve(clock_.now());
        lock.lock();
    } else {
        changed_.notify_all();
        changed_.wait_for(lock, kTimeout, [&] { return job_->done.has_value(); });
    }
    const auto done = std::exchange(job_, std::nullopt)->done;
    if (done) return *done;
    if (offs != offs_) return {};
    timer_.askStop();  // due after the current write, if there is one
    changed_.notify_all();
    return fail(ErrorCode::Timeout, "{} did not take the report within {:.0f} ms", identity_.name,
                kTimeout.count() * 1e3);
}

Result<void> HidMassager::reconnect(std::unique_lock<std::mutex>& lock) {
    writing_ = true;  // keeps the driver's thread away from the port
    lock.unlock();
    const auto connected = connect();
    lock.lock();
    writing_ = false;
    changed_.notify_all();
    if (!connected) {
        return fail(ErrorCode::Device, "{} is gone and could not be opened again: {}", identity_.name,
                    connected.error().message);
    }
    fault_.reset();
    return {};
}

void HidMassager::forceOff() noexcept {
    {
        const std::scoped_lock urgent(urgent_);
        // The stop report is still sent afterwards: only its write proves that the device took the stop.
        if (port_) static_cast<void>(port_->stopNow());
    }
    {
        const std::scoped_lock state(state_);
        ++offs_;
        timer_.askStop();
    }
    changed_.notify_all();
}

Instant HidMassager::serve(Instant now) noexcept {
    std::unique_lock lock(state_);
    for (;;) {
        if (job_ && !job_->done && job_->offs != offs_) finish({});  // forceOff() came first, so the burst is not sent
        const auto due = timer_.next();
        if (writing_ || due.what == HidWrite::Nothing) return Instant::max();
        const bool farewell = quitting_ && due.what == HidWrite::Stop && !farewell_;
        if (due.at > now && !farewell) return due.at;
        serveOne(due.what, lock);
        if (quitting_ && due.what == HidWrite::Stop) {
            farewell_ = true;
            return Instant::max();
        }
        now = std::max(now, clock_.now());
    }
}

void HidMassager::serveOne(HidWrite what, std::unique_lock<std::mutex>& lock) noexcept {
    const bool isBurst = what == HidWrite::Burst;
    if (isBurst && job_) {
        if (auto current = notExpired(job_->expires, clock_.now(), identity_.name, "a burst"); !current) {
            timer_.dropBurst();
            return finish(std::move(current));
        }
    }
    if (what != HidWrite::Stop) {
        lastBeat_ = clock_.now();
        if (const auto watchdog = watchdog_->beat(); watchdog != WatchdogState::Watching) {
            raise(unwatched(identity_.name, "is not driven", watchdog));
            timer_.askStop();
            return finish(tl::unexpected<Error>(*fault_));
        }
    }
    std::ranges::copy(what == HidWrite::Stop ? reports_.stop : burst_, sending_.begin());
    writing_ = true;
    const auto offs = offs_;
    lock.unlock();
    const Instant began = clock_.now();
    auto sent = send(sending_);
    lock.lock();
    writing_ = false;
    // A stop that was asked for during this write goes out after it, even if this write was itself a stop.
    timer_.wrote(what, began, clock_.now(), sent.has_value());
    if (offs != offs_) timer_.askStop();
    if (sent && what == HidWrite::Stop && watchdog_) watchdog_->rest();
    if (!sent) {
        if (sent.error().code != ErrorCode::Timeout) raise(sent.error());
        timer_.dropBurst();  // also drops a burst that waits behind a failed stop
    }
    if (isBurst || !sent) finish(std::move(sent));
    changed_.notify_all();
}

void HidMassager::finish(Result<void> result) noexcept {
    if (job_ && !job_->done) job_->done = std::move(result);
    changed_.notify_all();
}

void HidMassager::raise(Error fault) {
    if (fault_) return;
    fault_ = std::move(fault);
    faultTold_ = job_.has_value();
}

void HidMassager::endBurstAfterStandstill() {
    const Instant silent = clock_.now() - lastBeat_;
    if (writing_ || !timer_.vibrating() || silent <= Watchdog::kSilence) return;
    raise({ErrorCode::Timeout, fmt::format("{} was stopped by its watchdog: this program stood still for {:.0f} ms",
                                           identity_.name, toSeconds(silent) * 1e3)});
    timer_.askStop();
}

Instant HidMassager::keepBeating(Instant now) {
    if (writing_ || !timer_.vibrating()) return Instant::max();
    if (now - lastBeat_ < Watchdog::kBeat) return lastBeat_ + Watchdog::kBeat;
    lastBeat_ = now;
    const auto watchdog = watchdog_->beat();
    if (watchdog == WatchdogState::Watching) return now + Watchdog::kBeat;
    raise(unwatched(identity_.name, "was stopped", watchdog));
    timer_.askStop();
    return now;
}

bool HidMassager::vibrating() const {
    const std::scoped_lock state(state_);
    return timer_.vibrating();
}

void HidMassager::run() {
    for (;;) {
        {
            const std::scoped_lock state(state_);
            endBurstAfterStandstill();
        }
        serve(clock_.now());
        std::unique_lock lock(state_);
        // If the device did not take the last stop, this can no longer be reported.
        if (quitting_ && (farewell_ || !timer_.stopDue())) return;
        if (quitting_) continue;
        const Instant now = clock_.now();
        const Instant beatAt = keepBeating(now);
        const auto due = timer_.next();  // asks again: something may be new since serve()
        if (writing_ || due.what == HidWrite::Nothing) {
            changed_.wait(lock);
        } else if (const Instant next = std::min(due.at, beatAt); next > now) {
            changed_.wait_for(lock, next - now);
        }
    }
}

}  // namespace tacto::hid
