#include "core/analysis/psychophysics/TwoIntervalTrials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/Random.h"

namespace tacto {

Result<TrialInterval> trialIntervalFrom(std::string_view text) {
    if (const auto known = valueFor(kTrialIntervals, text)) return *known;
    return invalid("the answer is \"{}\"; first or second is accepted", text);
}

Result<void> validate(TrialInterval interval) {
    if (interval == TrialInterval::First || interval == TrialInterval::Second) return {};
    return invalid("answer number {} is not an interval; first or second is accepted", static_cast<int>(interval));
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

namespace {

constexpr double kEdgeWeight = 0.025;

double binaryEntropy(double p) noexcept {
    const auto part = [](double q) { return q > 0 ? -q * std::log(q) : 0; };
    return part(p) + part(1 - p);
}

}  // namespace

TwoIntervalPosterior::TwoIntervalPosterior(std::vector<double> prior, std::vector<double> right)
    : weights_(std::move(prior)), right_(std::move(right)) {
    normalise();
    entropy_.resize(right_.size());
    std::ranges::transform(right_, entropy_.begin(), binaryEntropy);
}

void TwoIntervalPosterior::normalise() {
    const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
    for (double& weight : weights_) weight /= sum;
}

void TwoIntervalPosterior::take(std::size_t choice, bool right) {
    const std::size_t from = choice * weights_.size();
    for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] *= right ? right_[from + i] : 1 - right_[from + i];
    normalise();
    taken_.push_back(choice);
}

std::size_t TwoIntervalPosterior::forbidden() const noexcept {
    if (taken_.size() < kMaxAlike || choices() < 2) return choices();
    const auto last = std::span(taken_).last(kMaxAlike);
    const bool alike = std::ranges::all_of(last, [&](std::size_t choice) { return choice == last.back(); });
    return alike ? last.back() : choices();
}

std::size_t TwoIntervalPosterior::mostInformative() const {
    const std::size_t again = forbidden();
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t choice = 0; choice < choices(); ++choice) {
        if (choice == again) continue;
        const double entropy = expectedEntropy(choice);
        if (entropy < least - kEqualEntropy) {
            least = entropy;
            best = choice;
        }
    }
    return best;
}

/// Returns the expected posterior entropy minus the present entropy, which is equal for every choice. This is the
/// answer's entropy given the model, minus the answer's entropy given present knowledge.
double TwoIntervalPosterior::expectedEntropy(std::size_t choice) const {
    const std::size_t size = weights_.size(), from = choice * size;
    double right = 0, known = 0;
    for (std::size_t i = 0; i < size; ++i) {
        right += weights_[i] * right_[from + i];
        known += weights_[i] * entropy_[from + i];
    }
    return known - binaryEntropy(right);
}

double EvenDensity::mean() const noexcept {
    double mean = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) mean += weights[i] * at(i);
    return mean;
}

double EvenDensity::sd() const noexcept {
    const double middle = mean();
    double variance = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) variance += weights[i] * (at(i) - middle) * (at(i) - middle);
    return std::sqrt(variance);
}

double EvenDensity::quantile(double q) const noexcept {
    double below = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double weight = weights[i];
        if (weight > 0 && below + weight >= q) return at(i) + step * (std::max(q - below, 0.0) / weight - 0.5);
        below += weight;
    }
    return at(weights.size() - 1) + step / 2;
}

bool EvenDensity::atEdge() const noexcept { return weights.front() > kEdgeWeight || weights.back() > kEdgeWeight; }

}  // namespace tacto
