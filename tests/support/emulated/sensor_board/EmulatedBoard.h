// EmulatedBoard.h - a sensor board without hardware: bytes in, bytes out, all on the time it is given. It speaks
// through the C99 encoder that firmware compiles (resources/firmware/sensor_board). No I/O and no thread:
// EmulatedBoardLine, a pseudo-terminal or an emulated USB node carries its bytes.
//
// Its clock runs apart from the host's; its line loses, doubles, swaps and spoils blocks; it falls silent, talks
// garbage, starts over. All of it follows from the seed and from when it is asked, and is counted, so that a test knows
// exactly what must be missing.
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

/// What the line does to blocks, as shares of them.
struct LineFlaws {
    double drop = 0;       ///< not sent
    double duplicate = 0;  ///< sent twice
    double swap = 0;       ///< sent behind the following one
    double flip = 0;       ///< the chance that one bit is wrong, the delimiter's apart
};

struct EmulatedBoardSettings {
    std::string name = "emulated sensor board";
    std::string serial = "EMU-0001";
    std::string firmware = TACTOSCOPE_VERSION;
    std::uint8_t lowestVersion = 1, highestVersion = 1;
    double tickRate_hz = 4000;  ///< rate of the signal's steps; every stream's rate divides it
    double rate_hz = 4000;
    double slowRate_hz = 200;
    std::uint8_t blockSamples = 32, slowBlockSamples = 2;
    bool wideForce = false;                ///< force as int32
    std::optional<std::uint8_t> unit;      ///< unit of acceleration, in place of the right one
    std::optional<std::uint8_t> done;      ///< the command that each DONE names, in place of the right one
    double drift_ppm = 0;                  ///< how much faster its clock runs than the host's
    std::uint64_t powerUp_us = 1'234'567;  ///< what its clock says when it is made
    Seconds latency{300e-6};               ///< delay of a frame on its way, at least
    Seconds jitter{0};                     ///< mean of an exponential delay on top
    LineFlaws flaws;
    std::size_t bufferBytes = 65536;  ///< with more bytes, new blocks are thrown away
    std::uint64_t seed = 1;
};

class EmulatedBoard {
public:
    static constexpr std::size_t kStreams = 3;

    /// What became of the blocks of one stream since START.
    struct Fate {
        std::uint64_t made = 0;     ///< blocks
        std::uint64_t samples = 0;  ///< in them
        std::uint64_t lost = 0;     ///< blocks that will not arrive whole and in their turn
        std::uint64_t lostSamples = 0;
        std::uint64_t late = 0;     ///< frames that arrive a second time, or behind a later one
        std::uint64_t flipped = 0;  ///< frames that arrive with a wrong bit; they count as lost
    };

    EmulatedBoard(std::unique_ptr<BoardSignal> signal, EmulatedBoardSettings settings, Instant now);

    /// Bytes from the host.
    void receive(std::span<const std::uint8_t> bytes, Instant now);
    /// Bytes for the host that are due by `now`; returns how many were written to `into`.
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now);
    /// When the next bytes for the host are due, if it can be told.
    [[nodiscard]] std::optional<Instant> nextTransmit() const noexcept;

    /// Samples are still taken, and nothing is sent any longer.
    void fallSilent() noexcept { silent_ = true; }
    /// Replaces every frame by noise, from now on or no longer.
    void talkGarbage(bool on) noexcept { garbage_ = on; }
    /// From now on the line treats blocks in this way.
    void spoil(const LineFlaws& flaws) noexcept { flaws_ = flaws; }
    /// The next block of `stream` is not sent.
    void dropNext(std::size_t stream) noexcept { dropNext_[stream] = true; }
    /// The sensor of `stream` makes `samples` samples that the board does not fetch.
    void overrun(std::size_t stream, std::uint32_t samples);
    /// The watchdog bites: the clock begins at 0, and so do the blocks, without a START.
    void restart(Instant now);
    void jumpClock(Seconds ahead);

    [[nodiscard]] const Fate& fate(std::size_t stream) const noexcept { return streams_[stream].fate; }
    [[nodiscard]] bool running() const noexcept { return running_; }
    /// The time on its own clock.
    [[nodiscard]] std::uint64_t time_us(Instant now) const noexcept;
    [[nodiscard]] BoardSignal& signal() noexcept { return *signal_; }
    [[nodiscard]] const tsb_configuration& configuration(std::size_t stream) const noexcept {
        return streams_[stream].configuration;
    }

private:
    struct Stream {
        tsb_configuration configuration{};
        std::uint8_t blockSamples = 1;
        std::int64_t divisor = 1;  // ticks a sample
        std::uint32_t sequence = 0, index = 0, skip = 0;
        std::uint64_t blockTime_us = 0;
        std::uint8_t held = 0;  // samples in the block under way
        std::array<std::int32_t, 128> raw{};
        std::vector<std::uint8_t> waiting;  // a block that the next one overtakes
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
    bool running_ = false, silent_ = false, garbage_ = false;
    double started_us_ = 0;
    std::int64_t tick_ = 0;  // the next one
    double nextStatus_us_ = 0;
    std::uint32_t samplesLost_ = 0, blocksDropped_ = 0;
};

}  // namespace tacto::sensorboard
