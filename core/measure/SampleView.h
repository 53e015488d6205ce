// SampleView.h - a channel as it is measured: as recorded, or without its drift, or as means of several samples.
// Private to core/measure.
//
// Thread-safety: none shared; the capture and the channel must outlive the view.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/Capture.h"

namespace tacto {

/// Movable: `samples` looks at the channel's samples or at `own`.
struct SampleView {
    const Capture* capture = nullptr;
    const CaptureChannel* channel = nullptr;
    std::vector<float> own{};
    std::span<const float> samples{};
    std::size_t mean = 1;  ///< recorded samples in each of `samples`
    double rate_hz = 0;
    double start_s = 0;  ///< time of the first of `samples`: the middle of what it is the mean of

    /// In `samples`, fractions included, and back.
    [[nodiscard]] double positionOf(double time_s) const noexcept { return (time_s - start_s) * rate_hz; }
    [[nodiscard]] double timeOf(double position) const noexcept { return start_s + position / rate_hz; }
};

[[nodiscard]] SampleView asRecorded(const Capture& capture, const CaptureChannel& channel);

/// `view` with `mean` of its samples averaged into one; what is left over at the end is left out. White noise falls by
/// √mean. A mean over a missing sample is missing.
[[nodiscard]] SampleView averaged(const SampleView& view, std::size_t mean);

}  // namespace tacto
