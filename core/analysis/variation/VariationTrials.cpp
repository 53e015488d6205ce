#include "core/analysis/variation/VariationTrials.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/Estimate.h"
#include "core/analysis/statistics/GivenFigure.h"

namespace tacto {

namespace {

double widthOf(std::size_t k, std::size_t n) noexcept {
    const auto interval = wilsonInterval(k, n);
    return interval.high - interval.low;
}

/// Smallest k from n/2 up with a narrow enough interval, or n + 1 if there is none. The interval is widest in the
/// middle, and its width is the same for k and n - k.
std::size_t narrowFrom(std::size_t n, double width) noexcept {
    return firstEnough((n + 1) / 2, n + 1, [&](std::size_t k) { return widthOf(k, n) <= width; });
}

/// Averages over people a probability that depends on their accuracy.
template <class Probability>
double over(std::span<const double> accuracies, Probability&& probability) {
    double sum = 0;
    for (const double p : accuracies) sum += probability(p);
    return sum / static_cast<double>(accuracies.size());
}

/// The search uses at most this many accuracies; more are combined into equally large groups of similar people.
constexpr std::size_t kGroups = 100;

std::vector<double> grouped(std::vector<double> sorted) {
    if (sorted.size() <= kGroups) return sorted;
    std::vector<double> out;
    for (std::size_t g = 0; g < kGroups; ++g) {
        const std::size_t from = g * sorted.size() / kGroups, to = (g + 1) * sorted.size() / kGroups;
        double sum = 0;
        for (std::size_t i = from; i < to; ++i) sum += sorted[i];
        out.push_back(sum / static_cast<double>(to - from));
    }
    return out;
}

/// Smallest multiple of `step` such that it and every larger one up to `enoughFrom` is enough; nothing if even the
/// largest is not. Searches downwards, because the probability rises with n in a saw-tooth.
template <class Reached>
std::optional<std::size_t> fewest(std::size_t step, std::size_t enoughFrom, double assurance, Reached&& reached) {
    std::size_t n = (enoughFrom + step - 1) / step * step;
    if (!(reached(n) >= assurance)) return std::nullopt;
    while (n > step && reached(n - step) >= assurance) n -= step;
    return n;
}

/// Number of trials from which every outcome gives a narrow enough interval, or `most`.
std::size_t alwaysNarrow(double width, std::size_t most) noexcept {
    return firstEnough(1, most, [&](std::size_t n) { return widthOf((n + 1) / 2, n) <= width; });
}

/// Finds by doubling a number of trials that is certainly enough, so that more trials cannot spoil the result.
template <class Reached>
std::size_t doubledUntil(std::size_t most, double assurance, Reached&& reached) {
    std::size_t n = 64;
    while (n < most && !(reached(n) >= assurance)) n *= 2;
    return std::min(4 * n, most);
}

PooledTrials pooled(std::optional<std::size_t> independent, double rho, const TrialsWanted& wanted) {
    PooledTrials out;
    out.designEffect = std::nan("");
    if (!independent) return out;
    const auto need = static_cast<double>(*independent);
    out.participantsLeast = static_cast<std::size_t>(std::floor(need * rho)) + 1;
    const auto people = static_cast<double>(wanted.participants);
    if (!(people > need * rho)) return out;
    // people·m / (1 + (m - 1)·rho) ≥ need, solved for m
    const double trials = need * (1 - rho) / (people - need * rho);
    if (!(trials <= static_cast<double>(wanted.most))) return out;
    const auto block = static_cast<double>(wanted.conditions);
    const double whole = std::max(1.0, std::ceil(trials / block)) * block;
    out.perParticipant = static_cast<std::size_t>(whole);
    out.total = *out.perParticipant * wanted.participants;
    out.designEffect = 1 + (whole - 1) * rho;
    return out;
}

/// P(X = k) for k = 0..n, averaged over people. Computing all outcomes at once is far cheaper than separate tails.
std::vector<double> outcomes(std::span<const double> accuracies, std::size_t n) {
    std::vector<double> logFactorial(n + 1, 0.0), out(n + 1, 0.0);
    for (std::size_t k = 1; k <= n; ++k) logFactorial[k] = logFactorial[k - 1] + std::log(static_cast<double>(k));
    const double share = 1 / static_cast<double>(accuracies.size());
    for (const double p : accuracies) {
        if (p <= 0 || p >= 1) {
            out[p <= 0 ? 0 : n] += share;
            continue;
        }
        const double right = std::log(p), wrong = std::log1p(-p);
        for (std::size_t k = 0; k <= n; ++k) {
            const double ways = logFactorial[n] - logFactorial[k] - logFactorial[n - k];
            out[k] += share * std::exp(ways + static_cast<double>(k) * right + static_cast<double>(n - k) * wrong);
        }
    }
    return out;
}

/// Quantiles of the width, from the probabilities of the outcomes sorted by width.
Estimate widthsAt(std::span<const double> accuracies, std::size_t n) {
    std::vector<std::pair<double, double>> mass;
    const auto shares = outcomes(accuracies, n);
    for (std::size_t k = 0; k <= n; ++k) mass.emplace_back(widthOf(k, n), shares[k]);
    std::ranges::stable_sort(mass, {}, &std::pair<double, double>::first);
    const auto quantile = [&mass](double q) {
        double sum = 0;
        for (const auto& [width, share] : mass) {
            sum += share;
            if (sum >= q) return width;
        }
        return mass.back().first;
    };
    return {quantile(0.5), quantile(0.05), quantile(0.95)};
}

}  // namespace

Result<void> validate(const TrialsWanted& wanted) {
    return checkFigures(
        {{"the wanted width of the interval", wanted.width, {.low = 0.02, .high = 1}},
         {"the chance level", wanted.chance, {.low = 0, .high = 1, .openLow = true, .openHigh = true}},
         {"the assurance", wanted.assurance, {.low = 0.5, .high = 0.999}},
         givenCount("the number of conditions", wanted.conditions, 1, 1e9),
         givenCount("the number of participants", wanted.participants, 1, 1e9),
         givenCount("the most trials searched", wanted.most, static_cast<double>(wanted.conditions), 1e6)});
}

double widthReached(std::span<const double> accuracies, std::size_t n, double width) noexcept {
    const std::size_t from = narrowFrom(n, width);
    if (from > n) return 0;
    if (2 * from <= n + 1) return 1;
    return over(accuracies,
                [&](double p) { return binomialAtLeast(from, n, p) + 1 - binomialAtLeast(n - from + 1, n, p); });
}

double chanceExceeded(std::span<const double> accuracies, std::size_t n, double chance) noexcept {
    // The lower end rises with k.
    const auto low = firstEnough(0, n + 1, [&](std::size_t k) { return wilsonInterval(k, n).low > chance; });
    if (low > n) return 0;
    return over(accuracies, [&](double p) { return binomialAtLeast(low, n, p); });
}

Estimate intervalWidths(std::span<const double> accuracies, std::size_t n) {
    std::vector<double> sorted(accuracies.begin(), accuracies.end());
    std::ranges::sort(sorted);
    return widthsAt(grouped(std::move(sorted)), n);
}

Result<TrialsNeeded> trialsNeeded(std::span<const double> accuracies, const TrialsWanted& wanted) {
    if (auto valid = validate(wanted); !valid) return failure(valid);
    if (accuracies.empty()) return invalid("no accuracy is given; at least one is needed");
    double sum = 0;
    for (const double p : accuracies) {
        if (!(p >= 0 && p <= 1)) return invalid("an accuracy is {}; 0 to 1 is accepted", p);
        sum += p;
    }
    const double mean = sum / static_cast<double>(accuracies.size());
    double variance = 0;
    for (const double p : accuracies) variance += (p - mean) * (p - mean) / static_cast<double>(accuracies.size());

    TrialsNeeded out;
    if (mean > 0 && mean < 1) out.rho = std::clamp(variance / (mean * (1 - mean)), 0.0, 1.0);
    std::vector<double> sorted(accuracies.begin(), accuracies.end());
    std::ranges::sort(sorted);
    const auto people = grouped(std::move(sorted));
    const double one[] = {mean};

    const auto narrow = [&](std::span<const double> of) {
        return [&wanted, of](std::size_t n) { return widthReached(of, n, wanted.width); };
    };
    const auto clear = [&](std::span<const double> of) {
        return [&wanted, of](std::size_t n) { return chanceExceeded(of, n, wanted.chance); };
    };
    const std::size_t certain = alwaysNarrow(wanted.width, wanted.most);
    out.forWidth = fewest(wanted.conditions, certain, wanted.assurance, narrow(people));
    out.aboveChance = fewest(wanted.conditions, doubledUntil(wanted.most, wanted.assurance, clear(people)),
                             wanted.assurance, clear(people));
    out.pooledForWidth = pooled(fewest(1, certain, wanted.assurance, narrow(one)), out.rho, wanted);
    out.pooledAboveChance =
        pooled(fewest(1, doubledUntil(wanted.most, wanted.assurance, clear(one)), wanted.assurance, clear(one)),
               out.rho, wanted);
    for (std::size_t blocks : {2U, 4U, 6U, 8U, 10U, 15U, 20U, 25U, 35U, 50U, 75U, 100U}) {
        const std::size_t n = blocks * wanted.conditions;
        out.curve.push_back({n, widthsAt(people, n)});
    }
    return out;
}

PilotOutlook outlookOf(const PilotPeople& population, std::size_t people, std::size_t trials, double chance) {
    PilotOutlook out;
    out.people = people;
    out.trials = trials;
    out.rightFrom = aboveChanceFrom(trials, chance);
    double above = 0;
    for (const double p : population.accuracies) above += binomialAtLeast(out.rightFrom, trials, p);
    const double all = static_cast<double>(population.all), n = static_cast<double>(people);
    out.allServed = std::pow(static_cast<double>(population.accuracies.size()) / all, n);
    out.allAboveChance = std::pow(above / all, n);
    out.prevalenceAll = prevalenceInterval(people, people).low;
    out.prevalenceButOne = prevalenceInterval(people - 1, people).low;
    out.width = intervalWidths(population.accuracies, trials);
    return out;
}

}  // namespace tacto
