#include "core/pilot/PilotIdentification.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <map>

#include "core/analysis/psychophysics/TrialPlan.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

constexpr Seconds kTargetsTimeout{10};  // from the appearance of the targets
constexpr Seconds kFeedback{1.5};
constexpr Seconds kDriftRest{300};  // a third of the recovery time of about 15 min (Kaczmarek 2000)
constexpr int kMaxOnDemand = 5;     // repetitions of each condition on demand
constexpr std::uint64_t kMaxBlocks = 50;

nlohmann::json toJson(const std::vector<PlannedTrial>& planned, const std::vector<Condition>& conditions) {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& each : planned) {
        const auto condition = each.condition ? conditions[*each.condition].name : std::string(kCatchCondition);
        all.push_back(
            {{"number", each.number}, {"phase", nameOf(each.phase)}, {"block", each.block}, {"condition", condition}});
    }
    return all;
}

}  // namespace

std::vector<std::string> PilotIdentification::labels() const {
    std::vector<std::string> names;
    for (const auto& each : stage_.settings().conditions) names.push_back(each.name);
    return names;
}

std::vector<std::string> PilotIdentification::places() const {
    auto names = labels();
    auto placed = stage_.settings().answers.empty() ? answersIn(0) : stage_.settings().answers;
    const bool same = std::ranges::is_permutation(placed, names);
    return same ? placed : names;  // a profile may use other names for its conditions
}

Result<void> PilotIdentification::plan(bool withTrials) {
    auto& settings = stage_.settings();
    const auto stored = stage_.record().once(row::kPlan, "plan", [&]() -> Result<nlohmann::json> {
        nlohmann::json body =
            toJson(PlanRow{settings.seed, settings.encoding, static_cast<std::uint64_t>(settings.blocks),
                           settings.runSha256, fmt::format("{}", fmt::join(places(), ",")), settings.words.code(),
                           settings.words.version(), settings.words.sha256()});
        body["trials"] = nullptr;
        if (!withTrials) return body;
        auto planned = drawn();
        if (!planned) return failure(planned);
        body["trials"] = toJson(*planned, settings.conditions);
        return body;
    });
    if (!stored) return failure(stored);
    const auto row = planRowFrom(*stored);
    if (row.encoding != settings.encoding || row.blocks < 1 || row.blocks > kMaxBlocks)
        return fail(ErrorCode::ParseError,
                    "the stored plan is of the encoding \"{}\" and {} blocks, and the session of {} and up to {}: it "
                    "cannot be gone on with",
                    row.encoding, row.blocks, settings.encoding, kMaxBlocks);
    settings.answers.clear();
    for (const auto each : split(row.answers, ',')) {
        if (!each.empty()) settings.answers.emplace_back(each);
    }
    settings.seed = row.seed;
    settings.blocks = static_cast<int>(row.blocks);
    plan_ = valueOr(*stored, "trials");
    if (!withTrials) return {};
    auto planned = drawn();
    if (!planned) return failure(planned);
    if (toJson(*planned, settings.conditions) != plan_)
        return fail(ErrorCode::ParseError,
                    "the stored plan is not the one that is drawn from its seed, {}: it cannot be gone on with",
                    settings.seed);
    planned_ = std::move(*planned);
    return {};
}

Result<std::vector<PlannedTrial>> PilotIdentification::drawn() const {
    const auto& settings = stage_.settings();
    TrialPlanSettings wanted;
    wanted.conditions = settings.conditions.size();
    wanted.blocks = static_cast<std::size_t>(settings.blocks);
    wanted.perCondition = static_cast<std::size_t>(settings.perCondition);
    wanted.catchTrials = static_cast<std::size_t>(settings.catchTrials);
    return planTrials(wanted, settings.seed);
}

