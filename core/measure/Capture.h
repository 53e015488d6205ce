// Capture.h - a stretch of oscilloscope record. Everything that is measured is measured on this.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace tacto {

struct CaptureChannel {
    std::string name;  ///< "voltage", "current", or the instrument's own
    std::string unit;  ///< "V", "A", or "" for logic
    std::vector<float> samples;
    double low = 0;  ///< the input range: at or beyond low/high a sample is clipped; equal = unknown
    double high = 0;
    double lsb = 0;              ///< resolution, 0 = unknown
    double gainTolerance = 0;    ///< half-width, relative (0.01 = 1 %); 0 = unknown
    double offsetTolerance = 0;  ///< half-width, in the channel's unit
};

struct Capture {
    double rate_hz = 0;
    double start_s = 0;    ///< time of sample 0 on the session's time base
    double trigger_s = 0;  ///< time stamp of the trigger; NaN for a record without one
    /// Amplitude that the stimulator was told for the train it shows, V or mA by its drive; NaN = not known.
    double told = std::numeric_limits<double>::quiet_NaN();
    bool simulated = false;
    bool untriggered = false;  ///< taken because no trigger came: it shows the signal, not an event; trigger_s is NaN
    std::vector<CaptureChannel> channels;  ///< equally long
    std::vector<std::string> warnings;     ///< sentences: what was tolerated or guessed when it was read from a file

    [[nodiscard]] std::size_t samples() const noexcept {
        return channels.empty() ? 0 : channels.front().samples.size();
    }
};

}  // namespace tacto
