// LoadResponse.h - the exact response of a load to a source: voltage and current in closed form, never as Euler steps.
//
// While the source does one thing, voltage and current are a + b·t + c·exp(−t/τ) (for a resistor τ = 0 and c = 0), so
// peaks, charges, ∫i² and energies have closed forms, too. A current source that would exceed its compliance becomes a
// voltage source at its compliance; a voltage source at its current limit becomes a current source. The moment of this
// change is solved for, and the stretch is split there. SI units in plain doubles, as in DriveSegment.
//
// Thread-safety: values and pure functions; nothing allocates.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/electrode/Load.h"

namespace tacto {

/// The curve a + b·t + c·exp(−t/τ); τ is stored in the piece.
struct ExpCurve {
    double a = 0;
    double b = 0;
    double c = 0;
};

/// A stretch in which the source does not reach or leave a limit. Time counts from the beginning of the stretch.
struct ResponsePiece {
    double start_s = 0;  ///< since the start of the segment
    double duration_s = 0;
    double tau_s = 0;      ///< 0: no exponential part
    ExpCurve v;            ///< voltage across the load
    ExpCurve i;            ///< current through it
    bool limited = false;  ///< true if the source is at its compliance or its current limit

    [[nodiscard]] double voltage(double t_s) const noexcept;
    [[nodiscard]] double current(double t_s) const noexcept;
    [[nodiscard]] double charge() const noexcept;          ///< ∫ i dt, C
    [[nodiscard]] double currentSquared() const noexcept;  ///< ∫ i² dt, A²s
    [[nodiscard]] double energy() const noexcept;  ///< ∫ v·i dt, J (energy from the source; negative if it flows back)
    [[nodiscard]] double peakVoltage() const noexcept;  ///< max |v|
    [[nodiscard]] double peakCurrent() const noexcept;  ///< max |i|
};

/// The response to one DriveSegment.
struct SegmentResponse {
    static constexpr std::size_t kMaxPieces = 12;
    std::array<ResponsePiece, kMaxPieces> items{};
    std::size_t count = 0;
    double endCapacitorVoltage = 0;

    /// A view into this object; deleted for a temporary, which `for (… : respond(…).pieces())` would outlive.
    [[nodiscard]] std::span<const ResponsePiece> pieces() const& noexcept { return {items.data(), count}; }
    std::span<const ResponsePiece> pieces() const&& = delete;
    /// Returns the voltage at `t_s` from the segment's start; outside the segment, the value at the nearer end.
    [[nodiscard]] double voltage(double t_s) const noexcept;
    [[nodiscard]] double current(double t_s) const noexcept;
    [[nodiscard]] bool limited() const noexcept;
};

/// Returns the response of `circuit` to `segment`, with the capacitor starting at `capacitorVoltage`. An open
/// circuit carries no current: a voltage source shows its level, a current source its compliance (0 if not stated).
/// The segment's values must be finite and its duration ≥ 0.
[[nodiscard]] SegmentResponse respond(const Circuit& circuit, const DriveSegment& segment, double capacitorVoltage,
                                      const SourceLimits& limits = {}) noexcept;

// What whole pulses do to a load: peaks, charge per phase, charge imbalance, energy (science.md section 7).
//
// Adds up the exact responses over the segments of a pulse. SI units in plain doubles.

/// The part of the pulse to which a segment belongs; a ramp belongs to the phase that it begins or ends.
enum class PulsePart { LeadingPhase, Gap, SecondPhase, Rest };

/// The effects of a pulse on a load; names as in science.md section 7.
struct PulseTotals {
    double peakVoltage_V = 0;
    double peakCurrent_A = 0;
    double leadingCharge_C = 0;      ///< signed ∫i over the leading phase
    double secondCharge_C = 0;       ///< signed ∫i over the second phase
    double netCharge_C = 0;          ///< signed ∫i over all segments added, gap and tail included
    double currentSquared_A2s = 0;   ///< ∫i²
    double energy_J = 0;             ///< ∫v·i over all segments added
    double leadingEndVoltage_V = 0;  ///< at the end of the leading phase
    double leadingEndCurrent_A = 0;
    double endCapacitorVoltage = 0;
    bool limited = false;  ///< true if compliance or current limit was reached

    /// The larger |charge| of the two phases.
    [[nodiscard]] double phaseCharge_C() const noexcept;
    /// |net charge| / phase charge; 0 without charge.
    [[nodiscard]] double imbalance() const noexcept;
    /// |V/I| at the end of the leading phase; infinite without current.
    [[nodiscard]] double impedanceOhm() const noexcept;
};

/// Follows a load through segments in time order; the residual voltage of the capacitor carries over from segment to
/// segment and from pulse to pulse.
class PulseResponse {
public:
    explicit PulseResponse(const Circuit& circuit, const SourceLimits& limits = {},
                           double capacitorVoltage = 0) noexcept;

    /// Adds one segment and returns its response.
    SegmentResponse add(const DriveSegment& segment, PulsePart part) noexcept;
    /// Adds a whole pulse as segmentsOf() makes it (one, two or three segments) and, if its duration is above 0, the
    /// `rest` until the next pulse.
    void addPulse(const PulseSegments& pulse, const DriveSegment& rest) noexcept;

    [[nodiscard]] const PulseTotals& totals() const noexcept { return totals_; }
    [[nodiscard]] double capacitorVoltage() const noexcept { return totals_.endCapacitorVoltage; }
    /// Sets the totals to zero; the capacitor keeps its voltage.
    void restart() noexcept;

private:
    Circuit circuit_;
    SourceLimits limits_;
    PulseTotals totals_;
};

/// Returns the totals of one pulse and the rest after it, starting from rest; a shorthand for previews and limits.
[[nodiscard]] PulseTotals pulseTotals(const Circuit& circuit, const PulseSegments& pulse, const DriveSegment& rest,
                                      const SourceLimits& limits = {}) noexcept;

}  // namespace tacto
