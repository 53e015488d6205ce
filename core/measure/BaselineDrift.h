// BaselineDrift.h - a baseline that wanders (an amplifier that warms up, mains hum) and pulses that stand on it.
// Private to core/measure.
//
// The wandering is the median of every block of the record, joined by straight lines: a pulse that fills less than half
// of its block moves no median. What is followed bends by less than a fifth of its span from block to block: what
// jumps, and be it once, is a state of the signal. The longest blocks that leave nothing but noise between them are
// taken. It is found only where at least seven tenths of the samples are baseline; else the record is left as it is.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/measure/SampleBlocks.h"

namespace tacto {

struct BaselineDrift {
    std::vector<double> medians;  ///< medians of the blocks, at their middles
    std::size_t block = 0;        ///< samples in one
    double span = 0;              ///< highest less lowest median

    [[nodiscard]] double at(std::size_t sample) const noexcept;
};

/// `noise`: standard deviation from neighbour to neighbour; `lsb` 0 = unknown. Reads at most some 200 000 samples.
/// None: the baseline stays where it is, or what moves is not a baseline.
[[nodiscard]] std::optional<BaselineDrift> findDrift(std::span<const float> samples, double noise, double lsb);

/// What is left: the baseline at the median of the medians, so that an offset stays.
[[nodiscard]] SampleView withoutDrift(const SampleView& view, const BaselineDrift& drift);

}  // namespace tacto
