// LevelGrid.h - the levels that a session may present: multiples of the device's step up to the lowest ceiling.
//
// A level is a current in mA, or with a massager an intensity from 0 to 1. Which of the two it is belongs to the grid,
// so the procedures carry levels as plain numbers in the grid's unit and serve both kinds of device.
//
// Thread-safety: values; pure functions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Words.h"

namespace tacto {

enum class LevelUnit { Current, Intensity };

/// The reason why levels cannot be higher.
enum class LevelLimit {
    Device,        ///< the device's largest amplitude
    Gate,          ///< the largest level that the gate approves
    Cap,           ///< the study's cap
    TooStrong,     ///< the participant called a level too strong
    Confirmation,  ///< the participant did not want the highest level for half an hour
};
inline constexpr Word<LevelUnit> kLevelUnits[] = {{"current_ma", LevelUnit::Current},
                                                  {"intensity", LevelUnit::Intensity}};
inline constexpr Word<LevelLimit> kLevelLimits[] = {{"device", LevelLimit::Device},
                                                    {"gate", LevelLimit::Gate},
                                                    {"cap", LevelLimit::Cap},
                                                    {"too-strong", LevelLimit::TooStrong},
                                                    {"confirmation", LevelLimit::Confirmation}};
/// The step between the levels of a massager (choice: twenty, so that a series of ascending limits is as long as one in
/// steps of 0.5 mA).
inline constexpr double kIntensityStep = 0.05;

[[nodiscard]] constexpr std::string_view nameOf(LevelUnit unit) noexcept { return wordFor(kLevelUnits, unit); }
/// The key of a level in JSON: "felt_ma", "felt_intensity".
[[nodiscard]] inline std::string levelKey(std::string_view what, LevelUnit unit) {
    return std::string(what) + (unit == LevelUnit::Current ? "_ma" : "_intensity");
}
[[nodiscard]] constexpr std::string_view nameOf(LevelLimit limit) noexcept { return wordFor(kLevelLimits, limit); }
/// The words that people read for it: "what was too strong".
inline constexpr Word<LevelLimit> kLevelLimitsInWords[] = {
    {"the device's largest level", LevelLimit::Device},
    {"the safety gate", LevelLimit::Gate},
    {"the study's cap", LevelLimit::Cap},
    {"what was too strong", LevelLimit::TooStrong},
    {"what they would feel for half an hour", LevelLimit::Confirmation}};
[[nodiscard]] constexpr std::string_view inWords(LevelLimit limit) noexcept {
    return wordFor(kLevelLimitsInWords, limit);
}

/// Levels above `level` are not presented.
struct LevelCeiling {
    double level = 0;
    LevelLimit by = LevelLimit::Device;
};

/// Levels have indices: 0 is nothing, 1 the device's smallest step, count() the highest.
class LevelGrid {
public:
    static constexpr std::size_t kMaxLevels = 10'000;

    /// The highest level is the last multiple of `step` that no ceiling forbids; of equal ceilings the first names it.
    /// Errors: InvalidArgument naming the value and what is accepted: a step that is not above 0 (of an intensity: to
    /// 1), no ceiling, a ceiling that is not finite or below one step, an intensity ceiling above 1, more than
    /// kMaxLevels.
    [[nodiscard]] static Result<LevelGrid> create(LevelUnit unit, double step, std::span<const LevelCeiling> ceilings);

    [[nodiscard]] LevelUnit unit() const noexcept { return unit_; }
    [[nodiscard]] double step() const noexcept { return step_; }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] LevelLimit limitedBy() const noexcept { return by_; }
    /// `index` ≤ count().
    [[nodiscard]] double level(std::size_t index) const noexcept { return step_ * static_cast<double>(index); }
    [[nodiscard]] double highest() const noexcept { return level(count_); }

    // A value within a billionth of a step of a level counts as that level. `value` is finite and ≥ 0. At most count();
    // 0 for less than a step.
    [[nodiscard]] std::size_t atOrBelow(double value) const noexcept;
    /// Nothing where the value lies above the highest level.
    [[nodiscard]] std::optional<std::size_t> atOrAbove(double value) const noexcept;
    /// 1 to count(); of two equally near the weaker.
    [[nodiscard]] std::size_t nearest(double value) const noexcept;

    /// "4.5 mA", "intensity 0.35".
    [[nodiscard]] std::string textOf(double level) const;

private:
    LevelGrid(LevelUnit unit, double step, std::size_t count, LevelLimit by) noexcept
        : unit_(unit), step_(step), count_(count), by_(by) {}

    LevelUnit unit_;
    double step_;
    std::size_t count_;
    LevelLimit by_;
};

}  // namespace tacto
