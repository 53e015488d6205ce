#include "core/measure/Clipping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tacto {

namespace {

constexpr std::size_t kMinFlat = 10;             // fewest samples at the extreme, if the signal is noisy enough
constexpr std::size_t kManyFlat = 50;            // fewest samples at the extreme, if the signal has little noise
constexpr double kKeeps = 0.95;                  // share of samples at the extreme, from the first such to the last
constexpr std::size_t kJudgedTriples = 100'000;  // most triples of neighbouring samples that are checked
constexpr std::size_t kMinTriples = 50;          // fewest triples from which noise can be judged
constexpr double kEdge = 0.05;                   // share of the record's span: a larger step is an edge, not noise
constexpr double kJitters = 0.01;                // share of the triples that shows noise of at least three codes
constexpr double kNoisyCodes = 2;                // codes: noise this large never keeps a third of the samples at one
constexpr double kNoisy = 0.3;                   // share of the triples that shows such noise
constexpr double kKeepsInNoise = 0.3;            // share of samples at the extreme, if noise was added after clipping
constexpr double kMoves = 0.2;                   // share of the steps that shows any noise

/// First sample of a phase, and the sample after its last, as recorded.
struct Stretch {
    std::size_t first;
    std::size_t end;

    explicit Stretch(const PhaseSpan& phase)
        : first(phase.begin * phase.view->mean),
          end(std::min(phase.end * phase.view->mean, phase.view->channel->samples.size())) {}
    [[nodiscard]] std::size_t size() const noexcept { return end - first; }
    [[nodiscard]] std::span<const float> of(const CaptureChannel& channel) const {
        return std::span<const float>(channel.samples).subspan(first, size());
    }
};

/// `recorded`: blocks of the recorded samples, or null.
void markAtRange(PhaseSpans& phases, const CaptureChannel& channel, const ClipLimits& limits,
                 const SampleBlocks* recorded) {
    for (auto& phase : phases) {
        const Stretch own(phase);
        // Most phases end far from the limits. The blocks show this without a look at the samples.
        if (recorded != nullptr && !recorded->mayReach(own.first, own.end, limits.low, limits.high)) continue;
        phase.clipped =
            std::ranges::any_of(own.of(channel), [&](float x) { return limits.reachedBy(static_cast<double>(x)); });
    }
}

/// How much the signal moves between its pulses.
enum class Rest { Still, Moves, Jitters, Noisy };

/// Checks three neighbouring samples at a time, away from the phases. Noise changes direction from one sample to the
/// next; a signal that settles slowly does not.
Rest restBetween(const PhaseSpans& phases, const CaptureChannel& channel, double span) {
    const auto& x = channel.samples;
    if (x.size() < 3) return Rest::Still;
    struct Steps {
        double before;
        double after;
    };
    std::vector<Steps> judged;
    double least = std::numeric_limits<double>::infinity();
    std::size_t moves = 0;
    auto phase = phases.begin();
    const std::size_t stride = std::max<std::size_t>(1, x.size() / kJudgedTriples);
    const auto quietAgain = [](const PhaseSpan& one) {
        const Stretch own(one);
        return own.end + own.size() / 4 + 2;
    };
    for (std::size_t i = 1; i + 1 < x.size(); i += stride) {
        while (phase != phases.end() && i >= quietAgain(*phase)) ++phase;
        if (phase != phases.end()) {
            const Stretch own(*phase);
            if (i + own.size() / 4 + 2 >= own.first) {
                const auto next = quietAgain(*phase);
                i += (next - i) / stride * stride;
                continue;
            }
        }
        const Steps steps{static_cast<double>(x[i]) - static_cast<double>(x[i - 1]),
                          static_cast<double>(x[i + 1]) - static_cast<double>(x[i])};
        const double larger = std::max(std::abs(steps.before), std::abs(steps.after));
        if (!(larger <= kEdge * span)) continue;
        if (steps.before != 0) {
            ++moves;
            least = std::min(least, std::abs(steps.before));
        }
        judged.push_back(steps);
    }
    const auto n = static_cast<double>(judged.size());
    if (judged.size() < kMinTriples || static_cast<double>(moves) < kMoves * n) return Rest::Still;
    const auto turnsBeyond = [&](double steps) {
        return static_cast<double>(std::ranges::count_if(judged, [&](const Steps& s) {
            return s.before * s.after < 0 && std::max(std::abs(s.before), std::abs(s.after)) > steps * least;
        }));
    };
    if (turnsBeyond(kNoisyCodes + 0.5) >= kNoisy * n) return Rest::Noisy;
    return turnsBeyond(1.5) >= kJitters * n ? Rest::Jitters : Rest::Moves;
}

bool isFlat(std::span<const float> samples, float extreme, Rest rest) {
    const auto first = std::ranges::find(samples, extreme);
    if (first == samples.end()) return false;
    auto end = samples.end();
    while (*(end - 1) != extreme) --end;
    const auto length = static_cast<std::size_t>(end - first);
    if (length < kMinFlat || 2 * length < samples.size()) return false;
    const auto kept = static_cast<std::size_t>(std::count(first, end, extreme));
    if (rest == Rest::Moves) return kept == length && length >= kManyFlat;
    if (rest == Rest::Noisy && kept >= kMinFlat &&
        static_cast<double>(kept) >= kKeepsInNoise * static_cast<double>(length))
        return true;
    return static_cast<double>(kept) >= kKeeps * static_cast<double>(length);
}

void markFlatTops(PhaseSpans& phases, const CaptureChannel& channel, const SampleBlocks& recorded) {
    const auto lowest = recorded.lowest();
    const auto highest = recorded.highest();
    const auto rest = restBetween(phases, channel, static_cast<double>(highest) - static_cast<double>(lowest));
    if (rest == Rest::Still) return;
    for (auto& phase : phases) {
        const Stretch own(phase);
        if (!recorded.mayReach(own.first, own.end, static_cast<double>(lowest), static_cast<double>(highest))) continue;
        phase.flatTop = isFlat(own.of(channel), phase.sign > 0 ? highest : lowest, rest);
    }
}

}  // namespace

void markClipped(PhaseSpans& phases, const SampleView& view, const SampleBlocks& blocks) {
    if (phases.empty()) return;
    const auto& channel = *view.channel;
    const bool isRecord = view.own.empty();
    if (const auto limits = clipLimits(channel)) {
        markAtRange(phases, channel, *limits, isRecord ? &blocks : nullptr);
    } else if (isRecord) {
        markFlatTops(phases, channel, blocks);
    } else {
        markFlatTops(phases, channel, SampleBlocks(channel.samples));
    }
}

std::optional<ClipLimits> clipLimits(const CaptureChannel& channel) noexcept {
    if (!(channel.high > channel.low)) return std::nullopt;
    // A float is less exact than the limit that it reaches.
    const double margin = std::max(0.5 * channel.lsb, 1e-6 * (channel.high - channel.low));
    return ClipLimits{channel.low + margin, channel.high - margin};
}

}  // namespace tacto
