#include "core/pilot/PilotThresholds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/JsonText.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/PilotResults.h"

namespace tacto {

namespace {

constexpr Seconds kFeltBeforeAsked{4};  // how long I_max is felt before the question "half an hour of this?"

/// Returns the length of one train of the profile, or of a massager's burst.
Seconds trainLength(const Bench& bench, LevelUnit unit) {
    if (unit == LevelUnit::Intensity) return VibrationBurst{}.duration;
    const auto& train = bench.profile().encoding.train;
    return train.pulses > 1 && train.rate.value() > 0 ? Seconds(train.pulses / train.rate.value()) : Seconds(0.001);
}

Estimate estimateOf(const QuestPlusResult& found) { return found.estimate; }
Estimate estimateOf(const StaircaseResult& found) { return {found.estimate, kNaN, kNaN}; }
bool isAtEdge(const QuestPlusResult& found) { return found.atEdge; }
bool isAtEdge(const StaircaseResult& /*found*/) { return false; }

}  // namespace

Result<DetectionMethod> detectionMethodFrom(std::string_view name) {
    if (const auto method = valueFor(kDetectionMethods, name)) return *method;
    return invalid("the detection method is \"{}\"; quest or staircase is expected", name);
}

// Ascending limits

Result<LevelGrid> PilotThresholds::ascendingGrid() {
    const auto stored = stage_.record().once(row::kPhase, numbered("ascending"), [this]() -> Result<nlohmann::json> {
        if (auto armed = stage_.ready(); !armed) return failure(armed);
        nlohmann::json body{{"step", stage_.step()}, {"cap", stage_.settings().cap}};
        if (stage_.settings().unit == LevelUnit::Intensity) {
            body["device"] = 1;  // a massager's full strength
            return body;
        }
        const auto limit = stage_.bench().levelLimit(stage_.settings().shortest);
        if (!limit) return failure(limit);
        body["device"] = stage_.bench().devices().stimulator->traits().amplitudeMax;
        body["gate"] = limit->level.value();
        body["gate_limited_by"] = limit->limitedBy;
        return body;
    });
    if (!stored) return failure(stored);
    std::vector<LevelCeiling> ceilings;
    if (stored->contains("device")) ceilings.push_back({numberOr(*stored, "device"), LevelLimit::Device});
    ceilings.push_back({numberOr(*stored, "cap"), LevelLimit::Cap});
    if (stored->contains("gate")) ceilings.push_back({numberOr(*stored, "gate"), LevelLimit::Gate});
    if (std::isfinite(tooStrongBefore_))
        ceilings.push_back({tooStrongBefore_ - numberOr(*stored, "step"), LevelLimit::TooStrong});
    return LevelGrid::create(stage_.settings().unit, numberOr(*stored, "step"), ceilings);
}

Result<void> PilotThresholds::ascendingLimits() {
    if (auto read = stage_.instruct("ascending"); !read) return read;
    auto grid = ascendingGrid();
    if (!grid) return failure(grid);
    grid_ = *grid;
    auto limits = AscendingLimits::create(*grid_, seed());
    if (!limits) return failure(limits);
    const auto before = ascended_;
    while (const auto next = limits->next()) {
        ascended_ = before + next->number;
        if (auto done = present(*limits, *next); !done) return done;
    }
    if (liveSeries_ > 0) {
        if (auto ended = stage_.bench().endAscending(); !ended) return ended;
    }
    ascending_ = limits->result();
    if (liveSeries_ > 0) {
        PilotScreen rest;  // levels stop rising: the participant may let go
        rest.phase = "ascending";
        rest.text = stage_.words().text("hold.let-go");
        stage_.participant().show(rest);
    }
    return {};
}

Result<void> PilotThresholds::present(AscendingLimits& limits, const AscendingPresentation& next) {
    StageTrial trial;
    const auto series = next.series + static_cast<std::size_t>(repeats_) * AscendingLimits::kSeries;
    trial.name = fmt::format("ascending {}", ascended_);
    trial.about = {{"series", series}};
    trial.level = next.level;
    trial.presentation = ascendingPresentation(stage_.levelOf(next.level), stage_.settings().shortest);
    trial.prompt = strengthPrompt(stage_.words());
    trial.screen.state = ScreenState::Feel;
    trial.screen.phase = "ascending";
    trial.screen.block = static_cast<int>(next.series);
    trial.screen.blocks = static_cast<int>(AscendingLimits::kSeries);
    trial.stopAnswers = true;
    trial.held = true;
    const bool live = stage_.record().find(row::kAnswer, trial.name) == nullptr;
    if (live && liveSeries_ != next.series) {
        if (auto armed = stage_.ready(); !armed) return armed;
        // After an interruption the series continues at the level that the ramp has reached again.
        const bool begins = liveSeries_ > 0 || limits.result().series.back().highest == 0;
        const auto prompt =
            begins ? seriesPrompt(next.series, AscendingLimits::kSeries, stage_.words()) : holdPrompt(stage_.words());
        if (auto held = stage_.hold(prompt); !held) return held;
        if (begins) {
            if (auto begun = stage_.bench().beginAscending(); !begun) return begun;
        }
        liveSeries_ = next.series;
    }
    const auto answer = stage_.trial(trial);
    if (!answer) {
        if (answer.error().code != ErrorCode::LimitExceeded || stage_.ended() != PilotEnd::Unfinished)
            return failure(answer);
        limits.refused(LevelLimit::Gate);
        return {};
    }
    if (answer->response == "stop") {
        limits.stop();
        return {};
    }
    const auto word = strengthWordFrom(answer->response);
    if (!word) return failure(word);
    bool tooStrong = *word == StrengthWord::TooStrong;
    if (tooStrong && limits.doubtful()) {
        const auto meant = stage_.meantTooStrong(trial.name);
        if (!meant) return failure(meant);
        tooStrong = *meant;
        if (!tooStrong) limits.takeBack();
    }
    const bool slip = !tooStrong && *word == StrengthWord::TooStrong;
    // "Too strong" about an empty presentation is taken to mean the last level of the series.
    const double level = next.empty() && tooStrong ? limits.result().series.back().highest : next.level;
    if (!slip) {
        if (auto told = stage_.judged(level, tooStrong, trial.name, answer->replayed); !told) return told;
    }
    if (*word == StrengthWord::TooStrong && !answer->replayed) {
        if (auto answered = stage_.answeredFor(tooStrongHold(trial.name)); !answered) return answered;
    }
    return slip ? Result<void>() : limits.answer(*word);
}

// Detection

Result<LevelGrid> PilotThresholds::belowTooStrong() const {
    std::vector<LevelCeiling> ceilings{{grid_->highest(), grid_->limitedBy()}};
    double highest = 0;
    for (const auto& series : ascending_.series) highest = std::max(highest, series.highest);
    if (ascending_.saidTooStrong)
        ceilings.push_back({ascending_.tooStrong - grid_->step(), LevelLimit::TooStrong});
    else
        ceilings.push_back({highest, grid_->limitedBy()});
    return LevelGrid::create(grid_->unit(), grid_->step(), ceilings);
}

Result<void> PilotThresholds::detection(DetectionMethod method) {
    if (!grid_) return invalid("detection comes after the ascending limits");
    method_ = method;
    measured_ = true;
    if (!std::isfinite(ascending_.felt) || !(ascending_.tooStrong > grid_->step())) return {};
    auto below = belowTooStrong();
    if (!below) return failure(below);
    detectionGrid_ = *below;
    if (auto read = stage_.instruct("detection"); !read) return read;
    auto done = method == DetectionMethod::Quest ? measureBy<QuestPlus>(QuestPlusSettings{})
                                                 : measureBy<Staircase>(StaircaseSettings{});
    if (!done) return done;
    const auto kept = stage_.record().once(row::kEstimate, numbered("detection"), [this]() -> Result<nlohmann::json> {
        return nlohmann::json{
            {"estimate", estimateOrNull(estimate_)}, {"at_edge", estimateAtEdge_}, {"trials", trials_.size()}};
    });
    return kept ? Result<void>() : failure(kept);
}

Result<TrialInterval> PilotThresholds::twoIntervals(const std::string& name, const TwoIntervalTrial& asked,
                                                    const std::string& phase) {
    StageTrial trial;
    trial.name = name;
    trial.level = asked.level;
    const auto& settings = stage_.settings();
    trial.presentation = detectionPresentation(stage_.levelOf(asked.level), asked.interval == TrialInterval::Second,
                                               trainLength(stage_.bench(), settings.unit), settings.shortest);
    trial.prompt = intervalPrompt(stage_.words());
    trial.screen.phase = phase;
    return askInterval(std::move(trial), asked.interval, asked.number);
}

Result<TrialInterval> PilotThresholds::askInterval(StageTrial trial, TrialInterval held, std::size_t number) {
    trial.about = {{"right", nameOf(held)}};
    trial.screen.state = ScreenState::Interval;
    trial.screen.trial = static_cast<int>(number);
    trial.felt.inInterval = held == TrialInterval::Second ? 2 : 1;
    const auto answer = stage_.trial(trial);
    if (!answer) return failure(answer);
    return trialIntervalFrom(answer->response);
}

template <class Procedure, class Settings>
Result<void> PilotThresholds::measureBy(Settings settings) {
    settings.felt = ascending_.felt;
    auto procedure = Procedure::create(*detectionGrid_, settings, seed());
    if (!procedure) return failure(procedure);
    while (const auto next = procedure->next()) {
        const auto said = twoIntervals(fmt::format("detection {}", ++detected_), *next, "detection");
        if (!said) return failure(said);
        if (auto taken = procedure->answer(*said); !taken) return taken;
    }
    auto result = procedure->result();
    estimate_ = estimateOf(result);
    estimateAtEdge_ = isAtEdge(result);
    shares_ = result.intervals;
    trials_ = std::move(result.trials);
    return {};
}

// Range

Result<void> PilotThresholds::range() {
    if (!measured_) return invalid("the range comes after the detection threshold");
    if (!std::isfinite(estimate_.value)) {
        PersonalRangeResult none;
        none.reason = std::isfinite(ascending_.felt) ? "no detection threshold was found"
                                                     : "nothing was felt up to the highest level";
        range_ = none;
    } else {
        PersonalRangeSettings settings;
        settings.detection = estimate_.value;
        settings.tooStrong = ascending_.tooStrong;
        settings.saidTooStrong = ascending_.saidTooStrong;
        auto range = PersonalRange::create(*grid_, settings);
        if (!range) return failure(range);
        while (const auto level = range->next()) {
            StageTrial trial;
            trial.name = fmt::format("range {}", ++ranged_);
            trial.level = *level;
            trial.presentation = testPresentation(stage_.levelOf(*level), stage_.settings().shortest, kFeltBeforeAsked);
            trial.prompt = yesNoPrompt("half-an-hour", stage_.words().text("range.question"), PromptTo::Participant,
                                       stage_.words());
            trial.screen.state = ScreenState::Feel;
            trial.screen.phase = "range";
            const auto answer = stage_.trial(trial);
            if (!answer) return failure(answer);
            if (auto taken = range->answer(answer->response == "yes"); !taken) return taken;
        }
        range_ = range->result();
    }
    if (range_->usable) stage_.settle(range_->max);
    // The voltages belong to the impedance at that moment: they are read from the row, also after a resume.
    auto stored = stage_.record().once(row::kRange, numbered("range"),
                                       [this]() -> Result<nlohmann::json> { return describe(*range_); });
    if (!stored) return failure(stored);
    const auto now = describe(*range_);
    const auto unit = stage_.settings().unit;
    for (const auto& key : {std::string("usable"), levelKey("min", unit), levelKey("max", unit)}) {
        if (valueOr(*stored, key.c_str()) == now[key]) continue;
        return fail(ErrorCode::ParseError, "the record has a range whose {} is {}, and its answers lead to {}", key,
                    dumpJson(valueOr(*stored, key.c_str())), dumpJson(now[key]));
    }
    rangeRow_ = std::move(*stored);
    rangeRow_.erase("name");
    return {};
}

Result<bool> PilotThresholds::measureAgain() {
    if (!range_) return invalid("whether to measure again comes after the range");
    if (range_->usable || repeats_ == kMaxRepeats) return false;
    if (ascending_.saidTooStrong) tooStrongBefore_ = std::min(tooStrongBefore_, ascending_.tooStrong);
    if (!(tooStrongBefore_ > 1.5 * grid_->step())) return false;  // no level lies below it
    stage_.rest();
    const auto prompt =
        yesNoPrompt("measure-again",
                    fmt::format("There is no usable range. Seat the {} again and measure once more, from "
                                "zero? What was too strong stays the ceiling.",
                                stage_.settings().modality()),
                    PromptTo::Operator);
    const auto said = stage_.ask(row::kPhase, fmt::format("measure again {}", repeats_ + 1), prompt);
    if (!said) return failure(said);
    if (textOr(*said, "key") != "yes") return false;
    ++repeats_;
    liveSeries_ = 0;
    stage_.forgetAccepted();
    detectionGrid_.reset();
    estimate_ = {kNaN, kNaN, kNaN};
    estimateAtEdge_ = measured_ = false;
    shares_ = {};
    trials_.clear();
    range_.reset();
    rangeRow_ = nullptr;
    stage_.electrodesTouched();
    return true;
}

/// Returns the name of a row that each repeat has: "range", "range 2".
std::string PilotThresholds::numbered(const char* name) const {
    return repeats_ == 0 ? std::string(name) : fmt::format("{} {}", name, repeats_ + 1);
}

// Comparison

Result<void> PilotThresholds::comparison() {
    if (!range_) return invalid("the comparison comes after the range");
    if (!range_->usable) return {};
    const auto& settings = stage_.settings();
    auto procedure = StrengthComparison::create(*grid_, {.low = range_->min, .high = range_->max}, settings.seed);
    if (!procedure) return failure(procedure);
    while (const auto next = procedure->next()) {
        const bool second = next->interval == TrialInterval::Second;
        const auto& [weaker, stronger] = next->pair;
        StageTrial trial;
        trial.name = fmt::format("comparison {}", next->number);
        trial.level = stronger;
        trial.weaker = weaker;
        trial.presentation = comparisonPresentation(stage_.levelOf(second ? weaker : stronger),
                                                    stage_.levelOf(second ? stronger : weaker),
                                                    trainLength(stage_.bench(), settings.unit), settings.shortest);
        trial.prompt = comparisonPrompt(stage_.words());
        trial.screen.phase = "comparison";
        const auto said = askInterval(std::move(trial), next->interval, next->number);
        if (!said) return failure(said);
        if (auto taken = procedure->answer(*said); !taken) return taken;
    }
    compared_ = procedure->result();
    const auto kept = stage_.record().once(row::kEstimate, "comparison", [this]() -> Result<nlohmann::json> {
        return nlohmann::json{{"amplitude_weber", estimateOrNull(compared_->weber)},
                              {"at_edge", compared_->atEdge},
                              {"trials", compared_->trials.size()}};
    });
    return kept ? Result<void>() : failure(kept);
}

nlohmann::json PilotThresholds::describe(const PersonalRangeResult& found) const {
    const double ohm = stage_.impedance();
    return tacto::toJson(RangeRow{.unit = stage_.settings().unit,
                                  .usable = found.usable,
                                  .reason = found.reason,
                                  .min = found.min,
                                  .max = found.max,
                                  .jnd = found.jnd,
                                  .limitedBy = found.limitedBy,
                                  .minVoltage = Volts(found.min * ohm / 1000),
                                  .maxVoltage = Volts(found.max * ohm / 1000),
                                  .impedance = Ohms(ohm)});
}

nlohmann::json PilotThresholds::toJson() const {
    return thresholdsJson(
        {.limits = ascending_,
         .detection = measured_ ? std::optional(DetectionFound{method_, estimate_, estimateAtEdge_, trials_, shares_})
                                : std::nullopt,
         .range = rangeRow_,
         .compared = compared_},
        stage_.settings().unit);
}

}  // namespace tacto
