// TrainExposure.h - what a pulse train does to a load, in every quantity of science.md section 7.
//
// Closed forms per segment (core/electrode); the charge that a pulse leaves on the load is carried into
// the next pulse and the next train, and the larger of "first train from rest" and "steady state" is
// given, so that the figures hold for any number of trains. What a device makes of a phase width, a gap and a rate is
// known to a range: on a load with a capacitor the sums of squares may be largest inside it, because what a longer
// phase adds a shorter rest no longer discharges. They are enclosed there: every segment at its longest, from each end
// of what the load may hold. A current source that would exceed its compliance is judged both with and without it. A
// load's drift and lost contact are left out: they would only make a limit look farther away than it is.
//
// Thread-safety: pure functions. Nothing here allocates, except exposureTable().
#pragma once

#include <span>
#include <vector>

#include "core/safety/GateSetup.h"

namespace tacto {

/// ∫ over a stretch of output, tails included. SI units, so that windows can add them up.
struct TrainSums {
    double currentSquared_A2s = 0;
    double voltageSquared_V2s = 0;
    double netCharge_C = 0;  ///< Σ |net charge| of the pulses: no window holds more, wherever it begins
    /// The heat that the load made, and the most that its capacitor held meanwhile. A pulse takes part of the second
    /// back, a window that ends before does not: none holds more than both.
    double dissipated_J = 0;
    double stored_J = 0;

    TrainSums& operator+=(const TrainSums& other) noexcept;
};

struct TrainExposure {
    QuantityValues values{};  ///< each in the unit unitOf() of its quantity; densities are NaN without an area
    TrainSums in1s;           ///< the most that one train puts into any second: all of it, unless it lasts longer
    TrainSums in5s;           ///< sums over the worst 5 s
    double residual_V = 0;    ///< largest |voltage| it leaves on the load's capacitor at its end
    [[nodiscard]] double at(Quantity q) const noexcept { return values[indexOf(q)]; }
};

/// Trains that differ in phase width, inter-phase gap and rate alone: what may come out of one that is programmed.
struct TrainRange {
    PulseTrain sparsest;  ///< all three at their smallest
    PulseTrain densest;   ///< all three at their largest
};

/// The state in which a train finds the load: up to this |voltage| on its capacitor, of either sign, from trains before
/// it. The gate carries it from train to train; previews start from rest.
struct Carried {
    double voltage_V = 0;
};

/// One train per `interval` into `load`, windows at their worst position: exact into a resistor, but that a pulse which
/// the window's edge parts counts as if its phases followed each other; into a load with a capacitor an upper bound, in
/// which such a pulse counts whole. `train` must be valid (validate()) and interval ≥ its duration; otherwise
/// the figures are NaN, which no limit lets pass. `area` in cm², NaN when unknown. CommandVoltage is taken at this
/// load.
[[nodiscard]] TrainExposure exposureOf(const PulseTrain& train, Seconds interval, const Load& load,
                                       const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;

/// The exposure to the densest of `trains`, but ∫i², ∫v² and heat are upper bounds for every train of the range.
[[nodiscard]] TrainExposure exposureOf(const TrainRange& trains, Seconds interval, const Load& load,
                                       const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;

/// A of science.md section 4, V: the amplitude, or of a current I·|Z| of `load` at the end of the leading phase.
[[nodiscard]] double commandVoltage(const PulseTrain& train, const Load& load, const SourceTraits& source) noexcept;

/// |Z| of `load` at the end of the leading phase of the source's pulses, the same for any amplitude of `train`.
[[nodiscard]] Ohms impedanceOf(const Load& load, const PulseTrain& train, const SourceTraits& source) noexcept;

/// The larger of both, quantity by quantity (NaN wins: it must not be hidden).
[[nodiscard]] TrainExposure worse(const TrainExposure& a, const TrainExposure& b) noexcept;

/// Worst case between load.min and load.max; CommandVoltage at load.nominal (I·|Z| at the end of the leading phase).
[[nodiscard]] TrainExposure worstExposure(const PulseTrain& train, Seconds interval, const LoadRange& load,
                                          const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;
[[nodiscard]] TrainExposure worstExposure(const TrainRange& trains, Seconds interval, const LoadRange& load,
                                          const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;

/// The windowed quantities from sums that fell into one window of windowOf(quantity) seconds; NaN for others.
[[nodiscard]] double windowedValue(Quantity quantity, const TrainSums& inWindow, double area_cm2) noexcept;

/// Judges every limit of the setup's sets and ceilings on this train, in the worst case over the load range and over
/// what the stimulator may make of it (DeliveryBounds.h), without the meter; then the in-train RMS without a limit.
/// Reports and previews show it. Density rows without an area read not evaluated.
[[nodiscard]] std::vector<ExposureRow> exposureTable(const GateSetup& setup, const PulseTrain& train, Seconds interval);

/// Whether the gate refuses a train for this row. A row that was not evaluated refuses none, as in the gate.
[[nodiscard]] bool forbids(const ExposureRow& row) noexcept;
/// The first row of a table that forbids; null where none does.
[[nodiscard]] const ExposureRow* firstForbidding(std::span<const ExposureRow> rows) noexcept;
/// Its quantity and limit set in a few words; empty where no row of the train's table forbids.
[[nodiscard]] std::string forbiddenBy(const GateSetup& setup, const PulseTrain& train, Seconds interval);

}  // namespace tacto
