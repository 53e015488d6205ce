// TrainExposure.h - the exposure of a load to a pulse train, in every quantity of science.md section 7.
//
// Each segment is calculated in closed form (core/electrode). The charge that a pulse leaves on the load carries over
// to the next pulse and train. The larger of "first train from rest" and "steady state" is returned, so the values hold
// for any number of trains. Phase width, gap and rate are known to a range. With a capacitor the sums of squares may be
// largest inside it, as a longer phase adds what a shorter rest no longer discharges. An upper bound is used: every
// segment at its longest, from each end of the load's states. A current source that would exceed its compliance is
// judged with and without it. Drift and lost contact are ignored: they would only make limits look farther away than
// they are.
//
// Thread-safety: pure functions. Nothing here allocates, except exposureTable().
#pragma once

#include <span>
#include <vector>

#include "core/safety/GateSetup.h"

namespace tacto {

/// Integrals over a stretch of output, tails included. SI units, so that windows can add them up.
struct TrainSums {
    double currentSquared_A2s = 0;
    double voltageSquared_V2s = 0;
    double netCharge_C = 0;  ///< Σ |net charge| of the pulses: an upper bound for any window
    /// The heat in the load, and the most that its capacitor held. A pulse takes part of the latter back, but a window
    /// may end before: so only the sum of both is an upper bound for any window.
    double dissipated_J = 0;
    double stored_J = 0;

    TrainSums& operator+=(const TrainSums& other) noexcept;
};

struct TrainExposure {
    QuantityValues values{};  ///< each in the unit that unitOf() gives; densities are NaN without an area
    TrainSums in1s;           ///< the most of one train in any second: all of it, unless it lasts longer
    TrainSums in5s;           ///< sums over the worst 5 s
    double residual_V = 0;    ///< largest |voltage| on the load's capacitor at the train's end
    [[nodiscard]] double at(Quantity q) const noexcept { return values[indexOf(q)]; }
};

/// Trains that differ only in phase width, inter-phase gap and rate: what one programmed train may deliver.
struct TrainRange {
    PulseTrain sparsest;  ///< all three values at their smallest
    PulseTrain densest;   ///< all three values at their largest
};

/// The state in which a train finds the load: up to this |voltage|, of either sign, on its capacitor from earlier
/// trains. The gate carries it from train to train; previews start from rest.
struct Carried {
    double voltage_V = 0;
};

/// Returns the exposure to one train per `interval` into `load`, with windows at their worst position. It is exact for
/// a resistor, except that a pulse at a window's edge is treated as if it had no gap. It is an upper bound for a load
/// with a capacitor: such a pulse is included whole. `train` must be valid (validate()) and interval ≥ its duration, or
/// all values are NaN, which no limit permits. `area` in cm², NaN if unknown. CommandVoltage is taken at this load.
[[nodiscard]] TrainExposure exposureOf(const PulseTrain& train, Seconds interval, const Load& load,
                                       const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;

/// Returns the exposure to the densest of `trains`; ∫i², ∫v² and heat are upper bounds for the whole range.
[[nodiscard]] TrainExposure exposureOf(const TrainRange& trains, Seconds interval, const Load& load,
                                       const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;

/// Returns A of science.md section 4, V: the amplitude, or I·|Z| of `load` at the end of the leading phase.
[[nodiscard]] double commandVoltage(const PulseTrain& train, const Load& load, const SourceTraits& source) noexcept;

/// Returns |Z| of `load` at the end of the leading phase of the source's pulses, whatever the amplitude.
[[nodiscard]] Ohms impedanceOf(const Load& load, const PulseTrain& train, const SourceTraits& source) noexcept;

/// Returns the larger of both, quantity by quantity (NaN wins, so that it is not hidden).
[[nodiscard]] TrainExposure worse(const TrainExposure& a, const TrainExposure& b) noexcept;

/// Worst case between load.min and load.max; CommandVoltage at load.nominal (I·|Z|, end of the leading phase).
[[nodiscard]] TrainExposure worstExposure(const PulseTrain& train, Seconds interval, const LoadRange& load,
                                          const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;
[[nodiscard]] TrainExposure worstExposure(const TrainRange& trains, Seconds interval, const LoadRange& load,
                                          const SourceTraits& source, double area_cm2, Carried carried = {}) noexcept;

/// Returns a windowed quantity from the sums in one window of windowOf(quantity) seconds; NaN for other quantities.
[[nodiscard]] double windowedValue(Quantity quantity, const TrainSums& inWindow, double area_cm2) noexcept;

/// Judges every limit of the setup's sets and ceilings for this train, in the worst case over the load range and over
/// what the stimulator may deliver (DeliveryBounds.h), without the meter; adds the in-train RMS without a limit. For
/// reports and previews. Without an area, density rows are not evaluated.
[[nodiscard]] std::vector<ExposureRow> exposureTable(const GateSetup& setup, const PulseTrain& train, Seconds interval);

/// True if the gate refuses a train because of this row. A row that was not evaluated refuses none, as in the gate.
[[nodiscard]] bool forbids(const ExposureRow& row) noexcept;
/// Returns the first row of a table that forbids the train; null if none does.
[[nodiscard]] const ExposureRow* firstForbidding(std::span<const ExposureRow> rows) noexcept;
/// Returns that row's quantity and limit set in a few words; empty if no row forbids the train.
[[nodiscard]] std::string forbiddenBy(const GateSetup& setup, const PulseTrain& train, Seconds interval);

}  // namespace tacto
