// Capture.h - one record of an oscilloscope, with what is known about it. All measurements start from a capture.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Statistics.h"

namespace tacto {

/// Tolerances are half-widths. NaN: not stated; a result that needs the tolerance is then unknown too (science.md
/// section 12, hazard H9). 0 states that there is no error.
struct CaptureChannel {
    std::string name;  ///< "voltage", "current", or the instrument's own name
    std::string unit;  ///< "V", "A", or "" for logic
    std::vector<float> samples;
    double low = 0;  ///< input range: a sample at or beyond low or high is clipped; low = high: unknown
    double high = 0;
    double lsb = 0;                 ///< resolution, 0 = unknown
    double gainTolerance = kNaN;    ///< relative (0.01 = 1 %)
    double offsetTolerance = kNaN;  ///< in the channel's unit
    double linearityTolerance = 0;  ///< in the channel's unit, for a difference of two levels, in addition to the gain
    double probeTolerance = kNaN;   ///< relative, of the probe or shunt at the input; 0: no probe
    std::string statedBy{};         ///< source of the tolerances: "the data sheet of ..."; empty: not stated
};

struct Capture {
    double rate_hz = 0;
    double start_s = 0;    ///< time of sample 0, in the session's time base
    double trigger_s = 0;  ///< time stamp of the trigger; NaN if the record has no trigger
    /// Amplitude programmed for the train in this capture, in V or mA according to its drive; NaN = not known.
    double programmed = kNaN;
    double timeBaseTolerance = kNaN;  ///< relative half-width (50e-6 = 50 ppm); NaN = not stated
    double stampTolerance_s = kNaN;   ///< half-width of start_s and trigger_s between captures; NaN = not stated
    /// True if all channels have the same gain error (one reference): it cancels when a voltage is divided by a
    /// current. False if that is not known; the gain errors are then treated as independent.
    bool gainShared = false;
    bool simulated = false;
    bool untriggered = false;  ///< taken without a trigger: it shows the signal but no event; trigger_s is NaN
    std::vector<CaptureChannel> channels;  ///< all of the same length
    std::vector<std::string> warnings;     ///< sentences: what the file reader tolerated or guessed

    [[nodiscard]] std::size_t samples() const noexcept {
        return channels.empty() ? 0 : channels.front().samples.size();
    }
};

/// Returns the channel with exactly this name, or null. findChannel() is for names that people type.
[[nodiscard]] inline const CaptureChannel* channelOf(const Capture& capture, std::string_view name) noexcept {
    for (const auto& channel : capture.channels) {
        if (channel.name == name) return &channel;
    }
    return nullptr;
}

}  // namespace tacto
