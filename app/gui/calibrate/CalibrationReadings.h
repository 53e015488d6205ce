// CalibrationReadings.h - the readings of one calibrated quantity as they arrive, with a fit of the readings so far.
//
// A reading has the form in which the protocol records it: record.trial("amplitude up", {commanded, amplitude, ...}).
// After each reading, fitCalibration() marks outliers anew; the protocol's own result replaces these marks.
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

/// The share of its tolerance that a level uses: the larger error of both directions plus its expanded uncertainty U.
struct ToleranceUse {
    double commanded = 0;
    double error = 0;
    double expanded = 0;   ///< expanded uncertainty U (95 %)
    double tolerance = 0;  ///< ±
    [[nodiscard]] double share() const { return (std::abs(error) + expanded) / tolerance; }
};

/// The readings of one quantity: "amplitude", "interval", "width" or "gap".
struct CalibrationReadings {
    std::string quantity;
    QString unit;                              ///< "V", "mA" or "s"
    double tolerance_pct = 0;                  ///< tolerance in % of the command at each level; 0: unknown
    std::vector<CalibrationReading> readings;  ///< in order of arrival, outliers marked
    std::optional<Calibration> fit;            ///< nothing before two levels were measured
    double gainExpanded = NAN;                 ///< U (95 %) of fit->gain; NaN before the result
    double offsetExpanded = NAN;               ///< U (95 %) of fit->offset
    std::vector<double> uncertainty;           ///< U of each of fit->levels; empty before the result
    double resolution = 0;                     ///< the instrument's step, in `unit`
    std::vector<ToleranceUse> used;            ///< levels judged; empty before the result
    QString verdict;                           ///< "pass", ...; empty before the result
    bool checks = false;  ///< a stored calibration is checked: `fit` is its line, and errors count from that

    /// Returns from what errors count at a command, less the command: 0, or in a check what the line gives there.
    [[nodiscard]] double baseAt(double command) const {
        return checks && fit ? (fit->gain - 1) * command + fit->offset : 0;
    }
    /// Fits the readings again.
    void judge();
    /// Returns the level nearest its tolerance, or furthest beyond it. Null before the result.
    [[nodiscard]] const ToleranceUse* nearest() const;
};

/// Returns the quantity that a trial passed to record.trial() measures; empty if the trial is no reading.
[[nodiscard]] std::string calibratedQuantity(const nlohmann::json& trial);
/// Returns the reading in such a trial.
[[nodiscard]] CalibrationReading readingFrom(const nlohmann::json& trial);
/// Returns the unit of such a trial's reading: stated for amplitudes, seconds for times.
[[nodiscard]] QString unitFrom(const nlohmann::json& trial);
/// Returns the tolerance in % that the protocol's parameters give for a quantity; 0 for none.
[[nodiscard]] double toleranceOf(const std::string& quantity, const nlohmann::json& parameters);
/// Returns the readings and levels for one quantity from a protocol's result; nothing if that quantity was not judged.
[[nodiscard]] std::optional<CalibrationReadings> readingsFrom(const std::string& quantity, const nlohmann::json& found);

/// Takes the levels of a check of the stored calibration, rows as checked for all quantities, into the readings of one.
/// Without rows of that quantity, nothing changes.
void takeCheck(CalibrationReadings& readings, const nlohmann::json& rows);

/// Returns "Amplitude", "Interval", "Phase width", "Inter-phase gap".
[[nodiscard]] QString quantityTitle(const std::string& quantity);

}  // namespace tacto::gui
