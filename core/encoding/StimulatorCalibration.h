// StimulatorCalibration.h - a stimulator's calibration, applied: what it is programmed to so that it delivers what is
// wanted, and what may come out of that.
//
// An interval is timed by the computer and measured by an oscilloscope, as everything else: where the two clocks
// differ, the oscilloscope's counts. What is programmed is then rounded to the device's steps (Rounding.h), so it comes
// out up to a step short.
//
// Thread-safety: values; pure functions that do not allocate, but for the text of an error.
#pragma once

#include <optional>

#include "core/encoding/CalibratedQuantity.h"
#include "core/encoding/CalibrationLine.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {

struct StimulatorCalibration {
    CalibrationLine amplitude;                    ///< V or mA, as the source
    std::optional<CalibrationLine> interval{};    ///< s, onset to onset; without one, a time is as programmed
    std::optional<CalibrationLine> phaseWidth{};  ///< s, of the leading phase
    std::optional<CalibrationLine> gap{};         ///< s, between the phases
    /// What a person needs: all four.
    [[nodiscard]] bool complete() const noexcept { return interval && phaseWidth && gap; }
    bool operator==(const StimulatorCalibration&) const = default;
};
/// A time, and the member that is its line: of StimulatorCalibration or StoredCalibration.
template <class Calibration>
struct TimeLine : CalibratedQuantity {
    decltype(&Calibration::interval) line;
};
template <class Calibration>
inline constexpr std::array<TimeLine<Calibration>, 3> kTimeLines{{{kCalibratedInterval, &Calibration::interval},
                                                                  {kCalibratedWidth, &Calibration::phaseWidth},
                                                                  {kCalibratedGap, &Calibration::gap}}};
using KnownLines = std::optional<StimulatorCalibration>;  ///< nothing: everything is as it is programmed

/// Errors: as for one line, of the first that has one.
[[nodiscard]] Result<void> validateNumbers(const StimulatorCalibration& calibration);
[[nodiscard]] Result<void> validate(const StimulatorCalibration& calibration);

/// `train` as it must be programmed: amplitude, phase width and gap.
[[nodiscard]] PulseTrain programmedFor(PulseTrain train, const KnownLines& calibration) noexcept;
[[nodiscard]] Seconds programmedFor(Seconds interval, const KnownLines& calibration) noexcept;

/// What comes out of a train that is programmed, by the lines alone; beyond the range of a line the most. What their
/// spread adds, the gate judges: core/safety/DeliveryBounds.h.
[[nodiscard]] PulseTrain deliveredBy(PulseTrain train, const StimulatorCalibration& calibration) noexcept;
/// `train` with the most, and with the least, amplitude that the stimulator then delivers by its line; times as
/// programmed.
[[nodiscard]] PulseTrain mostDelivered(PulseTrain train, const KnownLines& calibration) noexcept;
[[nodiscard]] PulseTrain leastDelivered(PulseTrain train, const KnownLines& calibration) noexcept;

}  // namespace tacto
