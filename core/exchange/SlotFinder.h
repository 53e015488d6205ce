// SlotFinder.h - the places of a stream's samples on a regular grid, for formats that hold no stamps: the slot nearest
// to each stamp.
//
// Thread-safety: one owner.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace tacto {

/// What the samples of a stream become on the grid.
struct GridCounts {
    std::uint64_t repeated = 0;  ///< slots filled by the sample before, where the clock slipped by one
    std::uint64_t dropped = 0;   ///< samples whose slot a later one has, or that lie before the first slot or the last
    double maxTimeError_s = 0;   ///< from a stamp to its slot
};

/// Finds the slot of each sample of a stream, in order.
class SlotFinder {
public:
    /// Slot k is at k / slotRate_hz; `usualRate_hz` tells a gap from a slip.
    SlotFinder(double slotRate_hz, double usualRate_hz) : slotRate_hz_(slotRate_hz), slip_s_(1.5 / usualRate_hz) {}

    struct Place {
        std::uint64_t slot;
        bool slipped;  ///< the slot before it has no sample, without a gap: the sample before stands there too
    };
    /// Returns nothing for a sample that is dropped.
    [[nodiscard]] std::optional<Place> next(double t_s);
    /// Takes the first samples that lie each in the slot after that of the sample before, and returns their number: as
    /// next() of each, faster.
    [[nodiscard]] std::size_t follow(std::span<const double> t_s);
    /// Of the last sample that was not dropped.
    [[nodiscard]] std::uint64_t lastSlot() const noexcept { return static_cast<std::uint64_t>(last_); }
    [[nodiscard]] GridCounts counts() const;

private:
    double slotRate_hz_, slip_s_;
    // Of the last sample, which the next may replace.
    std::int64_t last_ = -1;  // -1: there is none
    double last_s_ = -INFINITY, lastError_s_ = 0;
    GridCounts counts_;
};

}  // namespace tacto
