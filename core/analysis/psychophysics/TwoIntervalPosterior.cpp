#include "core/analysis/psychophysics/TwoIntervalPosterior.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tacto {

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

/// Less the entropy of what is known now, which is the same for every choice: the posterior's expected entropy is the
/// present one, plus what the answer would leave open if the model were known, less the answer's own.
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
