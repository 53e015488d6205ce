// EmulatedOutput.h - the output stage of the emulated stimulator: turns points into voltage and current on a load, in
// closed form, and keeps every pulse with its time.
//
// Thread-safety: none; the emulated stimulator owns this object.
#pragma once

#include <deque>

#include "core/electrode/LoadResponse.h"
#include "drivers/sciencemode/Acks.h"

namespace tacto::sciencemode {

/// One pulse that the device put out.
struct EmittedPulse {
    Instant onset{0};
    Instant end{0};   ///< when its last point ended or it was cut
    int channel = 0;  ///< 0 to 7: 4 × connector + channel
    bool midLevel = false;
    bool cut = false;
    Points points;
    PulseTotals totals;  ///< of the uncut pulse, with current and voltage at the end of the leading phase
};

class EmulatedOutput {
public:
    static constexpr std::size_t kKept = 65'536;

    EmulatedOutput(const Load& load, Volts compliance) : load_(load), compliance_(compliance) {}

    /// Connects this load from now on; its capacitor starts empty.
    void fit(const Load& load, Instant now);
    /// Puts out one pulse at `onset`. `into`, unless null, gets the device's measurement; `stepIsTotal`: its sample
    /// time is the length of all 128 samples.
    const EmittedPulse& play(const Points& points, int channel, bool midLevel, Instant onset, ChannelConfigAck* into,
                             bool stepIsTotal);
    /// Ends the running pulse at `now`.
    void cut(Instant now) noexcept;
    /// True while a pulse is being put out.
    [[nodiscard]] bool active(Instant now) const noexcept;
    [[nodiscard]] bool isOpen(Instant now) const noexcept { return load_.isOpenAt(toSeconds(now - fitted_)); }
    [[nodiscard]] const std::deque<EmittedPulse>& pulses() const noexcept { return pulses_; }

private:
    Load load_;
    const Volts compliance_;
    Instant fitted_{0};
    double capacitor_V_ = 0;  // the load's capacitor voltage at the end of the newest pulse
    std::deque<EmittedPulse> pulses_;
};

}  // namespace tacto::sciencemode
