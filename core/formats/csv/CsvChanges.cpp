#include "core/formats/csv/CsvChanges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto {

namespace {

constexpr double kWantedOfShortest = 100;  // samples in the shortest level
constexpr double kMinOfShortest = 20;
constexpr double kCheap = 8e6;  // samples in all channels: up to this number, levels are drawn as finely as wanted
constexpr double kMaxSamples = 64e6;

bool holdLevelsAlone(const std::vector<CaptureChannel>& channels) {
    const auto isLevel = [](float sample) { return sample == 0 || sample == 1; };
    return !channels.empty() && channels.front().samples.size() >= 3 &&
           std::ranges::all_of(channels, [&](const CaptureChannel& channel) {
               return channel.unit.empty() && std::ranges::all_of(channel.samples, isLevel);
           });
}

/// Returns the shortest time between two edges of one channel, or else between two rows.
double shortestLevel(std::span<const double> stamps, const std::vector<CaptureChannel>& channels) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& channel : channels) {
        double last = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < stamps.size(); ++i) {
            if (channel.samples[i] == channel.samples[i - 1]) continue;
            shortest = std::min(shortest, stamps[i] - last);
            last = stamps[i];
        }
    }
    if (std::isfinite(shortest)) return shortest;
    for (std::size_t i = 1; i < stamps.size(); ++i) shortest = std::min(shortest, stamps[i] - stamps[i - 1]);
    return shortest;
}

/// Returns the share of an edge in the sample that is `edgeBehind` steps away from it.
double shareOfEdge(double edgeBehind) {
    constexpr double kRounding = 1e-6;
    if (edgeBehind <= -0.5 + kRounding) return 1;
    if (edgeBehind >= 0.5 - kRounding) return 0;
    return edgeBehind < 0 ? 0.5 / (1 + edgeBehind) : (0.5 - edgeBehind) / (1 - edgeBehind);
}

std::vector<float> drawn(const std::vector<float>& levels, std::span<const double> places, std::size_t count) {
    std::vector<float> samples(count);
    std::size_t next = 0;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        if (levels[i] == levels[i - 1]) continue;
        const auto at = std::min(static_cast<std::size_t>(std::max(std::round(places[i]), 0.0)), count - 1);
        std::fill(samples.begin() + static_cast<std::ptrdiff_t>(next),
                  samples.begin() + static_cast<std::ptrdiff_t>(std::max(at, next)), levels[i - 1]);
        const double share = shareOfEdge(places[i] - static_cast<double>(at));
        samples[at] = levels[i - 1] + static_cast<float>(share) * (levels[i] - levels[i - 1]);
        next = at + 1;
    }
    std::fill(samples.begin() + static_cast<std::ptrdiff_t>(std::min(next, count)), samples.end(), levels.back());
    return samples;
}

}  // namespace

bool listsChanges(const std::vector<CaptureChannel>& channels) {
    if (!holdLevelsAlone(channels)) return false;
    const auto rows = channels.front().samples.size();
    for (std::size_t i = 1; i + 1 < rows; ++i) {
        const auto differs = [i](const auto& channel) { return channel.samples[i] != channel.samples[i - 1]; };
        if (std::ranges::none_of(channels, differs)) return false;
    }
    return true;
}

bool listsChangesOfMore(const std::vector<CaptureChannel>& channels, std::span<const double> stamps_s) {
    if (!holdLevelsAlone(channels)) return false;
    std::vector<double> steps;
    for (std::size_t i = 1; i < stamps_s.size(); ++i) steps.push_back(stamps_s[i] - stamps_s[i - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    constexpr double kAlike = 0.01;
    const double usual = *middle;
    return 2 * std::ranges::count_if(steps, [&](double step) { return std::abs(step / usual - 1) < kAlike; }) <
           std::ssize(steps);
}

Result<void> drawLevels(std::span<const double> stamps_s, CaptureReading& reading, std::string_view file) {
    auto& capture = reading.capture;
    for (std::size_t i = 1; i < stamps_s.size(); ++i) {
        if (stamps_s[i] > stamps_s[i - 1]) continue;
        return fail(ErrorCode::ParseError,
                    "{}: it lists changes of level, and the time of the change at {:.9g} s does not rise; later ones "
                    "were expected",
                    file, stamps_s[i]);
    }
    const double shortest = shortestLevel(stamps_s, capture.channels);
    const bool endsInARow = std::ranges::all_of(capture.channels, [](const auto& channel) {
        return channel.samples.back() == channel.samples[channel.samples.size() - 2];
    });
    const double duration = stamps_s.back() - stamps_s.front() + (endsInARow ? 0 : shortest);
    const double channels = static_cast<double>(capture.channels.size());
    const double levels = duration / shortest;
    const double fine = std::clamp(std::floor(kCheap / (channels * levels)), kMinOfShortest, kWantedOfShortest);
    if (!(channels * levels * fine <= kMaxSamples)) {
        return fail(ErrorCode::ParseError,
                    "{}: it lists changes of level and not samples: levels from {:.3g} s on in {:.3g} s are too many "
                    "samples; a shorter part was expected, without glitches, or an export of samples (in DSView: "
                    "original data; sigrok-cli: -O srzip)",
                    file, shortest, duration);
    }
    const double step = shortest / fine;
    // Samples stand in the middle of their steps, so an edge on the grid is half-way between two samples.
    capture.rate_hz = 1 / step;
    capture.start_s = stamps_s.front() + step / 2;
    std::vector<double> places;
    for (const double stamp : stamps_s) places.push_back((stamp - capture.start_s) / step);
    const auto count = static_cast<std::size_t>(std::max(std::llround(duration / step), 2LL));
    for (auto& channel : capture.channels) channel.samples = drawn(channel.samples, places, count);
    reading.warnings.push_back(
        fmt::format("{}: it lists {} changes of level and not samples; the levels between them are drawn at {:.6g} "
                    "samples per second, with each edge at its own time",
                    file, stamps_s.size() - 1, capture.rate_hz));
    return {};
}

}  // namespace tacto
