// StimulatorCalibration.h - a stimulator's calibration, applied: what it is programmed to so that it delivers what is
// wanted, and what may come out of that.
//
// An interval is timed by the computer and measured by an oscilloscope, as everything else: where the two clocks
// differ, the oscilloscope's counts. What is programmed is then rounded to the device's steps (Rounding.h), so it comes
// out up to a step short.
//
// Thread-safety: values; pure functions that do not allocate, but for the text of an error.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/Result.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {

// A straight line from what a stimulator is programmed to deliver to what it delivers, and back.
//
// Within the calibrated range delivered = gain · programmed + offset. Outside it the ratio of the nearer end holds, so
// that 0 stays 0 and nothing jumps. The unit is that of the quantity: V or mA for an amplitude, s for a time.
//
// A stimulator that is off by more than 20 % anywhere in its range is out of order (IEC 60601-2-10 allows its output
// ± 20 %): its calibration is refused, not applied. So no calibration file makes a command grow by more
// than a quarter.

// How far a value may lie from the one that is expected: what an uncertainty (95 %), a stated accuracy or a
// largest residual amounts to.

struct Spread {
    double relative = 0;  ///< share of the value: 0.01 is 1 %
    double absolute = 0;  ///< in the value's own unit

    /// The most and the least that a value may be. Zero stays zero: an output that is commanded 0 is off. NaN stays.
    [[nodiscard]] double above(double value) const noexcept {
        return value > 0 ? value * (1 + relative) + absolute : value;
    }
    [[nodiscard]] double below(double value) const noexcept {
        return value > 0 ? std::max(value * (1 - relative) - absolute, 0.0) : value;
    }
    /// 0 or more, finite, and less than the value itself.
    [[nodiscard]] bool sound() const noexcept {
        return relative >= 0 && relative < 1 && absolute >= 0 && std::isfinite(absolute);
    }
    bool operator==(const Spread&) const = default;
};

/// Stands in where no spread is stated: science.md section 12.
inline constexpr Spread kUnknownSpread{0.05, 0};

struct CalibrationLine {
    double gain = 1;
    double offset = 0;  ///< in the quantity's unit, like the two below
    double lowest = 0;  ///< the calibrated range, as programmed: 0 < lowest < highest
    double highest = 0;
    /// How far the delivered value may lie from the line: its uncertainty U (95 %) and the largest residual. Nothing:
    /// unknown.
    std::optional<Spread> spread{};

    /// For values of 0 and more; NaN stays NaN.
    [[nodiscard]] double delivered(double programmed) const noexcept;
    [[nodiscard]] double programmedFor(double delivered) const noexcept;
    /// The most and the least that the line may stand for: outside the range the line, too, may continue. Without its
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

// The quantities that a stimulator is calibrated in: what files, scripts and people call them.

struct CalibratedQuantity {
    std::string_view id;       ///< its name in files, scripts and results
    std::string_view reading;  ///< its member in a reading and in the command: V or mA by the source, else s
    std::string_view title;
    std::string_view words;    ///< its name within a sentence
    std::string_view setting;  ///< the unit in which a run's parameters state its range, as their names end
    double perUnit = 1;        ///< factor from the unit of a reading to that of a parameter
    [[nodiscard]] constexpr bool isAmplitude() const noexcept { return id == "amplitude"; }
};

inline constexpr CalibratedQuantity kCalibratedAmplitude{"amplitude", "amplitude", "Amplitude", "amplitude", "v"};
inline constexpr CalibratedQuantity kCalibratedInterval{"interval", "interval_s", "Interval", "interval", "s"};
inline constexpr CalibratedQuantity kCalibratedWidth{"width", "width_s", "Phase width", "phase width", "us", 1e6};
inline constexpr CalibratedQuantity kCalibratedGap{"gap", "gap_s", "Inter-phase gap", "inter-phase gap", "us", 1e6};
inline constexpr std::array kCalibratedQuantities{kCalibratedAmplitude, kCalibratedInterval, kCalibratedWidth,
                                                  kCalibratedGap};

/// Null for another id.
[[nodiscard]] constexpr const CalibratedQuantity* calibratedQuantity(std::string_view id) noexcept {
    for (const auto& one : kCalibratedQuantities) {
        if (one.id == id) return &one;
    }
    return nullptr;
}

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
using KnownLines = std::optional<StimulatorCalibration>;  ///< nothing: everything comes out as it is programmed

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
