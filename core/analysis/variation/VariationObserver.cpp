#include "core/analysis/variation/VariationObserver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/Words.h"

namespace tacto {

namespace {

constexpr double kTailDeviations = 9;  // in standard deviations; only 1e-19 lies beyond
constexpr double kPanel = 0.5;         // largest width of a quadrature panel in standard deviations

double phi(double z) noexcept { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// x·across + y·along ≤ bound: the points that are nearer to one of two conditions.
struct HalfPlane {
    double across = 0;
    double along = 0;
    double bound = 0;
};

struct Region {
    bool empty = false;  ///< true if not given, or if an earlier point has the same coordinates
    std::vector<HalfPlane> sides;
};

std::vector<Region> regionsOf(const IdentificationTask& task) {
    std::vector<Region> regions(task.points.size());
    for (std::size_t j = 0; j < task.points.size(); ++j) {
        regions[j].empty = !task.given[j];
        if (regions[j].empty) continue;  // the point of an empty region may be unknown
        for (std::size_t m = 0; m < task.points.size(); ++m) {
            if (m == j || !task.given[m]) continue;
            const auto& own = task.points[j];
            const auto& other = task.points[m];
            const double across = other.amplitude_jnd - own.amplitude_jnd;
            const double along = other.interval_jnd - own.interval_jnd;
            if (across == 0 && along == 0) {
                if (m < j) regions[j].empty = true;
                continue;
            }
            // The midpoint of the two points lies on the bisector. This form avoids cancellation at large coordinates.
            const double bound = across * (own.amplitude_jnd + other.amplitude_jnd) / 2 +
                                 along * (own.interval_jnd + other.interval_jnd) / 2;
            regions[j].sides.push_back({across, along, bound});
        }
    }
    return regions;
}

/// The amplitudes at which the regions' cross-section has a step or a kink.
std::vector<double> breaksOf(const std::vector<Region>& regions) {
    std::vector<double> breaks;
    for (const auto& region : regions) {
        for (std::size_t i = 0; i < region.sides.size(); ++i) {
            const auto& a = region.sides[i];
            if (a.along == 0) breaks.push_back(a.bound / a.across);
            for (std::size_t k = i + 1; k < region.sides.size(); ++k) {
                const auto& b = region.sides[k];
                const double turn = a.across * b.along - b.across * a.along;
                if (turn != 0) breaks.push_back((a.bound * b.along - b.bound * a.along) / turn);
            }
        }
    }
    std::ranges::sort(breaks);
    return breaks;
}

/// Probability that the felt interval falls into `region` when the felt amplitude is `x`.
double slice(const Region& region, double x, double centre, double sigma) noexcept {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    for (const auto& side : region.sides) {
        const double left = side.bound - side.across * x;
        if (side.along > 0) {
            high = std::min(high, left / side.along);
        } else if (side.along < 0) {
            low = std::max(low, left / side.along);
        } else if (left < 0) {
            return 0;
        }
    }
    return low < high ? phi((high - centre) / sigma) - phi((low - centre) / sigma) : 0;
}

/// Integrates density of the felt amplitude times slice() over [from, to], with 8-point Gauss-Legendre.
double panel(const Region& region, const FeltPoint& stimulus, double sigma, double from, double to) noexcept {
    constexpr std::array<double, 4> kNodes = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                              0.9602898564975363};
    constexpr std::array<double, 4> kWeights = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                0.1012285362903763};
    const double middle = (from + to) / 2, half = (to - from) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        for (const double sign : {-1.0, 1.0}) {
            const double x = middle + sign * half * kNodes[i];
            const double z = (x - stimulus.amplitude_jnd) / sigma;
            sum += kWeights[i] * std::exp(-z * z / 2) * slice(region, x, stimulus.interval_jnd, sigma);
        }
    }
    return sum * half / (sigma * std::sqrt(2 * std::numbers::pi));
}

/// Index of the nearest given point; the number of points if none is given.
std::size_t answerTo(const IdentificationTask& task, const FeltPoint& felt) noexcept {
    std::size_t best = task.points.size();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < task.points.size(); ++j) {
        if (!task.given[j]) continue;
        const double d = distance_jnd(task.points[j], felt);
        if (d < nearest) {
            nearest = d;
            best = j;
        }
    }
    return best;
}

