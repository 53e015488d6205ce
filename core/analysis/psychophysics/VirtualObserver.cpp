#include "core/analysis/psychophysics/VirtualObserver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/analysis/statistics/GivenFigure.h"

namespace tacto {

namespace {

/// A rating that rises on a logarithmic scale from `least` at `from` to `most` at `to`, with noise, as a whole number.
struct RatingScale {
    double from;
    double to;
    double least;
    double most;
};

int ratingOn(const RatingScale& scale, double level, double noise) noexcept {
    const double share = std::log(level / scale.from) / std::log(scale.to / scale.from);
    const double rated = std::round(scale.least + share * (scale.most - scale.least) + noise);
    return static_cast<int>(std::clamp(rated, 0.0, 10.0));
}

constexpr double kRatingNoise = 0.5;

TrialInterval other(TrialInterval interval) noexcept {
    return interval == TrialInterval::First ? TrialInterval::Second : TrialInterval::First;
}

}  // namespace

Result<VirtualObserver> VirtualObserver::create(const VirtualObserverSettings& settings) {
    const auto& who = settings.who;
    auto valid = checkFigures(
        {{"the adaptation", settings.adaptation, {.low = 0, .high = 10}},
         givenAboveZero("the time of adaptation in s", settings.adaptationTime.count()),
         givenAboveZero("the virtual participant's perception threshold (mA)", who.detection.value(), 1e6),
         givenAboveZero("the virtual participant's attention threshold (mA)", who.attention.value(), 1e6),
         givenAboveZero("the virtual participant's intolerance threshold (mA)", who.intolerance.value(), 1e6),
         givenAboveZero("the virtual participant's level that is too strong (mA)", who.discomfort.value(), 1e6),
         givenAboveZero("the virtual participant's Weber fraction of amplitude", who.amplitudeWeber, 10),
         givenAboveZero("the virtual participant's Weber fraction of interval", who.intervalWeber, 10),
         givenAboveZero("the virtual participant's noise (JND)", who.noise_jnd, 100),
         {"the virtual participant's lapse rate", who.lapse, {.low = 0, .high = 1}}});
    if (!valid) return failure(valid);
    if (!(who.discomfort > who.detection)) {
        return invalid(
            "the virtual participant's discomfort level is {} mA; it must exceed the perception threshold "
            "({} mA)",
            who.discomfort.value(), who.detection.value());
    }
    return VirtualObserver(settings);
}

VirtualObserver::VirtualObserver(const VirtualObserverSettings& settings) noexcept : settings_(settings) {
    const auto& who = settings_.who;
    const double unit = settings_.unit == LevelUnit::Current ? 1 : kVirtualFullIntensity.value();
    detection_ = who.detection.value() / unit;
    attention_ = who.attention.value() / unit;
    tooStrong_ = who.discomfort.value() / unit;
    intolerance_ = who.intolerance.value() / unit;
    // Equates the slopes d(felt)/d(ln level) at the threshold: β/e (Weibull) and 1/(√(2π) σ) (normal noise).
    const double sigma = who.noise_jnd * std::log1p(who.amplitudeWeber);
    slope_ = std::numbers::e / (std::sqrt(2 * std::numbers::pi) * sigma);
}

double VirtualObserver::risen(Seconds stimulated) const noexcept {
    return 1 + settings_.adaptation * -std::expm1(-stimulated.count() / settings_.adaptationTime.count());
}

Random VirtualObserver::randomFor(std::string_view question, std::string_view key) const {
    return {settings_.seed, fmt::format("virtual participant's {}, {}", question, key)};
}

double VirtualObserver::jnd(double level) const noexcept {
    return feltBy(settings_.who, level, Seconds(1)).amplitude_jnd;
}

double VirtualObserver::noisy(Random random, double level) const noexcept {
    return jnd(level) + settings_.who.noise_jnd * random.normal();
}

StrengthWord VirtualObserver::strength(std::string_view key, double level, Seconds stimulated) const {
    if (!(level > 0)) return StrengthWord::Nothing;
    const double felt = noisy(randomFor("strength", key), level / risen(stimulated));
    if (felt < jnd(detection_)) return StrengthWord::Nothing;
    if (felt >= jnd(tooStrong_)) return StrengthWord::TooStrong;
    return felt < jnd(attention_) ? StrengthWord::Weak : StrengthWord::Strong;
}

double VirtualObserver::probabilityRight(double level, Seconds stimulated) const noexcept {
    const double known = level > 0 ? -std::expm1(-std::pow(level / (detection_ * risen(stimulated)), slope_)) : 0;
    return 0.5 + (1 - settings_.who.lapse) / 2 * known;
}

TrialInterval VirtualObserver::detect(std::string_view key, double level, TrialInterval interval,
                                      Seconds stimulated) const {
    const bool right = randomFor("detection", key).uniform() < probabilityRight(level, stimulated);
    return right ? interval : other(interval);
}

TrialInterval VirtualObserver::compare(std::string_view key, double weaker, double stronger,
                                       TrialInterval interval) const {
    Random random = randomFor("comparison", key);
    const auto& who = settings_.who;
    if (random.uniform() < who.lapse) return random.uniform() < 0.5 ? TrialInterval::First : TrialInterval::Second;
    const double first = random.normal(), second = random.normal();
    return jnd(stronger) - jnd(weaker) + who.noise_jnd * (first - second) > 0 ? interval : other(interval);
}

IdentificationTask VirtualObserver::taskFor(std::span<const DeliveredCondition> conditions) const {
    IdentificationTask task;
    for (const auto& condition : conditions) {
        task.points.push_back(feltBy(settings_.who, condition.level, condition.interval));
    }
    task.given.assign(conditions.size(), true);
    return task;
}

Observer VirtualObserver::observerAfter(Seconds stimulated) const {
    return observerOf(settings_.who, detection_ * risen(stimulated));
}

std::size_t VirtualObserver::identify(std::string_view key, std::span<const DeliveredCondition> conditions,
                                      std::optional<std::size_t> presented, Seconds stimulated) const {
    Random random = randomFor("identification", key);
    const auto task = taskFor(conditions);
    const FeltPoint nothing{-std::numeric_limits<double>::infinity(), 0};
    return sampleResponse(task, observerAfter(stimulated), presented ? task.points[*presented] : nothing, random);
}

bool VirtualObserver::acceptable(std::string_view key, double level, Seconds stimulated) const {
    return noisy(randomFor("consent to a level", key), level / risen(stimulated)) < jnd(tooStrong_);
}

VirtualRating VirtualObserver::rate(std::string_view key, double level, Seconds stimulated) const {
    Random random = randomFor("rating", key);
    const double rated = level / risen(stimulated);
    VirtualRating out;
    if (!(rated > 0) || jnd(rated) + settings_.who.noise_jnd * random.normal() < jnd(detection_)) {
        out.naturalness = Naturalness::TotallyUnnatural;
        return out;
    }
    out.intensity = ratingOn({detection_, tooStrong_, 1, 8}, rated, kRatingNoise * random.normal());
    out.unpleasantness = ratingOn({detection_, tooStrong_, -2, 6}, rated, kRatingNoise * random.normal());
    out.pain = ratingOn({detection_, tooStrong_, -4, 3}, rated, kRatingNoise * random.normal());
    out.naturalness = kNaturalness[1 + random.below(4)].value;
    const bool current = settings_.unit == LevelUnit::Current;
    out.qualities.emplace_back(current ? "tingling" : "vibration");
    for (const std::string_view quality : {"tapping", "pressure", current ? "vibration" : "touch"}) {
        if (random.uniform() < 0.4) out.qualities.push_back(quality);
    }
    return out;
}

std::vector<std::vector<double>> VirtualObserver::predicted(std::span<const DeliveredCondition> conditions,
                                                            Seconds stimulated) const {
    return responseProbabilities(taskFor(conditions), observerAfter(stimulated));
}

}  // namespace tacto
