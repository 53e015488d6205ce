// DeliveryBounds.h - the range of what a programmed train may deliver: the gate judges the worst of it (H1, H9).
//
// Amplitude, phase width, gap, interval and rate each come out between two bounds. An applied calibration gives these
// bounds by its line, its uncertainty and its largest residual. Without one, the accuracy stated by the driver gives
// them, or ± 5 % if none is stated. With an old calibration that is known but not applied, the wider bounds of both are
// used. No calibration measures the rate within a train, so the driver's statement is used. The programmed value is
// always within the bounds.
//
// Thread-safety: a value; nothing allocates.
#pragma once

#include <array>

#include "core/safety/GateSetup.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

/// The two bounds between which a quantity may come out.
template <class Value>
struct Range {
    Value least{0};
    Value most{0};
    [[nodiscard]] Value middle() const { return least + 0.5 * (most - least); }
    /// Calls `use` with both bounds, or once if they are equal.
    template <class Use>
    void eachEnd(Use use) const {
        use(least);
        if (most != least) use(most);
    }
};

/// The bounds of one quantity, in its own unit.
class QuantityBounds {
public:
    QuantityBounds(const std::optional<CalibrationLine>& line, bool applied,
                   const std::optional<Spread>& stated) noexcept;
    [[nodiscard]] double most(double programmed) const noexcept;
    [[nodiscard]] double least(double programmed) const noexcept;
    /// Returns the range of a time; a time without a spread is returned exactly.
    template <class Time>
    [[nodiscard]] Range<Time> times(Time programmed) const noexcept {
        const double s = Seconds(programmed).count();
        const auto bound = [&](double at) { return at == s ? programmed : Time(Seconds(at)); };
        return {bound(least(s)), bound(most(s))};
    }
    /// Returns the smallest ratio of delivered to programmed, at `programmed` and at the ends of the line; above 0.
    [[nodiscard]] double leastRatio(double programmed) const noexcept;

private:
    std::optional<CalibrationLine> line_;
    Spread ofLine_, stated_;
    bool applied_;  // true if the line holds: the stated accuracy is then not used
};

/// The worst of a range of trains. TrainRange bounds the sums of squares. Only leftover charge may be larger inside
/// than at the corners; for random trains, twice the bends of the axes through the middle cover this. (A bend is the
/// middle minus the mean of the ends; a parabola exceeds its ends by at most its bend. All bends add up to the middle
/// minus the mean of the corners.)
class WorstOfRange {
public:
    WorstOfRange(const TrainExposure& enclosed, const TrainExposure& middle) noexcept
        : worst_(worse(enclosed, middle)), middle_(middle) {}
    void addCorner(const TrainExposure& corner) noexcept;
    /// Adds the ends of an axis through the middle. One axis may be omitted: its bend follows from the others.
    void addAxis(const TrainExposure& least, const TrainExposure& most) noexcept;
    [[nodiscard]] TrainExposure worst() const noexcept;

private:
    using NetCharges = std::array<double, 4>;
    static NetCharges netChargesOf(const TrainExposure& exposure) noexcept;
    TrainExposure worst_, middle_;
    NetCharges corners_{}, bends_{}, sizes_{};  // sums of the bends, and of their magnitudes
    int count_ = 0;
};

class DeliveryBounds {
public:
    explicit DeliveryBounds(const GateSetup& setup) noexcept;

    /// The commanded train: for a calibrated stimulator the delivered values by its lines, else the programmed train.
    [[nodiscard]] PulseTrain commandOf(const PulseTrain& programmed) const noexcept;
    /// The level used for a person: the larger of the programmed level and the one delivered by the line. acceptedAs()
    /// returns the smaller. Levels of one unit are compared with each other, so that their uncertainty cancels.
    [[nodiscard]] PulseTrain levelOf(const PulseTrain& programmed) const noexcept;
    [[nodiscard]] PulseTrain acceptedAs(const PulseTrain& programmed) const noexcept;

    [[nodiscard]] Range<double> amplitudes(double programmed) const noexcept {
        return {amplitude_.least(programmed), amplitude_.most(programmed)};
    }
    /// The range in which an interval may come out: the shortest gives the most exposure, the longest the lowest band.
    [[nodiscard]] Range<Seconds> intervals(Seconds programmed) const noexcept { return interval_.times(programmed); }
    /// How much longer a window of real time may last on the clock that times the bookings: 1 or more.
    [[nodiscard]] double stretch(Seconds programmed) const noexcept {
        return 1 / interval_.leastRatio(programmed.count());
    }
    /// `programmed` with the largest amplitude, phase width and gap, at the highest rate (densest) or lowest (longest).
    [[nodiscard]] PulseTrain densest(const PulseTrain& programmed) const noexcept;
    [[nodiscard]] PulseTrain longest(const PulseTrain& programmed) const noexcept;
    /// Returns the worst `exposure` (a function of a train, or of a TrainRange) on `load` over what `programmed` may
    /// deliver: if the load keeps no charge, that of the densest train; else it lies at a corner of the range or near
    /// one (WorstOfRange).
    template <class Exposure>
    [[nodiscard]] TrainExposure worst(const PulseTrain& programmed, const LoadRange& load,
                                      Exposure exposure) const noexcept {
        const PulseTrain first = densest(programmed);
        if (!load.keepsCharge()) return exposure(first);
        const auto width = width_.times(programmed.phaseWidth), gap = gap_.times(programmed.interPhaseGap);
        const auto rate = ratesOf(programmed.rate);
        PulseTrain out = first;
        out.phaseWidth = width.least;
        out.interPhaseGap = gap.least;
        out.rate = rate.least;
        const TrainExposure enclosed = exposure(TrainRange{out, first});
        if (out == first) return enclosed;
        const auto with = [&](Micros ofWidth, Micros ofGap, Hertz ofRate) {
            out.phaseWidth = ofWidth;
            out.interPhaseGap = ofGap;
            out.rate = ofRate;
            return out == first ? enclosed : exposure(out);
        };
        const Micros w = width.middle(), g = gap.middle();
        const Hertz r = rate.middle();
        WorstOfRange worst(enclosed, with(w, g, r));
        width.eachEnd([&](Micros ofWidth) {
            gap.eachEnd([&](Micros ofGap) {
                rate.eachEnd([&](Hertz ofRate) { worst.addCorner(with(ofWidth, ofGap, ofRate)); });
            });
        });
        const bool widths = width.least != width.most, gaps = gap.least != gap.most, rates = rate.least != rate.most;
        if (gaps && widths) worst.addAxis(with(w, gap.least, r), with(w, gap.most, r));
        if (rates && (widths || gaps)) worst.addAxis(with(w, g, rate.least), with(w, g, rate.most));
        return worst.worst();
    }

private:
    [[nodiscard]] Range<Hertz> ratesOf(Hertz programmed) const noexcept {
        return {Hertz(rate_.least(programmed.value())), Hertz(rate_.most(programmed.value()))};
    }

    KnownLines known_;
    bool applied_;
    QuantityBounds amplitude_, width_, gap_, interval_, rate_;
};

}  // namespace tacto
