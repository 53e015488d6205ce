// Clipping.h - finds phases whose tops were cut off at the oscilloscope's input range, or may have been. Private to
// core/measure.
//
// A sample at either end of the channel's range, where the full-scale codes are, is clipped. If the range is unknown,
// nothing is called clipped: the highest value of a record may belong to the signal. If a top then stays at the
// record's extreme although the signal is noisy between pulses, the noise was cut off. Such a phase is flat-topped: it
// is measured, and flagged for the reader.
//
// If the noise spans several codes, a third of the samples at the extreme is enough: noise was added after clipping.
//
// A top is flat if 95 % of a run of at least 10 samples, and at least half of the phase, are at the extreme, and the
// signal between pulses jitters over three codes or more: such noise never keeps one code 95 % of the time. Noise of
// two codes shows only at some levels, so the top must then stay at the extreme in every one of at least 50 samples.
// With noise of 0.4 codes (s.d.) or more, every clipped record is found; with less, some. No clean record is flagged
// with 0.3 codes or more; with less, about one in ten. The samples are judged as recorded.
#pragma once

#include <optional>
#include <span>

#include "core/measure/Capture.h"
#include "core/measure/PhaseFinder.h"
#include "core/measure/SampleBlocks.h"

namespace tacto {

// Finds the samples at which a channel reaches the end of its input range.

/// A sample at or beyond these limits is clipped. They lie half a step inside the range, because samples are rounded.
struct ClipLimits {
    double low;
    double high;
    [[nodiscard]] bool reachedBy(double x) const noexcept { return x >= high || x <= low; }
};

/// Returns nothing if the channel states no range.
[[nodiscard]] std::optional<ClipLimits> clipLimits(const CaptureChannel& channel) noexcept;

/// Sets `clipped` and `flatTop` of `phases`, which were found in `view`; `blocks` holds the same samples.
void markClipped(PhaseSpans& phases, const SampleView& view, const SampleBlocks& blocks);

}  // namespace tacto
