// StreamTrack.h - one stream of a board: which blocks are next, what is missing, and samples from raw numbers.
//
// A gap is never filled: samples behind it carry the board's own later time stamps. What is missing is known exactly,
// from the board's numbers: blocks from the sequence, samples from the index.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>

#include "drivers/sensor_board/ClockFit.h"
#include "drivers/sensor_board/Messages.h"

namespace tacto::sensorboard {

/// Counted since the start of the stream. Counts only grow.
struct StreamCounts {
    std::uint64_t blocks = 0;  ///< used
    std::uint64_t samples = 0;
    std::uint64_t gaps = 0;         ///< places where something is missing
    std::uint64_t lostBlocks = 0;   ///< lost on the line or in the board's full buffer
    std::uint64_t lostSamples = 0;  ///< in lost blocks, or never fetched by the board
    std::uint64_t late = 0;         ///< blocks that came again or behind later ones: not used
    std::uint64_t unsound = 0;      ///< blocks that contradict the configuration or the block before: not used

    StreamCounts& operator+=(const StreamCounts& more) noexcept {
        blocks += more.blocks;
        samples += more.samples;
        gaps += more.gaps;
        lostBlocks += more.lostBlocks;
        lostSamples += more.lostSamples;
        late += more.late;
        unsound += more.unsound;
        return *this;
    }
};

class StreamTrack {
public:
    explicit StreamTrack(StreamConfiguration configuration);

    enum class Verdict { Next, Late, Unsound };
    /// Judges a block and counts what is missing before it.
    [[nodiscard]] Verdict take(const DataBlock& block) noexcept;
    /// Board time of a block's last sample, µs.
    [[nodiscard]] static std::uint64_t endOf(const DataBlock& block) noexcept;
    /// Appends the samples of a block that take() found next.
    void append(const DataBlock& block, const ClockFit& clock, SampleBlock& into) const;

    [[nodiscard]] const StreamConfiguration& configuration() const noexcept { return configuration_; }
    [[nodiscard]] const StreamCounts& counts() const noexcept { return counts_; }
    /// Late blocks in a row: a board that began again counts from 0.
    [[nodiscard]] std::uint64_t lateInARow() const noexcept { return lateInARow_; }

    static constexpr double kIntervalTolerance = 0.1;

private:
    [[nodiscard]] bool sound(const DataBlock& block) const noexcept;

    const StreamConfiguration configuration_;
    const double nominal_ns_;
    bool begun_ = false;
    std::uint32_t nextSequence_ = 0;
    std::uint32_t nextIndex_ = 0;
    std::uint64_t last_us_ = 0;  // the last sample's time
    std::uint64_t lateInARow_ = 0;
    StreamCounts counts_;
};

}  // namespace tacto::sensorboard
