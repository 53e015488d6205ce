// RoughnessChain.h - from a fingertip's streams to roughness R and pressure P, frame by frame.
//
// Computes science.md sections 2 and 3. The same numbers come out, bit for bit, whatever the block sizes:
// the live bench and a whole file share this one class.
//
// Promptness. A frame describes the middle of its window, so it comes out half a window (32 ms) after its
// t_s, plus the wait for the next force sample, to interpolate towards (5 ms at 200 Hz), and for the taxel
// sample that may be nearer (none, at 200 Hz). With taxels and no declared baseline the first 250 ms are held
// back until the baseline is known, once; before the first contact ends the rest, or a declared baseline has
// passed, frames have no v. When force or taxels stop coming frames are held for up to 1.25 s;
// so a caller that stimulates watches the age of the newest frame and of every stream (StreamHealth).
//
// While force more than doubles within a window (a finger landing or lifting), the frame slides only if its vibration
// with the normalisation undone sample by sample says so too: one force for the whole window would turn the sensor's
// noise into a vibration, and static contact must never read as rough (hazard H7).
//
// Force and taxels are turned into N and Pa here, by the scales that the settings hold for this fingertip; everything
// behind, flags included, sees the units in use. Scales of another fingertip (by serial number) or for readings in
// another unit are left aside and flagged, and R is then uncalibrated too.
//
// Values that are not finite, repeated or stepped back in time are not used; a gap or a NaN in acceleration starts the
// filter and the windows again behind it. All of it is counted and shows among the flags.
//
// Thread-safety: none; one owner. feed() does not allocate, given room in `frames`.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/dsp/RoughnessSettings.h"

namespace tacto {

/// One window's verdict. NaN means absent.
struct RoughnessFrame {
    double t_s = 0;  ///< centre of the window, on the stamps' time base
    bool contact = false;
    bool sliding = false;
    double h = std::numeric_limits<double>::quiet_NaN();  ///< h or h_abs, as the settings say
    double v = std::numeric_limits<double>::quiet_NaN();  ///< static or dynamic, as the settings say
    double R = std::numeric_limits<double>::quiet_NaN();  ///< 0..1
    double pressure_pa = std::numeric_limits<double>::quiet_NaN();
    double P = std::numeric_limits<double>::quiet_NaN();  ///< 0..1
};

/// What the sensors read at rest. Measured by the chain itself; given to it where the rest lies later in a recording
/// than the frames that need it.
struct RestLevels {
    std::vector<double> taxelBaseline;  ///< per taxel, in the unit in use; empty without taxels
    double taxelFloor = 0;              ///< 3 standard deviations of the taxel mean
    double slidingMeanSquare = std::numeric_limits<double>::quiet_NaN();  ///< see RoughnessSettings; NaN = not known
};

class RoughnessChain {
public:
    /// Errors: InvalidArgument for settings that validate() refuses, two streams of a kind, no stream at all, a rate
    /// outside 100 Hz..20 kHz for acceleration or not positive, fewer than 2 taxels, more than 3 axes, scales of
    /// this fingertip for another number of taxels. `serial` is of the fingertip that gives the samples; empty: not
    /// known.
    [[nodiscard]] static Result<std::unique_ptr<RoughnessChain>> create(std::span<const StreamInfo> streams,
                                                                        const RoughnessSettings& settings,
                                                                        const DeclaredIntervals& declared = {},
                                                                        std::string_view serial = {});
    ~RoughnessChain();
    RoughnessChain(const RoughnessChain&) = delete;
    RoughnessChain& operator=(const RoughnessChain&) = delete;

    /// Takes the next samples, `blocks[i]` for the i-th stream given to create(), and appends the frames that are
    /// complete. Streams may run ahead of each other by up to 200 ms between calls.
    void feed(std::span<const SampleBlock> blocks, std::vector<RoughnessFrame>& frames);
    /// No more samples will come: appends the frames that still waited.
    void finish(std::vector<RoughnessFrame>& frames);
    /// Forgets all samples, contact and rest; keeps settings, plans and buffers.
    void reset();

    /// Uses these instead of measuring, reset() included; for a declared baseline that lies behind the frames that need
    /// it.
    void presetRest(const RestLevels& rest);
    /// The levels in use, once they are known.
    [[nodiscard]] const RestLevels* rest() const noexcept;

    /// The streams given to create(), in the units in use.
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept;
    /// A reading of one channel in the unit in use.
    [[nodiscard]] double inUse(std::size_t stream, std::size_t channel, double reading) const noexcept;

    /// What the data so far gave.
    [[nodiscard]] RoughnessFlags flags() const noexcept;

    /// Time between frames where nothing is missing.
    [[nodiscard]] double framePeriod_s() const noexcept;

private:
    struct State;
    explicit RoughnessChain(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
