#include "core/analysis/psychophysics/QuestPlus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "core/analysis/statistics/GivenFigure.h"

namespace tacto {

namespace {

constexpr double kAlphaBelow_db = 12, kAlphaAbove_db = 9, kAlphaStep_db = 0.5;  // relative to 20 lg F
constexpr auto kAlphas = static_cast<std::size_t>((kAlphaBelow_db + kAlphaAbove_db) / kAlphaStep_db) + 1;
constexpr std::array<double, 4> kSlopes = {2, 4, 8, 16};
constexpr double kPriorBelowFelt_db = 1;
constexpr double kEasyTimes = 1.5;
constexpr std::size_t kEasyEvery = 8;

double decibels(double level) noexcept { return 20 * std::log10(level); }
double levelOf(double db) noexcept { return std::pow(10.0, db / 20); }

Result<void> validateQuestPlus(const QuestPlusSettings& settings) {
    auto valid = checkFigures({givenAboveZero("the first felt level", settings.felt),
                               {"the threshold expected", settings.prior, {.low = 0}},
                               {"the estimate to begin with", settings.first, {.low = 0}},
                               givenAboveZero("the prior's standard deviation in dB", settings.priorSd_db, 100),
                               {"the precision that ends detection, in dB,", settings.enough_db, {.low = 0}}});
    if (!valid || (settings.least >= 1 && settings.most >= settings.least && settings.most <= 1000)) return valid;
    return invalid("{} to {} detection trials; 1 to 1000, the first no larger than the second, is accepted",
                   settings.least, settings.most);
}

/// The α grid around F.
EvenDensity alphasAround(double felt) { return {decibels(felt) - kAlphaBelow_db, kAlphaStep_db, {}}; }

/// The levels above 0.
std::vector<double> levelsOf(const LevelGrid& grid) {
    std::vector<double> levels;
    for (std::size_t level = 1; level <= grid.count(); ++level) levels.push_back(grid.level(level));
    return levels;
}

/// Returns the posterior before any answer; its choices are `levels`.
TwoIntervalPosterior priorOver(std::span<const double> levels, const QuestPlusSettings& settings) {
    const double centre = decibels(settings.felt);
    const double prior = settings.prior > 0 ? decibels(settings.prior) : centre - kPriorBelowFelt_db;
    const auto alphas = alphasAround(settings.felt);
    // Weights are relative to the grid point nearest to the prior, so that a distant prior does not underflow.
    const double nearest = std::clamp(prior, alphas.first, alphas.at(kAlphas - 1));
    const auto exponent = [&](double alpha) { return std::pow((alpha - prior) / settings.priorSd_db, 2) / 2; };
    std::vector<double> weights, right;
    for (std::size_t i = 0; i < kAlphas; ++i)
        weights.insert(weights.end(), kSlopes.size(), std::exp(exponent(nearest) - exponent(alphas.at(i))));
    right.reserve(levels.size() * weights.size());
    for (const double level : levels) {
        const double x = decibels(level);
        for (std::size_t i = 0; i < kAlphas; ++i) {
            for (const double slope : kSlopes) right.push_back(QuestPlus::probabilityRight(x, alphas.at(i), slope));
        }
    }
    return {std::move(weights), std::move(right)};
}

EvenDensity alphaIn(const TwoIntervalPosterior& posterior, double felt) {
    auto alpha = alphasAround(felt);
    const auto weights = posterior.weights();
    for (std::size_t from = 0; from < weights.size(); from += kSlopes.size()) {
        const auto slopes = weights.subspan(from, kSlopes.size());
        alpha.weights.push_back(std::accumulate(slopes.begin(), slopes.end(), 0.0));
    }
    return alpha;
}

Estimate thresholdIn(const EvenDensity& alpha) {
    return {levelOf(alpha.mean()), levelOf(alpha.quantile(0.025)), levelOf(alpha.quantile(0.975))};
}

/// Mean of p(x) over the posterior, and its 2.5 and 97.5 % points; α is uniform within its cell.
Estimate rightAt(double level, const TwoIntervalPosterior& posterior, const EvenDensity& alphas) {
    constexpr int kParts = 10;  // of a cell of α
    const double x = decibels(level);
    std::vector<std::pair<double, double>> shares;  // p(x), weight
    const auto weights = posterior.weights();
    double mean = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        for (int part = 0; part < kParts; ++part) {
            const double alpha = alphas.at(i / kSlopes.size()) + kAlphaStep_db * ((part + 0.5) / kParts - 0.5);
            const double weight = weights[i] / kParts;
            shares.emplace_back(QuestPlus::probabilityRight(x, alpha, kSlopes[i % kSlopes.size()]), weight);
            mean += weight * shares.back().first;
        }
    }
    std::ranges::sort(shares);
    const auto point = [&](double q) {
        double sum = 0;
        for (const auto& [share, weight] : shares) {
            sum += weight;
            if (sum >= q) return share;
        }
        return shares.back().first;
    };
    return {mean, point(0.025), point(0.975)};
}

}  // namespace

