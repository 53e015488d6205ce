// TwoIntervalPosterior.h - what answers of two-interval trials say about a grid of models, and which trial says most
// next.
//
// Each cell of the grid is a model that gives each choice (a level, a pair of levels) a probability of a right answer.
// The next choice is that with the least expected entropy of the posterior (Watson, Journal of Vision 17(3):10, 2017).
//
// Thread-safety: none; one owner.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tacto {

class TwoIntervalPosterior {
public:
    static constexpr double kGuess = 0.5;
    /// Fixed: left free, it sends the search to the easiest trials.
    static constexpr double kLapse = 0.02;
    static constexpr double kEqualEntropy = 1e-9;  ///< nats
    static constexpr std::size_t kMaxAlike = 3;    ///< trials in a row with the same choice

    /// `prior`: a weight of each cell, not all 0. `right`: choice after choice, of each cell the probability of a right
    /// answer.
    TwoIntervalPosterior(std::vector<double> prior, std::vector<double> right);

    [[nodiscard]] std::span<const double> weights() const noexcept { return weights_; }
    [[nodiscard]] std::size_t choices() const noexcept { return right_.size() / weights_.size(); }
    void take(std::size_t choice, bool right);
    /// The first of those within kEqualEntropy; one that was taken kMaxAlike times in a row only where it is the only
    /// one.
    [[nodiscard]] std::size_t mostInformative() const;
    /// That choice; none: choices().
    [[nodiscard]] std::size_t forbidden() const noexcept;

private:
    void normalise();
    [[nodiscard]] double expectedEntropy(std::size_t choice) const;

    std::vector<double> weights_;
    std::vector<double> right_;
    std::vector<double> entropy_;  // entropy of the answer when the cell is known
    std::vector<std::size_t> taken_;
};

/// Weights on an even grid of a quantity, the sum of which is 1; each cell is taken as even.
struct EvenDensity {
    double first = 0;  ///< middle of the first cell
    double step = 1;
    std::vector<double> weights;

    [[nodiscard]] double mean() const noexcept;
    [[nodiscard]] double sd() const noexcept;
    [[nodiscard]] double quantile(double q) const noexcept;
    /// More than 2.5 % lies in an end's cell: the quantity may lie beyond, and an interval is too narrow.
    [[nodiscard]] bool atEdge() const noexcept;
    [[nodiscard]] double at(std::size_t cell) const noexcept { return first + step * static_cast<double>(cell); }
};

}  // namespace tacto
