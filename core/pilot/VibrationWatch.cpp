#include "core/pilot/VibrationWatch.h"

namespace tacto {

namespace {

std::optional<std::uint32_t> accelerationOf(Bench& bench) {
    const auto& devices = bench.devices();
    if (!devices.sensor || !devices.massager || devices.stimulator) return std::nullopt;
    const auto streams = devices.sensor->streams();
    for (std::size_t i = 0; i < streams.size(); ++i) {
        const auto& stream = streams[i];
        const bool inMetres = stream.unit == StreamUnit::MetrePerSecondSquared;
        if (stream.kind == StreamKind::Acceleration && inMetres && stream.channels == 3)
            return static_cast<std::uint32_t>(i);
    }
    return std::nullopt;
}

}  // namespace

VibrationWatch::VibrationWatch(Bench& bench) : bench_(bench), stream_(accelerationOf(bench)) {
    if (stream_) tap_ = std::make_unique<BenchTap>();
}

void VibrationWatch::begin() {
    if (!tap_) return;
    while (tap_->samples.pop()) {
    }
    samples_.clear();
    bench_.listen(tap_.get());
}

void VibrationWatch::look() {
    if (!tap_) return;
    while (const auto sample = tap_->samples.pop()) {
        if (sample->stream != *stream_) continue;
        samples_.push_back({sample->t_s, sample->values[0], sample->values[1], sample->values[2]});
    }
}

void VibrationWatch::end() {
    if (!tap_) return;
    look();
    bench_.listen(nullptr);
}

std::optional<BurstFigures> VibrationWatch::measured(const Presented& presented) const {
    if (!tap_) return std::nullopt;
    std::vector<CommandedBurst> bursts;
    for (const auto& train : presented.trains) bursts.push_back({toSeconds(train.onset), VibrationBurst{}.duration});
    if (bursts.empty()) return std::nullopt;
    const auto found = burstFigures(samples_, bursts);
    return found ? std::optional(*found) : std::nullopt;
}

}  // namespace tacto
