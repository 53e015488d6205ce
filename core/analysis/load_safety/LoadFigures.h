// LoadFigures.h - the figures of the trains of one load, each with its uncertainty (LoadReading.h says what they are).
// Private to core/analysis.
#pragma once

#include <span>

#include "core/analysis/load_safety/ChannelDoubt.h"
#include "core/analysis/load_safety/LoadReading.h"

namespace tacto {

/// A current below that many steps of its converter says nothing.
constexpr double kMinLsb = 10;

/// The reading in another unit, or a part of it.
[[nodiscard]] Reading times(double factor, const Reading& reading);

class LoadFigures {
public:
    /// Takes at least one train; `capture` is the first one's. All arguments outlive this.
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

    /// Amplitude, width and peak.
    void addVoltage(LoadReading& out) const;
    /// Adds the rate, in trains of more than one pulse.
    void addRate(LoadReading& out) const;
    /// `rhythm`: readLoad()'s, where the interval is taken from it.
    void addInterval(LoadReading& out, const Capture* rhythm) const;
    /// After addInterval().
    void addVoltageWindows(LoadReading& out) const;
    /// Adds all that rests on the current; called after the others.
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

// Adds a second, finer current range for the same command: a skin equivalent's charging spike clips in it, the end of a
// phase does not. Private to core/analysis.

/// |Z|, net charge and imbalance of `out`, read again: in `fine`, and in `captures` only while `fine` clips; not
/// measured where a record of the two cannot be read. `figures` are those of `captures`, whose charge and width `out`
/// has.
void addFineRange(LoadReading& out, const LoadFigures& figures, std::span<const Capture> captures,
                  std::span<const Capture> fine, const ExpectedTrain& expected);

}  // namespace tacto
