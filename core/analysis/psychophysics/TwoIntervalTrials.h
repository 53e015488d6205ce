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
#include <string>
#include <string_view>

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
    std::size_t trials = 0;  ///< with the train in this interval
    std::size_t right = 0;
};
struct IntervalShares {
    IntervalShare first;
    IntervalShare second;
    void add(TrialInterval interval, bool correct) noexcept;
};

class TwoIntervalOrder {
public:
    /// `name` tells the procedures of a session apart: two of the same seed and name are alike.
    TwoIntervalOrder(std::uint64_t seed, std::string_view name);
    /// The interval of trial `number`, from 1.
    [[nodiscard]] TrialInterval of(std::size_t number) const;

private:
    std::uint64_t seed_;
    std::string name_;
    mutable std::optional<std::size_t> drawn_;  ///< which ten are in ten_
    mutable std::array<TrialInterval, 10> ten_{};
};

}  // namespace tacto
