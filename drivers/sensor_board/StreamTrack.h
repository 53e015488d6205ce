// StreamTrack.h - follows one stream of a board: finds the next blocks and gaps, and scales raw numbers to samples.
//
// A gap is never filled: the samples after it carry the board's own later time stamps. The board's numbers show exactly
// what is missing: the sequence number gives lost blocks, the index lost samples.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "core/base/Stream.h"
#include "drivers/sensor_board/Messages.h"

namespace tacto::sensorboard {

/// Counts since the start of the stream; they only grow.
struct StreamCounts {
    std::uint64_t blocks = 0;  ///< blocks used
    std::uint64_t samples = 0;
    std::uint64_t gaps = 0;         ///< places where samples are missing
    std::uint64_t lostBlocks = 0;   ///< lost on the line or in the board's full buffer
    std::uint64_t lostSamples = 0;  ///< lost with blocks, or never fetched from the sensor
    std::uint64_t late = 0;         ///< unused blocks that came again or after later ones
    std::uint64_t unsound = 0;      ///< unused blocks that contradict the configuration or the block before

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
    /// Returns the board time of a block's last sample in µs.
    [[nodiscard]] static std::uint64_t endOf(const DataBlock& block) noexcept;
    /// Appends the samples of a block for which take() returned Next, at the times that `timeOf` gives for board times.
    void append(const DataBlock& block, const std::function<double(double us)>& timeOf, SampleBlock& into) const;

    [[nodiscard]] const StreamConfiguration& configuration() const noexcept { return configuration_; }
    [[nodiscard]] const StreamCounts& counts() const noexcept { return counts_; }
    /// Returns the number of late blocks in a row: a board that restarts counts from 0.
    [[nodiscard]] std::uint64_t lateInARow() const noexcept { return lateInARow_; }

    static constexpr double kIntervalTolerance = 0.1;

private:
    [[nodiscard]] bool sound(const DataBlock& block) const noexcept;

    const StreamConfiguration configuration_;
    const double nominal_ns_;
    bool begun_ = false;
    std::uint32_t nextSequence_ = 0;
    std::uint32_t nextIndex_ = 0;
    std::uint64_t last_us_ = 0;  // time of the last sample
    std::uint64_t lateInARow_ = 0;
    StreamCounts counts_;
};

/// Follows the numbers of messages that have no samples.
class SequenceTrack {
public:
    /// Returns how many are missing before this one; nothing for one that came again or after a later one.
    [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t sequence) noexcept {
        const std::uint32_t ahead = begun_ ? sequence - next_ : 0;
        if (ahead > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
        begun_ = true;
        next_ = sequence + 1;
        return ahead;
    }

private:
    bool begun_ = false;
    std::uint32_t next_ = 0;
};

}  // namespace tacto::sensorboard
