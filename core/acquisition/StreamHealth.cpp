#include "core/acquisition/StreamHealth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace tacto {

std::string HealthReport::text() const {
    std::string out;
    const auto say = [&out](std::size_t count, const char* one, const char* many) {
        if (count == 0) return;
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, count == 1 ? one : many);
    };
    say(gaps, "gap", "gaps");
    if (gaps > 0) out += fmt::format(" (longest {:.3g} s, about {} samples missing)", longestGap_s, missingSamples);
    say(repeats, "repeated stamp", "repeated stamps");
    say(clockSteps, "step back in time", "steps back in time");
    say(irregular, "early stamp", "early stamps");
    say(invalidStamps, "stamp that is not a number", "stamps that are not numbers");
    say(invalidSamples, "sample that is not a number", "samples that are not numbers");
    if (coarseStamps) out += fmt::format("{}coarse stamps spread evenly", out.empty() ? "" : ", ");
    return out.empty() ? "continuous" : out;
}

StampClass StreamHealth::feed(double t_s) noexcept {
    const double before = grid_.last();
    const auto kind = grid_.next(t_s);
    ++report_.samples;
    switch (kind) {
        case StampClass::Regular:
            ++stretchSteps_;
            if (stretchSteps_ >= longestSteps_) {
                longestSteps_ = stretchSteps_;
                report_.rate_hz = static_cast<double>(stretchSteps_) / (t_s - stretchFirst_);
            }
            return kind;
        case StampClass::Gap: {
            const double steps = std::round((t_s - before) / grid_.step());
            ++report_.gaps;
            report_.missingSamples += steps > 1 && steps < 1e15 ? static_cast<std::size_t>(steps) - 1 : 0;
            report_.longestGap_s = std::max(report_.longestGap_s, t_s - before);
            break;
        }
        case StampClass::Early:
            ++report_.irregular;
            break;
        case StampClass::Repeat:
            ++report_.repeats;
            break;
        case StampClass::Backward:
            ++report_.clockSteps;
            break;
        case StampClass::Invalid:
            ++report_.invalidStamps;
            return kind;
        case StampClass::First:
            break;
    }
    stretchFirst_ = grid_.last();
    stretchSteps_ = 0;
    return kind;
}

void StreamHealth::feed(const SampleBlock& block, std::size_t channels) noexcept {
    for (std::size_t i = 0; i < block.samples(); ++i) {
        feed(block.t_s[i]);
        const auto* sample = block.values.data() + i * channels;
        if (!std::all_of(sample, sample + channels, [](double x) { return std::isfinite(x); })) {
            ++report_.invalidSamples;
        }
    }
}

namespace {
// Steps forward above this many median steps are certainly gaps, whatever the jitter.
constexpr double kCertainGap = 2.5;

double medianStepForward(std::span<const double> stamps) {
    std::vector<double> steps;
    steps.reserve(stamps.size());
    for (std::size_t i = 1; i < stamps.size(); ++i) {
        const double step = stamps[i] - stamps[i - 1];
        if (step > 0 && std::isfinite(step)) steps.push_back(step);
    }
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}
}  // namespace

double roughRate_hz(std::span<const double> stamps) {
    const double largest = kCertainGap * medianStepForward(stamps);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 1; i < stamps.size(); ++i) {
        const double step = stamps[i] - stamps[i - 1];
        if (!(step >= 0 && step <= largest)) continue;
        sum += step;
        ++count;
    }
    return sum > 0 ? static_cast<double>(count) / sum : 0;
}

bool stampsAreCoarse(std::span<const double> stamps) noexcept {
    std::size_t repeats = 0;
    for (std::size_t i = 1; i < stamps.size(); ++i) repeats += stamps[i] == stamps[i - 1] ? 1 : 0;
    return repeats * 4 > stamps.size();
}

