// LoadFigures.h - the figures of the trains of one load, each with its uncertainty (LoadReading.h says what they are).
// Private to core/analysis.
#pragma once

#include <span>

#include "core/analysis/load_safety/ChannelDoubt.h"
#include "core/analysis/load_safety/LoadReading.h"

namespace tacto {

/// Currents below this many converter steps are too coarse to evaluate.
constexpr double kMinLsb = 10;

/// Multiplies a reading by a factor, to change its unit or to take a part of it.
[[nodiscard]] Reading times(double factor, const Reading& reading);

class LoadFigures {
public:
    /// `trains` holds at least one train; `capture` is that of the first train. All arguments outlive this object.
    LoadFigures(const LoadTrains& trains, const ExpectedTrain& expected, const Capture& capture)
        : trains_(trains),
          expected_(expected),
          v_(channelOf(capture, "voltage")),
          i_(channelOf(capture, "current")),
          dt_(1 / capture.rate_hz),
          record_s_(static_cast<double>(capture.samples()) * dt_),
          timeBase_(capture.timeBaseTolerance),
          stamp_s_(capture.stampTolerance_s),
          gainShared_(capture.gainShared) {}

    /// Adds amplitude, width and peak voltage.
    void addVoltage(LoadReading& out) const;
    /// Adds the rate, in trains of more than one pulse.
    void addRate(LoadReading& out) const;
    /// `rhythm` is the argument of readLoad(); if it is given, the interval comes from that record.
    void addInterval(LoadReading& out, const Capture* rhythm) const;
    /// Adds the voltage figures over longer windows. Call it after addInterval().
    void addVoltageWindows(LoadReading& out) const;
    /// Adds all figures that need the current. Call it after the other functions.
    void addCurrent(LoadReading& out) const;
    [[nodiscard]] Reading impedanceOf(const LoadTrains& trains, const ChannelDoubt& v, const ChannelDoubt& i,
                                      double currentLsb) const;
    [[nodiscard]] Reading figure(double value, BudgetRows rows) const;

private:
    void addTimeBase(BudgetRows& rows, double sensitivity) const;
    void addOnsets(BudgetRows& rows, double rate_hz, double sensitivity) const;
    void addWidth(BudgetRows& rows, double sensitivity) const;
    void addEnd(BudgetRows& rows, const LoadTrains& trains, double samples, double sensitivity) const;
    void addAmplitude(LoadReading& out, Reading& amplitude, double TrainFigures::*member, const BudgetRows& rows,
                      bool driven) const;

    const LoadTrains& trains_;
    const ExpectedTrain& expected_;
    const ChannelDoubt v_, i_;
    const double dt_, record_s_, timeBase_, stamp_s_;
    const bool gainShared_;
};

// Adds a second, finer current range for the same command. In it a skin equivalent's charging spike clips, but the end
// of a phase does not. Private to core/analysis.

/// Reads |Z|, net charge and imbalance of `out` again from `fine`, and from `captures` only while `fine` clips. They
/// are not measured if either record cannot be read. `figures` belong to `captures`, which also gave the charge and
/// width in `out`.
void addFineRange(LoadReading& out, const LoadFigures& figures, std::span<const Capture> captures,
                  std::span<const Capture> fine, const ExpectedTrain& expected);

}  // namespace tacto
