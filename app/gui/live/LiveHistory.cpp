#include "app/gui/live/LiveHistory.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {
constexpr std::size_t kFrames = 8192;  // a minute at 62.5 Hz, and room for faster settings
constexpr std::size_t kTrains = 512;
}  // namespace

Series::Series(std::size_t channels, std::size_t capacity)
    : channels_(std::max<std::size_t>(1, channels)),
      times_(std::max<std::size_t>(1, capacity)),
      values_(times_.size() * channels_) {}

void Series::push(double t_s, std::span<const float> values) {
    times_[head_] = t_s;
    for (std::size_t c = 0; c < channels_; ++c)
        values_[head_ * channels_ + c] = c < values.size() ? values[c] : std::nanf("");
    head_ = head_ + 1 == times_.size() ? 0 : head_ + 1;
    count_ = std::min(count_ + 1, times_.size());
}

std::size_t Series::firstFrom(double t_s) const noexcept {
    std::size_t low = 0, high = count_;
    while (low < high) {
        const auto middle = (low + high) / 2;
        if (time(middle) < t_s)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

LiveHistory::LiveHistory() : frames_(kColumns, kFrames) {}

void LiveHistory::begin(const std::vector<StreamInfo>& streams) {
    streams_ = streams;
    samples_.clear();
    for (const auto& stream : streams) {
        const auto rate = std::clamp(stream.rate_hz, 10.0, 20'000.0);
        samples_.emplace_back(std::min(stream.channels, TapSample::kMaxChannels),
                              static_cast<std::size_t>(rate * kKept_s));
    }
    frames_.clear();
    trains_.clear();
    now_s_ = 0;
    missed_ = 0;
}

void LiveHistory::take(BenchTap& tap, const Telemetry& telemetry) {
    now_s_ = toSeconds(telemetry.at);
    while (const auto sample = tap.samples.pop()) {
        if (sample->stream >= samples_.size()) continue;  // of a bench that was opened since
        samples_[sample->stream].push(sample->t_s, {sample->values.data(), sample->channels});
    }
    while (const auto frame = tap.frames.pop()) {
        const float columns[kColumns] = {static_cast<float>(frame->R), static_cast<float>(frame->P),
                                         static_cast<float>(frame->h), static_cast<float>(frame->v)};
        frames_.push(frame->t_s, columns);
    }
    while (const auto train = tap.trains.pop()) {
        trains_.push_back(*train);
        if (trains_.size() > kTrains) trains_.pop_front();
    }
    missed_ = tap.samples.dropped();
}

const Series* LiveHistory::samples(StreamKind kind) const noexcept {
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        if (streams_[i].kind == kind) return &samples_[i];
    }
    return nullptr;
}

const StreamInfo* LiveHistory::info(StreamKind kind) const noexcept {
    const auto found = std::find_if(streams_.begin(), streams_.end(), [&](const auto& s) { return s.kind == kind; });
    return found == streams_.end() ? nullptr : &*found;
}

}  // namespace tacto::gui
