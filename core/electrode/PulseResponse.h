// PulseResponse.h - what whole pulses do to a load: peaks, charge per phase, imbalance, energy (science.md section 7).
//
// Sums the exact responses of LoadResponse.h over the segments of a pulse. SI units in plain doubles.
//
// Thread-safety: values and pure functions; nothing allocates.
#pragma once

#include "core/electrode/LoadResponse.h"

namespace tacto {

/// Where in the pulse a segment belongs; a ramp belongs to the phase it leads to or from.
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

/// One pulse and the rest after it, from rest: the shorthand for previews and limits.
[[nodiscard]] PulseTotals pulseTotals(const Circuit& circuit, const PulseSegments& pulse, const DriveSegment& rest,
                                      const SourceLimits& limits = {}) noexcept;

}  // namespace tacto
