#include "core/bench/sensing/SampleTaps.h"

#include <algorithm>

namespace tacto {

namespace {

void pushSamples(const FingerInput& finger, BenchTap& tap) noexcept {
    const auto blocks = finger.blocks();
    const auto streams = finger.session().device().streams();
    for (std::size_t s = 0; s < blocks.size(); ++s) {
        TapSample sample;
        sample.stream = static_cast<std::uint32_t>(s);
        const auto all = streams[s].channels;
        const auto shown = std::min(all, TapSample::kMaxChannels);
        sample.channels = static_cast<std::uint32_t>(shown);
        for (std::size_t i = 0; i < blocks[s].samples(); ++i) {
            sample.t_s = blocks[s].t_s[i];
            for (std::size_t c = 0; c < shown; ++c)
                sample.values[c] = static_cast<float>(blocks[s].values[i * all + c]);
            tap.samples.push(sample);
        }
    }
}

}  // namespace

void SampleTaps::listen(BenchTap* tap) {
    const std::scoped_lock lock(mutex_);
    listener_ = tap;
    listening_.store(tap != nullptr, std::memory_order_release);
}

void SampleTaps::push(const FingerInput& finger) noexcept {
    if (display_ != nullptr) {
        pushSamples(finger, *display_);
        for (const auto& frame : finger.frames()) display_->frames.push(frame);
    }
    if (!listening_.load(std::memory_order_acquire)) return;
    const std::scoped_lock lock(mutex_);
    if (listener_ != nullptr) pushSamples(finger, *listener_);
}

}  // namespace tacto
