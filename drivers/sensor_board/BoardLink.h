// BoardLink.h - sends commands to a sensor board and receives its frames, over a Transport.
//
// ask() waits for a limited time: three attempts of 0.3 s, at most 64 KiB of other data. A board that sends only noise,
// or nothing, is therefore refused.
//
// listen() starts a thread that reads all the time, so that arrival times are exact: a session reads every 2 ms at
// best, a busy one less often. On a virtual clock only fill() reads; doubt() then states the uncertainty.
//
// Thread-safety: none; one owner. The thread shares only a ring and two flags with it.
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
    /// Waits for the thread, at most kListenTimeout.
    ~BoardLink();
    BoardLink(const BoardLink&) = delete;
    BoardLink& operator=(const BoardLink&) = delete;

    /// Sends a command and waits for its answer, which is valid until the next call. Other frames are skipped.
    /// Errors: Timeout if no valid frame came; Device if only noise came, the board refused, or the line failed.
    [[nodiscard]] Result<Frame> ask(Command command, Reply answer, std::span<const std::uint8_t> payload = {});

    /// Sends a command whose answer is DONE. Errors: as ask(); Device if the answer names another command.
    [[nodiscard]] Result<void> order(Command command);

    /// Returns the next frame of the bytes read so far; nothing if they are used up: see fill().
    [[nodiscard]] std::optional<Frame> next() noexcept { return decoder_.take(pending_); }
    /// Starts the reading thread; ask() must not be called afterwards. Does nothing on a virtual clock.
    void listen();
    /// Takes the bytes that have arrived; returns false if there are none. `timeout` 0 does not wait; while the thread
    /// listens, `timeout` is ignored and nothing waits. Errors: Device.
    [[nodiscard]] Result<bool> fill(Seconds timeout);
    /// Returns when fill() last got bytes, on the session's clock.
    [[nodiscard]] Instant arrival() const noexcept { return arrival_; }
    /// Returns how much earlier than arrival() the bytes may have come.
    [[nodiscard]] Seconds doubt() const noexcept { return doubt_; }
    /// Returns when ask() last sent something.
    [[nodiscard]] Instant sent() const noexcept { return sent_; }

    /// Tells the board to stop, without waiting for an answer.
    void stopUnheard() noexcept;

    [[nodiscard]] const LineCounts& counts() const noexcept { return decoder_.counts(); }
    /// Returns how many bytes were lost because they were not read in time.
    [[nodiscard]] std::uint64_t dropped() const noexcept;

private:
    /// The bytes of one read by the thread: one or a few full-speed packets.
    struct Chunk {
        Instant arrival;
        std::uint32_t size;
        std::array<std::uint8_t, 500> bytes;
    };
    static constexpr std::size_t kChunks = 512;     ///< room for several seconds of a board's stream
    static constexpr Seconds kListenTimeout{0.05};  ///< longest single wait

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
    std::unique_ptr<SpscRing<Chunk>> ring_;  // exists while the thread listens
    std::atomic<bool> ending_{false};
    std::atomic<bool> broken_{false};
    std::string broke_;  // why the line broke; written once, before broken_ is set
    std::thread thread_;
    Instant sent_{0};
    std::uint8_t token_ = 0;
    const std::vector<std::uint8_t> stop_ = encodeCommand(Command::Stop, 255);  // encoded in advance
};

/// Returns a command's name, such as "HELLO", for messages.
[[nodiscard]] std::string_view nameOf(Command command) noexcept;

}  // namespace tacto::sensorboard
