// RoughnessChain.h - computes roughness R and pressure P from a fingertip's streams, frame by frame.
//
// Implements science.md sections 2 and 3. The results are equal, bit for bit, for all block sizes: the live bench and a
// whole file use this same class.
//
// Delay. A frame describes the middle of its window, so it is complete half a window (32 ms) after its t_s. It also
// waits for the next force sample, for the interpolation (5 ms at 200 Hz), and for a taxel sample that may be nearer
// (none at 200 Hz). With taxels and no declared baseline, the first 250 ms are held back once, until the baseline is
// known. Frames have no v until the first contact or until a declared baseline has passed. If force or taxels stop,
// frames are held for up to 1.25 s, so a caller that stimulates must check the age of the newest frame and of every
// stream (StreamHealth).
//
// If force more than doubles within a window (a finger landing or lifting), the frame slides only if its vibration,
// with the normalisation undone sample by sample, shows it too. One force for the whole window would turn sensor noise
// into vibration, and static contact must never read as rough (hazard H7).
//
// Force and taxels are converted here to N and Pa, with the scales in the settings for this fingertip; all later steps
// and the flags use the converted units. Scales for another fingertip (by serial number) or another unit of reading are
// ignored and flagged, and R is then uncalibrated too.
//
// Samples that are not finite, or whose stamps repeat or step back, are not used. After a gap or a NaN in acceleration,
// the filter and the windows start again. All of these are counted in the flags.
//
// Thread-safety: none; one owner. feed() does not allocate if `frames` has room.
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

/// Results for one window. NaN means absent.
struct RoughnessFrame {
    double t_s = 0;  ///< centre of the window, in the time of the stamps
    bool contact = false;
    bool sliding = false;
    double h = std::numeric_limits<double>::quiet_NaN();  ///< h or h_abs, according to the settings
    double v = std::numeric_limits<double>::quiet_NaN();  ///< static or dynamic feature, according to the settings
    double R = std::numeric_limits<double>::quiet_NaN();  ///< roughness, 0 to 1
    double pressure_pa = std::numeric_limits<double>::quiet_NaN();
    double P = std::numeric_limits<double>::quiet_NaN();  ///< pressure, 0 to 1
};

/// Sensor readings at rest. The chain measures these itself, unless the rest comes after the frames that need it: then
/// the caller provides the levels.
struct RestLevels {
    std::vector<double> taxelBaseline;  ///< one per taxel, in the unit in use; empty without taxels
    double taxelFloor = 0;              ///< 3 standard deviations of the taxels' mean
    double slidingMeanSquare = std::numeric_limits<double>::quiet_NaN();  ///< see RoughnessSettings; NaN = not known
};

class RoughnessChain {
public:
    /// Errors: InvalidArgument for settings that validate() refuses, two streams of a kind, no stream at all, a rate
    /// outside 100 Hz..20 kHz for acceleration or not positive, fewer than 2 taxels, more than 3 axes, scales of this
    /// fingertip for another number of taxels. `serial`: of the fingertip that gives the samples; empty: unknown.
    [[nodiscard]] static Result<std::unique_ptr<RoughnessChain>> create(std::span<const StreamInfo> streams,
                                                                        const RoughnessSettings& settings,
                                                                        const DeclaredIntervals& declared = {},
                                                                        std::string_view serial = {});
    ~RoughnessChain();
    RoughnessChain(const RoughnessChain&) = delete;
    RoughnessChain& operator=(const RoughnessChain&) = delete;

    /// Takes the next samples, `blocks[i]` for the i-th stream in create(), and appends frames that are now complete.
    /// Streams may run ahead of each other by up to 200 ms between calls.
    void feed(std::span<const SampleBlock> blocks, std::vector<RoughnessFrame>& frames);
    /// Ends the input and appends the frames that were still waiting.
    void finish(std::vector<RoughnessFrame>& frames);
    /// Drops all samples, contact and rest; keeps settings, plans and buffers.
    void reset();

    /// Uses these levels instead of measured ones, also after reset(). For a declared baseline that comes after the
    /// frames that need it.
    void presetRest(const RestLevels& rest);
    /// Returns the levels in use, or null if unknown.
    [[nodiscard]] const RestLevels* rest() const noexcept;

    /// Returns the streams given to create(), in the units in use.
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept;
    /// Whether a stream is converted, that is inUse() does not return its readings as they are.
    [[nodiscard]] bool converts(std::size_t stream) const noexcept;
    /// Converts a reading of one channel to the unit in use.
    [[nodiscard]] double inUse(std::size_t stream, std::size_t channel, double reading) const noexcept;

    /// Returns the flags for the data so far.
    [[nodiscard]] RoughnessFlags flags() const noexcept;

    /// Returns the time between frames when no data are missing.
    [[nodiscard]] double framePeriod_s() const noexcept;

private:
    struct State;
    explicit RoughnessChain(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
