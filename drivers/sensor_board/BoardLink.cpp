#include "drivers/sensor_board/BoardLink.h"

#include <algorithm>

namespace tacto::sensorboard {

namespace {
constexpr Seconds kWriteTime{0.5};
constexpr unsigned kTokens = 250;  // those above are stopUnheard()'s
}  // namespace

std::string_view nameOf(Command command) noexcept {
    switch (command) {
        case Command::Hello:
            return "HELLO";
        case Command::GetConfiguration:
            return "GET_CONFIGURATION";
        case Command::SetConfiguration:
            return "SET_CONFIGURATION";
        case Command::GetCalibration:
            return "GET_CALIBRATION";
        case Command::Start:
            return "START";
        case Command::Stop:
            return "STOP";
        case Command::GetStatus:
            return "GET_STATUS";
    }
    return "a command";
}

Result<bool> BoardLink::fill(Seconds timeout) {
    const auto got = transport_->read(buffer_, timeout);
    if (!got) {
        if (got.error().code == ErrorCode::Timeout) return false;
        return fail(ErrorCode::Device, "{}", got.error().message);
    }
    arrival_ = clock_.now();
    pending_ = std::span(buffer_).first(std::min(*got, buffer_.size()));
    return true;
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
        if (counts().bytes - before.bytes > kNoiseMost) break;
    }
    const auto sound = counts().frames - before.frames;
    const auto bytes = counts().bytes - before.bytes;
    if (bytes == 0)
        return fail(ErrorCode::Timeout, "it does not answer {} within {} s", nameOf(command), kAttempt.count());
    if (sound == 0) {
        return fail(ErrorCode::Device,
                    "it answers {} with garbage: {} bytes without a sound frame of the sensor board protocol",
                    nameOf(command), bytes);
    }
    return fail(ErrorCode::Timeout, "it sends {} frames but no answer to {} within {} s", sound, nameOf(command),
                kAttempt.count());
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
        if (left <= Instant(0) || counts().bytes - begin > kNoiseMost) return std::optional<Frame>{};
        const auto came = fill(Seconds(left));
        if (!came) return failure(came);
        // The transport waited as long as it was told to, whatever the clock says.
        if (!*came) return std::optional<Frame>{};
    }
}

void BoardLink::stopUnheard() noexcept { transport_->writeUrgent(stop_); }

}  // namespace tacto::sensorboard
