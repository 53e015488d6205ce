// GateSetup.h - the data that the gate needs before it can judge: what is connected, to whom or to what, and which
// limits hold. Plain data; SafetyGate::configure() checks it.
//
// Trains are rounded to the device's grid before approval, by core/encoding; the gate refuses values off the grid
// (apart from the rounding of decimal steps in binary, 1e-6 of a step).
//
// Thread-safety: values; pure functions.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/electrode/Load.h"
#include "core/encoding/PulseTrain.h"
#include "core/encoding/StimulatorCalibration.h"
#include "core/safety/LimitSet.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

enum class OutputMode { BenchLoad, Person };
[[nodiscard]] std::string_view nameOf(OutputMode mode) noexcept;  // "bench load", "person"

/// The loads over which the worst case is taken (science.md section 7).
struct LoadRange {
    Load min;
    Load max;
    Load nominal;  ///< declared, or as last measured; its |Z| converts a current into A

    /// The range of `nominal` with its impedance times `low` to `high` at every frequency (same time constants).
    [[nodiscard]] static LoadRange around(const Load& nominal, double low, double high);
    /// The declared load of a bench ± 20 %.
    [[nodiscard]] static LoadRange declared(const Load& nominal) { return around(nominal, 0.8, 1.2); }
    /// 0.7 to 1.3 times a person's measured |Z|.
    [[nodiscard]] static LoadRange measured(Ohms magnitude);
    /// Resistances from `low` to `high`, nominal at their geometric mean: for previews, and a person before the check.
    [[nodiscard]] static LoadRange between(Ohms low, Ohms high);
    /// True if the charge left by one pulse may still be there at the next pulse.
    [[nodiscard]] bool keepsCharge() const noexcept {
        return min.kind == LoadKind::SkinEquivalent || max.kind == LoadKind::SkinEquivalent;
    }
};

/// A profile's own limit on a quantity, judged over the load range. It may be tighter than the limit sets, never
/// looser: configure() refuses a ceiling above the tightest "refuse" row of its quantity.
struct Ceiling {
    Quantity quantity = Quantity::PeakCurrent;
    double max = 0;  ///< in unitOf(quantity); "≤"
};
using Ceilings = std::vector<Ceiling>;

/// A person's limits at a massager; the levels are intensities from 0 to 1.
struct PersonVibration {
    double discomfortLimit = 1;  ///< above 0 to 1; may fall during a session, never rise
    double rampStep = 0.05;      ///< above 0 to 1; the largest step above an accepted intensity (H6)
};

/// What must be known before any output reaches a person.
struct PersonSetup {
    std::string participant;  ///< pseudonym; accepted levels and discomfort are kept while it stays the same
    bool consentRecorded = false;
    Milliamps discomfortLimit{0};    ///< > 0; may fall during a session, never rise
    Milliamps rampStep{0};           ///< > 0; the largest step above an accepted level (H6)
    std::optional<Milliamps> cap{};  ///< > 0; the study's cap: no level exceeds it. Nothing: the study has no cap
    Ohms impedanceLow{500};          ///< the profile's range in which a person's |Z| must lie
    Ohms impedanceHigh{10'000};
    /// For a massager in place of electrodes: no train is then approved, and nothing about electrodes is required.
    std::optional<PersonVibration> vibration{};
};

struct GateSetup {
    OutputMode mode = OutputMode::BenchLoad;
    SourceTraits source;
    LoadRange load;  ///< bench: declared(); person: replaced by the profile's range, then by the measured |Z|
    std::vector<LimitSet> limits;  ///< at least one
    Ceilings ceilings;
    std::optional<SquareCentimetres> electrodeArea;  ///< without an area, density rows are not evaluated
    PulseTrain check;                   ///< shape and timing of the impedance check; the source sets its amplitude
    std::optional<PersonSetup> person;  ///< required in person mode
    /// The last known calibration of the connected stimulator, even if it has expired or is not applied. Trains hold
    /// programmed values; the gate judges the worse of programmed and delivered (H1, H9).
    KnownLines calibration;
    /// True if a calibration holds and trains are programmed by it: then the command is delivered, else the programmed
    /// value. Required in person mode, with all four lines.
    bool calibrated = false;
};

inline constexpr Seconds kCheckInterval{0.5};  ///< the shortest time between two impedance checks
/// The interval for judging a check: with room for a check that lasts longer than programmed.
[[nodiscard]] inline Seconds checkInterval(const PulseTrain& check) noexcept {
    return std::max(kCheckInterval, 1.2 * check.duration());
}
/// Returns the impedance check: the setup's check pulse at the source's check amplitude, rounded to the source's grid
/// toward zero (at least one step).
[[nodiscard]] PulseTrain checkTrainOf(const GateSetup& setup);

}  // namespace tacto
