// ChannelDoubt.h - the uncertainty budget rows of a load's figures: the stated channel tolerances, the noise, and the
// spread between trains. Private to core/analysis.
//
// Thread-safety: pure functions; a ChannelDoubt does not outlive its capture.
#pragma once

#include <string>
#include <vector>

#include "core/analysis/load_safety/LoadTrain.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/measure/Capture.h"

namespace tacto {

using BudgetRows = std::vector<Contribution>;

constexpr double kSqrt2 = 1.4142135623730951;
constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kSqrt12 = 3.4641016151377544;

/// Adds budget rows for a channel's stated tolerances. An unstated tolerance is NaN and makes the figure's U unknown.
class ChannelDoubt {
public:
    /// `channel` may be null if the capture lacks the channel; all its tolerances are then unknown.
    explicit ChannelDoubt(const CaptureChannel* channel) : channel_(channel) {}

    /// The relative gain tolerance; NaN if it is not stated.
    [[nodiscard]] double gain() const;
    /// Adds gain and probe (or shunt). `sensitivity`: change of the figure per relative change of the channel.
    void addGain(BudgetRows& rows, double sensitivity) const;
    void addProbe(BudgetRows& rows, double sensitivity) const;
    /// Adds the converter step of a level and of its baseline, and the linearity between the two.
    void addLevel(BudgetRows& rows, double sensitivity) const;
    /// Adds the converter steps for the sum of two opposite levels, each over `width_s`, above one shared baseline. A
    /// nonlinearity bends the two levels in opposite ways (the cubic of CalibrationVerdict.h).
    void addOpposites(BudgetRows& rows, double width_s) const;

private:
    [[nodiscard]] std::string name() const;
    void addStep(BudgetRows& rows, const char* of, double sensitivity) const;
    const CaptureChannel* channel_;
};

void addNormal(BudgetRows& rows, const char* what, double u, double sensitivity = 1);
/// Adds the standard error of the mean of the trains; a single train has no spread, so nothing is added.
void addSpread(BudgetRows& rows, const LoadTrains& trains, double TrainFigures::*member, double sensitivity = 1);

}  // namespace tacto
