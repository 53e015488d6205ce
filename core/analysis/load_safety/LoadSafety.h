// LoadSafety.h - checks whether the stimulator's output into a set of bench loads keeps every limit. Turns measured
// trains into rows, tables and one verdict (science.md sections 6, 7 and 9; safety.md).
//
// Promise (hazard H9): nothing unmeasured is shown as passed. The overall verdict is a pass only if every applicable
// row passes. A missing load of the bench set or a missing trip has its own row with "not evaluated". A figure passes
// if value + U keeps the limit, fails if value - U exceeds the limit, and is indeterminate otherwise. U is 95 %.
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
    Indeterminate,      ///< the limit lies within ± U of the value
    NotEvaluated,       ///< it was not measured; this is never a pass
    NotApplicable,      ///< impossible on this device; listed, but does not prevent a pass
    RefusedAsExpected,  ///< the command would exceed a limit on this load, was tried, and was refused
    Attention,          ///< above a figure that requires a warning or a marking; not a fault
};
/// Returns "pass", "fail", "indeterminate", "not evaluated", "not applicable", "refused as expected", "attention".
[[nodiscard]] std::string_view nameOf(RowVerdict verdict) noexcept;

/// Where a row's value comes from: a capture, a command, or a computation.
enum class RowBasis { Measured, Commanded, Computed };
/// Returns "measured", "commanded" or "computed".
[[nodiscard]] std::string_view nameOf(RowBasis basis) noexcept;

/// One judged item of the check.
struct SafetyRow {
    std::string load;   ///< in the form that parseLoad() reads, or the load range; empty for rows without a load
    std::string item;   ///< key of a quantity ("rms_current_5s"), or "load_value", "amplitude_error", "refusal", ...
    std::string title;  ///< title shown to people
    double value = std::numeric_limits<double>::quiet_NaN();
    double expanded = std::numeric_limits<double>::quiet_NaN();  ///< U, in the value's unit
    double limit = std::numeric_limits<double>::quiet_NaN();
    std::string unit;
    std::string set;     ///< id of the limit set; "laboratory" for this program's own limits
    std::string source;  ///< document and clause
    RowVerdict verdict = RowVerdict::NotEvaluated;
    std::string reason;  ///< a full sentence, unless the row passed
    RowBasis basis = RowBasis::Measured;
    std::string note{};                      ///< additional information as a sentence; may be empty
    double stop_s = kNaN, allowed_s = kNaN;  ///< times of a trip, as in TripTrial
};

/// A command that was delivered and measured. Only `reading` is measured; the other members state the command.
struct LoadStep {
    double command_v = kNaN;  ///< commanded amplitude (A in science.md section 4)
    double interval_s = kNaN;
    LoadReading reading;
};

/// A command that the limits forbid on this load, or that was refused although they allow it.
struct RefusedStep {
    double command_v = kNaN;
    double interval_s = kNaN;
    bool forbidden = false;  ///< true if a prediction exceeds a limit, in the worst case of the declared load ± 20 %
    bool refused = false;    ///< true if the program refused the command
    std::string predicted;   ///< the predicted figure: "RMS current over 5 s 11.3 mA at 100 ohm, limit 10 mA"
    std::string reason;      ///< the sentence with which the program refused
    std::string what{};      ///< what was requested, if not a command
};

/// A command that the device cannot deliver on this load because of its step or range. It is only listed.
struct UndrivenStep {
    double command_v = kNaN;
    double interval_s = kNaN;
    std::string reason;
};

/// Everything that was done with one load of the set.
struct LoadRecord {
    std::string name;  ///< the text that parseLoad() reads
    Load load;
    Reading dmm_ohm;     ///< meter reading by the operator, with its standard uncertainty; else not measured
    std::string serial;  ///< serial number of the resistor; may be empty
    std::vector<LoadStep> steps;
    std::vector<RefusedStep> refusals;
    std::vector<UndrivenStep> undriven;
    std::string notApplicable;  ///< why the device can deliver none of the commands; otherwise empty
    std::string problem;        ///< why the load was left unfinished; otherwise empty
};

/// One test that output ends by itself: open or short circuit, intermittent contact, or a silent control loop.
struct TripTrial {
    std::string name;
    bool evaluated = false;
    bool tripped = false;
    double after_s = std::numeric_limits<double>::quiet_NaN();  ///< from the change to the end of output
    std::string reason;                                         ///< the trip's message, or why it was not evaluated
    double stop_s = kNaN;     ///< from the onset of the detecting train to the end of output; upper bound
    double allowed_s = kNaN;  ///< from the same onset to the time when the next train is due
};
/// The trips that a complete check contains.
inline constexpr std::array<std::string_view, 6> kRequiredTrips = {
    "open", "short", "open while delivering", "short while delivering", "intermittent contact", "dead-man"};

