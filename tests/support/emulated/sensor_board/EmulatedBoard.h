// EmulatedBoard.h - a sensor board without hardware: takes and returns bytes at the times it is given. It uses the C99
// encoder of the firmware (resources/firmware/sensor_board). No I/O and no thread: EmulatedBoardLine, a pseudo-terminal
// or an emulated USB node carries the bytes.
//
// Its clock drifts from the host's; its line loses, doubles, swaps and corrupts blocks; it can fall silent, send
// garbage or restart. Everything depends only on the seed and the times of the calls, and is counted, so that a test
// knows exactly what must be missing.
//
// Three streams: 0 acceleration (3 × int16), 1 taxels (8 × int16), 2 force (1 × int16, or int32).
//
// Thread-safety: none; the owner locks. Time never goes back between calls.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Random.h"
#include "core/base/Units.h"
#include "resources/firmware/sensor_board/tsb_board.h"
#include "tests/support/emulated/sensor_board/BoardSignal.h"

namespace tacto::sensorboard {

/// What the line does to blocks, as shares of all blocks.
struct LineFlaws {
    double drop = 0;       ///< not sent
    double duplicate = 0;  ///< sent twice
    double swap = 0;       ///< sent after the following block
    double flip = 0;       ///< chance of one wrong bit outside the delimiter
};

struct EmulatedBoardSettings {
    std::string name = "emulated sensor board";
    std::string serial = "EMU-0001";
    std::string firmware = TACTOSCOPE_VERSION;
    std::uint8_t lowestVersion = 1, highestVersion = 1;
    double tickRate_hz = 4000;  ///< rate of the signal's steps, a multiple of each stream's rate
    double rate_hz = 4000;
    double slowRate_hz = 200;
    std::uint8_t blockSamples = 32, slowBlockSamples = 2;
    bool wideForce = false;            ///< send force as int32
    std::optional<std::uint8_t> unit;  ///< a wrong unit for acceleration; empty: the right unit
    /// What encodes in it, for version 2; empty: it has no encoder. Its messages come by EmulatedBoard::send().
    std::optional<tsb_encoder> encoder;
    std::optional<std::uint8_t> done;      ///< a wrong command in each DONE; empty: the right command
    double drift_ppm = 0;                  ///< how much faster the board's clock runs than the host's
    std::uint64_t powerUp_us = 1'234'567;  ///< its clock's time when the board is made
    Seconds latency{300e-6};               ///< least delay of a frame
    Seconds jitter{0};                     ///< mean of an additional exponential delay
    LineFlaws flaws;
    std::size_t bufferBytes = 65536;  ///< when this buffer is full, new blocks are discarded
    std::uint64_t seed = 1;
};

class EmulatedBoard {
public:
    static constexpr std::size_t kStreams = 3;

    /// What happened to the blocks of one stream since START.
    struct Fate {
        std::uint64_t made = 0;     ///< blocks made
        std::uint64_t samples = 0;  ///< samples in these blocks
        std::uint64_t lost = 0;     ///< blocks that do not arrive intact and in order
        std::uint64_t lostSamples = 0;
        std::uint64_t late = 0;     ///< frames that arrive twice, or after a later frame
        std::uint64_t flipped = 0;  ///< frames that arrive with a wrong bit; also counted as lost
    };

    EmulatedBoard(std::unique_ptr<BoardSignal> signal, EmulatedBoardSettings settings, Instant now);

    /// Receives bytes from the host.
    void receive(std::span<const std::uint8_t> bytes, Instant now);
    /// Moves bytes for the host that are due by `now` into `into`; returns how many.
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now);
    /// Returns when the next bytes for the host are due, if that is known.
    [[nodiscard]] std::optional<Instant> nextTransmit() const noexcept;

