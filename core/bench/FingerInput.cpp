#include "core/bench/FingerInput.h"

#include <algorithm>

namespace tacto {

namespace {
constexpr std::size_t kFramesPerStep = 256;  // a step after a stall of seconds still finds room
// A frame stands for the middle of its window: half of 64 ms, one hop, and the next force sample behind.
constexpr double kFrameLatency_s = 0.032 + 0.016 + 0.03;
}  // namespace

Result<std::unique_ptr<FingerInput>> FingerInput::create(SensorSession& session, const RoughnessSettings& settings) {
    auto chain = RoughnessChain::create(session.device().streams(), settings, session.device().declared());
    if (!chain) return failure(chain);
    return std::unique_ptr<FingerInput>(new FingerInput(session, std::move(*chain)));
}

FingerInput::FingerInput(SensorSession& session, std::unique_ptr<RoughnessChain> chain)
    : session_(session), chain_(std::move(chain)) {
    for (const auto& stream : session.device().streams()) {
        health_.emplace_back(stream.rate_hz);
        blocks_.emplace_back();
        // A second's worth, so that a step never has to grow it.
        const auto samples = static_cast<std::size_t>(std::max(64.0, stream.rate_hz));
        blocks_.back().t_s.reserve(samples);
        blocks_.back().values.reserve(samples * stream.channels);
    }
    frames_.reserve(kFramesPerStep);
}

void FingerInput::update() {
    const bool over = session_.finished();  // asked first: what it left behind is collected now
    session_.collect(blocks_);
    const auto streams = session_.device().streams();
    for (std::size_t s = 0; s < blocks_.size(); ++s) health_[s].feed(blocks_[s], streams[s].channels);
    frames_.clear();
    chain_->feed(blocks_, frames_);
    if (over && !finished_) {
        finished_ = true;
        chain_->finish(frames_);
    }
    if (!frames_.empty()) latest_ = frames_.back();
}

double FingerInput::age_s(double now_s) const noexcept {
    double oldest = 0;
    for (const auto& health : health_) oldest = std::max(oldest, health.age_s(now_s));
    return oldest;
}

bool FingerInput::fresh(double now_s) const noexcept {
    return !std::ranges::any_of(health_, [&](const StreamHealth& health) { return health.stale(now_s); }) &&
           now_s - latest_.t_s <= StreamHealth::kStale_s + kFrameLatency_s;
}

std::uint64_t FingerInput::gaps() const noexcept {
    std::uint64_t found = 0;
    for (const auto& health : health_) found += health.report().gaps + health.report().clockSteps;
    return found;
}

}  // namespace tacto
