// TwoIntervalTrials.h - detection trials with one train in one of two intervals: "first or second; guess".
//
// The seed decides which interval holds the train; in every ten trials each interval holds it five times. Right answers
// are counted for each interval, because people prefer one of them.
//
// Thread-safety: values may be shared; a TwoIntervalOrder must have a single owner.
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
/// Errors: InvalidArgument naming the text and the accepted words.
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
    /// `name` separates the procedures of a session: equal seeds and names give equal orders.
    TwoIntervalOrder(std::uint64_t seed, std::string_view name);
    /// The interval of trial `number`, from 1.
    [[nodiscard]] TrialInterval of(std::size_t number) const;

private:
    std::uint64_t seed_;
    std::string name_;
    mutable std::optional<std::size_t> drawn_;  ///< index of the ten trials stored in ten_
    mutable std::array<TrialInterval, 10> ten_{};
};

// The posterior over a grid of models from two-interval answers, and the choice of the most informative next trial.
//
// Each cell of the grid is a model that gives a probability of a right answer for each choice (a level or a pair of
// levels). The next choice has the least expected posterior entropy (Watson, Journal of Vision 17(3):10, 2017).

class TwoIntervalPosterior {
public:
    static constexpr double kGuess = 0.5;
    /// Fixed, because a free lapse rate would favour the easiest trials.
    static constexpr double kLapse = 0.02;
    static constexpr double kEqualEntropy = 1e-9;  ///< in nats
    static constexpr std::size_t kMaxAlike = 3;    ///< largest number of trials in a row with the same choice

    /// `prior`: one weight per cell, not all 0. `right`: the probability of a right answer, for every cell of the first
    /// choice, then of the second, and so on.
    TwoIntervalPosterior(std::vector<double> prior, std::vector<double> right);

    [[nodiscard]] std::span<const double> weights() const noexcept { return weights_; }
    [[nodiscard]] std::size_t choices() const noexcept { return right_.size() / weights_.size(); }
    void take(std::size_t choice, bool right);
    /// Returns the first choice within kEqualEntropy of the best. A choice taken kMaxAlike times in a row is returned
    /// only if there is no other.
    [[nodiscard]] std::size_t mostInformative() const;
    /// Returns the choice that may not be taken next; choices() if there is none.
    [[nodiscard]] std::size_t forbidden() const noexcept;

private:
    void normalise();
    [[nodiscard]] double expectedEntropy(std::size_t choice) const;

    std::vector<double> weights_;
    std::vector<double> right_;
    std::vector<double> entropy_;  // entropy of the answer if the cell is the true model
    std::vector<std::size_t> taken_;
};

/// A density on an even grid: weights with sum 1, uniform within each cell.
struct EvenDensity {
    double first = 0;  ///< middle of the first cell
    double step = 1;
    std::vector<double> weights;

    [[nodiscard]] double mean() const noexcept;
    [[nodiscard]] double sd() const noexcept;
    [[nodiscard]] double quantile(double q) const noexcept;
    /// True if more than 2.5 % lies in an end cell: the value may lie outside, and an interval is too narrow.
    [[nodiscard]] bool atEdge() const noexcept;
    [[nodiscard]] double at(std::size_t cell) const noexcept { return first + step * static_cast<double>(cell); }
};

}  // namespace tacto
