// ChannelDoubt.h - the rows of an uncertainty budget that a load's figures are made of: what is stated of a channel,
// its noise, and the spread of the trains. Private to core/analysis.
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

/// Rows for what is stated about a channel; anything unstated is NaN and makes the figure's U unknown.
class ChannelDoubt {
public:
    /// Null for a missing channel: nothing is stated of it.
    explicit ChannelDoubt(const CaptureChannel* channel) : channel_(channel) {}

    /// Relative.
    [[nodiscard]] double gain() const;
    /// Gain and probe or shunt; `sensitivity`: the figure's change per relative change of the channel.
    void addGain(BudgetRows& rows, double sensitivity) const;
    void addProbe(BudgetRows& rows, double sensitivity) const;
    /// A level above its baseline: two of them, each to a step of the converter; and the linearity between them.
    void addLevel(BudgetRows& rows, double sensitivity) const;
    /// The sum of two equal and opposite levels, over `width_s` each, above one baseline, which both share. What bends
    /// one level bends the other the opposite way (the cubic of CalibrationVerdict.h).
    void addOpposites(BudgetRows& rows, double width_s) const;

private:
    [[nodiscard]] std::string name() const;
    void addStep(BudgetRows& rows, const char* of, double sensitivity) const;
    const CaptureChannel* channel_;
};

void addNormal(BudgetRows& rows, const char* what, double u, double sensitivity = 1);
/// The spread of the mean of the trains; one train has no spread to tell.
void addSpread(BudgetRows& rows, const LoadTrains& trains, double TrainFigures::*member, double sensitivity = 1);

}  // namespace tacto