struct LoadSafetyTolerances {
    double load_pct = 5;       ///< load value against the DMM, else the nominal one; also a current source's voltage
    double resistor_pct = 1;   ///< half-width of the tolerance around the nominal value, used without a DMM value
    double amplitude_pct = 2;  ///< delivered amplitude above the command; laboratory's figure (science.md section 9)
    double timing_pct = 1;     ///< phase wider, or interval shorter, than commanded
    double clock_pct = 0.5;    ///< the reference's train interval against the computer's clock (choice)
    double imbalance_pct = 1;  ///< net charge as a share of the phase charge (hazard H5)
    double imbalanceUncertainty_pct = 0.5;  ///< with a larger uncertainty the net charge is not evaluated (hazard H5)
    double area_pct = 5;                    ///< uncertainty of an electrode area that was not measured, 95 % (choice)
};

struct LoadSafetyInput {
    std::vector<LimitSet> limits;
    SourceTraits source;
    PulseTrain train;                ///< commanded shape and timing; its amplitude is ignored
    double command_v = 40;           ///< the largest command, A_max
    double interval_s = 0.5;         ///< the shortest interval, T_min
    std::optional<double> area_cm2;  ///< electrode area; if absent, densities are not evaluated
    Ohms loadLow{500};               ///< the permitted load range, for the extrapolated worst case
    Ohms loadHigh{10'000};
    LoadSafetyTolerances tolerances;
    std::optional<SafetyRow> reference;  ///< the known-reference check
    std::optional<SafetyRow> absolute;   ///< check against a known voltage, if one was measured
    std::optional<SafetyRow> time;       ///< judgeTimeReference(), if a reference was measured
    std::vector<LoadRecord> loads;
    std::vector<TripTrial> trips;
    /// The strongest train delivered into an open circuit, with its command; otherwise empty.
    std::optional<LoadStep> openCircuit;
};

/// One entry of `loads` in cli.md. NaN means absent.
struct LoadLine {
    std::string name;
    std::string serial;
    double nominal_ohm = std::numeric_limits<double>::quiet_NaN();  ///< |Z| at the end of the leading phase
    Reading measured_ohm;
    LoadReading strongest;  ///< for each quantity the largest value of all steps
    double powerDensity_w_cm2 = std::numeric_limits<double>::quiet_NaN();
    double currentDensity_ma_cm2 = std::numeric_limits<double>::quiet_NaN();
    std::size_t steps = 0;
    std::size_t refused = 0;
    RowVerdict verdict = RowVerdict::NotEvaluated;
};

/// One line of the outputs to disclose: the table that the FDA guidance asks for, and the RMS current of the marking in
/// IEC 60601-2-10.
struct DisclosedOutput {
    std::string output;  ///< "maximum output voltage"
    std::string load;    ///< "500 ohm"
    double value = std::numeric_limits<double>::quiet_NaN();
    double expanded = std::numeric_limits<double>::quiet_NaN();      ///< U, in the value's unit
    double expanded_pct = std::numeric_limits<double>::quiet_NaN();  ///< U in ± % of the value; NaN if U is larger
    std::string unit;
    std::string reason;  ///< why the output is not evaluated; otherwise empty
};

struct LoadWorstCase {
    double low_ohm = 0, high_ohm = 0;
    Reading amplitudeFactor;  ///< the largest ratio measured / commanded, at least 1
    std::vector<SafetyRow> rows;
    RowVerdict verdict = RowVerdict::NotEvaluated;
};

struct LoadSafety {
    std::vector<LoadLine> loads;
    std::vector<SafetyRow> rows;  ///< rows of every load, then of the reference and the trips, then missing items
    std::vector<DisclosedOutput> disclosed;
    LoadWorstCase worstCase;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;  ///< sentences; the deciding reasons come first
};

[[nodiscard]] LoadSafety judgeLoadSafety(const LoadSafetyInput& input);

/// Judges the known-reference check: a known load is measured first and must be within tolerances.load_pct.
[[nodiscard]] SafetyRow judgeReference(const LoadRecord& record, const LoadSafetyInput& input);
/// Compares the interval of the reference's trains with the computer's clock. It reveals an oscilloscope time base with
/// a larger error than stated, which would falsify every width and charge.
[[nodiscard]] SafetyRow judgeTimeReference(const LoadRecord& record, const LoadSafetyInput& input);

/// Compares a value with an upper limit, using U as a guard band. If value or U is NaN, the result is not evaluated: a
/// value without U proves nothing on either side of the limit.
[[nodiscard]] RowVerdict judgeUpper(double value, double expanded, double limit, bool strict) noexcept;

/// Returns the worst verdict of a group: fail, then indeterminate, then not evaluated, then the rest. Rows that are not
/// applicable are ignored; if all rows are, so is the group. An empty group is not evaluated.
[[nodiscard]] RowVerdict summaryOf(const std::vector<RowVerdict>& verdicts) noexcept;

}  // namespace tacto
