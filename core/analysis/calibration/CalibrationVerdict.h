// CalibrationVerdict.h - a calibration with its uncertainty, judged against a tolerance. science.md section 9.
//
// The measurand at a level is the device's mean delivered value there, up and down sweep taken together; its error is
// that value less the command. Type A is s/√n of the level's own readings, s pooled within direction (readings at
// different levels need not scatter alike). Type B is what the instruments' data sheets state, in InstrumentErrors.
// The error that is judged is that of the worse direction, so hysteresis cannot hide in the mean.
//
// The line's gain and offset are weighted sums of the levels' means, and so are their errors: those of single levels
// (scatter, or the levels' own departures from the line where they are clearly more) count with the root of the squared
// weights; the step of the converter that the one baseline hides is in all levels alike, and all of it in the offset. A
// departure from the straight line is taken to bend as a cubic through 0 and both ends of the range, or to be another
// straight line through 0, whichever weighs more (choice).
#pragma once

#include "core/analysis/calibration/Calibration.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/Statistics.h"

namespace tacto {

/// What the measuring instrument and the load may contribute; each constant over the calibration, and unknown within
/// limits. Half-widths of rectangular distributions unless said otherwise. NaN: not stated; the budget then has no U
/// and the verdict is at best indeterminate (hazard H9).
struct InstrumentErrors {
    double gainTolerance = kNaN;    ///< relative (0.005 = 0.5 %): vertical gain, or the time base
    double probeTolerance = 0;      ///< relative, of the probe or shunt
    double linearityTolerance = 0;  ///< in the readings' unit, beside the gain
    double offsetTolerance = 0;     ///< in the readings' unit; 0 where each reading has its own baseline
    /// One step (LSB) in the readings' unit; 0 for times. A level that is read from its own baseline (offsetTolerance
    /// 0) is the difference of two, each to a step.
    double resolution = kNaN;
    /// End of the range that the linearity holds for, in the readings' unit; NaN: the largest command.
    double fullScale = kNaN;
    double stampTolerance = 0;  ///< s, of two records against each other; 0 within one record
    double loadTolerance = 0;   ///< relative, of the resistor
    /// Relative change of the reading per relative change of the load: 0 where the voltage across the load of a
    /// voltage source is read (or any time), -1 where a current is computed from the voltage across it.
    double loadSensitivity = 0;
    /// Sampling step, for widths and intervals: two edges, each anywhere within a step, make a triangle (step/√6).
    /// A clock that runs freely shows it in the scatter of the readings already; it is a row of its own only where s
    /// is under half of step/√6, which means that every reading met the same sampling phase.
    double samplingStep = 0;
    std::string unit{};  ///< the readings' unit, for sentences; empty where it is not known
};

struct JudgedLevel {
    double commanded = 0;
    double error = 0;               ///< error of the level's mean
    double worstError = 0;          ///< error of the worse direction: what is judged
    UncertaintyBudget budget;       ///< budget of the level's mean
    UncertaintyBudget worstBudget;  ///< budget of the worse direction's mean, which has fewer readings: what is judged
    double tolerance = 0;           ///< in the readings' unit
    Verdict verdict = Verdict::Indeterminate;
};

struct JudgedCalibration {
    Calibration calibration;
    std::vector<JudgedLevel> levels;  ///< as calibration.levels
    UncertaintyBudget gain;           ///< budget of the fitted line's gain
    UncertaintyBudget offset;
    double tolerance_pct = 0;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;  ///< reasons; the one that decided the verdict comes first
    /// The level of the largest command.
    [[nodiscard]] const JudgedLevel& fullScale() const noexcept;
    /// The level of the smallest.
    [[nodiscard]] const JudgedLevel& smallest() const noexcept;
};

/// `tolerance_pct`: in % of the command at each level. The verdict is the worst level's; fewer than 11 levels or 5
/// repeats, a level that was not met both ways or a reading that was not measured cannot pass.
/// A level without a measured reading is indeterminate, its budget empty and its U NaN.
/// Errors: as combine(); InvalidArgument for a tolerance that is not above 0, or where nothing was repeated.
[[nodiscard]] Result<JudgedCalibration> judgeCalibration(Calibration calibration, const InstrumentErrors& errors,
                                                         double tolerance_pct, const BudgetOptions& options = {});

/// The verdict on these readings with another tolerance; cheap. `tolerance_pct` > 0, else all levels are indeterminate.
[[nodiscard]] Verdict verdictAt(const JudgedCalibration& judged, double tolerance_pct) noexcept;

}  // namespace tacto