Result<void> PilotIdentification::prepare() {
    if (!presented_.empty()) return {};
    const auto& range = thresholds_.found();
    if (!range || !range->usable) return invalid("trials come after a usable range was found");
    presented_ = presentedConditions(stage_.settings(), range->min, range->max, stage_.step());
    lastDetection_ = thresholds_.estimate();
    return {};
}

std::vector<PlannedTrial> PilotIdentification::of(TrialPhase phase) const {
    std::vector<PlannedTrial> out;
    std::ranges::copy_if(planned_, std::back_inserter(out),
                         [phase](const PlannedTrial& each) { return each.phase == phase; });
    return out;
}

std::string PilotIdentification::nameOfCondition(const PlannedTrial& planned) const {
    return planned.condition ? presented_[*planned.condition].name : std::string(kCatchCondition);
}

StageTrial PilotIdentification::stageTrial(const PlannedTrial& planned) const {
    StageTrial trial;
    trial.name = fmt::format("{} {}", nameOf(planned.phase), planned.number);
    trial.about = {{"number", planned.number},
                   {"phase", nameOf(planned.phase)},
                   {"block", planned.block},
                   {"condition", nameOfCondition(planned)}};
    // An empty trial takes as long as the others, and uses the bench in the same way.
    const auto interval = planned.condition ? presented_[*planned.condition].interval : stage_.settings().longest;
    trial.level = planned.condition ? presented_[*planned.condition].level : 0;
    trial.presentation = testPresentation(stage_.levelOf(trial.level), interval, stage_.settings().window);
    trial.prompt = conditionPrompt(places(), stage_.words());
    trial.prompt.within = kTargetsTimeout;
    trial.screen.state = ScreenState::Feel;
    trial.screen.phase = nameOf(planned.phase);
    trial.screen.block = static_cast<int>(planned.block);
    if (planned.phase == TrialPhase::Test) trial.screen.blocks = stage_.settings().blocks;
    for (const auto& each : plan_) {  // finds the trial's place in its phase
        if (textOr(each, "phase") != nameOf(planned.phase)) continue;
        ++trial.screen.trials;
        if (countOr(each, "number") <= planned.number) ++trial.screen.trial;
    }
    return trial;
}

Result<StageAnswer> PilotIdentification::present(const PlannedTrial& planned, const StageTrial& trial) {
    auto answer = stage_.trial(trial);
    if (answer && (answer->given || trial.askedAgain)) keep(planned, trial, *answer);
    return answer;
}

void PilotIdentification::keep(const PlannedTrial& planned, const StageTrial& trial, const StageAnswer& answer) {
    IdentificationTrial kept;
    kept.number = planned.number;
    kept.phase = planned.phase;
    kept.block = planned.block;
    kept.condition = nameOfCondition(planned);
    kept.response = answer.response;
    kept.attempt = answer.attempt;
    kept.rt_s = answer.rt_s;
    if (stage_.settings().unit == LevelUnit::Current) kept.current = Milliamps(trial.level);
    kept.interval_s = planned.condition ? trial.presentation.interval.count() : kNaN;
    kept.trains = trial.level > 0 ? trial.presentation.onsets.size() : 0;
    stimulated_.push_back(stage_.stimulated() - lengthOf(trial));
    if (stage_.settings().unit == LevelUnit::Intensity && planned.condition)
        vibrations_.push_back(
            {kept.condition, trial.level, kept.interval_s, answer.vibration.value_or(BurstFigures{})});
    trials_.push_back(std::move(kept));
}

// Before the test

