// BaselineDrift.h - finds a baseline that wanders (amplifier warming up, mains hum) under the pulses on it. Private to
// core/measure.
//
// The baseline is the median of every block of the record, joined by straight lines: a pulse that fills less than half
// of its block moves no median. A baseline bends by less than a fifth of its span from block to block; a jump, even a
// single one, is a change of state and not drift. The longest blocks that leave only noise about the line are used. At
// least seven tenths of the samples must be baseline; otherwise the record is left unchanged.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/measure/SampleBlocks.h"

namespace tacto {

struct BaselineDrift {
    std::vector<double> medians;  ///< medians of the blocks, each at the middle of its block
    std::size_t block = 0;        ///< samples in a block
    double span = 0;              ///< difference between the highest and the lowest median

    [[nodiscard]] double at(std::size_t sample) const noexcept;
};

/// `noise`: standard deviation between neighbours; `lsb` 0 = unknown. Reads at most about 200 000 samples. Returns
/// nothing if the baseline stays level, or if the movement is not that of a baseline.
[[nodiscard]] std::optional<BaselineDrift> findDrift(std::span<const float> samples, double noise, double lsb);

/// Subtracts the drift. The baseline is then the median of the medians, so that an offset stays.
[[nodiscard]] SampleView withoutDrift(const SampleView& view, const BaselineDrift& drift);

}  // namespace tacto
