// Exchange.h - sends one request over a Transport and receives its ack.
//
// An ack belongs to a request by packet number and command. Late, repeated, unasked and garbled bytes are dropped and
// counted, so that a device that answers with garbage costs only the allowed time and a bounded number of bytes. Packet
// numbers 62 and 63 are reserved for the stop frames, which bypass this class through Transport::writeUrgent().
//
// Thread-safety: one caller at a time; stopFrames() any thread.
#pragma once

#include "core/base/Clock.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sciencemode/ScienceModeCommands.h"

namespace tacto::sciencemode {

/// How long an ack may take, counted from the end of the pulse if the request starts a pulse.
inline constexpr Seconds kAnswerTime{0.05};

struct ExchangeCounts {
    std::uint64_t junkBytes = 0;
    std::uint64_t brokenFrames = 0;
    std::uint64_t strayAcks = 0;  ///< acks that came late, repeated or unasked
};

/// LL_STOP and ML_STOP, encoded in advance.
struct StopFrames {
    FrameBytes lowLevel;
    FrameBytes midLevel;
    /// Both frames in one message, because a transport keeps only the newest urgent message.
    std::array<std::uint8_t, Transport::kMaxUrgent> both{};
    std::size_t bothSize = 0;
    [[nodiscard]] std::span<const std::uint8_t> everything() const noexcept { return {both.data(), bothSize}; }
};
[[nodiscard]] const StopFrames& stopFrames() noexcept;

class Exchange {
public:
    /// Both arguments must outlive the exchange.
    Exchange(Transport& transport, const Clock& clock) : transport_(transport), clock_(clock) {}

    /// Sends a request; receive() then returns its ack. Errors: as Transport::write().
    [[nodiscard]] Result<void> send(Command command, std::span<const std::uint8_t> payload);

    /// Waits at most `allowed` for the ack to the last send() and returns its payload, valid until the next call.
    /// Errors: Timeout if nothing came; Device for garbage, a refusal (GENERAL_ERROR, UNKNOWN_COMMAND), or if the
    /// device is gone.
    [[nodiscard]] Result<std::span<const std::uint8_t>> receive(Seconds allowed = kAnswerTime);

    [[nodiscard]] Result<std::span<const std::uint8_t>> ask(Command command, std::span<const std::uint8_t> payload = {},
                                                            Seconds allowed = kAnswerTime);

    /// True if the transport failed: no more answers will come.
    [[nodiscard]] bool gone() const noexcept { return gone_; }
    [[nodiscard]] ExchangeCounts counts() const noexcept;

private:
    static constexpr std::size_t kMaxGarbage = 262'144;  ///< most bytes read for one ack; USB gives 60 kB in 50 ms

    [[nodiscard]] Result<std::size_t> refill(Seconds left);
    [[nodiscard]] tl::unexpected<Error> silence(std::uint64_t junkBefore) const;

    Transport& transport_;
    const Clock& clock_;
    FrameDecoder decoder_;
    FrameBytes frame_;
    std::array<std::uint8_t, 512> chunk_{};
    std::span<const std::uint8_t> unread_;  // points into chunk_
    Command command_ = Command::Reset;      // of the last request
    std::uint8_t number_ = 61;              // of the last request
    std::uint64_t stray_ = 0;
    bool gone_ = false;
};

}  // namespace tacto::sciencemode
