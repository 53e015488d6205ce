// DeliveryBounds.h - what may come out of a train that is programmed: the gate judges the worst of it (H1, H9).
//
// Each of amplitude, phase width, gap and interval comes out between two bounds. A calibration that is applied gives
// them: its line, its uncertainty and its largest residual. Without one they are the accuracy that the driver states,
// ± 5 % where it states none; and where an old calibration is known that is not applied, the wider of both. What is
// programmed lies inside the bounds in any case.
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
    [[nodiscard]] double most(double programmed) const noexcept;
    [[nodiscard]] double least(double programmed) const noexcept;
    /// The same of a time; one that has no spread stays as it is to the last bit.
    template <class Time>
    [[nodiscard]] TimeRange<Time> times(Time programmed) const noexcept {
        const double s = Seconds(programmed).count();
        const auto bound = [&](double at) { return at == s ? programmed : Time(Seconds(at)); };
        return {bound(least(s)), bound(most(s))};
    }
    /// The smallest ratio of what comes out to what is programmed, at `programmed` and at the ends of the line; above
    /// 0.
    [[nodiscard]] double leastRatio(double programmed) const noexcept;

private:
    std::optional<CalibrationLine> line_;
    Spread ofLine_, stated_;
    bool applied_;  // the line holds: what is stated no longer counts
};

class DeliveryBounds {
public:
    explicit DeliveryBounds(const GateSetup& setup) noexcept;

    /// What was commanded: of a calibrated stimulator what it delivers by its lines, else what is programmed.
    [[nodiscard]] PulseTrain commandOf(const PulseTrain& programmed) const noexcept;
    /// What a person's level counts as: the larger of what is programmed and what is delivered by the line; and when it
    /// is accepted, the smaller. Levels of one unit are compared with each other, so their uncertainty cancels.
    [[nodiscard]] PulseTrain levelOf(const PulseTrain& programmed) const noexcept;
    [[nodiscard]] PulseTrain acceptedAs(const PulseTrain& programmed) const noexcept;

    /// Between which an interval may come out: the shortest gives the most exposure, the longest the lowest band.
    [[nodiscard]] TimeRange<Seconds> intervals(Seconds programmed) const noexcept {
        return interval_.times(programmed);
    }
    /// How much longer a window of real time may last by the clock that trains are booked on: 1 or more.
    [[nodiscard]] double stretch(Seconds programmed) const noexcept {
        return 1 / interval_.leastRatio(programmed.count());
    }
    /// `programmed` with the most amplitude, phase width and gap.
    [[nodiscard]] PulseTrain largest(const PulseTrain& programmed) const noexcept;
    /// `exposure`, a function of a train and of a TrainRange, at its worst over what may come out of `programmed`.
    template <class Exposure>
    [[nodiscard]] TrainExposure worst(const PulseTrain& programmed, Exposure exposure) const noexcept {
        const PulseTrain first = largest(programmed);
        const auto width = width_.times(programmed.phaseWidth), gap = gap_.times(programmed.interPhaseGap);
        PulseTrain out = first;
        out.phaseWidth = width.least;
        out.interPhaseGap = gap.least;
        TrainExposure worst = exposure(TrainRange{out, first});
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
