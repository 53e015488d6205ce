#include "core/analysis/psychophysics/StrengthComparison.h"

#include <cmath>
#include <utility>

namespace tacto {

namespace {

constexpr double kMinWeber = 0.01;
constexpr double kWeberStep = 0.05;  // step of ln w
constexpr std::size_t kWebers = 93;  // number of grid points, up to w = 1
constexpr double kPriorWeber = 0.10;
constexpr std::size_t kWidestEvery = 8;

double priorSd() noexcept { return std::log(2.0); }

EvenDensity webers() { return {std::log(kMinWeber), kWeberStep, {}}; }

}  // namespace

double StrengthComparison::probabilityRight(const StrengthPair& pair, double weber) noexcept {
    using P = TwoIntervalPosterior;
    const double apart = std::log(pair.stronger / pair.weaker) / std::log1p(weber);  // in JND
    return P::kGuess + (1 - P::kGuess - P::kLapse) * std::erf(apart / 2);
}

Result<StrengthComparison> StrengthComparison::create(const LevelGrid& grid, const StrengthComparisonSettings& settings,
                                                      std::uint64_t seed) {
    const auto isLevel = [](double level) { return level > 0 && std::isfinite(level); };
    const auto low = isLevel(settings.low) ? grid.atOrAbove(settings.low).value_or(0) : 0;
    const auto high = isLevel(settings.high) ? grid.atOrBelow(settings.high) : 0;
    if (low == 0 || high <= low) {
        return invalid("a comparison between {:g} and {:g}; two levels in steps of {} up to {} are needed",
                       settings.low, settings.high, grid.textOf(grid.step()), grid.textOf(grid.highest()));
    }
    if (settings.trials < 1 || settings.trials > 1000)
        return invalid("{} trials of comparison; 1 to 1000 are accepted", settings.trials);
    std::vector<StrengthPair> pairs;
    const double middle = std::log(settings.low * settings.high) / 2;
    for (std::size_t apart = 1; apart <= high - low; ++apart) {
        StrengthPair best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t from = low; from + apart <= high; ++from) {
            const StrengthPair pair{grid.level(from), grid.level(from + apart)};
            const double off = std::abs(std::log(pair.weaker * pair.stronger) / 2 - middle);
            if (off < least) best = pair, least = off;
        }
        pairs.push_back(best);
    }
    return StrengthComparison(std::move(pairs), settings.trials, seed);
}

StrengthComparison::StrengthComparison(std::vector<StrengthPair> pairs, std::size_t trials, std::uint64_t seed)
    : pairs_(std::move(pairs)), trials_(trials), order_(seed, "comparison"), posterior_(begun()) {
    choose();
}

TwoIntervalPosterior StrengthComparison::begun() const {
    const auto weber = webers();
    std::vector<double> weights, right;
    for (std::size_t i = 0; i < kWebers; ++i)
        weights.push_back(std::exp(-std::pow((weber.at(i) - std::log(kPriorWeber)) / priorSd(), 2) / 2));
    for (const auto& pair : pairs_) {
        for (std::size_t i = 0; i < kWebers; ++i) right.push_back(probabilityRight(pair, std::exp(weber.at(i))));
    }
    return {std::move(weights), std::move(right)};
}

void StrengthComparison::choose() {
    const std::size_t number = answered_.size() + 1;
    const bool widest = (number == 1 || number % kWidestEvery == 0) && posterior_.forbidden() != pairs_.size() - 1;
    chosen_ = widest ? pairs_.size() - 1 : posterior_.mostInformative();
}

std::optional<ComparisonTrial> StrengthComparison::next() const {
    const std::size_t number = answered_.size() + 1;
    if (number > trials_) return std::nullopt;
    return ComparisonTrial{number, pairs_[chosen_], order_.of(number)};
}

Result<void> StrengthComparison::answer(TrialInterval said) {
    if (auto valid = validate(said); !valid) return valid;
    const auto asked = next();
    if (!asked) return invalid("the comparison is complete; no answer is accepted");
    const bool correct = said == asked->interval;
    posterior_.take(chosen_, correct);
    shares_.add(asked->interval, correct);
    answered_.push_back({asked->pair, correct});
    choose();
    return {};
}

StrengthComparisonResult StrengthComparison::result() const {
    auto weber = webers();
    const auto weights = posterior_.weights();
    weber.weights.assign(weights.begin(), weights.end());
    return {{std::exp(weber.mean()), std::exp(weber.quantile(0.025)), std::exp(weber.quantile(0.975))},
            weber.atEdge(),
            shares_,
            answered_};
}

}  // namespace tacto
