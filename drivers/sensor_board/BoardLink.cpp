#include "drivers/sensor_board/BoardLink.h"

#include <algorithm>
#include <utility>

#include "core/base/Words.h"

namespace tacto::sensorboard {

namespace {
constexpr Seconds kWriteTime{0.5};
constexpr unsigned kTokens = 250;  // higher numbers are for stopUnheard()
constexpr Word<Command> kCommandWords[] = {{"HELLO", Command::Hello},
                                           {"GET_CONFIGURATION", Command::GetConfiguration},
                                           {"SET_CONFIGURATION", Command::SetConfiguration},
                                           {"GET_CALIBRATION", Command::GetCalibration},
                                           {"START", Command::Start},
                                           {"STOP", Command::Stop},
                                           {"GET_STATUS", Command::GetStatus},
                                           {"GET_ENCODER", Command::GetEncoder},
                                           {"SET_ENCODER", Command::SetEncoder}};
}  // namespace

std::string_view nameOf(Command command) noexcept { return wordFor(kCommandWords, command, "a command"); }

BoardLink::~BoardLink() {
    ending_.store(true, std::memory_order_release);
    if (thread_.joinable()) thread_.join();
}

void BoardLink::listen() {
    if (clock_.isVirtual()) return;
    ring_ = std::make_unique<SpscRing<Chunk>>(kChunks);
    thread_ = std::thread([this] { run(); });
}

void BoardLink::run() noexcept {
    Chunk chunk{};
    while (!ending_.load(std::memory_order_acquire)) {
        const auto got = transport_->read(chunk.bytes, kListenTimeout);
        if (got) {
            chunk.arrival = clock_.now();
            chunk.size = static_cast<std::uint32_t>(std::min(*got, chunk.bytes.size()));
            ring_->push(chunk);
        } else if (got.error().code != ErrorCode::Timeout) {
            broke_ = got.error().message;
            broken_.store(true, std::memory_order_release);
            return;
        }
    }
}

Result<bool> BoardLink::take() {
    const bool broken = broken_.load(std::memory_order_acquire);  // read first: earlier bytes are still taken below
    if (const auto chunk = ring_->pop()) {
        std::copy_n(chunk->bytes.begin(), chunk->size, buffer_.begin());
        pending_ = std::span(buffer_).first(chunk->size);
        arrival_ = chunk->arrival;
        doubt_ = Seconds(0);
        return true;
    }
    if (broken) return fail(ErrorCode::Device, "{}", broke_);
    return false;
}

Result<bool> BoardLink::fill(Seconds timeout) {
    if (ring_) return take();
    const auto got = transport_->read(buffer_, timeout);
    const Instant before = std::exchange(looked_, clock_.now());
    if (!got) {
        if (got.error().code == ErrorCode::Timeout) return false;
        return fail(ErrorCode::Device, "{}", got.error().message);
    }
    arrival_ = looked_;
    // A caller that waits sees the bytes at the moment they come.
    doubt_ = timeout > Seconds(0) ? Seconds(0) : Seconds(arrival_ - before);
    pending_ = std::span(buffer_).first(std::min(*got, buffer_.size()));
    return true;
}

std::uint64_t BoardLink::dropped() const noexcept {
    const auto chunks = ring_ ? ring_->dropped() : 0;
    return transport_->dropped() + chunks * sizeof(Chunk::bytes);
}

Result<Frame> BoardLink::ask(Command command, Reply answer, std::span<const std::uint8_t> payload) {
    const auto before = counts();
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        token_ = static_cast<std::uint8_t>(token_ % kTokens + 1);
        const auto bytes = encodeCommand(command, token_, payload);
        sent_ = clock_.now();
        if (const auto written = transport_->write(bytes, kWriteTime); !written) {
            return fail(ErrorCode::Device, "{}", written.error().message);
        }
        const auto frame = await(command, answer, token_);
        if (!frame) return failure(frame);
        if (*frame) return **frame;
        if (counts().bytes - before.bytes > kMaxNoise) break;
    }
    const auto sound = counts().frames - before.frames;
    const auto bytes = counts().bytes - before.bytes;
    if (bytes == 0)
        return fail(ErrorCode::Timeout, "it does not answer {} within {} s", nameOf(command), kAttempt.count());
    if (sound == 0) {
        return fail(ErrorCode::Device,
                    "it answers {} with garbage: {} bytes without a valid frame of the sensor board protocol",
                    nameOf(command), bytes);
    }
    return fail(ErrorCode::Timeout, "it sends {} frames but no answer to {} within {} s", sound, nameOf(command),
                kAttempt.count());
}

Result<void> BoardLink::order(Command command) {
    const auto answer = ask(command, Reply::Done);
    if (!answer) return failure(answer);
    if (const auto done = readDone(*answer, command); !done) return fail(ErrorCode::Device, "{}", done.error().message);
    return {};
}

Result<std::optional<Frame>> BoardLink::await(Command command, Reply answer, std::uint8_t token) {
    const auto begin = counts().bytes;
    const Instant deadline = clock_.now() + toInstant(kAttempt);
    for (;;) {
        while (const auto frame = next()) {
            if (tokenOf(*frame) != token) continue;
            if (frame->is(answer)) return frame;
            if (!frame->is(Reply::Refused)) continue;
            const auto refusal = readRefusal(*frame);
            if (!refusal || refusal->command != static_cast<std::uint8_t>(command)) continue;
            return fail(ErrorCode::Device, "it refuses {}: {}", nameOf(command), refusal->text());
        }
        const Instant left = deadline - clock_.now();
        if (left <= Instant(0) || counts().bytes - begin > kMaxNoise) return std::optional<Frame>{};
        const auto came = fill(Seconds(left));
        if (!came) return failure(came);
        // The transport waited for its full timeout, even if a virtual clock did not move.
        if (!*came) return std::optional<Frame>{};
    }
}

void BoardLink::stopUnheard() noexcept { transport_->writeUrgent(stop_); }

}  // namespace tacto::sensorboard
