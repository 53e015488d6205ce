// CalibrationReadings.h - the readings of one calibrated quantity while they come, and what can be said about them so
// far.
//
// A reading comes as the protocol records it: record.trial("amplitude up", {commanded, amplitude, ...}). Which of them
// stand out is found with fitCalibration(), again after each; the protocol's own result has the last word.
//
// Thread-safety: value type.
#pragma once

#include <QString>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/analysis/calibration/Calibration.h"

namespace tacto::gui {

/// How much of its tolerance a level uses: the error of the worse direction and its U together.
struct ToleranceUse {
    double commanded = 0;
    double error = 0;
    double expanded = 0;   ///< U, 95 %
    double tolerance = 0;  ///< ±
    [[nodiscard]] double share() const { return (std::abs(error) + expanded) / tolerance; }
};

/// The readings of one quantity: "amplitude", "interval", "width" or "gap".
struct CalibrationReadings {
    std::string quantity;
    QString unit;                              ///< "V", "mA" or "s"
    double tolerance_pct = 0;                  ///< share of the command at each level; 0: none known
    std::vector<CalibrationReading> readings;  ///< in the order in which they came, outliers marked
    std::optional<Calibration> fit;            ///< nothing before two levels were met
    double gainExpanded = NAN;                 ///< U of fit->gain; not a number before the result
    double offsetExpanded = NAN;               ///< U of fit->offset
    std::vector<double> uncertainty;           ///< U of each of fit->levels; empty before the result
    double resolution = 0;                     ///< the instrument's step, in `unit`
    std::vector<ToleranceUse> used;            ///< levels that were judged; empty before the result
    QString verdict;                           ///< "pass", ...; empty before the result

    /// Fits again.
    void judge();
    /// The level nearest to its tolerance, or furthest beyond it. Null before the result.
    [[nodiscard]] const ToleranceUse* nearest() const;
};

/// The quantity that a trial, as record.trial() was given it, is a reading of; empty for another trial.
[[nodiscard]] std::string calibratedQuantity(const nlohmann::json& trial);
/// The reading in such a trial.
[[nodiscard]] CalibrationReading readingFrom(const nlohmann::json& trial);
/// Unit of such a trial's reading: amplitude's is stated, the others are times.
[[nodiscard]] QString unitFrom(const nlohmann::json& trial);
/// The tolerance that the protocol's parameters state for a quantity, in %; 0 for none.
[[nodiscard]] double toleranceOf(const std::string& quantity, const nlohmann::json& parameters);
/// The readings and levels of a protocol's result for one quantity. Nothing where it is not one that was judged.
[[nodiscard]] std::optional<CalibrationReadings> readingsFrom(const std::string& quantity, const nlohmann::json& found);

/// "Amplitude", "Interval", "Phase width", "Inter-phase gap".
[[nodiscard]] QString quantityTitle(const std::string& quantity);

}  // namespace tacto::gui
