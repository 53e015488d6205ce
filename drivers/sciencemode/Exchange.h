// Exchange.h - one request and its ack over a Transport.
//
// An ack belongs to a request by packet number and command. What comes late, twice, unasked or as junk is dropped and
// counted, so that a device that answers with garbage costs the time allowed and a bounded number of bytes, no more.
// Packet numbers 62 and 63 are kept for the stop frames, which are sent past all this by Transport::writeUrgent().
//
// Thread-safety: one caller at a time; stopFrames() any thread.
#pragma once

#include "core/base/Clock.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sciencemode/ScienceModeCommands.h"

namespace tacto::sciencemode {

/// How long an ack may take, counted from the end of the pulse where the request starts one.
inline constexpr Seconds kAnswerTime{0.05};

struct ExchangeCounts {
    std::uint64_t junkBytes = 0;
    std::uint64_t brokenFrames = 0;
    std::uint64_t strayAcks = 0;  ///< late, repeated or unasked
};

/// LL_STOP and ML_STOP, encoded before they are needed.
struct StopFrames {
    FrameBytes lowLevel;
    FrameBytes midLevel;
    /// The two behind each other: one message, since a transport keeps but the newest that waits.
    std::array<std::uint8_t, Transport::kMaxUrgent> both{};
    std::size_t bothSize = 0;
    [[nodiscard]] std::span<const std::uint8_t> everything() const noexcept { return {both.data(), bothSize}; }
};
[[nodiscard]] const StopFrames& stopFrames() noexcept;

class Exchange {
public:
    /// Both arguments outlive the exchange.
    Exchange(Transport& transport, const Clock& clock) : transport_(transport), clock_(clock) {}

    /// Sends a request; its ack is the next that receive() gives. Errors: as Transport::write().
    [[nodiscard]] Result<void> send(Command command, std::span<const std::uint8_t> payload);

    /// The payload of the ack to the last send(), valid until the next call. Waits for it as long as `allowed`.
    /// Errors: Timeout when nothing came; Device for garbage, a refusal (GENERAL_ERROR, UNKNOWN_COMMAND), or when the
    /// device is gone.
    [[nodiscard]] Result<std::span<const std::uint8_t>> receive(Seconds allowed = kAnswerTime);

    [[nodiscard]] Result<std::span<const std::uint8_t>> ask(Command command, std::span<const std::uint8_t> payload = {},
                                                            Seconds allowed = kAnswerTime);

    /// The transport failed: nothing more will come of it.
    [[nodiscard]] bool gone() const noexcept { return gone_; }
    [[nodiscard]] ExchangeCounts counts() const noexcept;

private:
    static constexpr std::size_t kMaxGarbage = 262'144;  ///< bytes read for one ack; USB gives 60 kB in 50 ms

    [[nodiscard]] Result<std::size_t> refill(Seconds left);
    [[nodiscard]] tl::unexpected<Error> silence(std::uint64_t junkBefore) const;

    Transport& transport_;
    const Clock& clock_;
    FrameDecoder decoder_;
    FrameBytes frame_;
    std::array<std::uint8_t, 512> chunk_{};
    std::span<const std::uint8_t> unread_;  // of chunk_
    Command command_ = Command::Reset;      // last sent
    std::uint8_t number_ = 61;              // last sent
    std::uint64_t stray_ = 0;
    bool gone_ = false;
};

}  // namespace tacto::sciencemode
