// Capture.h - a stretch of oscilloscope record. Everything that is measured is measured on this.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Statistics.h"

namespace tacto {

/// Tolerances are half-widths. NaN: not stated, and what is computed from it is not known either (science.md
/// section 12, hazard H9); 0 is a statement too.
struct CaptureChannel {
    std::string name;  ///< "voltage", "current", or the instrument's own
    std::string unit;  ///< "V", "A", or "" for logic
    std::vector<float> samples;
    double low = 0;  ///< the input range: at or beyond low/high a sample is clipped; equal = unknown
    double high = 0;
    double lsb = 0;                 ///< resolution, 0 = unknown
    double gainTolerance = kNaN;    ///< relative (0.01 = 1 %)
    double offsetTolerance = kNaN;  ///< in the channel's unit
    double linearityTolerance = 0;  ///< in the channel's unit, of a difference of two levels, beside the gain
    double probeTolerance = kNaN;   ///< relative, of the probe or shunt before the input; 0: no probe
    std::string statedBy{};         ///< who states the tolerances: "the data sheet of ..."; empty: not stated
};

struct Capture {
    double rate_hz = 0;
    double start_s = 0;    ///< time of sample 0 on the session's time base
    double trigger_s = 0;  ///< time stamp of the trigger; NaN for a record without one
    /// Amplitude that was programmed for the train it shows, V or mA by its drive; NaN = not known.
    double programmed = kNaN;
    double timeBaseTolerance = kNaN;  ///< relative half-width (50e-6 = 50 ppm); NaN = not stated
    double stampTolerance_s = kNaN;   ///< half-width of start_s and trigger_s against other captures'; NaN = not stated
    /// The channels' gain errors are one and the same (one reference for all): they divide out of a voltage over a
    /// current. false: not known to be, and taken as independent of each other.
    bool gainShared = false;
    bool simulated = false;
    bool untriggered = false;  ///< taken because no trigger came: it shows the signal, not an event; trigger_s is NaN
    std::vector<CaptureChannel> channels;  ///< equally long
    std::vector<std::string> warnings;     ///< sentences: what was tolerated or guessed when it was read from a file

    [[nodiscard]] std::size_t samples() const noexcept {
        return channels.empty() ? 0 : channels.front().samples.size();
    }
};

/// The channel of exactly that name; null without one. findChannel() is for names that people type.
[[nodiscard]] inline const CaptureChannel* channelOf(const Capture& capture, std::string_view name) noexcept {
    for (const auto& channel : capture.channels) {
        if (channel.name == name) return &channel;
    }
    return nullptr;
}

}  // namespace tacto