constexpr Word<GuessBehaviour> kGuessBehaviours[] = {{"none", GuessBehaviour::None},
                                                     {"uniform", GuessBehaviour::Uniform}};

}  // namespace

std::string_view nameOf(GuessBehaviour guess) noexcept { return wordFor(kGuessBehaviours, guess); }

Result<GuessBehaviour> guessBehaviourFrom(std::string_view name) {
    if (const auto known = valueFor(kGuessBehaviours, name)) return *known;
    return invalid("the guess behaviour is \"{}\"; none or uniform is accepted", name);
}

double distance_jnd(const FeltPoint& a, const FeltPoint& b) noexcept {
    return std::hypot(a.amplitude_jnd - b.amplitude_jnd, a.interval_jnd - b.interval_jnd);
}

FeltPoint feltBy(const VirtualParticipant& who, double level, Seconds interval) noexcept {
    return {std::log(level) / std::log1p(who.amplitudeWeber),
            std::log(interval.count()) / std::log1p(who.intervalWeber)};
}

Observer observerOf(const VirtualParticipant& who, double detection, GuessBehaviour guess) noexcept {
    return {who.noise_jnd, who.lapse, feltBy(who, detection, Seconds(1)).amplitude_jnd, guess};
}

std::vector<std::vector<double>> responseProbabilities(const IdentificationTask& task, const Observer& observer) {
    const std::size_t n = task.points.size();
    const double sigma = observer.noise_jnd;
    const auto regions = regionsOf(task);
    const auto breaks = breaksOf(regions);
    std::vector table(n, std::vector<double>(n + 1, 0.0));
    for (std::size_t i = 0; i < n; ++i) {
        if (!task.given[i]) continue;
        const auto& stimulus = task.points[i];
        const double from = std::max(stimulus.amplitude_jnd - kTailDeviations * sigma, observer.detection_jnd);
        const double to = stimulus.amplitude_jnd + kTailDeviations * sigma;
        for (double left = from; left < to;) {
            double right = std::min(left + kPanel * sigma, to);
            if (const auto next = std::ranges::upper_bound(breaks, left); next != breaks.end()) {
                right = std::min(right, *next);
            }
            for (std::size_t j = 0; j < n; ++j) {
                if (!regions[j].empty) table[i][j] += panel(regions[j], stimulus, sigma, left, right);
            }
            left = right;
        }
        const double unfelt = phi((observer.detection_jnd - stimulus.amplitude_jnd) / sigma);
        const double names = static_cast<double>(n);
        for (std::size_t j = 0; j < n; ++j) {
            if (observer.guess == GuessBehaviour::Uniform) table[i][j] += unfelt / names;
            table[i][j] = (1 - observer.lapse) * table[i][j] + observer.lapse / names;
        }
        if (observer.guess == GuessBehaviour::None) table[i][n] = (1 - observer.lapse) * unfelt;
    }
    return table;
}

std::size_t sampleResponse(const IdentificationTask& task, const Observer& observer, const FeltPoint& stimulus,
                           Random& random) {
    const bool lapsed = random.uniform() < observer.lapse;
    FeltPoint felt = stimulus;
    felt.amplitude_jnd += observer.noise_jnd * random.normal();
    felt.interval_jnd += observer.noise_jnd * random.normal();
    const bool unfelt = felt.amplitude_jnd < observer.detection_jnd;
    if (lapsed || (unfelt && observer.guess == GuessBehaviour::Uniform)) {
        return static_cast<std::size_t>(random.below(task.points.size()));
    }
    return unfelt ? task.points.size() : answerTo(task, felt);
}

std::vector<std::vector<std::size_t>> sampleResponses(const IdentificationTask& task, const Observer& observer,
                                                      std::size_t trials, Random& random) {
    const std::size_t n = task.points.size();
    std::vector table(n, std::vector<std::size_t>(n + 1, 0));
    for (std::size_t i = 0; i < n; ++i) {
        if (!task.given[i]) continue;
        for (std::size_t trial = 0; trial < trials; ++trial) {
            const std::size_t answer = sampleResponse(task, observer, task.points[i], random);
            ++table[i][answer];
        }
    }
    return table;
}

}  // namespace tacto
