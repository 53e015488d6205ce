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
    /// At `t_s` from the segment's start; held at the ends outside it.
    [[nodiscard]] double voltage(double t_s) const noexcept;
    [[nodiscard]] double current(double t_s) const noexcept;
    [[nodiscard]] bool limited() const noexcept;
};

/// The response of `circuit` to `segment`, its capacitor starting at `capacitorVoltage`. An open circuit carries no
/// current: a voltage source shows its level, a current source its compliance (0 when none is stated). The segment's
/// values must be finite and its duration ≥ 0.
[[nodiscard]] SegmentResponse respond(const Circuit& circuit, const DriveSegment& segment, double capacitorVoltage,
                                      const SourceLimits& limits = {}) noexcept;

}  // namespace tacto
