// Quantity.h - the quantities that limits are written in (science.md section 7), each with the one unit in
// which limit files, exposure tables and refusals give it.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace tacto {

enum class Quantity {
    CommandVoltage,   ///< A of section 4: a voltage source's amplitude, or I·|Z| at the nominal load (V)
    PeakVoltage,      ///< across the load, capped by the source's compliance (V)
    PeakCurrent,      ///< (mA)
    PhaseCharge,      ///< the larger |charge| of either phase (µC)
    NetCharge,        ///< |charge| of one pulse, gap and tail included (µC)
    PulseEnergy,      ///< ∫v·i dt of one pulse (mJ)
    RmsCurrentTrain,  ///< over n / intra-train rate (mA); shown, without a limit
    RmsCurrent1s,     ///< worst sliding second (mA)
    RmsCurrent5s,     ///< worst sliding 5 s (mA): the window of every "mA RMS" limit
    RmsVoltage5s,     ///< worst sliding 5 s (V)
    DcCurrent,        ///< |mean current| over 5 s (mA)
    CurrentDensity,   ///< RmsCurrent5s / electrode area (mA/cm²)
    PowerDensity,     ///< power over the worst second / electrode area (W/cm²)
};
inline constexpr std::size_t kQuantityCount = 13;

/// One value per quantity, each in unitOf() its quantity.
using QuantityValues = std::array<double, kQuantityCount>;
[[nodiscard]] constexpr std::size_t indexOf(Quantity q) noexcept { return static_cast<std::size_t>(q); }

/// As written in limit files: "rms_current_5s".
[[nodiscard]] std::string_view keyOf(Quantity quantity) noexcept;
/// As read by people: "RMS current over 5 s".
[[nodiscard]] std::string_view titleOf(Quantity quantity) noexcept;
/// "V", "mA", "uC", "mJ", "mA/cm2", "W/cm2": plain ASCII, as in files.
[[nodiscard]] std::string_view unitOf(Quantity quantity) noexcept;
/// The averaging window in seconds; 0 for quantities of one pulse.
[[nodiscard]] double windowOf(Quantity quantity) noexcept;
/// True for the density rows, which without an electrode area read "not evaluated".
[[nodiscard]] bool needsArea(Quantity quantity) noexcept;
/// Nothing for an unknown key.
[[nodiscard]] std::optional<Quantity> quantityOf(std::string_view key) noexcept;

}  // namespace tacto
