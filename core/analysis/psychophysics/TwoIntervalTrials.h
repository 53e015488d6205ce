// TwoIntervalTrials.h - detection trials: one train in one of two intervals, "first or second; guess".
//
// Which interval holds the train is drawn from the seed, each five times in every ten trials. How often each interval
// was answered rightly is counted, because people prefer one of them.
//
// Thread-safety: values; none for TwoIntervalOrder, one owner.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Words.h"

namespace tacto {

enum class TrialInterval { First, Second };
inline constexpr Word<TrialInterval> kTrialIntervals[] = {{"first", TrialInterval::First},
                                                          {"second", TrialInterval::Second}};
[[nodiscard]] constexpr std::string_view nameOf(TrialInterval interval) noexcept {
    return wordFor(kTrialIntervals, interval);
}
/// Errors: InvalidArgument naming the text and the words.
[[nodiscard]] Result<TrialInterval> trialIntervalFrom(std::string_view text);
/// Errors: InvalidArgument for a value that has no word.
[[nodiscard]] Result<void> validate(TrialInterval interval);

struct TwoIntervalTrial {
    std::size_t number = 0;  ///< from 1
    double level = 0;        ///< in the grid's unit
    TrialInterval interval = TrialInterval::First;
};

struct AnsweredTwoIntervalTrial {
    double level = 0;
    TrialInterval interval = TrialInterval::First;
    bool correct = false;
};

struct IntervalShare {
    std::size_t trials = 0;  ///< trials with the train in this interval
    std::size_t right = 0;
};
struct IntervalShares {
    IntervalShare first;
    IntervalShare second;
    void add(TrialInterval interval, bool correct) noexcept;
};

class TwoIntervalOrder {
public:
    /// `name` tells the procedures of a session apart: two with the same seed and name are the same.
    TwoIntervalOrder(std::uint64_t seed, std::string_view name);
    /// The interval of trial `number`, from 1.
    [[nodiscard]] TrialInterval of(std::size_t number) const;

private:
    std::uint64_t seed_;
    std::string name_;
    mutable std::optional<std::size_t> drawn_;  ///< which ten stand in ten_
    mutable std::array<TrialInterval, 10> ten_{};
};

// What answers of two-interval trials say about a grid of models, and which trial says most next.
//
// Each cell of the grid is a model that gives each choice (a level, a pair of levels) a probability of a right answer.
// The next choice is that with the least expected entropy of the posterior (Watson, Journal of Vision 17(3):10, 2017).

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
    /// The choice that is forbidden; choices() where none is.
    [[nodiscard]] std::size_t forbidden() const noexcept;

private:
    void normalise();
    [[nodiscard]] double expectedEntropy(std::size_t choice) const;

    std::vector<double> weights_;
    std::vector<double> right_;
    std::vector<double> entropy_;  // entropy of the answer when the cell is known
    std::vector<std::size_t> taken_;
};

/// Weights on an even grid of a quantity, with a sum of 1; the weight is even within a cell.
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
