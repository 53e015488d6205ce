// Load.h - what the electrodes are connected to: a resistor, the skin's equivalent circuit, nothing, or a short.
//
// A Load is a value: what an operator declares, what a limit is judged at, what the simulated bench plays.
// Its modifiers (a parallel resistance that falls with intensity, drift, contact that comes and goes) are
// functions of time and pulse without hidden state, so the same question has the same answer. circuitAt()
// turns it into the plain Circuit that core/electrode/LoadResponse.h answers for.
//
// Thread-safety: values and pure functions. Nothing here allocates except text() and parseLoad().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "core/base/DriveSegment.h"
#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto {

enum class LoadKind { Resistor, SkinEquivalent, Open, Short };

/// A short is a wire, not zero: an ideal one would make every current infinite and every check of it void.
inline constexpr double kShortOhms = 0.1;

/// What a source can reach at most. SI units; infinite where nothing is stated.
struct SourceLimits {
    double compliance_V = std::numeric_limits<double>::infinity();
    double current_A = std::numeric_limits<double>::infinity();
};

/// A load at one moment, for arithmetic: series resistance + (parallel resistance ∥ capacitance). SI units.
/// A resistor has parallelOhm = capacitance_F = 0. `open`: the contact is broken (the capacitor keeps its charge
/// and leaks through its own resistance).
struct Circuit {
    double seriesOhm = 0;    ///< above 0
    double parallelOhm = 0;  ///< > 0 with a capacitance
    double capacitance_F = 0;
    bool open = false;
    [[nodiscard]] bool hasCapacitor() const noexcept { return capacitance_F > 0; }
    bool operator==(const Circuit&) const = default;
};

/// Stretches in which contact is lost: [from, to) seconds.
struct OpenWindow {
    double from_s = 0;
    double to_s = 0;
    bool operator==(const OpenWindow&) const = default;
};

struct Load {
    LoadKind kind = LoadKind::Resistor;
    Ohms series{1000};          ///< R, or R_s of the skin equivalent
    Ohms parallel{0};           ///< R_p, SkinEquivalent only
    Nanofarads capacitance{0};  ///< C, SkinEquivalent only

    /// R_p falls with intensity: over a pulse R_p' = R_p / (1 + V / halvingVoltage), V the largest |voltage| that
    /// this pulse would put across the unmodified R_p from rest. 0 = constant R_p.
    Volts halvingVoltage{0};
    /// Resistances drift: R(t) = R (1 + driftPerSecond · t), held within 0.01 to 100 times R.
    double driftPerSecond = 0;
    /// Contact is lost in a seeded pattern: each stretch of kContactCell is open with this probability.
    double openFraction = 0;
    std::uint64_t openSeed = 1;
    std::array<OpenWindow, 4> windows{};
    std::size_t windowCount = 0;

    static constexpr double kContactCell_s = 0.05;

    [[nodiscard]] static Load resistor(Ohms r) noexcept;
    [[nodiscard]] static Load skin(Ohms rs, Ohms rp, Nanofarads c) noexcept;
    [[nodiscard]] static Load openCircuit() noexcept;
    [[nodiscard]] static Load shortCircuit() noexcept;

    /// Text that parseLoad() reads back to the same load, to a part in 10¹²: "500 ohm", "200 ohm + 10 kohm || 50 nF,
    /// drift 0.1 %/s".
    [[nodiscard]] std::string text() const;
    /// Whether contact is broken at `t` seconds (always, for an open load).
    [[nodiscard]] bool isOpenAt(double t_s) const noexcept;
    bool operator==(const Load&) const = default;
};

/// Reads a load: "500 ohm", "1 kohm", "10k", "10 kΩ", "open", "short", "200 ohm + 10 kohm || 50 nF" (also ∥), then
/// any of ", halves at 20 V", ", drift 0.1 %/s", ", open 1.5 s to 1.7 s" (up to four), ", intermittent 5 % seed 3".
/// Errors: InvalidArgument naming the text and what is accepted; resistances 0.1 ohm to 1 Gohm, capacitances 1 pF
/// to 1 mF.
[[nodiscard]] Result<Load> parseLoad(std::string_view text);

struct NamedLoad {
    std::string_view name;  ///< the text that parseLoad() reads
    Load load;
};
/// The bench set of science.md section 6: six resistors from 100 ohm to 100 kohm, open, short, and the RC load.
[[nodiscard]] std::span<const NamedLoad> benchLoads() noexcept;
/// 200 ohm + 10 kohm ∥ 50 nF.
[[nodiscard]] Load benchRcLoad() noexcept;

/// The load with its impedance times `factor` at every frequency (resistances times it, capacitance divided by it, time
/// constants kept). Open and short stay what they are. `factor` > 0.
[[nodiscard]] Load scaled(const Load& load, double factor) noexcept;

/// The load `t_s` after it was fitted. With `pulse`, an intensity-dependent R_p takes that pulse's value.
[[nodiscard]] Circuit circuitAt(const Load& load, double t_s, std::span<const DriveSegment> pulse = {},
                                const SourceLimits& limits = {}) noexcept;

/// Voltage over current at the end of `leadingPhase` from rest, which is what |Z| means here (science.md section 4):
/// the RC load reads 10.2 kΩ from a voltage source and 3.50 kΩ from a current source at 200 µs. Infinite when open
/// or when no current flows.
[[nodiscard]] Ohms effectiveImpedance(const Load& load, const DriveSegment& leadingPhase,
                                      const SourceLimits& limits = {}, double t_s = 0) noexcept;

}  // namespace tacto
