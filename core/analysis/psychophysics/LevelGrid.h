// LevelGrid.h - the levels that a session may present: multiples of the device's step up to the lowest ceiling.
//
// A level is a current in mA or, for a massager, an intensity from 0 to 1. Only the grid knows which of the two. The
// procedures carry levels as plain numbers in the grid's unit and so serve both kinds of device.
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

/// What limits the highest level.
enum class LevelLimit {
    Device,        ///< the device's largest amplitude
    Gate,          ///< the largest level that the gate approves
    Cap,           ///< the study's cap
    TooStrong,     ///< the participant called a level too strong
    Confirmation,  ///< the participant refused half an hour of the highest level
};
inline constexpr Word<LevelUnit> kLevelUnits[] = {{"current_ma", LevelUnit::Current},
                                                  {"intensity", LevelUnit::Intensity}};
inline constexpr Word<LevelLimit> kLevelLimits[] = {{"device", LevelLimit::Device},
                                                    {"gate", LevelLimit::Gate},
                                                    {"cap", LevelLimit::Cap},
                                                    {"too-strong", LevelLimit::TooStrong},
                                                    {"confirmation", LevelLimit::Confirmation}};
/// Step between the levels of a massager (choice: with twenty levels an ascending series is as long as with steps of
/// 0.5 mA).
inline constexpr double kIntensityStep = 0.05;

[[nodiscard]] constexpr std::string_view nameOf(LevelUnit unit) noexcept { return wordFor(kLevelUnits, unit); }
/// Returns the JSON key of a level: "felt_ma", "felt_intensity".
[[nodiscard]] inline std::string levelKey(std::string_view what, LevelUnit unit) {
    return std::string(what) + (unit == LevelUnit::Current ? "_ma" : "_intensity");
}
[[nodiscard]] constexpr std::string_view nameOf(LevelLimit limit) noexcept { return wordFor(kLevelLimits, limit); }
/// What people read for each limit: "what was too strong".
inline constexpr Word<LevelLimit> kLevelLimitsInWords[] = {
    {"the device's largest level", LevelLimit::Device},
    {"the safety gate", LevelLimit::Gate},
    {"the study's cap", LevelLimit::Cap},
    {"what was too strong", LevelLimit::TooStrong},
    {"what they would feel for half an hour", LevelLimit::Confirmation}};
[[nodiscard]] constexpr std::string_view inWords(LevelLimit limit) noexcept {
    return wordFor(kLevelLimitsInWords, limit);
}

/// An upper limit of the levels and where it comes from.
struct LevelCeiling {
    double level = 0;
    LevelLimit by = LevelLimit::Device;
};

/// Levels have indices: 0 is no stimulus, 1 the device's smallest step, count() the highest level.
class LevelGrid {
public:
    static constexpr std::size_t kMaxLevels = 10'000;

    /// Makes a grid up to the last multiple of `step` that no ceiling forbids; of equal ceilings, limitedBy() is the
    /// first. Errors: InvalidArgument naming the value and what is accepted: a step that is not positive (for an
    /// intensity also above 1), no ceiling, a ceiling that is infinite or below one step, an intensity ceiling above 1,
    /// or more than kMaxLevels.
    [[nodiscard]] static Result<LevelGrid> create(LevelUnit unit, double step, std::span<const LevelCeiling> ceilings);

    [[nodiscard]] LevelUnit unit() const noexcept { return unit_; }
    [[nodiscard]] double step() const noexcept { return step_; }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] LevelLimit limitedBy() const noexcept { return by_; }
    /// `index` ≤ count().
    [[nodiscard]] double level(std::size_t index) const noexcept { return step_ * static_cast<double>(index); }
    [[nodiscard]] double highest() const noexcept { return level(count_); }

    // In the following functions, a value within a billionth of a step of a level equals that level. `value` is finite
    // and ≥ 0. This one returns at most count(), and 0 for less than a step.
    [[nodiscard]] std::size_t atOrBelow(double value) const noexcept;
    /// Returns nothing if the value is above the highest level.
    [[nodiscard]] std::optional<std::size_t> atOrAbove(double value) const noexcept;
    /// Returns 1 to count(); of two equally near levels the weaker.
    [[nodiscard]] std::size_t nearest(double value) const noexcept;

    /// Returns "4.5 mA" or "intensity 0.35".
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
