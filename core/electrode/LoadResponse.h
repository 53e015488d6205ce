// LoadResponse.h - the exact answer of a load to a source: voltage and current as closed forms, never Euler steps.
//
// Over each stretch in which the source does one thing, voltage and current are a + b·t + c·exp(−t/τ) (τ = 0 for a
// resistor, whose c is 0), so peaks, charges, ∫i² and energies are closed forms too. A current source that would need
// more than its compliance turns into a voltage source at compliance, a voltage source at its current limit into a
// current source; the moment is solved for and the stretch is split there. SI units in plain doubles, as in
// DriveSegment.
//
// Thread-safety: values and pure functions; nothing allocates.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/electrode/Load.h"

namespace tacto {

/// a + b·t + c·exp(−t/τ); τ belongs to the piece.
struct ExpCurve {
    double a = 0;
    double b = 0;
    double c = 0;
};

/// A stretch without a change of regime. Time runs from its own start.
struct ResponsePiece {
    double start_s = 0;  ///< from the start of the segment
    double duration_s = 0;
    double tau_s = 0;      ///< 0: no exponential part
    ExpCurve v;            ///< voltage across the load
    ExpCurve i;            ///< current through it
    bool limited = false;  ///< the source is at its compliance or its current limit

    [[nodiscard]] double voltage(double t_s) const noexcept;
    [[nodiscard]] double current(double t_s) const noexcept;
    [[nodiscard]] double charge() const noexcept;          ///< ∫ i dt, C
    [[nodiscard]] double currentSquared() const noexcept;  ///< ∫ i² dt, A²s
    [[nodiscard]] double energy() const noexcept;  ///< ∫ v·i dt, J (what the source gives; negative when it takes back)
    [[nodiscard]] double peakVoltage() const noexcept;  ///< max |v|
    [[nodiscard]] double peakCurrent() const noexcept;  ///< max |i|
};

/// The answer to one DriveSegment.
struct SegmentResponse {
    static constexpr std::size_t kMaxPieces = 12;
    std::array<ResponsePiece, kMaxPieces> items{};
    std::size_t count = 0;
    double endCapacitorVoltage = 0;

    /// A view into this object: not of a temporary, which `for (… : respond(…).pieces())` would outlive.
    [[nodiscard]] std::span<const ResponsePiece> pieces() const& noexcept { return {items.data(), count}; }
    std::span<const ResponsePiece> pieces() const&& = delete;
    /// The voltage at `t_s` from the segment's start; outside the segment, the value at its nearer end.
    [[nodiscard]] double voltage(double t_s) const noexcept;
    [[nodiscard]] double current(double t_s) const noexcept;
    [[nodiscard]] bool limited() const noexcept;
};

/// The response of `circuit` to `segment`, its capacitor starting at `capacitorVoltage`. An open circuit carries no
/// current: a voltage source shows its level, a current source its compliance (0 when none is stated). The segment's
/// values must be finite and its duration ≥ 0.
[[nodiscard]] SegmentResponse respond(const Circuit& circuit, const DriveSegment& segment, double capacitorVoltage,
                                      const SourceLimits& limits = {}) noexcept;

// What whole pulses do to a load: peaks, charge per phase, imbalance, energy (science.md section 7).
//
// Sums the exact responses of LoadResponse.h over the segments of a pulse. SI units in plain doubles.

/// The part of the pulse that a segment belongs to; a ramp belongs to the phase it leads to or from.
enum class PulsePart { LeadingPhase, Gap, SecondPhase, Rest };

/// What a pulse does to a load: exposure as science.md section 7 names it.
struct PulseTotals {
    double peakVoltage_V = 0;
    double peakCurrent_A = 0;
    double leadingCharge_C = 0;      ///< signed ∫i over the leading phase
    double secondCharge_C = 0;       ///< signed ∫i over the second phase
    double netCharge_C = 0;          ///< signed ∫i over everything added, gap and tail included
    double currentSquared_A2s = 0;   ///< ∫i²
    double energy_J = 0;             ///< ∫v·i over everything added
    double leadingEndVoltage_V = 0;  ///< at the end of the leading phase
    double leadingEndCurrent_A = 0;
    double endCapacitorVoltage = 0;
    bool limited = false;  ///< compliance or current limit was reached

    /// The larger phase's |charge|.
    [[nodiscard]] double phaseCharge_C() const noexcept;
    /// |net charge| / phase charge; 0 without charge.
    [[nodiscard]] double imbalance() const noexcept;
    /// |V/I| at the end of the leading phase; infinite without current.
    [[nodiscard]] double impedanceOhm() const noexcept;
};

/// Follows a load through segments in time order, carrying the capacitor's residual voltage from each to the next and
/// from pulse to pulse.
class PulseResponse {
public:
    explicit PulseResponse(const Circuit& circuit, const SourceLimits& limits = {},
                           double capacitorVoltage = 0) noexcept;

    /// Adds one segment and returns its response.
    SegmentResponse add(const DriveSegment& segment, PulsePart part) noexcept;
    /// Adds a whole pulse as segmentsOf() makes it (one, two or three segments) and, if its duration is above 0, the
    /// `rest` until the next one.
    void addPulse(const PulseSegments& pulse, const DriveSegment& rest) noexcept;

    [[nodiscard]] const PulseTotals& totals() const noexcept { return totals_; }
    [[nodiscard]] double capacitorVoltage() const noexcept { return totals_.endCapacitorVoltage; }
    /// Totals from zero again; the capacitor keeps its voltage.
    void restart() noexcept;

private:
    Circuit circuit_;
    SourceLimits limits_;
    PulseTotals totals_;
};

/// The totals of one pulse and the rest after it, from rest: the shorthand for previews and limits.
[[nodiscard]] PulseTotals pulseTotals(const Circuit& circuit, const PulseSegments& pulse, const DriveSegment& rest,
                                      const SourceLimits& limits = {}) noexcept;

}  // namespace tacto
