// Load.h - the load that the electrodes see: a resistor, the skin's equivalent circuit, an open circuit, or a short.
//
// A Load is a value: what an operator declares, what a limit is judged with, what the simulated bench simulates. Its
// modifiers (a parallel resistance that falls with intensity, drift, intermittent contact) depend on time and pulse,
// without hidden state, so the same question gets the same answer. circuitAt() turns a Load into the plain Circuit of
// core/electrode/LoadResponse.h.
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

/// A short is a wire, not 0 ohm: an ideal short would make every current infinite and every check meaningless.
inline constexpr double kShortOhms = 0.1;

/// The most that a source can deliver. SI units; infinite if not stated.
struct SourceLimits {
    double compliance_V = std::numeric_limits<double>::infinity();
    double current_A = std::numeric_limits<double>::infinity();
};

/// A load at one moment, for arithmetic: series resistance + (parallel resistance ∥ capacitance). SI units.
/// A resistor has parallelOhm = capacitance_F = 0. `open`: contact is broken (the capacitor keeps its charge, which
/// leaks through the parallel resistance).
struct Circuit {
    double seriesOhm = 0;    ///< above 0
    double parallelOhm = 0;  ///< > 0 if there is a capacitance
    double capacitance_F = 0;
    bool open = false;
    [[nodiscard]] bool hasCapacitor() const noexcept { return capacitance_F > 0; }
    bool operator==(const Circuit&) const = default;
};

/// A stretch of time without contact: [from, to) in seconds.
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

    /// R_p falls with intensity: over a pulse R_p' = R_p / (1 + V / halvingVoltage), with V the largest |voltage| that
    /// this pulse, from rest, would put across the unmodified R_p. 0 = constant R_p.
    Volts halvingVoltage{0};
    /// Resistances drift: R(t) = R (1 + driftPerSecond · t), limited to 0.01 to 100 times R.
    double driftPerSecond = 0;
    /// Contact is lost in a seeded pattern: openFraction is the probability that a stretch of kContactCell is open.
    double openFraction = 0;
    std::uint64_t openSeed = 1;
    std::array<OpenWindow, 4> windows{};
    std::size_t windowCount = 0;

    static constexpr double kContactCell_s = 0.05;

    [[nodiscard]] static Load resistor(Ohms r) noexcept;
    [[nodiscard]] static Load skin(Ohms rs, Ohms rp, Nanofarads c) noexcept;
    [[nodiscard]] static Load openCircuit() noexcept;
    [[nodiscard]] static Load shortCircuit() noexcept;

    /// Returns a text that parseLoad() reads back as the same load, to a part in 10¹²: "500 ohm", "200 ohm + 10 kohm ||
    /// 50 nF, drift 0.1 %/s".
    [[nodiscard]] std::string text() const;
    /// True if contact is broken at `t` seconds (always for an open load).
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
/// The bench loads of science.md section 6: six resistors from 100 ohm to 100 kohm, open, short, and the RC load.
[[nodiscard]] std::span<const NamedLoad> benchLoads() noexcept;
/// 200 ohm + 10 kohm ∥ 50 nF.
[[nodiscard]] Load benchRcLoad() noexcept;

/// Returns the load with its impedance multiplied by `factor` at every frequency (resistances multiplied, capacitance
/// divided, time constants kept). Open and short are returned unchanged. `factor` > 0.
[[nodiscard]] Load scaled(const Load& load, double factor) noexcept;

/// Returns the load `t_s` after it was connected. With `pulse`, an intensity-dependent R_p is that pulse's.
[[nodiscard]] Circuit circuitAt(const Load& load, double t_s, std::span<const DriveSegment> pulse = {},
                                const SourceLimits& limits = {}) noexcept;

/// Returns |Z| as defined here (science.md section 4): voltage over current at the end of `leadingPhase`, from rest.
/// At 200 µs the RC load has 10.2 kΩ with a voltage source and 3.50 kΩ with a current source. Infinite if open or if no
/// current flows.
[[nodiscard]] Ohms effectiveImpedance(const Load& load, const DriveSegment& leadingPhase,
                                      const SourceLimits& limits = {}, double t_s = 0) noexcept;

}  // namespace tacto
