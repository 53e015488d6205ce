// ClockLine.h - brings a stream's stamps onto the recorder's clock, from the offsets that were measured meanwhile.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tacto::xdf {

struct ClockOffset {
    double at_s;      ///< when it was measured, on the stream's clock
    double offset_s;  ///< the recorder's clock less the stream's
};

/// The offset at time t is offset_s + drift * (t - at_s).
struct ClockLine {
    double at_s = 0, offset_s = 0, drift = 0;
    [[nodiscard]] double onRecorder(double t_s) const noexcept { return t_s + offset_s + drift * (t_s - at_s); }
};

/// Returns the line with the least sum of Huber's loss, which is quadratic up to 0.1 ms and linear beyond, so that a
/// few offsets measured while the network was busy do not turn it. One offset, or several of one moment, give their
/// median without drift; none gives 0. Offsets that are not finite are left out.
[[nodiscard]] ClockLine fitClock(std::span<const ClockOffset> offsets);

// The offsets of both functions are finite, and so are their differences.

/// Returns the index of the first offset after which the stream's clock was reset (its computer was restarted): the
/// time of the next offset goes back, or both time and offset step out of all proportion (by more than 5 s and 5 median
/// deviations, and 1 s and 10), as pyxdf has it.
[[nodiscard]] std::optional<std::size_t> clockReset(std::span<const ClockOffset> offsets);

/// Whether the last offset stands apart, more than ten times as far as usual in time or in value: what LabRecorder
/// writes when an outlet ends under an inlet (labstreaminglayer/pylsl#67, sccn/liblsl#246).
[[nodiscard]] bool lastOffsetIsStray(std::span<const ClockOffset> offsets);

}  // namespace tacto::xdf
