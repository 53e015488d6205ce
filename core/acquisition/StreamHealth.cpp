#include "core/acquisition/StreamHealth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

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

template <class Function>
void eachBit(std::uint64_t mask, Function function) {
    for (; mask != 0; mask &= mask - 1) function(static_cast<std::size_t>(std::countr_zero(mask)));
}

/// Returns the mask of those of 64 bytes that equal `byte`.
std::uint64_t equalBytes(const std::uint8_t* bytes, std::uint8_t byte) noexcept {
    std::uint64_t equal = 0;
#ifdef __SSE2__
    const auto wanted = _mm_set1_epi8(static_cast<char>(byte));
    for (unsigned from = 0; from < 64; from += 16) {
        const auto sixteen = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + from));
        const auto mask = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(sixteen, wanted)));
        equal |= std::uint64_t{mask} << from;
    }
#else
    for (unsigned i = 0; i < 64; ++i) equal |= std::uint64_t{bytes[i] == byte} << i;
#endif
    return equal;
}
}  // namespace

Standstill::Standstill(std::size_t channels, bool eachChannel)
    : channels_(channels), eachChannel_(eachChannel), before_(channels), repeats_(1 + channels) {
    static_assert(kTogether < kEnough);
}

void Standstill::feed(const SampleBlock& block) noexcept {
    for (std::size_t begin = 0; begin < block.t_s.size(); begin += kTogether) {
        const auto t_s = std::span(block.t_s).subspan(begin, std::min(kTogether, block.t_s.size() - begin));
        Masks all;
        all.fill(~Mask{0});
        for (std::size_t c = 0; c < channels_; ++c) {
            Masks same;
            compare(c, block.values.data() + begin * channels_ + c, t_s.size(), same);
            if (eachChannel_) track(repeats_[1 + c], same, t_s);
            for (std::size_t i = 0; i < t_s.size(); ++i) all[i] &= same[i];
        }
        for (std::size_t i = 0; i < t_s.size(); ++i)
            eachBit(all[i], [&](std::size_t bit) { ++repeats_.front().count[bit]; });
        track(repeats_.front(), all, t_s);
        seen_ += t_s.size();
        newest_s_ = t_s.back();
    }
}

void Standstill::compare(std::size_t channel, const double* values, std::size_t count, Masks& same) noexcept {
    auto& [bits, marks] = before_[channel];
    auto& repeats = repeats_[1 + channel].count;
    for (std::size_t i = 0; i < count; ++i) {
        bits[kPeriods + i] = std::bit_cast<std::uint64_t>(values[i * channels_]);
        marks[kPeriods + i] = static_cast<std::uint8_t>(bits[kPeriods + i] * 0x9E37'79B9'7F4A'7C15U >> 56U);
    }
    for (std::size_t i = 0; i < count; ++i) {
        auto left = equalBytes(marks.data() + i, marks[kPeriods + i]);
        if (seen_ + i < kPeriods) left &= seen_ + i == 0 ? 0 : ~Mask{0} << (kPeriods - seen_ - i);
        same[i] = left;
        // Works for no bit too: whether there is one is chance, and a branch on chance costs more than a comparison.
        const auto compareOne = [&, i] {
            const auto bit = static_cast<std::size_t>(std::countr_zero(left | Mask{1} << (kPeriods - 1)));
            const Mask equal = bits[i + bit] == bits[kPeriods + i] ? 1 : 0;
            repeats[bit] += equal & left >> bit;
            same[i] &= ~((equal ^ 1U) << bit);
            left &= left - 1;
        };
        compareOne();
        while (left != 0) compareOne();
    }
    std::copy_n(bits.begin() + static_cast<std::ptrdiff_t>(count), kPeriods, bits.begin());
    std::copy_n(marks.begin() + static_cast<std::ptrdiff_t>(count), kPeriods, marks.begin());
}

/// Whether a value usually moves, after `seen` samples, `count` repeats and the last `run` of them in a row. Repeats
/// during a standstill are not counted as noise of the value.
bool Standstill::moves(const Repeats& row, std::size_t bit, std::uint64_t seen, std::uint64_t count,
                       std::uint64_t run) noexcept {
    const auto changes = seen - std::min<std::uint64_t>(seen, kPeriods - bit) - count;
    return changes >= kKnown && count - run - row.excess[bit] < changes;
}

/// Follows the runs through samples whose repeats are counted. One that begins and ends among them shows nothing.
void Standstill::track(Repeats& row, const Masks& same, std::span<const double> t_s) const noexcept {
    eachBit(row.newest | same[t_s.size() - 1], [&](std::size_t bit) {
        const auto repeats = [&](std::size_t i) { return (same[i] >> bit & 1U) != 0; };
        auto& run = row.run[bit];
        std::size_t end = 0;
        while (end < t_s.size() && repeats(end)) ++end;
        if (run > 0 && end == t_s.size()) {
            run += end;
            return;
        }
        if (run > 0 && run + end > kEnough) {
            auto count = row.count[bit];
            for (auto i = end; i < t_s.size(); ++i) count -= repeats(i) ? 1 : 0;
            if (moves(row, bit, seen_ + end, count, run + end)) row.excess[bit] += run + end - kEnough;
        }
        auto begin = t_s.size();
        while (begin > 0 && repeats(begin - 1)) --begin;
        run = t_s.size() - begin;
        row.since_s[bit] = begin == 0 ? newest_s_ : t_s[begin - 1];
    });
    row.newest = same[t_s.size() - 1];
}

std::optional<double> Standstill::since() const noexcept {
    const auto& row = repeats_.front();
    constexpr std::size_t kNext = kPeriods - 1;
    const auto run = row.run[kNext];
    if (run == 0 || !(newest_s_ - row.since_s[kNext] > StreamHealth::kStale_s)) return std::nullopt;
    const auto noise = row.count[kNext] - run - row.excess[kNext];
    const auto changes = seen_ - 1 - row.count[kNext];
    const double share = static_cast<double>(noise + 1) / static_cast<double>(noise + changes + 2);
    if (static_cast<double>(run) * std::log(share) > std::log(kByChance)) return std::nullopt;
    return row.since_s[kNext];
}

std::optional<double> Standstill::repeatsSince() const noexcept {
    std::optional<double> earliest;
    for (std::size_t r = eachChannel_ ? 1 : 0; r < (eachChannel_ ? repeats_.size() : 1); ++r) {
        const auto& row = repeats_[r];
        eachBit(row.newest, [&](std::size_t bit) {
            const auto run = row.run[bit];
            if (run < kEnough || !(newest_s_ - row.since_s[bit] > StreamHealth::kStale_s)) return;
            if (moves(row, bit, seen_, row.count[bit], run))
                earliest = std::min(earliest.value_or(row.since_s[bit]), row.since_s[bit]);
        });
    }
    return earliest;
}

}  // namespace tacto
