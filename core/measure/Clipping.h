// Clipping.h - which phases lost their tops to the oscilloscope's input range, and which may have. Private to
// core/measure.
//
// Clipping is known from the channel's range alone: a sample that stands at either end of it, which is where the
// full-scale codes are. Without a range nothing is called clipped, for the highest value of a record may be the
// signal's own. Where a top then keeps the record's extreme from sample to sample although the signal is noisy where it
// rests, the noise was cut off: such a phase is flat-topped, is measured, and flagged for the reader.
//
// Where the noise spans several codes, a third of them at the extreme is enough: an amplifier clipped and noise came
// after it.
//
// A top is flat when it keeps the extreme in 95 % of at least 10 samples that are at least half of the phase, and the
// resting signal jitters over three codes or more: such noise never keeps one code 95 % of the time. Noise
// of two codes is seen or not by where the level lies between them, so that the top must then keep the extreme in every
// one of at least 50 samples. From 0.4 codes (s.d.) on every clipped record is so found, with less noise some; of clean
// ones none from 0.3 codes on, with less noise about one in ten. Judged on the samples as recorded.
#pragma once

#include <optional>
#include <span>

#include "core/measure/Capture.h"
#include "core/measure/PhaseFinder.h"
#include "core/measure/SampleBlocks.h"

namespace tacto {

// Finds the samples at which a channel stands at the end of its input range.

/// A sample at or beyond these is clipped: they lie half a step inside the range, as samples are rounded.
struct ClipLimits {
    double low;
    double high;
    [[nodiscard]] bool reachedBy(double x) const noexcept { return x >= high || x <= low; }
};

/// Nothing where the channel states no range.
[[nodiscard]] std::optional<ClipLimits> clipLimits(const CaptureChannel& channel) noexcept;

/// Sets `clipped` and `flatTop` of `phases`, which were found in `view`; `blocks` has the same samples.
void markClipped(PhaseSpans& phases, const SampleView& view, const SampleBlocks& blocks);

}  // namespace tacto
