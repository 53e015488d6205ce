#include "core/analysis/psychophysics/DriftCheck.h"

#include <cmath>

namespace tacto {

Result<QuestPlus> DriftCheck::checkFor(const LevelGrid& grid, const DriftCheckSettings& settings, std::uint64_t seed,
                                       double prior, std::size_t rests) {
    QuestPlusSettings quest;
    quest.felt = settings.felt;
    quest.prior = quest.first = prior;
    quest.priorSd_db = settings.priorSd_db;
    quest.least = quest.most = settings.trials;
    quest.stream = fmt::format("drift before block {}, check {}", settings.block, rests + 1);
    return QuestPlus::create(grid, quest, seed);
}

Result<DriftCheck> DriftCheck::create(const LevelGrid& grid, const DriftCheckSettings& settings, std::uint64_t seed) {
    const struct {
        std::string_view name;
        double value;
        double high;
    } asked[] = {{"the last estimate of the threshold", settings.last, 1e6},
                 {"the lowest level of the range", settings.min, 1e6},
                 {"the margin of the drift check", settings.margin, 10},
                 {"the probability that means drift", settings.threshold, 1}};
    for (const auto& each : asked) {
        if (!(each.value > 0 && each.value <= each.high)) {
            return fail(ErrorCode::InvalidArgument, "{} is {}; above 0 to {:g} is accepted", each.name, each.value,
                        each.high);
        }
    }
    auto quest = checkFor(grid, settings, seed, settings.last, 0);
    if (!quest) return failure(quest);
    return DriftCheck(grid, settings, seed, std::move(*quest));
}

DriftCheck::DriftCheck(const LevelGrid& grid, const DriftCheckSettings& settings, std::uint64_t seed, QuestPlus quest)
    : grid_(grid), settings_(settings), seed_(seed), quest_(std::move(quest)) {}

std::optional<TwoIntervalTrial> DriftCheck::next() const {
    if (step_ != DriftStep::Trial) return std::nullopt;
    return quest_.next();
}

Result<void> DriftCheck::answer(TrialInterval said) {
    if (step_ != DriftStep::Trial) {
        return fail(ErrorCode::InvalidArgument, "the drift check asks for no trial now; no answer is accepted");
    }
    if (auto answered = quest_.answer(said); !answered) return answered;
    if (!quest_.done()) return {};
    result_.checks.push_back(quest_.result());
    result_.estimate = result_.checks.back().estimate;
    result_.probability = quest_.probabilityAbove(settings_.min / settings_.margin);
    const bool drifted = result_.probability >= settings_.threshold;
    if (drifted && result_.rests < settings_.rests) {
        step_ = DriftStep::Rest;
    } else {
        step_ = DriftStep::Done;
        result_.adapted = drifted;
    }
    return {};
}

Result<void> DriftCheck::rested() {
    if (step_ != DriftStep::Rest) {
        return fail(ErrorCode::InvalidArgument, "the drift check asks for no rest now; none can end");
    }
    auto quest = checkFor(grid_, settings_, seed_, result_.estimate.value, result_.rests + 1);
    if (!quest) return failure(quest);
    quest_ = std::move(*quest);
    ++result_.rests;
    step_ = DriftStep::Trial;
    return {};
}

}  // namespace tacto
