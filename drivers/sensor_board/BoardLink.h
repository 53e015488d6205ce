// BoardLink.h - questions to a board and the frames that come from it, over a Transport.
//
// ask() waits, within bounds: three attempts of 0.3 s, 64 KiB of other data. A board that floods the line with
// noise, or says nothing, is refused in the end, never waited for.
//
// listen() starts a thread that reads what comes, so that it is known when it came: a session looks every 2 ms at best,
// and a busy one now and then. On a virtual clock nothing reads but fill(), and the doubt is said (doubt()).
//
// Thread-safety: none; one owner. The thread shares a ring and two flags with it.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "core/base/Clock.h"
#include "core/base/SpscRing.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sensor_board/Messages.h"

namespace tacto::sensorboard {

class BoardLink {
public:
    static constexpr Seconds kAttempt{0.3};
    static constexpr int kAttempts = 3;
    static constexpr std::size_t kMaxNoise = 65536;

    BoardLink(std::unique_ptr<Transport> transport, const Clock& clock)
        : transport_(std::move(transport)), clock_(clock) {}
    /// Waits for the thread: kListenTimeout at most.
    ~BoardLink();
    BoardLink(const BoardLink&) = delete;
    BoardLink& operator=(const BoardLink&) = delete;

    /// Sends a command and waits for its answer, which is valid until the next call. Other frames are passed over.
    /// Errors: Timeout where no valid frame came; Device where only noise did, the board refused, or the line failed.
    [[nodiscard]] Result<Frame> ask(Command command, Reply answer, std::span<const std::uint8_t> payload = {});

    /// Sends a command that is answered by DONE. Errors: as ask(); Device for an answer that names another command.
    [[nodiscard]] Result<void> order(Command command);

    /// The next frame of what has been read; nothing when that is used up: see fill().
    [[nodiscard]] std::optional<Frame> next() noexcept { return decoder_.take(pending_); }
    /// From now on a thread reads; ask() must not be called any longer. Does nothing on a virtual clock.
    void listen();
    /// Reads what has arrived; false when there is nothing. `timeout` 0 does not wait; ignored while a thread listens,
    /// when nothing waits. Errors: Device.
    [[nodiscard]] Result<bool> fill(Seconds timeout);
    /// When fill() last got something, on the session's clock.
    [[nodiscard]] Instant arrival() const noexcept { return arrival_; }
    /// How much earlier it may have come.
    [[nodiscard]] Seconds doubt() const noexcept { return doubt_; }
    /// When ask() last sent something.
    [[nodiscard]] Instant sent() const noexcept { return sent_; }

    /// Tells the board to stop, without waiting for anything.
    void stopUnheard() noexcept;

    [[nodiscard]] const LineCounts& counts() const noexcept { return decoder_.counts(); }
    /// Bytes that were not read in time.
    [[nodiscard]] std::uint64_t dropped() const noexcept;

private:
    /// The bytes of one read of the thread: a full-speed packet or a few.
    struct Chunk {
        Instant arrival;
        std::uint32_t size;
        std::array<std::uint8_t, 500> bytes;
    };
    static constexpr std::size_t kChunks = 512;     ///< seconds of a board's stream
    static constexpr Seconds kListenTimeout{0.05};  ///< the longest wait at a time

    void run() noexcept;
    [[nodiscard]] Result<bool> take();
    [[nodiscard]] Result<std::optional<Frame>> await(Command command, Reply answer, std::uint8_t token);

    const std::unique_ptr<Transport> transport_;
    const Clock& clock_;
    FrameDecoder decoder_;
    std::array<std::uint8_t, 4096> buffer_{};
    std::span<const std::uint8_t> pending_;
    Instant arrival_{0};
    Instant looked_{0};
    Seconds doubt_{0};
    std::unique_ptr<SpscRing<Chunk>> ring_;  // there while a thread listens
    std::atomic<bool> ending_{false};
    std::atomic<bool> broken_{false};
    std::string broke_;  // why it broke; written once, before broken_ is set
    std::thread thread_;
    Instant sent_{0};
    std::uint8_t token_ = 0;
    const std::vector<std::uint8_t> stop_ = encodeCommand(Command::Stop, 255);  // made before it is needed
};

/// "HELLO", for messages.
[[nodiscard]] std::string_view nameOf(Command command) noexcept;

}  // namespace tacto::sensorboard
