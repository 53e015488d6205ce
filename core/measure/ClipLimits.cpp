#include "core/measure/ClipLimits.h"

#include <algorithm>

namespace tacto {

std::optional<ClipLimits> clipLimits(const CaptureChannel& channel) noexcept {
    if (!(channel.high > channel.low)) return std::nullopt;
    // A float is less exact than the limit that it stands at.
    const double margin = std::max(0.5 * channel.lsb, 1e-6 * (channel.high - channel.low));
    return ClipLimits{channel.low + margin, channel.high - margin};
}

}  // namespace tacto
