#include "core/bench/sensing/FingerInput.h"

#include <algorithm>
#include <cmath>

#include "core/dsp/SampleHistory.h"

namespace tacto {

namespace {
constexpr std::size_t kFramesPerStep = 256;  // leaves room for a step after a stall of seconds
// A frame shows the middle of its window: half of 64 ms late, plus one hop, plus the wait for the next force sample.
constexpr double kFrameLatency_s = 0.032 + 0.016 + 0.03;
}  // namespace

Result<std::unique_ptr<FingerInput>> FingerInput::create(SensorSession& session, const RoughnessSettings& settings) {
    auto chain = RoughnessChain::create(session.device().streams(), settings, session.device().declared(),
                                        session.device().identity().serial);
    if (!chain) return failure(chain);
    return std::unique_ptr<FingerInput>(new FingerInput(session, std::move(*chain)));
}

FingerInput::FingerInput(SensorSession& session, std::unique_ptr<RoughnessChain> chain)
    : session_(session), chain_(std::move(chain)) {
    for (const auto& stream : session.device().streams()) {
        health_.emplace_back(stream.rate_hz);
        still_.emplace_back(stream.channels, stream.kind == StreamKind::Acceleration);
        blocks_.emplace_back();
        // Reserve one second of samples, so that no step has to allocate.
        const auto samples = static_cast<std::size_t>(std::max(64.0, stream.rate_hz));
        blocks_.back().t_s.reserve(samples);
        blocks_.back().values.reserve(samples * stream.channels);
    }
    frames_.reserve(kFramesPerStep);
    encoded_.frames.reserve(SensorSession::kFrames);
    encoded_.trains.reserve(SensorSession::kTrains);
    encoded_.silences.reserve(SensorSession::kTrains);
}

void FingerInput::update() {
    const bool over = session_.finished();  // asked first, so that the remaining samples are collected now
    session_.collect(blocks_);
    session_.collect(encoded_);
    const auto streams = session_.device().streams();
    for (std::size_t s = 0; s < blocks_.size(); ++s) {
        health_[s].feed(blocks_[s], streams[s].channels);
        still_[s].feed(blocks_[s]);
        watchRange(s);
    }
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
    const auto since = standsStillSince();
    return since ? std::max(oldest, now_s - *since) : oldest;
}

/// A working accelerometer never stands still: its noise is larger than its steps. Force and taxels may stand still,
/// except an array that is touched and has changed all the time.
std::optional<double> FingerInput::standsStillSince() const noexcept {
    constexpr std::size_t kArray = 4;  // the least number of taxels that a filter does not make all equal
    const auto streams = session_.device().streams();
    std::optional<double> latest;  // when the last stream stopped changing
    bool all = !still_.empty();
    for (std::size_t s = 0; s < still_.size(); ++s) {
        const auto since = still_[s].since();
        const bool accelerates = streams[s].kind == StreamKind::Acceleration;
        if (since && accelerates) return since;
        const bool array = streams[s].kind == StreamKind::Taxels && streams[s].channels >= kArray && latest_.contact;
        if (const auto repeats = still_[s].repeatsSince(); repeats && (accelerates || array)) return repeats;
        all = all && since;
        if (since) latest = std::max(latest.value_or(*since), *since);
    }
    return all ? latest : std::nullopt;
}

FingerStanding FingerInput::standing(double now_s) const noexcept {
    if (now_s - implausible_s_ <= StreamHealth::kStale_s) return FingerStanding::Implausible;
    // A stamp in the future does not tell how old the data are, so it is as bad as a stale one.
    const auto current = [&](double age_s, double allowed_s) {
        return age_s <= StreamHealth::kStale_s + allowed_s && age_s >= -StreamHealth::kStale_s;
    };
    const bool streams =
        std::ranges::all_of(health_, [&](const StreamHealth& health) { return current(health.age_s(now_s), 0); });
    return streams && !standsStillSince() && current(now_s - latest_.t_s, kFrameLatency_s) ? FingerStanding::Fresh
                                                                                           : FingerStanding::Stale;
}

void FingerInput::watchRange(std::size_t stream) noexcept {
    const auto& block = blocks_[stream];
    const auto& info = chain_->streams()[stream];
    const double largest = mostPlausible(info.unit);
    const bool converts = chain_->converts(stream);
    const auto* reading = block.values.data();
    for (const double t_s : block.t_s) {
        for (std::size_t c = 0; c < info.channels; ++c, ++reading) {
            const double value = converts ? chain_->inUse(stream, c, *reading) : *reading;
            if (!(std::abs(value) <= largest)) implausible_s_ = std::max(implausible_s_, t_s);
        }
    }
}

std::uint64_t FingerInput::gaps() const noexcept {
    std::uint64_t found = 0;
    for (const auto& health : health_) found += health.report().gaps + health.report().clockSteps;
    return found;
}

}  // namespace tacto
