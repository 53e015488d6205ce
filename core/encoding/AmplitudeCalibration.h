// AmplitudeCalibration.h - what a calibrated stimulator delivers for what it is told, and the other way round.
//
// Within the calibrated range the line of the calibration holds: delivered = gain · told + offset. Outside it the ratio
// of the nearer end does, so that 0 stays 0 and nothing jumps. The unit is the source's: V or mA.
//
// A stimulator that is off by more than 20 % anywhere in its range is out of order (IEC 60601-2-10 allows its output
// ± 20 %): its calibration is refused, not applied. So whatever stands in a calibration file, no command grows by more
// than a quarter.
//
// Thread-safety: values; pure functions that do not allocate, but for the text of an error.
#pragma once

#include <optional>

#include "core/encoding/PulseTrain.h"

namespace tacto {

struct AmplitudeCalibration {
    double gain = 1;
    double offset = 0;   ///< V or mA
    double lowest = 0;   ///< the calibrated range, as told: 0 < lowest < highest
    double highest = 0;  ///< V or mA

    /// Both for values of 0 and more; NaN stays NaN.
    [[nodiscard]] double delivered(double told) const noexcept;
    [[nodiscard]] double told(double delivered) const noexcept;
    /// The most and the least that may be delivered: outside the range the line, too, may go on. For judging.
    [[nodiscard]] double atMost(double told) const noexcept;
    [[nodiscard]] double atLeast(double told) const noexcept;
    bool operator==(const AmplitudeCalibration&) const = default;

private:
    [[nodiscard]] double ratioAt(double end) const noexcept { return gain + offset / end; }
};

inline constexpr double kLargestMiscalibration = 0.2;

/// Errors: InvalidArgument for numbers that are not finite, a gain that is not above 0, or a range that is none.
[[nodiscard]] Result<void> validateNumbers(const AmplitudeCalibration& calibration);
/// Errors: InvalidArgument for numbers that are not finite, a range that is none, or an output more than 20 % from what
/// is told at either end of it.
[[nodiscard]] Result<void> validate(const AmplitudeCalibration& calibration);

/// `train` with the amplitude that the stimulator must be told; as it is without a calibration.
[[nodiscard]] PulseTrain toldFor(PulseTrain train, const std::optional<AmplitudeCalibration>& calibration) noexcept;
/// `train` with the most, and with the least, that the stimulator then delivers.
[[nodiscard]] PulseTrain deliveredBy(PulseTrain train, const std::optional<AmplitudeCalibration>& calibration) noexcept;
[[nodiscard]] PulseTrain leastDeliveredBy(PulseTrain train,
                                          const std::optional<AmplitudeCalibration>& calibration) noexcept;

}  // namespace tacto
