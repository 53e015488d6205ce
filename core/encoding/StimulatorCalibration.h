// StimulatorCalibration.h - applies a stimulator's calibration: what to program for a wanted output, and what output a
// programmed value may give.
//
// The computer times an interval and an oscilloscope measures it, like all quantities. If the two clocks differ, the
// oscilloscope's time is used. Programmed values are then rounded to the device's steps (Rounding.h), so the output may
// be up to one step too low.
//
// Thread-safety: values; pure functions, which allocate only for the text of an error.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/Result.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {

// A straight line between a stimulator's programmed value and its delivered value, in both directions.
//
// Within the calibrated range delivered = gain · programmed + offset. Outside, the ratio delivered / programmed of the
// nearer end is used, so that 0 stays 0 and there is no jump. Unit: V or mA for an amplitude, s for a time.
//
// A stimulator with an error of more than 20 % anywhere in its range is defective (IEC 60601-2-10 allows ± 20 %), and
// its calibration is refused. Therefore no calibration file can increase a command by more than a quarter.

// The possible distance of a value from its expected value: an uncertainty (95 %), a stated accuracy or a largest
// residual.

struct Spread {
    double relative = 0;  ///< share of the value: 0.01 is 1 %
    double absolute = 0;  ///< in the value's own unit

    /// Largest and smallest possible value. Zero stays zero, because an output commanded to 0 is off. NaN stays NaN.
    [[nodiscard]] double above(double value) const noexcept {
        return value > 0 ? value * (1 + relative) + absolute : value;
    }
    [[nodiscard]] double below(double value) const noexcept {
        return value > 0 ? std::max(value * (1 - relative) - absolute, 0.0) : value;
    }
    /// True if both parts are finite and not negative and the relative one is below 1.
    [[nodiscard]] bool sound() const noexcept {
        return relative >= 0 && relative < 1 && absolute >= 0 && std::isfinite(absolute);
    }
    bool operator==(const Spread&) const = default;
};

/// Used if no spread is stated (science.md section 12).
inline constexpr Spread kUnknownSpread{0.05, 0};

struct CalibrationLine {
    double gain = 1;
    double offset = 0;  ///< in the quantity's unit, like the next two
    double lowest = 0;  ///< start of the calibrated range of programmed values: 0 < lowest < highest
    double highest = 0;
    /// Possible distance of the delivered value from the line: U (95 %) and the largest residual. Empty: unknown.
    std::optional<Spread> spread{};

    /// For values ≥ 0; NaN stays NaN.
    [[nodiscard]] double delivered(double programmed) const noexcept;
    [[nodiscard]] double programmedFor(double delivered) const noexcept;
    /// Largest and smallest value that the line may give, without its spread. Outside the calibrated range the line
    /// itself may also continue.
    [[nodiscard]] double atMost(double programmed) const noexcept;
    [[nodiscard]] double atLeast(double programmed) const noexcept;
    bool operator==(const CalibrationLine&) const = default;

private:
    [[nodiscard]] double ratioAt(double end) const noexcept { return gain + offset / end; }
};

inline constexpr double kLargestMiscalibration = 0.2;

/// Errors: InvalidArgument naming `quantity`, for numbers that are not finite, a gain that is not positive, an empty
/// range, a negative spread, or an output below a hundredth of the programmed value at either end of the range.
[[nodiscard]] Result<void> validateNumbers(const CalibrationLine& line, std::string_view quantity);
/// Errors: as validateNumbers(), and for an output more than 20 % off the programmed value at either end of the range.
[[nodiscard]] Result<void> validate(const CalibrationLine& line, std::string_view quantity);

// The calibrated quantities of a stimulator, with their names for files, scripts and people.

struct CalibratedQuantity {
    std::string_view id;       ///< its name in files, scripts and results
    std::string_view reading;  ///< its member in readings and commands: V or mA depending on the source, else s
    std::string_view title;
    std::string_view words;    ///< its name within a sentence
    std::string_view setting;  ///< unit of its range in a run's parameters, as at the end of their names
    double perUnit = 1;        ///< factor from a reading's unit to a parameter's unit
    [[nodiscard]] constexpr bool isAmplitude() const noexcept { return id == "amplitude"; }
};

inline constexpr CalibratedQuantity kCalibratedAmplitude{"amplitude", "amplitude", "Amplitude", "amplitude", "v"};
inline constexpr CalibratedQuantity kCalibratedInterval{"interval", "interval_s", "Interval", "interval", "s"};
inline constexpr CalibratedQuantity kCalibratedWidth{"width", "width_s", "Phase width", "phase width", "us", 1e6};
inline constexpr CalibratedQuantity kCalibratedGap{"gap", "gap_s", "Inter-phase gap", "inter-phase gap", "us", 1e6};
inline constexpr std::array kCalibratedQuantities{kCalibratedAmplitude, kCalibratedInterval, kCalibratedWidth,
                                                  kCalibratedGap};

/// Returns the quantity with that id, or null.
[[nodiscard]] constexpr const CalibratedQuantity* calibratedQuantity(std::string_view id) noexcept {
    for (const auto& one : kCalibratedQuantities) {
        if (one.id == id) return &one;
    }
    return nullptr;
}

struct StimulatorCalibration {
    CalibrationLine amplitude;                    ///< V or mA, depending on the source
    std::optional<CalibrationLine> interval{};    ///< s, onset to onset; if absent, delivered as programmed
    std::optional<CalibrationLine> phaseWidth{};  ///< s, of the leading phase
    std::optional<CalibrationLine> gap{};         ///< s, between the phases
    /// True if all four lines exist, which output to a person requires.
    [[nodiscard]] bool complete() const noexcept { return interval && phaseWidth && gap; }
    bool operator==(const StimulatorCalibration&) const = default;
};
/// A calibrated time with the member that holds its line, in StimulatorCalibration or StoredCalibration.
template <class Calibration>
struct TimeLine : CalibratedQuantity {
    decltype(&Calibration::interval) line;
};
template <class Calibration>
inline constexpr std::array<TimeLine<Calibration>, 3> kTimeLines{{{kCalibratedInterval, &Calibration::interval},
                                                                  {kCalibratedWidth, &Calibration::phaseWidth},
                                                                  {kCalibratedGap, &Calibration::gap}}};
using KnownLines = std::optional<StimulatorCalibration>;  ///< empty: output is as programmed

/// Errors: as for a single line; reports the first invalid line.
[[nodiscard]] Result<void> validateNumbers(const StimulatorCalibration& calibration);
[[nodiscard]] Result<void> validate(const StimulatorCalibration& calibration);

/// Returns the train to program, so that `train` is delivered: amplitude, phase width and gap.
[[nodiscard]] PulseTrain programmedFor(PulseTrain train, const KnownLines& calibration) noexcept;
[[nodiscard]] Seconds programmedFor(Seconds interval, const KnownLines& calibration) noexcept;

/// Returns the output of a programmed train by the lines alone; outside a line's range the largest possible. The spread
/// of the lines is judged by the gate (core/safety/DeliveryBounds.h).
[[nodiscard]] PulseTrain deliveredBy(PulseTrain train, const StimulatorCalibration& calibration) noexcept;
/// Returns `train` with the largest (or smallest) amplitude that the stimulator may deliver by its line; times stay as
/// programmed.
[[nodiscard]] PulseTrain mostDelivered(PulseTrain train, const KnownLines& calibration) noexcept;
[[nodiscard]] PulseTrain leastDelivered(PulseTrain train, const KnownLines& calibration) noexcept;

}  // namespace tacto
