// Units.h - the physical quantities in public interfaces, as types that cannot be mixed up.
//
// core/base/CMakeLists.txt lists the compiled families of units; each new family costs compile time in every file.
// Durations are std::chrono, sample positions are plain indices of their stream. Use `.value()` only in arithmetic
// kernels, wire protocols, file formats and plots.
#pragma once

#include <chrono>
#include <units.h>

namespace tacto {

using Volts = units::voltage::volt_t;
using Milliamps = units::current::milliampere_t;
using Ohms = units::impedance::ohm_t;
using Nanofarads = units::capacitance::nanofarad_t;
using Hertz = units::frequency::hertz_t;
using SquareCentimetres = units::unit_t<units::squared<units::length::centimeters>>;
using Newtons = units::force::newton_t;
using Pascals = units::pressure::pascal_t;
using Millimetres = units::length::millimeter_t;
using Micrometres = units::length::micrometer_t;
using MillimetresPerSecond =
    units::unit_t<units::compound_unit<units::length::millimeters, units::inverse<units::time::seconds>>>;

using Seconds = std::chrono::duration<double>;
using Micros = std::chrono::duration<double, std::micro>;

/// A moment on the session's only time base: nanoseconds since the session's clock started.
using Instant = std::chrono::nanoseconds;

[[nodiscard]] constexpr double toSeconds(Instant t) noexcept { return Seconds(t).count(); }
/// Rounds to the nearest nanosecond. `s` must be finite and within ± 290 years.
[[nodiscard]] constexpr Instant toInstant(double s) noexcept {
    return Instant(static_cast<Instant::rep>(s * 1e9 + (s < 0 ? -0.5 : 0.5)));
}
[[nodiscard]] constexpr Instant toInstant(Seconds s) noexcept { return toInstant(s.count()); }

}  // namespace tacto
