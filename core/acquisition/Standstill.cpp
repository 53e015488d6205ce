#include "core/acquisition/Standstill.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/acquisition/StreamHealth.h"

namespace tacto {

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

/// What a value that stood still repeated is not taken for its noise.
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
