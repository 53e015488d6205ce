#include "core/analysis/psychophysics/PredictedFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/Random.h"

namespace tacto {

namespace {

constexpr double kSumOfProbabilities = 1e-6;  // allowed difference of the sum from 1
constexpr double kSameG = 1e-9;

/// A table of counts or expected counts, [condition][response].
class ResponseTable {
public:
    ResponseTable(std::size_t conditions, std::size_t responses)
        : responses_(responses), cells_(conditions * responses, 0.0) {}
    [[nodiscard]] double& at(std::size_t condition, std::size_t response) {
        return cells_[condition * responses_ + response];
    }
    [[nodiscard]] std::span<double> row(std::size_t condition) {
        return std::span(cells_).subspan(condition * responses_, responses_);
    }
    void clear() { std::ranges::fill(cells_, 0.0); }

private:
    std::size_t responses_;
    std::vector<double> cells_;
};

double gOf(std::span<const double> counts, std::span<const double> expected) {
    double g = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) g += 2 * counts[i] * std::log(counts[i] / expected[i]);
    }
    return std::max(g, 0.0);
}

/// Counts the simulated sessions with a G larger than or equal to `g`.
struct SimulatedG {
    double g = 0;
    std::size_t larger = 0;
    std::size_t equal = 0;
    void add(double simulated) {
        const double tolerance = kSameG * (1 + simulated);  // `g` may be infinite
        if (std::abs(simulated - g) <= tolerance) {
            ++equal;
        } else if (simulated > g) {
            ++larger;
        }
    }
    [[nodiscard]] FitFigure figure(std::size_t draws, Random& random) const {
        const double above = static_cast<double>(larger) + random.uniform() * static_cast<double>(equal + 1);
        return {g, above / static_cast<double>(draws + 1)};
    }
};

Result<void> validateTrials(std::span<const PredictedTrial> trials, std::size_t conditions, std::size_t draws) {
    if (trials.empty() || conditions == 0 || draws == 0) {
        return invalid("{} trials of {} conditions, {} draws; 1 or more of each is accepted", trials.size(), conditions,
                       draws);
    }
    const std::size_t responses = trials.front().probabilities.size();
    for (const auto& trial : trials) {
        if (trial.condition >= conditions) {
            return invalid("condition {} of {}; 0 to {} is accepted", trial.condition, conditions, conditions - 1);
        }
        if (trial.probabilities.size() != responses || trial.response >= responses) {
            return invalid("response {} with {} probabilities; one below {}, and as many probabilities, is accepted",
                           trial.response, trial.probabilities.size(), responses);
        }
        double sum = 0;
        for (const double p : trial.probabilities) {
            if (!(p >= 0 && p <= 1)) {
                return invalid("a response's probability is {}; 0 to 1 is accepted", p);
            }
            sum += p;
        }
        if (!(std::abs(sum - 1) <= kSumOfProbabilities)) {
            return invalid("the responses' probabilities sum to {}; 1 is accepted", sum);
        }
    }
    return {};
}

std::size_t drawnResponse(const PredictedTrial& trial, Random& random) {
    double left = random.uniform();
    std::size_t last = 0;
    for (std::size_t i = 0; i < trial.probabilities.size(); ++i) {
        if (trial.probabilities[i] == 0) continue;
        last = i;
        left -= trial.probabilities[i];
        if (left < 0) break;
    }
    return last;
}

}  // namespace

Result<PredictedFit> fitOf(std::span<const PredictedTrial> trials, std::size_t conditions, std::uint64_t seed,
                           std::size_t draws) {
    if (auto valid = validateTrials(trials, conditions, draws); !valid) return failure(valid);
    const std::size_t responses = trials.front().probabilities.size();
    ResponseTable expected(conditions, responses), counts(conditions, responses);
    std::vector<std::size_t> given(conditions, 0);
    for (const auto& trial : trials) {
        ++given[trial.condition];
        counts.at(trial.condition, trial.response) += 1;
        for (std::size_t i = 0; i < responses; ++i) expected.at(trial.condition, i) += trial.probabilities[i];
    }
    std::vector<SimulatedG> rows(conditions);
    SimulatedG all;
    for (std::size_t c = 0; c < conditions; ++c) {
        rows[c].g = gOf(counts.row(c), expected.row(c));
        all.g += rows[c].g;
    }
    Random random(seed, "predicted against observed");
    for (std::size_t draw = 0; draw < draws; ++draw) {
        counts.clear();
        for (const auto& trial : trials) counts.at(trial.condition, drawnResponse(trial, random)) += 1;
        double sum = 0;
        for (std::size_t c = 0; c < conditions; ++c) {
            const double g = gOf(counts.row(c), expected.row(c));
            rows[c].add(g);
            sum += g;
        }
        all.add(sum);
    }
    PredictedFit out;
    out.all = all.figure(draws, random);
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t c = 0; c < conditions; ++c) {
        const bool known = given[c] > 0;
        out.rows.push_back(known ? rows[c].figure(draws, random) : FitFigure{kUnknown, kUnknown});
        auto& mean = out.predicted.emplace_back();
        if (!known) continue;
        for (const double n : expected.row(c)) mean.push_back(n / static_cast<double>(given[c]));
    }
    return out;
}

}  // namespace tacto
