#include "core/analysis/identification/GoodnessOfFit.h"

#include <cmath>
#include <limits>

#include "core/base/Random.h"

namespace tacto {

namespace {

constexpr std::size_t kFewestDraws = 1000;
/// Two tables whose G differ by rounding alone have the same one.
constexpr double kSameG = 1e-9;

Result<void> checkRows(std::span<const std::vector<std::size_t>> counts,
                       std::span<const std::vector<double>> predicted) {
    if (counts.size() != predicted.size()) {
        return fail(ErrorCode::InvalidArgument, "{} rows of counts and {} of predictions; as many were expected",
                    counts.size(), predicted.size());
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i].size() != predicted[i].size()) {
            return fail(ErrorCode::InvalidArgument, "row {} has {} counts and {} predictions; as many were expected",
                        i + 1, counts[i].size(), predicted[i].size());
        }
        double sum = 0;
        for (const double p : predicted[i]) {
            if (!(p >= 0) || !(p <= 1)) {
                return fail(ErrorCode::InvalidArgument, "row {} predicts a probability of {}; 0 to 1 is accepted",
                            i + 1, p);
            }
            sum += p;
        }
        if (!(std::abs(sum - 1) <= 1e-6)) {
            return fail(ErrorCode::InvalidArgument, "the probabilities of row {} sum to {}; 1 was expected", i + 1,
                        sum);
        }
    }
    return {};
}

double statisticOf(const std::vector<std::size_t>& counts, const std::vector<double>& predicted, std::size_t trials) {
    double g = 0;
    for (std::size_t j = 0; j < counts.size(); ++j) {
        if (counts[j] == 0) continue;
        const double n = static_cast<double>(counts[j]), expected = static_cast<double>(trials) * predicted[j];
        if (!(expected > 0)) return std::numeric_limits<double>::infinity();
        g += 2 * n * std::log(n / expected);
    }
    return g;
}

std::size_t totalOf(const std::vector<std::size_t>& row) {
    std::size_t sum = 0;
    for (const std::size_t n : row) sum += n;
    return sum;
}

std::size_t drawAnswer(const std::vector<double>& predicted, Random& random) {
    double left = random.uniform();
    std::size_t last = 0;
    for (std::size_t j = 0; j < predicted.size(); ++j) {
        if (!(predicted[j] > 0)) continue;
        if (left < predicted[j]) return j;
        left -= predicted[j];
        last = j;
    }
    return last;  // rounding left a remainder
}

}  // namespace

Result<GoodnessOfFit> goodnessOfFit(std::span<const std::vector<std::size_t>> counts,
                                    std::span<const std::vector<double>> predicted, const FitOptions& options) {
    if (auto sane = checkRows(counts, predicted); !sane) return failure(sane);
    if (options.draws < kFewestDraws) {
        return fail(ErrorCode::InvalidArgument, "{} draws; at least {} were expected", options.draws, kFewestDraws);
    }
    GoodnessOfFit out;
    std::vector<std::size_t> trials;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        trials.push_back(totalOf(counts[i]));
        out.g += statisticOf(counts[i], predicted[i], trials.back());
    }
    if (std::isinf(out.g)) {
        out.p = 0;
        return out;
    }
    Random random(options.seed, "goodness of fit");
    std::size_t larger = 0, equal = 0;
    std::vector<std::size_t> drawn;
    for (std::size_t draw = 0; draw < options.draws; ++draw) {
        double g = 0;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            drawn.assign(counts[i].size(), 0);
            for (std::size_t trial = 0; trial < trials[i]; ++trial) ++drawn[drawAnswer(predicted[i], random)];
            g += statisticOf(drawn, predicted[i], trials[i]);
        }
        if (std::abs(g - out.g) <= kSameG) {
            ++equal;
        } else if (g > out.g) {
            ++larger;
        }
    }
    const double ties = random.uniform() * static_cast<double>(equal + 1);
    out.p = (static_cast<double>(larger) + ties) / static_cast<double>(options.draws + 1);
    return out;
}

}  // namespace tacto
