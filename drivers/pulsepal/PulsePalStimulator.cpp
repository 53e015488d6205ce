#include "drivers/pulsepal/PulsePalStimulator.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/devices/Device.h"

namespace tacto::pulsepal {

namespace {

/// From the trigger's last byte to the onset: the device starts on the next cycle but one; two more are spare.
constexpr Instant kTriggerDelay = std::chrono::microseconds(200);
/// The most that the device's clock may run slow for ours to predict a train's end: twice 100 ppm (two crystals).
constexpr double kClockError = 200e-6;
/// After this much silence the device has answered everything that another program asked before us: it takes a command
/// every 50 µs, and a USB frame is 1 ms.
constexpr Seconds kLineSilence{0.005};

}  // namespace

PulsePalStimulator::PulsePalStimulator(Connect connect, Channel channel, const Clock& clock)
    : connect_(std::move(connect)), channel_(channel), clock_(clock), traits_(sourceTraits()) {}

Result<std::unique_ptr<PulsePalStimulator>> PulsePalStimulator::open(Connect connect, std::string uri,
                                                                     std::string serial, int channel,
                                                                     const Clock& clock) {
    const auto output = Channel::of(channel);
    if (!output) return failure(output);
    std::unique_ptr<PulsePalStimulator> opened(new PulsePalStimulator(std::move(connect), *output, clock));
    const auto found = opened->reconnect();
    if (!found) return failure(found);
    opened->identity_ = {
        std::move(uri), Role::Stimulator, "Pulse Pal 2", std::move(serial), fmt::format("{}", found->firmware), false};
    return opened;
}

PulsePalStimulator::~PulsePalStimulator() {
    forceOff();
    if (lost_) return;
    // Waits, so that the bytes are sent before the transport closes. An error could no longer be reported.
    const Instant deadline = clock_.now() + toInstant(kTimeout);
    static_cast<void>(write(abortTwice(), deadline));
    static_cast<void>(write(disconnect(), deadline));
}

Result<Handshake> PulsePalStimulator::reconnect() {
    {
        std::unique_ptr<Transport> old;
        const std::scoped_lock urgent(urgent_);
        old = std::move(transport_);
    }
    lost_ = true;
    silent_ = false;
    auto transport = connect_();
    if (!transport) return failure(transport);
    {
        const std::scoped_lock urgent(urgent_);
        transport_ = std::move(*transport);
    }
    const auto offs = offs_.load(std::memory_order_acquire);
    if (auto aborted = write(abortTwice(), clock_.now() + toInstant(kTimeout)); !aborted) return failure(aborted);
    auto found = greet(kGreetingTimeout, kLineSilence);
    if (!found) return found;
    std::vector<CommandBytes> commands;
    for (int number = 1; number <= kChannels; ++number) {
        for (const auto& command : quietChannel(*Channel::of(number))) commands.push_back(command);
    }
    if (auto quiet = program(commands, kGreetingTimeout); !quiet) return failure(quiet);
    if (auto named = write(clientName("TACTO"), clock_.now() + toInstant(kTimeout)); !named) return failure(named);
    lost_ = false;
    silent_ = true;
    silentOffs_ = offs;
    trainEnd_ = Instant(0);
    return found;
}

Result<void> PulsePalStimulator::write(const CommandBytes& command, Instant deadline) {
    const double left = std::max(0.0, toSeconds(deadline - clock_.now()));
    return transport_->write(command.view(), Seconds(left));
}

Result<void> PulsePalStimulator::readExactly(std::span<std::uint8_t> into, Instant deadline) {
    while (!into.empty()) {
        const double left = std::max(0.0, toSeconds(deadline - clock_.now()));
        const auto came = transport_->read(into, Seconds(left));
        if (!came) return failure(came);
        into = into.subspan(std::min(*came, into.size()));
    }
    return {};
}

void PulsePalStimulator::drain(Seconds quiet) {
    std::array<std::uint8_t, 64> stale{};
    // The loop is bounded: a device that sends without end is recognised by its wrong answer.
    for (int i = 0; i < 64 && transport_->read(stale, quiet); ++i) {
    }
}

Result<Handshake> PulsePalStimulator::greet(Seconds timeout, Seconds quiet) {
    drain(quiet);
    const Instant deadline = clock_.now() + toInstant(timeout);
    std::array<std::uint8_t, kHandshakeSize> reply{};
    if (auto asked = write(handshake(), deadline); !asked) return failure(asked);
    const auto answered = readExactly(reply, deadline);
    if (!answered && answered.error().code == ErrorCode::Timeout) {
        return fail(ErrorCode::Timeout,
                    "Pulse Pal: no answer to the handshake within {:.2g} s; one that was cut off in the middle of a "
                    "command waits for a click on its joystick",
                    timeout.count());
    }
    if (!answered) return failure(answered);
    return readHandshake(reply);
}

Result<void> PulsePalStimulator::program(std::span<const CommandBytes> commands, Seconds timeout) {
    const Instant deadline = clock_.now() + toInstant(timeout);
    for (const auto& command : commands) {
        if (auto sent = write(command, deadline); !sent) return sent;
    }
    std::array<std::uint8_t, 64> acks{};
    for (std::size_t done = 0; done < commands.size();) {
        const auto part = std::span(acks).first(std::min(acks.size(), commands.size() - done));
        if (auto came = readExactly(part, deadline); !came) {
            return fail(came.error().code, "Pulse Pal: {} of {} parameters were acknowledged: {}", done,
                        commands.size(), came.error().message);
        }
        for (const auto ack : part) {
            if (ack != kDone) {
                return fail(ErrorCode::Device, "Pulse Pal: it answered {:02X} to a parameter; 01 was expected", ack);
            }
        }
        done += part.size();
    }
    return {};
}

tl::unexpected<Error> PulsePalStimulator::lost(const Error& error) {
    lost_ = true;
    sendAbort();
    const bool late = error.code == ErrorCode::Timeout;
    return tl::unexpected<Error>(Error{late ? ErrorCode::Timeout : ErrorCode::Device, error.message});
}

Result<void> PulsePalStimulator::ensureSilence() {
    const auto offs = offs_.load(std::memory_order_acquire);
    if (silent_ && silentOffs_ == offs) return {};
    if (auto aborted = write(abortTwice(), clock_.now() + toInstant(kTimeout)); !aborted) return aborted;
    silent_ = true;
    silentOffs_ = offs;
    return {};
}

Result<void> PulsePalStimulator::deliver(ApprovedTrain&& train) {
    const ApprovedTrain consumed = std::move(train);
    const auto offs = offs_.load(std::memory_order_acquire);
    const Instant now = clock_.now();
    if (lost_) return fail(ErrorCode::Device, "{} is lost; its status looks for it again", identity_.uri);
    if (auto current = notExpired(consumed.expires(), now, "Pulse Pal", "a train"); !current) return current;
    if (playing(now)) {
        return fail(ErrorCode::Device, "Pulse Pal refused a train while another is in progress, for {:.1f} ms more",
                    toSeconds(trainEnd_ - now) * 1e3);
    }
    return start(consumed, offs);
}

Result<void> PulsePalStimulator::start(const ApprovedTrain& train, std::uint64_t offs) {
    const auto wanted = programTrain(train.train(), channel_);
    if (!wanted) return fail(ErrorCode::Device, "{}", wanted.error().message);
    if (auto silent = ensureSilence(); !silent) return lost(silent.error());
    drain(Seconds(0));
    if (auto programmed = program(wanted->commands, kTimeout); !programmed) return lost(programmed.error());
    if (stoppedSince(offs)) return {};
    const Instant now = clock_.now();
    if (!(now <= train.expires())) {
        return fail(ErrorCode::Timeout, "Pulse Pal took {:.1f} ms longer to program than the train's approval lasted",
                    toSeconds(now - train.expires()) * 1e3);
    }
    silent_ = false;
    trainOffs_ = offs;
    const auto triggered = write(trigger(channel_.mask()), now + toInstant(kTimeout));
    // A stop that came in between may have been sent before the trigger; then it is sent again after the trigger.
    if (stoppedSince(offs)) sendAbort();
    if (!triggered) return lost(triggered.error());
    const double lasts = Seconds(wanted->duration.time()).count() * (1 + kClockError);
    trainEnd_ = clock_.now() + kTriggerDelay + toInstant(lasts);
    ++trains_;
    return {};
}

Result<StimulatorStatus> PulsePalStimulator::status() {
    if (lost_) {
        if (const auto found = reconnect(); !found) {
            return fail(ErrorCode::Device, "{} is lost and could not be opened again: {}", identity_.uri,
                        found.error().message);
        }
    }
    StimulatorStatus status;
    status.trainsDelivered = trains_;
    status.delivering = playing(clock_.now());
    if (!status.delivering) {
        if (auto silent = ensureSilence(); !silent) return lost(silent.error());
        if (const auto there = greet(kTimeout, Seconds(0)); !there) return lost(there.error());
    }
    status.at = clock_.now();
    return status;
}

Result<void> PulsePalStimulator::keepAlive() {
    if (lost_) return fail(ErrorCode::Device, "{} is lost; its status looks for it again", identity_.uri);
    return {};
}

void PulsePalStimulator::sendAbort() noexcept {
    const std::scoped_lock urgent(urgent_);
    if (transport_) transport_->writeUrgent(abortTwice().view());
}

void PulsePalStimulator::forceOff() noexcept {
    offs_.fetch_add(1, std::memory_order_acq_rel);
    sendAbort();
}

}  // namespace tacto::pulsepal
