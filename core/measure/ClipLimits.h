// ClipLimits.h - at which samples a channel stands at the end of its input range.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>

#include "core/measure/Capture.h"

namespace tacto {

/// At or beyond which a sample is clipped: half a step inside the range, for samples are rounded.
struct ClipLimits {
    double low;
    double high;
    [[nodiscard]] bool reachedBy(double x) const noexcept { return x >= high || x <= low; }
};

/// Nothing where the channel states no range.
[[nodiscard]] std::optional<ClipLimits> clipLimits(const CaptureChannel& channel) noexcept;

}  // namespace tacto