double QuestPlus::probabilityRight(double level_db, double alpha_db, double slope) noexcept {
    using P = TwoIntervalPosterior;
    return P::kGuess + (1 - P::kGuess - P::kLapse) * -std::expm1(-std::pow(10.0, slope * (level_db - alpha_db) / 20));
}

Result<QuestPlus> QuestPlus::create(const LevelGrid& grid, const QuestPlusSettings& settings, std::uint64_t seed) {
    if (auto valid = validateQuestPlus(settings); !valid) return failure(valid);
    return QuestPlus(grid, settings, seed);
}

QuestPlus::QuestPlus(const LevelGrid& grid, const QuestPlusSettings& settings, std::uint64_t seed)
    : grid_(grid), settings_(settings), order_(seed, settings.stream), posterior_(priorOver(levelsOf(grid), settings)) {
    if (!(settings_.first > 0)) settings_.first = settings_.felt;
    choose();
}

void QuestPlus::choose() {
    const std::size_t number = trials_.size() + 1;
    if (number != 1 && number % kEasyEvery != 0) {
        chosen_ = posterior_.mostInformative() + 1;
        return;
    }
    const double wanted = kEasyTimes * (number == 1 ? settings_.first : levelOf(ofAlpha().mean()));
    chosen_ = grid_.nearest(wanted);
    if (chosen_ != posterior_.forbidden() + 1) return;
    const bool weakerIsNearer = wanted - grid_.level(chosen_ - 1) <= grid_.level(chosen_ + 1) - wanted;
    chosen_ = chosen_ == grid_.count() || (chosen_ > 1 && weakerIsNearer) ? chosen_ - 1 : chosen_ + 1;
}

std::optional<TwoIntervalTrial> QuestPlus::next() const {
    if (done()) return std::nullopt;
    const std::size_t number = trials_.size() + 1;
    return TwoIntervalTrial{number, grid_.level(chosen_), order_.of(number)};
}

Result<void> QuestPlus::answer(TrialInterval said) {
    if (auto valid = validate(said); !valid) return valid;
    const auto asked = next();
    if (!asked) return invalid("detection is complete; no answer is accepted");
    const bool correct = said == asked->interval;
    posterior_.take(chosen_ - 1, correct);
    shares_.add(asked->interval, correct);
    trials_.push_back({asked->level, asked->interval, correct});
    choose();
    return {};
}

bool QuestPlus::done() const {
    if (trials_.size() >= settings_.most) return true;
    return trials_.size() >= settings_.least && ofAlpha().sd() <= settings_.enough_db;
}

EvenDensity QuestPlus::ofAlpha() const { return alphaIn(posterior_, settings_.felt); }

double QuestPlus::probabilityAbove(double level) const {
    const double x = decibels(level);
    const auto alpha = ofAlpha();
    double above = 0;
    for (std::size_t i = 0; i < kAlphas; ++i)
        above += alpha.weights[i] * std::clamp((alpha.at(i) - x) / kAlphaStep_db + 0.5, 0.0, 1.0);
    return above;
}

QuestPlusResult QuestPlus::result() const {
    QuestPlusResult out;
    const auto alpha = ofAlpha();
    out.estimate = thresholdIn(alpha);
    out.sd_db = alpha.sd();
    out.slope = 0;
    const auto weights = posterior_.weights();
    for (std::size_t i = 0; i < weights.size(); ++i) out.slope += weights[i] * kSlopes[i % kSlopes.size()];
    out.atEdge = alpha.atEdge();
    out.intervals = shares_;
    out.trials = trials_;
    return out;
}

Result<DetectionCourse> detectionCourse(std::span<const LevelAnswer> answers, double felt, std::span<const double> at) {
    QuestPlusSettings settings;
    settings.felt = felt;
    if (auto valid = validateQuestPlus(settings); !valid) return failure(valid);
    std::vector<double> levels;
    for (const auto& answer : answers) levels.push_back(answer.level);
    std::ranges::copy(at, std::back_inserter(levels));
    for (const double level : levels) {
        if (!(level > 0) || !std::isfinite(level)) return invalid("a level of {}; a number above 0 is accepted", level);
    }
    auto posterior = priorOver(levels, settings);  // each answer is a choice of its own
    DetectionCourse out;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        posterior.take(i, answers[i].correct);
        out.threshold.push_back(thresholdIn(alphaIn(posterior, felt)));
    }
    const auto alphas = alphasAround(felt);
    for (const double level : at) out.right.push_back(rightAt(level, posterior, alphas));
    return out;
}

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
    auto valid = checkFigures({givenAboveZero("the last estimate of the threshold", settings.last, 1e6),
                               givenAboveZero("the lowest level of the range", settings.min, 1e6),
                               givenAboveZero("the margin of the drift check", settings.margin, 10),
                               givenAboveZero("the probability that means drift", settings.threshold, 1)});
    if (!valid) return failure(valid);
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
        return invalid("the drift check asks for no trial now; no answer is accepted");
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
        return invalid("the drift check asks for no rest now; none can end");
    }
    auto quest = checkFor(grid_, settings_, seed_, result_.estimate.value, result_.rests + 1);
    if (!quest) return failure(quest);
    quest_ = std::move(*quest);
    ++result_.rests;
    step_ = DriftStep::Trial;
    return {};
}

}  // namespace tacto
