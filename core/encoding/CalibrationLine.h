// CalibrationLine.h - a straight line from what a stimulator is programmed to deliver to what it delivers, and back.
//
// Within the calibrated range delivered = gain · programmed + offset. Outside it the ratio of the nearer end holds, so
// that 0 stays 0 and nothing jumps. The unit is that of the quantity: V or mA for an amplitude, s for a time.
//
// A stimulator that is off by more than 20 % anywhere in its range is out of order (IEC 60601-2-10 allows its output
// ± 20 %): its calibration is refused, not applied. So no calibration file makes a command grow by more
// than a quarter.
//
// Thread-safety: values; pure functions that do not allocate, but for the text of an error.
#pragma once

#include <optional>
#include <string_view>

#include "core/base/Result.h"
#include "core/encoding/Spread.h"

namespace tacto {

struct CalibrationLine {
    double gain = 1;
    double offset = 0;  ///< in the quantity's unit, as the two below
    double lowest = 0;  ///< the calibrated range, as programmed: 0 < lowest < highest
    double highest = 0;
    /// How far what is delivered lies from the line: its uncertainty U (95 %) and the largest residual. Nothing:
    /// unknown.
    std::optional<Spread> spread{};

    /// Both for values of 0 and more; NaN stays NaN.
    [[nodiscard]] double delivered(double programmed) const noexcept;
    [[nodiscard]] double programmedFor(double delivered) const noexcept;
    /// The most and the least of what the line may stand for: outside the range the line, too, may go on. Without its
    /// spread.
    [[nodiscard]] double atMost(double programmed) const noexcept;
    [[nodiscard]] double atLeast(double programmed) const noexcept;
    bool operator==(const CalibrationLine&) const = default;

private:
    [[nodiscard]] double ratioAt(double end) const noexcept { return gain + offset / end; }
};

inline constexpr double kLargestMiscalibration = 0.2;

/// Errors: InvalidArgument for numbers that are not finite, a gain that is not above 0, an empty range, a negative
/// spread, or an output below a hundredth of what is programmed at either end of the range; `quantity` is named.
[[nodiscard]] Result<void> validateNumbers(const CalibrationLine& line, std::string_view quantity);
/// Errors: as above, and for an output more than 20 % from what is programmed at either end of the range.
[[nodiscard]] Result<void> validate(const CalibrationLine& line, std::string_view quantity);

}  // namespace tacto