Result<void> PilotIdentification::familiarise() {
    if (auto ready = prepare(); !ready) return ready;
    if (auto read = stage_.instruct("familiarisation"); !read) return read;
    for (const auto& planned : of(TrialPhase::Familiarisation)) {
        auto trial = stageTrial(planned);
        trial.asks = false;
        trial.screen.state = ScreenState::Named;
        trial.screen.named = planned.condition ? nameOfCondition(planned) : std::string(kNoneResponse);
        if (planned.condition) trial.felt.named = trial.screen.named;
        const auto felt = present(planned, trial);
        if (!felt) return failure(felt);
    }
    const auto& words = stage_.words();
    // The targets have the places and keys of the answers to come, so that all four places are there from the start.
    std::vector<PromptTarget> offered = conditionPrompt(places(), words).targets;
    offered.resize(labels().size());
    offered.push_back({"go-on", words.text("answer.go-on")});
    std::map<std::string, int> onDemand;
    const auto isLeft = [&](const PresentedCondition& each) { return onDemand[each.name] < kMaxOnDemand; };
    for (int n = 1; std::ranges::any_of(presented_, isLeft); ++n) {
        const auto wanted = stage_.ask(row::kPhase, fmt::format("on demand {}", n),
                                       choicePrompt("on-demand", words.text("demand.question"), offered));
        if (!wanted) return failure(wanted);
        const auto key = textOr(*wanted, "key");
        const auto at = std::ranges::find(presented_, key, &PresentedCondition::name);
        if (at == presented_.end()) break;
        if (onDemand[key] == kMaxOnDemand) continue;
        PlannedTrial again;
        again.phase = TrialPhase::Familiarisation;
        again.condition = static_cast<std::size_t>(at - presented_.begin());
        auto trial = stageTrial(again);
        trial.name = fmt::format("on demand {}", n);
        trial.asks = false;
        trial.screen.state = ScreenState::Named;
        trial.screen.named = trial.felt.named = at->name;
        const auto felt = stage_.trial(trial);
        if (!felt) return failure(felt);
        if (++onDemand[key] < kMaxOnDemand) continue;
        auto& text = std::ranges::find(offered, key, &PromptTarget::key)->text;
        text = words.text("demand.felt", {{"name", text}, {"times", fmt::format("{}", kMaxOnDemand)}});
    }
    return {};
}

Result<void> PilotIdentification::train() {
    if (auto ready = prepare(); !ready) return ready;
    auto rule = TrainingRule::create({});
    if (!rule) return failure(rule);
    for (const auto& planned : of(TrialPhase::Training)) {
        if (rule->done()) break;
        auto trial = stageTrial(planned);
        trial.prompt.within.reset();  // no time limit while learning
        const auto answer = present(planned, trial);
        if (!answer) return failure(answer);
        const bool right = answer->response == nameOfCondition(planned);
        if (auto taken = rule->answer(right); !taken) return taken;
        if (auto shown = feedback(planned, trial, right, answer->replayed); !shown) return shown;
    }
    return {};
}

/// Shows the condition's name; after a wrong answer presents the condition again with its name.
Result<void> PilotIdentification::feedback(const PlannedTrial& planned, const StageTrial& trial, bool right,
                                           bool replayed) {
    StageTrial again = trial;
    again.name += " again";
    again.about = {{"of", planned.number}};
    again.asks = false;
    again.screen.state = ScreenState::Named;
    again.screen.named = again.felt.named = nameOfCondition(planned);
    again.screen.right = right;
    if (!right) {
        const auto felt = stage_.trial(again);
        return felt ? Result<void>() : failure(felt);
    }
    if (replayed) return {};
    stage_.participant().show(again.screen);
    return stage_.pass(kFeedback);
}

// The test

Result<void> PilotIdentification::testBlock(int block) {
    if (auto ready = prepare(); !ready) return ready;
    if (block == 1) {
        if (auto read = stage_.instruct("test"); !read) return read;
    }
    std::vector<PlannedTrial> silent;
    for (const auto& planned : of(TrialPhase::Test)) {
        if (planned.block != static_cast<std::size_t>(block)) continue;
        auto trial = stageTrial(planned);
        const auto answer = present(planned, trial);
        if (!answer) return failure(answer);
        if (!answer->given) silent.push_back(planned);
    }
    for (const auto& planned : silent) {
        auto trial = stageTrial(planned);
        trial.askedAgain = true;
        const auto answer = present(planned, trial);
        if (!answer) return failure(answer);
    }
    return {};
}

