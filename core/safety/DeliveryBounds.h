// DeliveryBounds.h - what may come out of a train that a stimulator is told: the gate judges the worst of it (H1, H9).
//
// Each of amplitude, phase width, gap and interval comes out between two bounds. A calibration that is applied gives
// them: its line, its uncertainty and its largest residual. Without one they are the accuracy that the driver states,
// ± 5 % where it states none; and where an old calibration is known that is not applied, the wider of both. What the
// stimulator is told lies inside the bounds in any case.
//
// Thread-safety: a value; nothing allocates.
#pragma once

#include "core/safety/GateSetup.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

/// Between which a time may come out.
template <class Time>
struct TimeRange {
    Time least{0};
    Time most{0};
};

/// The bounds of one quantity, in its own unit.
class QuantityBounds {
public:
    QuantityBounds(const std::optional<CalibrationLine>& line, bool applied,
                   const std::optional<Spread>& stated) noexcept;
    [[nodiscard]] double most(double told) const noexcept;
    [[nodiscard]] double least(double told) const noexcept;
    /// The same of a time; one that has no spread stays as it is to the last bit.
    template <class Time>
    [[nodiscard]] TimeRange<Time> times(Time told) const noexcept {
        const double s = Seconds(told).count();
        const auto bound = [&](double at) { return at == s ? told : Time(Seconds(at)); };
        return {bound(least(s)), bound(most(s))};
    }
    /// The smallest ratio of what comes out to what is told, at `told` and at the ends of the line; above 0.
    [[nodiscard]] double leastRatio(double told) const noexcept;

private:
    std::optional<CalibrationLine> line_;
    Spread ofLine_, stated_;
    bool applied_;  // The line holds: what is stated no longer counts
};

class DeliveryBounds {
public:
    explicit DeliveryBounds(const GateSetup& setup) noexcept;

    /// What was commanded: of a calibrated stimulator what it delivers by its lines, else what it is told.
    [[nodiscard]] PulseTrain commandOf(const PulseTrain& told) const noexcept;
    /// What a person's level counts as: the larger of what is told and what is delivered by the line; and when it is
    /// accepted, the smaller. Levels of one unit are compared with each other, so their uncertainty cancels.
    [[nodiscard]] PulseTrain levelOf(const PulseTrain& told) const noexcept;
    [[nodiscard]] PulseTrain acceptedAs(const PulseTrain& told) const noexcept;

    /// Between which an interval may come out: the shortest gives the most exposure, the longest the lowest band.
    [[nodiscard]] TimeRange<Seconds> intervals(Seconds told) const noexcept { return interval_.times(told); }
    /// How much longer a window of real time may last by the clock that trains are booked on: 1 or more.
    [[nodiscard]] double stretch(Seconds told) const noexcept { return 1 / interval_.leastRatio(told.count()); }
    /// `told` with the most amplitude, phase width and gap.
    [[nodiscard]] PulseTrain largest(const PulseTrain& told) const noexcept;
    /// `exposure`, a function of a train, at its worst over what may come out of `told`.
    template <class Exposure>
    [[nodiscard]] TrainExposure worst(const PulseTrain& told, Exposure exposure) const noexcept {
        PulseTrain out = largest(told);
        TrainExposure worst = exposure(out);
        const PulseTrain first = out;
        const auto width = width_.times(told.phaseWidth), gap = gap_.times(told.interPhaseGap);
        for (const Micros w : {width.least, width.most}) {
            for (const Micros g : {gap.least, gap.most}) {
                out.phaseWidth = w;
                out.interPhaseGap = g;
                if (out != first) worst = worse(worst, exposure(out));
            }
        }
        return worst;
    }

private:
    KnownLines known_;
    bool applied_;
    QuantityBounds amplitude_, width_, gap_, interval_;
};

}  // namespace tacto
