#include "core/analysis/psychophysics/QuestPlus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace tacto {

namespace {

constexpr double kAlphaBelow_db = 12, kAlphaAbove_db = 9, kAlphaStep_db = 0.5;  // About 20 lg F
constexpr std::array<double, 4> kSlopes = {2, 4, 8, 16};
constexpr double kPriorBelowFelt_db = 1;
constexpr double kEasyTimes = 1.5;
constexpr std::size_t kEasyEvery = 8;
constexpr std::size_t kMaxAlike = 3;
constexpr double kEdgeWeight = 0.025;

double decibels(double level) noexcept { return 20 * std::log10(level); }
double levelOf(double db) noexcept { return std::pow(10.0, db / 20); }

double binaryEntropy(double p) noexcept {
    const auto part = [](double q) { return q > 0 ? -q * std::log(q) : 0; };
    return part(p) + part(1 - p);
}

Result<void> validateQuestPlus(const QuestPlusSettings& settings) {
    const auto level = [](double x) { return x > 0 && std::isfinite(x); };
    if (!level(settings.felt)) {
        return fail(ErrorCode::InvalidArgument, "the first felt level is {}; above 0 is accepted", settings.felt);
    }
    if (settings.prior != 0 && !level(settings.prior)) {
        return fail(ErrorCode::InvalidArgument, "the threshold expected is {}; above 0 is accepted", settings.prior);
    }
    if (settings.first != 0 && !level(settings.first)) {
        return fail(ErrorCode::InvalidArgument, "the estimate to begin with is {}; above 0 is accepted",
                    settings.first);
    }
    if (!(settings.priorSd_db > 0 && settings.priorSd_db <= 100)) {
        return fail(ErrorCode::InvalidArgument, "the prior's standard deviation is {} dB; above 0 to 100 is accepted",
                    settings.priorSd_db);
    }
    if (settings.least < 1 || settings.most < settings.least || settings.most > 1000) {
        return fail(ErrorCode::InvalidArgument,
                    "{} to {} detection trials; 1 to 1000, the first no larger than the second, is accepted",
                    settings.least, settings.most);
    }
    if (!(settings.enough_db >= 0 && std::isfinite(settings.enough_db))) {
        return fail(ErrorCode::InvalidArgument, "the precision that ends detection is {} dB; 0 or more is accepted",
                    settings.enough_db);
    }
    return {};
}

}  // namespace

double QuestPlus::probabilityRight(double level_db, double alpha_db, double slope) noexcept {
    return kGuess + (1 - kGuess - kLapse) * -std::expm1(-std::pow(10.0, slope * (level_db - alpha_db) / 20));
}

Result<QuestPlus> QuestPlus::create(const LevelGrid& grid, const QuestPlusSettings& settings, std::uint64_t seed) {
    if (auto valid = validateQuestPlus(settings); !valid) return failure(valid);
    return QuestPlus(grid, settings, seed);
}

QuestPlus::QuestPlus(const LevelGrid& grid, const QuestPlusSettings& settings, std::uint64_t seed)
    : grid_(grid), settings_(settings), order_(seed, settings.stream) {
    const double centre = decibels(settings_.felt);
    const double prior = settings_.prior > 0 ? decibels(settings_.prior) : centre - kPriorBelowFelt_db;
    if (!(settings_.first > 0)) settings_.first = settings_.felt;
    const auto alphas = static_cast<std::size_t>((kAlphaBelow_db + kAlphaAbove_db) / kAlphaStep_db) + 1;
    for (std::size_t i = 0; i < alphas; ++i) {
        alphas_.push_back(centre - kAlphaBelow_db + kAlphaStep_db * static_cast<double>(i));
    }
    // A prior far outside the grid keeps its nearest end: relative to that no weight underflows to nothing.
    const double nearest = std::clamp(prior, alphas_.front(), alphas_.back());
    const auto exponent = [&](double alpha) { return std::pow((alpha - prior) / settings_.priorSd_db, 2) / 2; };
    for (const double alpha : alphas_) {
        posterior_.insert(posterior_.end(), kSlopes.size(), std::exp(exponent(nearest) - exponent(alpha)));
    }
    normalise();
    right_.reserve(grid_.count() * posterior_.size());
    for (std::size_t level = 1; level <= grid_.count(); ++level) {
        const double x = decibels(grid_.level(level));
        for (const double alpha : alphas_) {
            for (const double slope : kSlopes) right_.push_back(probabilityRight(x, alpha, slope));
        }
    }
    entropy_.resize(right_.size());
    std::ranges::transform(right_, entropy_.begin(), binaryEntropy);
    choose();
}

void QuestPlus::normalise() {
    const double sum = std::accumulate(posterior_.begin(), posterior_.end(), 0.0);
    for (double& weight : posterior_) weight /= sum;
}