Result<bool> PilotIdentification::driftCheck(int block) {
    if (auto ready = prepare(); !ready) return failure(ready);
    DriftCheckSettings settings;
    settings.felt = thresholds_.limits().felt;
    settings.last = lastDetection_;
    settings.min = thresholds_.found()->min;
    settings.block = static_cast<std::size_t>(block);
    // The participant accepted I_max for half an hour; the ramp of a resumed session goes no higher.
    const auto& all = *thresholds_.grid();
    const LevelCeiling highest[] = {{thresholds_.found()->max, all.limitedBy()}};
    const auto grid = LevelGrid::create(all.unit(), all.step(), highest);
    if (!grid) return failure(grid);
    auto check = DriftCheck::create(*grid, settings, stage_.settings().seed);
    if (!check) return failure(check);
    for (int trials = 1; !check->done();) {
        if (check->step() == DriftStep::Rest) {
            if (auto rested = takeBreak(block, kDriftRest); !rested) return failure(rested);
            if (auto taken = check->rested(); !taken) return failure(taken);
            continue;
        }
        const auto next = check->next();
        if (!next) break;
        const auto said = thresholds_.twoIntervals(fmt::format("drift {}.{}", block, trials++), *next, "drift");
        if (!said) return failure(said);
        if (auto taken = check->answer(*said); !taken) return failure(taken);
    }
    const auto& found = check->result();
    lastDetection_ = found.estimate.value;
    const auto stored =
        stage_.record().once(row::kDrift, fmt::format("block {}", block), [&]() -> Result<nlohmann::json> {
            return toJson(DriftRow{.unit = stage_.settings().unit,
                                   .block = settings.block,
                                   .detection = found.estimate,
                                   .probability = found.probability,
                                   .rests = found.rests,
                                   .adapted = found.adapted});
        });
    if (!stored) return failure(stored);
    auto row = *stored;
    row.erase("name");
    drift_.push_back(std::move(row));
    return found.adapted ? goesOnAdapted(block) : Result<bool>(true);
}

/// The weakest level is hardly felt any more, and rests did not help: the participant decides whether to continue.
Result<bool> PilotIdentification::goesOnAdapted(int block) {
    const auto& words = stage_.words();
    const auto said =
        stage_.ask(row::kPhase, fmt::format("ending before block {}", block),
                   choicePrompt("ending", words.text("ending.question"),
                                {{"go-on", words.text("answer.go-on")}, {"end", words.text("ending.end")}}));
    if (!said) return failure(said);
    return textOr(*said, "key") != "end";
}

Result<void> PilotIdentification::takeBreak(int block, Seconds time) {
    auto& record = stage_.record();
    const auto name = fmt::format("break after {} ({})", block, ++breaks_);
    if (record.find(row::kBreakEnd, name) != nullptr) return {};
    stage_.rest();
    if (record.find(row::kBreakBegin, name) == nullptr) {
        if (auto kept = record.write(row::kBreakBegin, name, {{"least_s", time.count()}}); !kept) return kept;
    }
    PilotScreen screen;
    screen.state = ScreenState::Break;
    screen.phase = "break";
    screen.block = block;
    screen.blocks = stage_.settings().blocks;
    screen.until = stage_.bench().clock().now() + toInstant(time);
    stage_.participant().show(screen);
    if (auto passed = stage_.pass(time); !passed) return passed;
    const auto on = stage_.ask(row::kPhase, name,
                               goOnPrompt(stage_.words().text("break.question"), PromptTo::Both, stage_.words()));
    if (!on) return failure(on);
    if (auto kept = record.write(row::kBreakEnd, name); !kept) return kept;
    stage_.electrodesTouched();
    return {};
}

}  // namespace tacto
