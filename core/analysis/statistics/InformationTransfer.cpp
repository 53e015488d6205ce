#include "core/analysis/statistics/InformationTransfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/Statistics.h"

namespace tacto {

namespace {

using Table = std::vector<std::vector<double>>;

/// Contribution of one share to an entropy, in bits.
double surprise(double share) noexcept { return share > 0 ? -share * std::log2(share) : 0; }

double entropy(std::span<const double> shares) noexcept {
    double bits = 0;
    for (const double share : shares) bits += surprise(share);
    return bits;
}

/// Contribution of `k` of `n` trials to an entropy by the second-order jackknife; uncorrected for a single trial.
double jackknifed(double k, double n) noexcept {
    const double all = surprise(k / n);
    if (n < 2) return all;
    const double oneLess = ((n - k) * surprise(k / (n - 1)) + k * surprise((k - 1) / (n - 1))) / n;
    double bits = all + (2 * n - 3) * (all - oneLess);
    if (n < 3) return bits;
    const double twoLess = ((n - k) * (n - k - 1) * surprise(k / (n - 2)) +
                            2 * k * (n - k) * surprise((k - 1) / (n - 2)) + k * (k - 1) * surprise((k - 2) / (n - 2))) /
                           (n * (n - 1));
    bits += (n - 2) * (n - 2) / 2 * (all - 2 * oneLess + twoLess);
    return bits;
}

/// The presented stimuli with the shares of their answers.
struct Answers {
    std::vector<double> n, weight;  // one entry for each row
    Table share;                    // shares of a row's answers
    std::vector<double> overall;    // shares of all answers
    double trials = 0;
};

Answers answersOf(std::span<const std::vector<double>> counts) {
    Answers out;
    for (const auto& row : counts) {
        double n = 0;
        for (const double k : row) n += k;
        out.trials += n;
        out.overall.resize(std::max(out.overall.size(), row.size()), 0.0);
        if (!(n > 0)) continue;
        out.n.push_back(n);
        out.share.push_back(row);
        for (double& share : out.share.back()) share /= n;
    }
    for (std::size_t s = 0; s < out.n.size(); ++s) {
        out.weight.push_back(out.n[s] / out.trials);
        out.share[s].resize(out.overall.size(), 0.0);
        for (std::size_t r = 0; r < out.overall.size(); ++r) out.overall[r] += out.weight[s] * out.share[s][r];
    }
    return out;
}

/// Variance of the information for these shares of answers: `first` from the derivative, `second` from the second-order
/// term, which remains if the derivative is 0.
struct Variance {
    double first = 0, second = 0;
};

Variance varianceAt(const Answers& told) {
    Variance out;
    double cells = 0, likeness = -1, columns = 0;
    for (const double share : told.overall) columns += share > 0 ? 1 : 0;
    for (std::size_t s = 0; s < told.n.size(); ++s) {
        double mean = 0, squares = 0;
        for (std::size_t r = 0; r < told.overall.size(); ++r) {
            const double share = told.share[s][r];
            if (!(share > 0)) continue;
            const double bits = std::log2(share / told.overall[r]);
            mean += share * bits;
            squares += share * bits * bits;
            likeness += told.weight[s] * share * share / told.overall[r];
            cells += 1;
        }
        out.first += told.weight[s] * (squares - mean * mean) / told.trials;
    }
    const double rows = static_cast<double>(told.n.size()), nats = told.trials * std::numbers::ln2;
    out.second = std::max(0.0, cells - rows - columns + 1 + likeness) / (2 * nats * nats);
    return out;
}

/// Adds two answers to each row, distributed like all answers.
Answers smoothed(Answers told) {
    constexpr double kMore = 2;
    for (std::size_t s = 0; s < told.n.size(); ++s) {
        const double weight = kMore / (told.n[s] + kMore);
        for (std::size_t r = 0; r < told.overall.size(); ++r)
            told.share[s][r] += weight * (told.overall[r] - told.share[s][r]);
    }
    std::ranges::fill(told.overall, 0.0);
    for (std::size_t s = 0; s < told.n.size(); ++s) {
        for (std::size_t r = 0; r < told.overall.size(); ++r) told.overall[r] += told.weight[s] * told.share[s][r];
    }
    return told;
}

}  // namespace

double informationTransfer(std::span<const std::vector<double>> table) {
    const Answers told = answersOf(table);
    if (!(told.trials > 0)) return kNaN;
    double bits = entropy(told.overall);
    for (std::size_t s = 0; s < told.n.size(); ++s) bits -= told.weight[s] * entropy(told.share[s]);
    return std::max(0.0, bits);
}

Estimate correctedInformation(std::span<const std::vector<double>> counts) {
    const Answers told = answersOf(counts);
    if (!(told.trials > 0)) return {};
    const double all = entropy(told.overall);
    double bits = all, jackknife = 0;
    for (std::size_t s = 0; s < told.n.size(); ++s) {
        const double n = told.n[s], weight = told.weight[s];
        const auto& share = told.share[s];
        for (const double part : share) bits -= weight * jackknifed(n * part, n);
        if (n < 2) continue;
        // Leave out one trial of the row, for each possible answer; the weight of the row stays the same.
        const double row = entropy(share);
        double mean = 0, squares = 0;
        for (std::size_t left = 0; left < share.size(); ++left) {
            if (!(share[left] > 0)) continue;
            double overall = 0, rest = 0;
            for (std::size_t r = 0; r < share.size(); ++r) {
                const double fewer = std::max(0.0, (n * share[r] - (r == left ? 1 : 0)) / (n - 1));
                overall += surprise(std::max(0.0, told.overall[r] + weight * (fewer - share[r])));
                rest += surprise(fewer);
            }
            const double change = overall - all - weight * (rest - row);
            bits -= (n - 1) * share[left] * (overall - all);
            mean += share[left] * change;
            squares += share[left] * change * change;
        }
        jackknife += (n - 1) * std::max(0.0, squares - mean * mean);
    }
    const Variance variance = varianceAt(smoothed(told));
    constexpr double k95 = 1.959963984540054;
    const double reach = k95 * std::sqrt(std::max(variance.first, jackknife) + variance.second);
    const double most = std::min(entropy(told.weight), std::log2(static_cast<double>(told.overall.size())));
    return {std::clamp(bits, 0.0, most), std::clamp(bits - reach, 0.0, most), std::clamp(bits + reach, 0.0, most)};
}

}  // namespace tacto