void spreadCoarseStamps(std::span<double> stamps) {
    const double largest = kCertainGap * medianStepForward(stamps);
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= stamps.size(); ++i) {
        if (i < stamps.size() && stamps[i] >= stamps[i - 1] && stamps[i] - stamps[i - 1] <= largest) continue;
        const double first = stamps[begin];
        const double last = stamps[i - 1];
        const auto steps = static_cast<double>(i - 1 - begin);
        for (std::size_t j = begin; j < i && last > first; ++j) {
            stamps[j] = first + (last - first) * static_cast<double>(j - begin) / steps;
        }
        begin = i;
    }
}

namespace {
constexpr double kByChance = 1e-9;
constexpr std::uint64_t kKnown = 100;  // changes: what a value does by itself is known from there on
constexpr std::uint64_t kEnough = 40;  // repeats of one that moves more often than not: by chance in 10^12 times
}  // namespace

Standstill::Standstill(std::size_t channels, bool eachChannel)
    : channels_(channels),
      eachChannel_(eachChannel),
      before_(channels * kPeriods),
      all_(kPeriods),
      each_(eachChannel ? channels * kPeriods : 0) {}

void Standstill::feed(const SampleBlock& block) noexcept {
    for (std::size_t i = 0; i < block.t_s.size(); ++i) {
        const double* values = block.values.data() + i * channels_;
        last_s_ = std::exchange(newest_s_, block.t_s[i]);
        compare(values);
        const std::size_t at = seen_ % kPeriods * channels_;
        for (std::size_t c = 0; c < channels_; ++c) before_[at + c] = std::bit_cast<std::uint64_t>(values[c]);
        ++seen_;
    }
}

void Standstill::compare(const double* values) noexcept {
    for (std::size_t period = 1; period <= std::min<std::uint64_t>(seen_, kPeriods); ++period) {
        const std::uint64_t* past = before_.data() + (seen_ - period) % kPeriods * channels_;
        bool same = true;
        for (std::size_t c = 0; c < channels_ && (same || eachChannel_); ++c) {
            const bool one = std::bit_cast<std::uint64_t>(values[c]) == past[c];
            if (eachChannel_) count(each_[(period - 1) * channels_ + c], period, one);
            same = same && one;
        }
        count(all_[period - 1], period, same);
    }
}

/// Repeats of a value that stood still do not count as its noise.
void Standstill::count(Repeats& one, std::size_t period, bool same) const noexcept {
    if (same) {
        if (one.run++ == 0) one.since_s = last_s_;
    } else if (one.run > 0) {
        one.repeated += moves(one, period) ? std::min(one.run, kEnough) : one.run;
        one.matched += std::exchange(one.run, 0);
    }
}

std::uint64_t Standstill::changes(const Repeats& one, std::size_t period) const noexcept {
    return seen_ < period ? 0 : seen_ - period - one.matched - std::min(one.run, seen_ - period - one.matched);
}

bool Standstill::moves(const Repeats& one, std::size_t period) const noexcept {
    const auto changed = changes(one, period);
    return changed >= kKnown && one.repeated < changed;
}

bool Standstill::stands(const Repeats& one, std::size_t period) const noexcept {
    return one.run >= kEnough && newest_s_ - one.since_s > StreamHealth::kStale_s && moves(one, period);
}

std::optional<double> Standstill::since() const noexcept {
    const auto& last = all_.front();
    if (last.run == 0 || !(newest_s_ - last.since_s > StreamHealth::kStale_s)) return std::nullopt;
    const double share =
        static_cast<double>(last.repeated + 1) / static_cast<double>(last.repeated + changes(last, 1) + 2);
    if (static_cast<double>(last.run) * std::log(share) > std::log(kByChance)) return std::nullopt;
    return last.since_s;
}

std::optional<double> Standstill::repeatsSince() const noexcept {
    std::optional<double> earliest;
    const auto& judged = eachChannel_ ? each_ : all_;
    for (std::size_t i = 0; i < judged.size(); ++i) {
        if (!stands(judged[i], i / (eachChannel_ ? channels_ : 1) + 1)) continue;
        earliest = std::min(earliest.value_or(judged[i].since_s), judged[i].since_s);
    }
    return earliest;
}

}  // namespace tacto
