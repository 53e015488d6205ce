// GateSetup.h - what the gate must know before it can judge: what is connected, who or what it is connected
// to, and which limits hold. Plain data; SafetyGate::configure() checks it.
//
// Rounding onto the device's grid happens before approval and elsewhere (core/encoding); the gate refuses
// what is off the grid (beyond the representation of decimal steps in binary, 1e-6 of a step).
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

/// The loads among which the worst case is taken (science.md section 7).
struct LoadRange {
    Load min;
    Load max;
    Load nominal;  ///< declared, or as last measured: its |Z| makes A out of a current

    /// `nominal` with its impedance multiplied by `low` and `high` at every frequency (time constants stay).
    [[nodiscard]] static LoadRange around(const Load& nominal, double low, double high);
    /// A bench's declared load ± 20 %.
    [[nodiscard]] static LoadRange declared(const Load& nominal) { return around(nominal, 0.8, 1.2); }
    /// 0.7 to 1.3 of a person's measured |Z|.
    [[nodiscard]] static LoadRange measured(Ohms magnitude);
    /// Resistances from `low` to `high`, nominal their geometric mean: previews, and a person before the check pulse.
    [[nodiscard]] static LoadRange between(Ohms low, Ohms high);
    /// Whether the next pulse may find what one pulse leaves.
    [[nodiscard]] bool keepsCharge() const noexcept {
        return min.kind == LoadKind::SkinEquivalent || max.kind == LoadKind::SkinEquivalent;
    }
};

/// A profile's own limit on a quantity, judged over the load range. It may tighten what the limit sets say and never
/// loosen it: configure() refuses a ceiling above the tightest "refuse" row of its quantity.
struct Ceiling {
    Quantity quantity = Quantity::PeakCurrent;
    double max = 0;  ///< in unitOf(quantity); "≤"
};
using Ceilings = std::vector<Ceiling>;

/// The permissions of a person at a massager; their levels are intensities from 0 to 1.
struct PersonVibration {
    double discomfortLimit = 1;  ///< above 0 to 1; may fall during a session, never rise
    double rampStep = 0.05;      ///< above 0 to 1; the largest step above an accepted intensity (H6)
};

/// All that must be known before anything reaches a person.
struct PersonSetup {
    std::string participant;  ///< pseudonym; accepted levels and discomfort live as long as it stays the same
    bool consentRecorded = false;
    Milliamps discomfortLimit{0};    ///< > 0; may fall during a session, never rise
    Milliamps rampStep{0};           ///< > 0; the largest step above an accepted level (H6)
    std::optional<Milliamps> cap{};  ///< > 0; the study's: no level exceeds it. Nothing: the study has none
    Ohms impedanceLow{500};          ///< the profile's range in which a person's |Z| must lie
    Ohms impedanceHigh{10'000};
    /// A massager in place of electrodes: then no train passes, and nothing that belongs to electrodes is asked.
    std::optional<PersonVibration> vibration{};
};

struct GateSetup {
    OutputMode mode = OutputMode::BenchLoad;
    SourceTraits source;
    LoadRange load;  ///< bench: declared(); person: replaced by the profile's range, then by the measured |Z|
    std::vector<LimitSet> limits;  ///< at least one
    Ceilings ceilings;
    std::optional<SquareCentimetres> electrodeArea;  ///< without it density rows are not evaluated
    PulseTrain check;                   ///< shape and timing of the impedance check; its amplitude is the source's
    std::optional<PersonSetup> person;  ///< required in person mode
    /// The last that is known about the stimulator that is connected, also where it has expired or is left aside.
    /// Trains are what is programmed; everything is judged by the worse of programmed and delivered (H1, H9).
    KnownLines calibration;
    /// Whether a calibration holds and trains are programmed by it: then the command is delivered, else what is
    /// programmed. Required in person mode, with all four lines.
    bool calibrated = false;
};

inline constexpr Seconds kCheckInterval{0.5};  ///< the shortest time between two impedance checks
/// The interval at which a check is judged: it has room to last longer than programmed.
[[nodiscard]] inline Seconds checkInterval(const PulseTrain& check) noexcept {
    return std::max(kCheckInterval, 1.2 * check.duration());
}
/// The impedance check: the setup's check pulse with the source's check amplitude, rounded to its grid toward zero (one
/// step at least).
[[nodiscard]] PulseTrain checkTrainOf(const GateSetup& setup);

}  // namespace tacto
