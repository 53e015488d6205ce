#include "core/analysis/psychophysics/TrainingRule.h"

#include <algorithm>
#include <cmath>

namespace tacto {

Result<TrainingRule> TrainingRule::create(const TrainingRuleSettings& settings) {
    if (settings.blockSize < 1) {
        return fail(ErrorCode::InvalidArgument, "a block of training has {} trials; 1 or more is accepted",
                    settings.blockSize);
    }
    if (!(settings.share > 0 && settings.share <= 1)) {
        return fail(ErrorCode::InvalidArgument,
                    "the share of right answers that ends training is {}; must be above 0, at most 1", settings.share);
    }
    return TrainingRule(settings);
}

bool TrainingRule::done() const noexcept {
    return result_.reached || (result_.right.size() >= settings_.most && inBlock_ == 0);
}

std::optional<TrainingTrial> TrainingRule::next() const {
    if (done()) return std::nullopt;
    if (inBlock_ == 0) return TrainingTrial{result_.right.size() + 1, 1};
    return TrainingTrial{result_.right.size(), inBlock_ + 1};
}

Result<void> TrainingRule::answer(bool right) {
    if (done()) return fail(ErrorCode::InvalidArgument, "training is over; no answer is accepted");
    if (inBlock_ == 0) result_.right.push_back(0);
    if (right) ++result_.right.back();
    if (++inBlock_ < settings_.blockSize) return {};
    inBlock_ = 0;
    const double needed = settings_.share * static_cast<double>(settings_.blockSize);
    result_.reached = static_cast<double>(result_.right.back()) >= needed - 1e-9;
    return {};
}

}  // namespace tacto
