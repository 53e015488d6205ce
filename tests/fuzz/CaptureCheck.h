// CaptureCheck.h - checks what measuring code relies on in a capture from a file of any format.
//
// Thread-safety: pure function.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/formats/CaptureFormat.h"

namespace tacto::fuzz {

/// Aborts unless `reading` is refused with a sentence, or has a rate, a start, 2 to `maxSamples` samples (64 million in
/// all channels for a list of changes, which is drawn as samples), and channels of one length in known units.
inline void checkCapture(const Result<CaptureReading>& reading, std::size_t maxSamples) {
    if (!reading) {
        if (reading.error().message.empty()) std::abort();
        return;
    }
    const auto& capture = reading->capture;
    if (!(capture.rate_hz > 0) || !std::isfinite(capture.rate_hz) || !std::isfinite(capture.start_s)) std::abort();
    constexpr std::size_t kMaxDrawn = 64'000'000;
    const bool drawn = std::ranges::any_of(
        reading->warnings, [](const auto& said) { return said.find("changes of level") != std::string::npos; });
    const auto most = drawn ? kMaxDrawn / std::max<std::size_t>(capture.channels.size(), 1) : maxSamples;
    if (capture.samples() < 2 || capture.samples() > most) std::abort();
    for (const auto& channel : capture.channels) {
        if (channel.samples.size() != capture.samples()) std::abort();
        if (!channel.unit.empty() && channel.unit != "V" && channel.unit != "A") std::abort();
        if (std::isnan(channel.low) || !(channel.low <= channel.high)) std::abort();
    }
}

}  // namespace tacto::fuzz