    /// Keeps sampling but sends nothing from now on.
    void fallSilent() noexcept { silent_ = true; }
    /// Sends a whole frame, also one that it could not make itself.
    void send(std::span<const std::uint8_t> frame, Instant now) { queue(frame, now); }
    /// Replaces every frame by noise while `on`.
    void talkGarbage(bool on) noexcept { garbage_ = on; }
    /// Applies these flaws to blocks from now on.
    void spoil(const LineFlaws& flaws) noexcept { flaws_ = flaws; }
    /// Does not send the next block of `stream`.
    void dropNext(std::size_t stream) noexcept { dropNext_[stream] = true; }
    /// Makes the sensor of `stream` take `samples` samples that the board does not fetch.
    void overrun(std::size_t stream, std::uint32_t samples);
    /// Acts like a watchdog reset: clock and block numbers begin at 0, without a START.
    void restart(Instant now);
    void jumpClock(Seconds ahead);

    [[nodiscard]] const Fate& fate(std::size_t stream) const noexcept { return streams_[stream].fate; }
    [[nodiscard]] bool running() const noexcept { return running_; }
    /// Returns the encoder's mode, as the host set it.
    [[nodiscard]] std::uint8_t mode() const noexcept { return mode_; }
    /// Returns the time on the board's own clock.
    [[nodiscard]] std::uint64_t time_us(Instant now) const noexcept;
    [[nodiscard]] BoardSignal& signal() noexcept { return *signal_; }
    [[nodiscard]] const tsb_configuration& configuration(std::size_t stream) const noexcept {
        return streams_[stream].configuration;
    }

private:
    struct Stream {
        tsb_configuration configuration{};
        std::uint8_t blockSamples = 1;
        std::int64_t divisor = 1;  // ticks per sample
        std::uint32_t sequence = 0, index = 0, skip = 0;
        std::uint64_t blockTime_us = 0;
        std::uint8_t held = 0;  // samples in the unfinished block
        std::array<std::int32_t, 128> raw{};
        std::vector<std::uint8_t> waiting;  // a block that is sent after the next one
        Fate fate;
    };
    struct Outgoing {
        Instant due{0};
        std::vector<std::uint8_t> bytes;
    };

    void advance(Instant now);
    void begin(Instant now);
    void sample(Stream& stream, std::size_t number, std::uint64_t time_us, Instant at);
    void finishBlock(Stream& stream, std::size_t number, Instant at);
    void sendBlock(Stream& stream, std::vector<std::uint8_t> bytes, std::uint8_t count, Instant at);
    void answer(const tsb_command& command, Instant now);
    void setConfiguration(const tsb_command& command, Instant now);
    void sendStatus(std::uint8_t token, Instant now);
    void queue(std::span<const std::uint8_t> bytes, Instant at);
    void lose(Stream& stream, std::uint8_t count) noexcept;
    [[nodiscard]] std::array<double, BoardSignal::kTaxels> valuesOf(std::size_t number) const;
    [[nodiscard]] Instant hostTime(double device_us) const noexcept;
    [[nodiscard]] std::optional<std::int64_t> divisorOf(std::uint32_t rate_mhz) const noexcept;

    const EmulatedBoardSettings settings_;
    const std::unique_ptr<BoardSignal> signal_;
    LineFlaws flaws_;
    Instant madeAt_;
    double origin_us_;  // board time at madeAt_
    std::array<Stream, kStreams> streams_;
    std::array<bool, kStreams> dropNext_{};
    tsb_receiver receiver_{};
    Random random_;
    std::deque<Outgoing> outgoing_;
    std::size_t queuedBytes_ = 0;
    std::size_t sentOfFront_ = 0;
    Instant lastDue_{0};
    std::uint8_t mode_ = TSB_MODE_OFF;
    bool running_ = false, silent_ = false, garbage_ = false;
    double started_us_ = 0;
    std::int64_t tick_ = 0;  // the next tick
    double nextStatus_us_ = 0;
    std::uint32_t samplesLost_ = 0, blocksDropped_ = 0;
};

}  // namespace tacto::sensorboard
