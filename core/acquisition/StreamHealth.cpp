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
// Forward steps of more than this many median steps are certainly gaps, whatever the jitter.
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
constexpr std::uint64_t kKnown = 100;  // changes after which the normal behaviour of a value is known
constexpr std::uint64_t kEnough = 40;  // repeats that show a standstill: 1 in 10^12 if the value moves
}  // namespace

Standstill::Standstill(std::size_t channels, bool eachChannel)
    : channels_(channels),
      eachChannel_(eachChannel),
      before_(channels),
      repeats_((eachChannel ? 1 + channels : 1) * kPeriods),
      same_(eachChannel ? 1 + channels : 1) {}

void Standstill::feed(const SampleBlock& block) noexcept {
    for (std::size_t i = 0; i < block.t_s.size(); ++i) {
        const double* values = block.values.data() + i * channels_;
        last_s_ = std::exchange(newest_s_, block.t_s[i]);
        compare(values);
        ++seen_;
    }
}

std::uint64_t Standstill::History::push(std::uint64_t number, double value) noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto index = static_cast<std::uint8_t>(bits * 0x9E37'79B9'7F4A'7C15U >> 56U);
    auto& bucket = buckets[index];
    const auto slot = number % kPeriods;
    const auto here = std::uint64_t{1} << (kPeriods - slot) % kPeriods;
    auto same = std::rotl(bucket.where, static_cast<int>((number - 1) % kPeriods));
    if (bucket.where != 0 && bucket.value != bits) bucket.mixedUntil = number + kPeriods;
    if (number <= bucket.mixedUntil) {
        for (auto left = same; left != 0; left &= left - 1) {
            const auto period = static_cast<std::uint64_t>(std::countr_zero(left)) + 1;
            if (values[(number - period) % kPeriods] != bits) same &= ~(left & (0 - left));
        }
    }
    buckets[bucketOf[slot]].where &= ~here;
    bucket.where |= here;
    bucket.value = bits;
    values[slot] = bits;
    bucketOf[slot] = index;
    return same;
}

void Standstill::compare(const double* values) noexcept {
    std::uint64_t all = ~std::uint64_t{0};
    for (std::size_t c = 0; c < channels_; ++c) {
        const auto same = before_[c].push(seen_ + kPeriods, values[c]);
        if (eachChannel_) countAll(1 + c, same);
        all &= same;
    }
    countAll(0, all);
}

/// Counts only if values repeat or stop repeating, which is rare for a working sensor.
void Standstill::countAll(std::size_t row, std::uint64_t same) noexcept {
    for (std::uint64_t left = same | same_[row]; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        count(repeats_[row * kPeriods + i], i + 1, (same >> i & 1U) != 0);
    }
    same_[row] = same;
}

/// Repeats during a standstill are not counted as noise of the value. Without branches on `same`, which is chance.
void Standstill::count(Repeats& one, std::size_t period, bool same) const noexcept {
    const auto ended = same ? 0 : one.run;
    one.repeated += ended > kEnough && moves(one, period) ? kEnough : ended;
    one.matched += ended;
    one.since_s = same && one.run == 0 ? last_s_ : one.since_s;
    one.run = same ? one.run + 1 : 0;
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
    const auto& last = repeats_.front();
    if (last.run == 0 || !(newest_s_ - last.since_s > StreamHealth::kStale_s)) return std::nullopt;
    const double share =
        static_cast<double>(last.repeated + 1) / static_cast<double>(last.repeated + changes(last, 1) + 2);
    if (static_cast<double>(last.run) * std::log(share) > std::log(kByChance)) return std::nullopt;
    return last.since_s;
}

std::optional<double> Standstill::repeatsSince() const noexcept {
    std::optional<double> earliest;
    for (std::size_t row = eachChannel_ ? 1 : 0; row < same_.size(); ++row) {
        for (std::uint64_t left = same_[row]; left != 0; left &= left - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(left));
            const auto& judged = repeats_[row * kPeriods + i];
            if (stands(judged, i + 1)) earliest = std::min(earliest.value_or(judged.since_s), judged.since_s);
        }
    }
    return earliest;
}

}  // namespace tacto
