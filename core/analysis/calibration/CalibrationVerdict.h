// CalibrationVerdict.h - judges a calibration with its uncertainty against a tolerance (science.md section 9).
//
// At each level the error is the device's mean delivered value, over up and down sweep, minus the command. Type A
// uncertainty is s/√n of the level's own readings, with s pooled within direction (levels may scatter differently).
// Type B uncertainty comes from the instruments' data sheets (InstrumentErrors). The verdict uses the error of the
// worse direction, so hysteresis cannot be hidden in the mean.
//
// Gain and offset of the line are weighted sums of the level means, and so are their errors. Errors of single levels
// (scatter, or departures from the line if these are clearly larger) combine with the root of the squared weights. The
// converter step hidden in the common baseline is equal at all levels and goes fully into the offset. A departure from
// the line is assumed to be a cubic through 0 and both ends of the range, or another straight line through 0, whichever
// has the larger effect (choice).
#pragma once

#include "core/analysis/calibration/Calibration.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/Statistics.h"

namespace tacto {

/// Possible errors of the measuring instrument and the load. Each is constant during the calibration and unknown within
/// limits: half-widths of rectangular distributions unless stated otherwise. NaN means not stated; the budget then has
/// no U and the verdict cannot be a pass (hazard H9).
struct InstrumentErrors {
    double gainTolerance = kNaN;    ///< relative (0.005 = 0.5 %): vertical gain, or the time base
    double probeTolerance = 0;      ///< relative, probe or shunt
    double linearityTolerance = 0;  ///< in the readings' unit, in addition to the gain
    double offsetTolerance = 0;     ///< in the readings' unit; 0 if each reading has its own baseline
    /// One step (LSB) in the readings' unit; 0 for times. A level measured from its own baseline (offsetTolerance 0) is
    /// the difference of two values, each rounded to a step.
    double resolution = kNaN;
    /// End of the range in which the linearity is valid, in the readings' unit; NaN: the largest command.
    double fullScale = kNaN;
    double stampTolerance = 0;  ///< time stamps of two records against each other, s; 0 within one record
    double loadTolerance = 0;   ///< relative, load resistor
    /// Relative change of the reading per relative change of the load: 0 if the reading is a time or a voltage source's
    /// voltage, -1 if a current is computed from the voltage across the load.
    double loadSensitivity = 0;
    /// Sampling step, for widths and intervals. Two edges, each anywhere within a step, give a triangular distribution
    /// (step/√6). A free-running clock already shows this in the scatter. It gets its own row only if s is below half
    /// of step/√6, because then every reading had the same sampling phase.
    double samplingStep = 0;
    std::string unit{};  ///< the readings' unit, for sentences; empty if unknown
};

struct JudgedLevel {
    double commanded = 0;
    double error = 0;               ///< error of the level's mean
    double worstError = 0;          ///< error of the worse direction; used for the verdict
    UncertaintyBudget budget;       ///< budget of the level's mean
    UncertaintyBudget worstBudget;  ///< budget of the worse direction's mean, with fewer readings; used for the verdict
    double tolerance = 0;           ///< in the readings' unit
    Verdict verdict = Verdict::Indeterminate;
};

struct JudgedCalibration {
    Calibration calibration;
    std::vector<JudgedLevel> levels;  ///< same order as calibration.levels
    UncertaintyBudget gain;           ///< budget of the fitted line's gain
    UncertaintyBudget offset;
    double tolerance_pct = 0;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;  ///< the deciding reason comes first
    /// Returns the level with the largest command.
    [[nodiscard]] const JudgedLevel& fullScale() const noexcept;
    /// Returns the level with the smallest command.
    [[nodiscard]] const JudgedLevel& smallest() const noexcept;
};

/// `tolerance_pct`: in % of the command at each level. The verdict is that of the worst level. With fewer than 11
/// levels or 5 repeats, a level measured in one direction only, or an unmeasured reading, it cannot be a pass. A level
/// without a measured reading is indeterminate, with an empty budget and U = NaN. Errors: as combine(); InvalidArgument
/// for a tolerance that is not positive, or without any repeats.
[[nodiscard]] Result<JudgedCalibration> judgeCalibration(Calibration calibration, const InstrumentErrors& errors,
                                                         double tolerance_pct, const BudgetOptions& options = {});

/// A level of a stored calibration that was read again, in the unit that people read.
struct CheckedLevel {
    std::string quantity = {};
    double commanded = kNaN, expected = kNaN;
    double measured = kNaN;                           ///< the mean furthest from what is expected
    SweepDirection direction = SweepDirection::None;  ///< of that mean; None: of all readings
    double off = kNaN, expanded = kNaN;
    double allowed = kNaN;
    double notMeasured = kNaN;  ///< number of readings
    std::string unit = {};
    Verdict verdict = Verdict::Indeterminate;
};
struct CalibrationCheck {
    std::vector<CheckedLevel> rows = {};
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons = {};
};
/// What the store says of a calibration that it keeps; dates as text.
struct KeptCalibration {
    std::string serial = {};
    std::string validUntil = {};
    std::string supersedes = {};  ///< the date of the calibration before; empty: none
    std::size_t readings = 0;
    std::string sessionHead = {};
    bool simulated = false;
};

/// Judges the same readings with another tolerance; fast. `tolerance_pct` > 0, else all levels are indeterminate.
[[nodiscard]] Verdict verdictAt(const JudgedCalibration& judged, double tolerance_pct) noexcept;

}  // namespace tacto