void QuestPlus::choose() {
    const std::size_t number = trials_.size() + 1;
    std::size_t forbidden = 0;
    if (asked_.size() >= kMaxAlike && grid_.count() > 1) {
        const auto last = std::span(asked_).last(kMaxAlike);
        if (std::ranges::all_of(last, [&](std::size_t level) { return level == last.back(); })) forbidden = last.back();
    }
    if (number != 1 && number % kEasyEvery != 0) {
        chosen_ = informative(forbidden);
        return;
    }
    const double wanted = kEasyTimes * (number == 1 ? settings_.first : levelOf(mean_db()));
    chosen_ = grid_.nearest(wanted);
    if (chosen_ != forbidden) return;
    const bool weakerIsNearer = wanted - grid_.level(chosen_ - 1) <= grid_.level(chosen_ + 1) - wanted;
    chosen_ = chosen_ == grid_.count() || (chosen_ > 1 && weakerIsNearer) ? chosen_ - 1 : chosen_ + 1;
}

std::size_t QuestPlus::informative(std::size_t forbidden) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t level = 1; level <= grid_.count(); ++level) {
        if (level == forbidden) continue;
        const double entropy = expectedEntropy(level);
        if (entropy < least - kEqualEntropy) {
            least = entropy;
            best = level;
        }
    }
    return best;
}

/// Less the entropy of what is known now, which is the same for every level: the posterior's expected entropy is the
/// present one, plus what the answer would leave open if α and β were known, less the answer's own.
double QuestPlus::expectedEntropy(std::size_t level) const {
    const std::size_t size = posterior_.size(), from = (level - 1) * size;
    double right = 0, known = 0;
    for (std::size_t i = 0; i < size; ++i) {
        right += posterior_[i] * right_[from + i];
        known += posterior_[i] * entropy_[from + i];
    }
    return known - binaryEntropy(right);
}

std::optional<TwoIntervalTrial> QuestPlus::next() const {
    if (done()) return std::nullopt;
    const std::size_t number = trials_.size() + 1;
    return TwoIntervalTrial{number, grid_.level(chosen_), order_.of(number)};
}

Result<void> QuestPlus::answer(TrialInterval said) {
    if (auto valid = validate(said); !valid) return valid;
    const auto asked = next();
    if (!asked) return fail(ErrorCode::InvalidArgument, "detection is complete; no answer is accepted");
    const bool correct = said == asked->interval;
    const std::size_t from = (chosen_ - 1) * posterior_.size();
    for (std::size_t i = 0; i < posterior_.size(); ++i) {
        posterior_[i] *= correct ? right_[from + i] : 1 - right_[from + i];
    }
    normalise();
    shares_.add(asked->interval, correct);
    trials_.push_back({asked->level, asked->interval, correct});
    asked_.push_back(chosen_);
    choose();
    return {};
}

bool QuestPlus::done() const noexcept {
    if (trials_.size() >= settings_.most) return true;
    return trials_.size() >= settings_.least && sd_db() <= settings_.enough_db;
}

double QuestPlus::weightOf(std::size_t alpha) const noexcept {
    const auto first = posterior_.begin() + static_cast<std::ptrdiff_t>(alpha * kSlopes.size());
    return std::accumulate(first, first + static_cast<std::ptrdiff_t>(kSlopes.size()), 0.0);
}

double QuestPlus::mean_db() const noexcept {
    double mean = 0;
    for (std::size_t i = 0; i < alphas_.size(); ++i) mean += weightOf(i) * alphas_[i];
    return mean;
}

double QuestPlus::sd_db() const noexcept {
    const double mean = mean_db();
    double variance = 0;
    for (std::size_t i = 0; i < alphas_.size(); ++i)
        variance += weightOf(i) * (alphas_[i] - mean) * (alphas_[i] - mean);
    return std::sqrt(variance);
}

double QuestPlus::quantile_db(double q) const noexcept {
    double below = 0;
    for (std::size_t i = 0; i < alphas_.size(); ++i) {
        const double weight = weightOf(i);
        if (weight > 0 && below + weight >= q) {
            return alphas_[i] + kAlphaStep_db * (std::max(q - below, 0.0) / weight - 0.5);
        }
        below += weight;
    }
    return alphas_.back() + kAlphaStep_db / 2;
}

double QuestPlus::probabilityAbove(double level) const {
    const double x = decibels(level);
    double above = 0;
    for (std::size_t i = 0; i < alphas_.size(); ++i) {
        above += weightOf(i) * std::clamp((alphas_[i] - x) / kAlphaStep_db + 0.5, 0.0, 1.0);
    }
    return above;
}

QuestPlusResult QuestPlus::result() const {
    QuestPlusResult out;
    out.estimate = {levelOf(mean_db()), levelOf(quantile_db(0.025)), levelOf(quantile_db(0.975))};
    out.sd_db = sd_db();
    out.slope = 0;
    for (std::size_t i = 0; i < posterior_.size(); ++i) out.slope += posterior_[i] * kSlopes[i % kSlopes.size()];
    out.atEdge = weightOf(0) > kEdgeWeight || weightOf(alphas_.size() - 1) > kEdgeWeight;
    out.intervals = shares_;
    out.trials = trials_;
    return out;
}

}  // namespace tacto
