// LoadSafety.h - is what the stimulator delivers into a set of bench loads within every limit? From measured trains to
// rows, tables and one verdict (science.md sections 6, 7 and 9; safety.md).
//
// Promise (hazard H9): nothing that was not measured reads as passed. The overall verdict is a pass only if every row
// that applies passes; a load of the bench set or a trip that is missing is a row of its own and reads "not evaluated".
// A figure passes when value + U keeps the limit, fails when value - U breaks it, and is indeterminate between; U is 95
// %.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/load_safety/LoadReading.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/electrode/Load.h"
#include "core/safety/GateSetup.h"

namespace tacto {

enum class RowVerdict {
    Pass,
    Fail,
    Indeterminate,      ///< within U of the limit
    NotEvaluated,       ///< it was not measured; this is never a pass
    NotApplicable,      ///< cannot be asked of this device; named, and does not hold up a pass
    RefusedAsExpected,  ///< the command is over a limit on this load, was asked for, and was refused
    Attention,          ///< above a figure that asks for a warning or for marking; no fault
};
/// "pass", "fail", "indeterminate", "not evaluated", "not applicable", "refused as expected", "attention"
[[nodiscard]] std::string_view nameOf(RowVerdict verdict) noexcept;

/// The basis of a row's value: captured values are judged, computed ones say so.
enum class RowBasis { Measured, Commanded, Computed };
/// "measured", "commanded", "computed"
[[nodiscard]] std::string_view nameOf(RowBasis basis) noexcept;

/// One thing judged.
struct SafetyRow {
    std::string load;   ///< as parseLoad() reads it, or the range; empty for rows without a load
    std::string item;   ///< key of a quantity ("rms_current_5s"), or "load_value", "amplitude_error", "refusal", ...
    std::string title;  ///< the title that people read
    double value = std::numeric_limits<double>::quiet_NaN();
    double expanded = std::numeric_limits<double>::quiet_NaN();  ///< U, in the value's unit
    double limit = std::numeric_limits<double>::quiet_NaN();
    std::string unit;
    std::string set;     ///< id of the limit set; "laboratory" for this program's own
    std::string source;  ///< document and clause
    RowVerdict verdict = RowVerdict::NotEvaluated;
    std::string reason;  ///< a sentence unless it passed
    RowBasis basis = RowBasis::Measured;
    std::string note{};                      ///< what is to be known beside it, as a sentence; may be empty
    double stop_s = kNaN, allowed_s = kNaN;  ///< a trip's times, as TripTrial has them
};

/// A command that was delivered and measured. Commands, not measurements, apart from `reading`.
struct LoadStep {
    double command_v = kNaN;  ///< A of science.md section 4
    double interval_s = kNaN;
    LoadReading reading;
};

/// A command that the limits forbid on this load (or that was refused although they do not).
struct RefusedStep {
    double command_v = kNaN;
    double interval_s = kNaN;
    bool forbidden = false;  ///< predicted over a limit, worst case of the declared load ± 20 %
    bool refused = false;    ///< whether the program refused it
    std::string predicted;   ///< the figure, as "RMS current over 5 s 11.3 mA at 100 ohm, limit 10 mA"
    std::string reason;      ///< the refusal's own sentence
    std::string what{};      ///< what was asked for, if it is not a command
};

/// A command that the device cannot give on this load, by its step or its range: it is only named.
struct UndrivenStep {
    double command_v = kNaN;
    double interval_s = kNaN;
    std::string reason;
};

/// All that was done with one load of the set.
struct LoadRecord {
    std::string name;  ///< the text that parseLoad() reads
    Load load;
    Reading dmm_ohm;     ///< entered by the operator with its standard uncertainty; else not measured
    std::string serial;  ///< the resistor's; may be empty
    std::vector<LoadStep> steps;
    std::vector<RefusedStep> refusals;
    std::vector<UndrivenStep> undriven;
    std::string notApplicable;  ///< why the device can give none of the commands; empty when it can
    std::string problem;        ///< why it was left unfinished; empty when it was not
};

/// Open, short, intermittent contact, silence of the control loop: what must end output by itself.
struct TripTrial {
    std::string name;
    bool evaluated = false;
    bool tripped = false;
    double after_s = std::numeric_limits<double>::quiet_NaN();  ///< from the change to the end of output
    std::string reason;                                         ///< the trip's sentence, or why it was not evaluated
    double stop_s = kNaN;     ///< from the onset of the train that found the change to the end of output; at most
    double allowed_s = kNaN;  ///< from that onset to when the next train was due
};
/// The parts that a full check holds.
inline constexpr std::array<std::string_view, 6> kRequiredTrips = {
    "open", "short", "open while delivering", "short while delivering", "intermittent contact", "dead-man"};

struct LoadSafetyTolerances {
    double load_pct = 5;       ///< measured against the DMM's value, else the nominal one; a current source's voltage
    double resistor_pct = 1;   ///< how far a resistor may lie from its nominal value, where no DMM read it; half-width
    double amplitude_pct = 2;  ///< delivered above commanded; the laboratory's figure (science.md section 9)
    double timing_pct = 1;     ///< phase wider, or interval shorter, than commanded
    double clock_pct = 0.5;    ///< interval of the reference's trains against the computer's clock (choice)
    double imbalance_pct = 1;  ///< net charge of phase charge (hazard H5)
    double imbalanceUncertainty_pct = 0.5;  ///< above it the net charge is not evaluated (hazard H5)
    double area_pct = 5;  ///< uncertainty of the electrode's area, 95 %; a choice, where it was not measured
};

struct LoadSafetyInput {
    std::vector<LimitSet> limits;
    SourceTraits source;
    PulseTrain train;                ///< shape and timing commanded; its amplitude is not looked at
    double command_v = 40;           ///< the largest command, A_max
    double interval_s = 0.5;         ///< at the shortest interval, T_min
    std::optional<double> area_cm2;  ///< without it densities are not evaluated
    Ohms loadLow{500};               ///< the permitted load range, for the extrapolated worst case
    Ohms loadHigh{10'000};
    LoadSafetyTolerances tolerances;
    std::optional<SafetyRow> reference;  ///< the known-reference check
    std::optional<SafetyRow> absolute;   ///< a voltage of known size, where one was read
    std::optional<SafetyRow> time;       ///< judgeTimeReference(), where a reference was read
    std::vector<LoadRecord> loads;
    std::vector<TripTrial> trips;
    /// The strongest train that went into an open circuit, and the command that it was; not measured otherwise.
    std::optional<LoadStep> openCircuit;
};

/// A line of the `loads` of cli.md. NaN: absent.
struct LoadLine {
    std::string name;
    std::string serial;
    double nominal_ohm = std::numeric_limits<double>::quiet_NaN();  ///< |Z| at the end of the leading phase
    Reading measured_ohm;
    LoadReading strongest;  ///< the largest of the steps, for each quantity by itself
    double powerDensity_w_cm2 = std::numeric_limits<double>::quiet_NaN();
    double currentDensity_ma_cm2 = std::numeric_limits<double>::quiet_NaN();
    std::size_t steps = 0;
    std::size_t refused = 0;
    RowVerdict verdict = RowVerdict::NotEvaluated;
};

/// A line of the table that the FDA guidance asks for.
struct DisclosedOutput {
    std::string output;  ///< "maximum output voltage"
    std::string load;    ///< "500 ohm"
    double value = std::numeric_limits<double>::quiet_NaN();
    double expanded = std::numeric_limits<double>::quiet_NaN();      ///< U, in the value's unit
    double expanded_pct = std::numeric_limits<double>::quiet_NaN();  ///< ± % of the value; NaN where U exceeds it
    std::string unit;
    std::string reason;  ///< why it is not evaluated; else empty
};

struct LoadWorstCase {
    double low_ohm = 0, high_ohm = 0;
    Reading amplitudeFactor;  ///< the largest measured / commanded, at least 1
    std::vector<SafetyRow> rows;
    RowVerdict verdict = RowVerdict::NotEvaluated;
};

struct LoadSafety {
    std::vector<LoadLine> loads;
    std::vector<SafetyRow> rows;  ///< every load's, then reference, trips and what is missing
    std::vector<DisclosedOutput> disclosed;
    LoadWorstCase worstCase;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;  ///< sentences; what decided the verdict comes first
};

[[nodiscard]] LoadSafety judgeLoadSafety(const LoadSafetyInput& input);

/// The known-reference check: a known load is measured first. Passes within tolerances.load_pct.
[[nodiscard]] SafetyRow judgeReference(const LoadRecord& record, const LoadSafetyInput& input);
/// The interval of its trains, which the computer's clock hands out: what an oscilloscope whose time base is wrong by
/// more than it states reads wrong, and with it every width and charge.
[[nodiscard]] SafetyRow judgeTimeReference(const LoadRecord& record, const LoadSafetyInput& input);

/// A value against an upper limit with its guard band. NaN in value or U is not evaluated: a value without U proves
/// nothing, on either side of the limit.
[[nodiscard]] RowVerdict judgeUpper(double value, double expanded, double limit, bool strict) noexcept;

/// Fail, then indeterminate, then not evaluated, then the rest: what a group of rows comes to. Rows that are not
/// applicable count for nothing; a group of nothing else is not applicable; an empty group is not evaluated.
[[nodiscard]] RowVerdict summaryOf(const std::vector<RowVerdict>& verdicts) noexcept;

}  // namespace tacto
