#include "core/measure/Clipping.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace tacto {

namespace {

constexpr std::size_t kFewestSamples = 10;  // that can show a record's extreme repeating

/// At or beyond which a sample is suspect.
struct Limits {
    double low;
    double high;
};

bool reaches(std::span<const float> samples, const Limits& limits) {
    return std::any_of(samples.begin(), samples.end(), [&](float sample) {
        const auto x = static_cast<double>(sample);
        return x >= limits.high || x <= limits.low;
    });
}

/// True when neighbouring samples differ nearly always, so that a stretch of equal ones is no accident. Asked of a
/// hundred thousand pairs.
bool isRestless(std::span<const float> samples) {
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / 100'000);
    std::size_t moves = 0;
    std::size_t pairs = 0;
    for (std::size_t i = 1; i < samples.size(); i += stride) {
        moves += samples[i] != samples[i - 1] ? 1 : 0;
        ++pairs;
    }
    return static_cast<double>(moves) > 0.6 * static_cast<double>(pairs);
}

/// First and end of a phase's samples as recorded.
struct Stretch {
    std::size_t first;
    std::size_t end;

    explicit Stretch(const PhaseSpan& phase)
        : first(phase.begin * phase.view->mean),
          end(std::min(phase.end * phase.view->mean, phase.view->channel->samples.size())) {}
    [[nodiscard]] std::span<const float> of(const CaptureChannel& channel) const {
        return std::span<const float>(channel.samples).subspan(first, end - first);
    }
};

/// `recorded`: blocks of the samples as recorded, if there are any.
void markAtRange(PhaseSpans& phases, const CaptureChannel& channel, const SampleBlocks* recorded) {
    const double margin = 1.001 * channel.lsb;
    const Limits limits{channel.low + margin, channel.high - margin};
    for (auto& phase : phases) {
        const Stretch own(phase);
        // Most phases end far from the limits, and the blocks say so without the samples.
        if (recorded != nullptr && !recorded->mayReach(own.first, own.end, limits.low, limits.high)) continue;
        phase.clipped = reaches(own.of(channel), limits);
    }
}

void markRepeating(PhaseSpans& phases, const CaptureChannel& channel, const SampleBlocks& recorded) {
    const Limits limits{static_cast<double>(recorded.lowest()), static_cast<double>(recorded.highest())};
    for (auto& phase : phases) {
        const Stretch own(phase);
        if (phase.end - phase.begin < kFewestSamples) continue;
        if (!recorded.mayReach(own.first, own.end, limits.low, limits.high)) continue;
        const auto samples = own.of(channel);
        const float extreme = phase.sign > 0 ? recorded.highest() : recorded.lowest();
        phase.clipped =
            2 * static_cast<std::size_t>(std::count(samples.begin(), samples.end(), extreme)) > samples.size();
    }
}

}  // namespace

void markClipped(PhaseSpans& phases, const SampleView& view, const SampleBlocks& blocks) {
    const auto& channel = *view.channel;
    const bool isRecord = view.own.empty();
    if (channel.high > channel.low) {
        markAtRange(phases, channel, isRecord ? &blocks : nullptr);
        return;
    }
    if (phases.empty() || !isRestless(channel.samples)) return;
    if (isRecord) {
        markRepeating(phases, channel, blocks);
    } else {
        markRepeating(phases, channel, SampleBlocks(channel.samples));
    }
}

}  // namespace tacto
