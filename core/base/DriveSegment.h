// DriveSegment.h - a stretch of time in which a source does one thing. The encoding writes segments, electrode models
// compute the response, the safety gate integrates them, and the twin plays them.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/base/Words.h"

namespace tacto {

enum class Drive { Voltage, Current, HighImpedance };
inline constexpr Word<Drive> kDrives[] = {
    {"voltage", Drive::Voltage}, {"current", Drive::Current}, {"high impedance", Drive::HighImpedance}};
[[nodiscard]] constexpr std::string_view nameOf(Drive drive) noexcept { return wordFor(kDrives, drive); }
/// Returns the unit in which amplitudes of such a source are written and stored.
[[nodiscard]] constexpr const char* amplitudeUnit(Drive drive) noexcept { return drive == Drive::Current ? "mA" : "V"; }

/// The source's level runs from `start` to `end` in a straight line, in volts or amperes as `drive` says. Levels have
/// the sign of the phase. HighImpedance ignores them, since no current flows.
struct DriveSegment {
    Drive drive = Drive::Voltage;
    double start = 0;       ///< V or A
    double end = 0;         ///< V or A
    double duration_s = 0;  ///< > 0
};

/// The segments of one pulse in time order: leading phase, gap (if any), second phase (if any). Never allocates.
struct PulseSegments {
    std::array<DriveSegment, 3> items{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const DriveSegment> span() const noexcept { return {items.data(), count}; }
};

}  // namespace tacto
