#include "core/analysis/psychophysics/TwoIntervalTrials.h"

#include <algorithm>

#include "core/base/Random.h"

namespace tacto {

Result<TrialInterval> trialIntervalFrom(std::string_view text) {
    if (const auto known = valueFor(kTrialIntervals, text)) return *known;
    return fail(ErrorCode::InvalidArgument, "the answer is \"{}\"; first or second is accepted", text);
}

Result<void> validate(TrialInterval interval) {
    if (interval == TrialInterval::First || interval == TrialInterval::Second) return {};
    return fail(ErrorCode::InvalidArgument, "answer number {} is not an interval; first or second is accepted",
                static_cast<int>(interval));
}

void IntervalShares::add(TrialInterval interval, bool correct) noexcept {
    IntervalShare& share = interval == TrialInterval::First ? first : second;
    ++share.trials;
    if (correct) ++share.right;
}

TwoIntervalOrder::TwoIntervalOrder(std::uint64_t seed, std::string_view name) : seed_(seed), name_(name) {}

TrialInterval TwoIntervalOrder::of(std::size_t number) const {
    if (const auto wanted = (number - 1) / ten_.size(); drawn_ != wanted) {
        drawn_ = wanted;
        std::fill_n(ten_.begin(), 5, TrialInterval::First);
        std::fill(ten_.begin() + 5, ten_.end(), TrialInterval::Second);
        Random random(seed_, fmt::format("{}, intervals of ten {}", name_, wanted));
        for (std::size_t i = ten_.size() - 1; i > 0; --i) std::swap(ten_[i], ten_[random.below(i + 1)]);
    }
    return ten_[(number - 1) % ten_.size()];
}

}  // namespace tacto
